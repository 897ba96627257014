"""Assessments of a robot and its cables: what is odd about its file, which tolerances to tighten, how reliably
its pose is found, what its cables dissipate.

>>> import cdpr
>>> for finding in cdpr.assess.check(cdpr.Robot.from_file("four-cables")):
...     print(finding.severity, finding.field, finding.value)
note cables 4 for 6 free motions
"""

from __future__ import annotations

from .cables import LoadCycle, Moduli, hysteresis, linear_density, modulus
from .friction import FrictionFit, pulley_friction
from .robots import Finding, Robustness, ToleranceBudget, check, robustness, tolerances

__all__ = [
    "Finding",
    "FrictionFit",
    "LoadCycle",
    "Moduli",
    "Robustness",
    "ToleranceBudget",
    "check",
    "hysteresis",
    "linear_density",
    "modulus",
    "pulley_friction",
    "robustness",
    "tolerances",
]
