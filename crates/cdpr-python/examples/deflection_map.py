"""Where CAROCA gives how much under 50 kg. `python deflection_map.py robot.json [figure.svg]`"""

import sys

import matplotlib.pyplot as plt
import numpy as np

import cdpr

robot = cdpr.Robot.from_file(sys.argv[1])
found = robot.workspace(plane=("z", 1.75), grid=(81, 41), payload=50)
count_x, count_y = found.shape[:2]
x, y, _ = found.positions.reshape(count_x, count_y, 3).transpose(2, 0, 1)
held = np.array(found.status) == "held"
deflection_mm = np.where(held, 1e3 * found.magnitude, np.nan).reshape(count_x, count_y)

figure, axes = plt.subplots(figsize=(7, 4))
colours = axes.pcolormesh(x, y, deflection_mm)
figure.colorbar(colours, label="deflection [mm]")
axes.set(xlabel="x [m]", ylabel="y [m]", aspect="equal", title=f"{robot.name} under 50 kg at z = 1.75 m")
figure.savefig(sys.argv[2] if len(sys.argv) > 2 else "deflection.svg")
