"""Prints the seconds for 10^5 direct solves in one call, and the sum of all heights.

Each solve starts 1 cm away along each axis. It measures the same as `cargo run --release -p cdpr-statics
--example direct_batch`.

python crates/cdpr-python/benches/direct_batch.py, at the root of the repository
"""

import statistics
import time

import numpy as np

import cdpr

robot = cdpr.Robot.from_file("data/robots/caroca.json")
k = np.arange(100_000)


def share(step):
    return (k * step) % 1.0 - 0.5


poses = np.column_stack(
    [2.0 * share(0.7548776662466927), share(0.5698402909980532), 1.75 + 0.5 * share(0.25)]
)
lengths = robot.inverse(poses).lengths
times = []
for _ in range(5):
    clock = time.perf_counter()
    found = robot.direct(lengths, start=poses + 0.01)
    times.append(time.perf_counter() - clock)
    print(f"{times[-1]:.3f} s, {sum(found.position[:, 2].tolist())}, {found.least_stiffness[0]}")
print(f"median {statistics.median(times):.3f} s")
