"""Calibration: from measurements to a better robot, and to the accuracy that is left.

Nothing is written unless a call is given a folder or file; then the files are those of `cdpr calibrate fit`, byte for
byte.

>>> import cdpr
>>> robot = cdpr.Robot.from_file("cogiro")
>>> tolerances = {"a": 0.002}  # [m]
>>> noise = {"position": 1e-4, "rotation": 1e-4, "length": 1e-4}
>>> poses = [[x, y, z] for x in (-2, 0, 2) for y in (-1, 1) for z in (1.5, 2.5)]
>>> campaign = cdpr.calibration.simulate(robot, poses, uncertainty=tolerances, noise=noise)
>>> found = cdpr.calibration.calibrate(robot, campaign.measurements, uncertainty=tolerances, noise=noise)
>>> error = found.robot.anchor_points - campaign.robot.anchor_points
>>> bool(abs(error).max() < 2e-3)
True
"""

from __future__ import annotations

from .campaigns import Campaign, simulate
from .fitting import Calibrated, Residuals, calibrate
from .planning import Combination, Identified, Plan, Quality, identify, plan
from .pulleys import PulleyCalibration, calibrate_pulleys

__all__ = [
    "Calibrated",
    "Campaign",
    "Combination",
    "Identified",
    "Plan",
    "PulleyCalibration",
    "Quality",
    "Residuals",
    "calibrate",
    "calibrate_pulleys",
    "identify",
    "plan",
    "simulate",
]
