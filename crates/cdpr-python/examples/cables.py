"""The shape of a cable as it is reeled in: slack, then taut. `python cables.py [figure.svg]`"""

import sys

import matplotlib.pyplot as plt
import numpy as np

import cdpr

lengths = np.array([6.2, 5.6, 5.2, 5.05, 5.0])
cables = cdpr.catenary(0.9957, 1.28e6, length=lengths, end=[4.8, 1.6])

figure, axes = plt.subplots(figsize=(7, 4))
for length, shape, tension in zip(lengths, cables.shape, cables.anchor_tension):
    axes.plot(*shape.T, label=f"{length:.2f} m, {tension:.1f} N at the platform")
axes.set(xlabel="x [m]", ylabel="z [m]", aspect="equal", title="A steel cable of 4 mm between two points")
axes.legend()
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "cables.svg")
