"""Exceptions of the package. Messages name the field, its value, and what would be right."""

from __future__ import annotations


class CdprError(Exception):
    """Base class of all exceptions of the package."""


class InputError(CdprError, ValueError):
    """An invalid value; the message names the field, the value, and what would be right."""


class FileError(CdprError, OSError):
    """A file or folder that cannot be read, written or used."""


class FaultError(CdprError, RuntimeError):
    """A fault of the package itself, which should be reported with the call that raises it."""


class NoSolutionError(CdprError):
    """A question without an answer, such as a pose that no tensions can hold.

    ``kind`` names the kind of failure as tables of studies do: ``infeasible_tension``,
    ``cable_overstrained``, ``branch_ends`` where the platform falls before the whole load is on it, ...
    """

    def __init__(self, message: str, kind: str = "") -> None:
        super().__init__(message, kind)
        self.kind = kind

    def __str__(self) -> str:
        return str(self.args[0])
