"""The program cdpr: `python -m cdpr`, and the command that the wheel installs."""

import signal
import sys

from ._core import run_program


def main() -> int:
    """Runs the program with the arguments of this process, and returns its exit code."""
    # Ctrl-C ends it as it ends any program, without an exception of Python.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    return run_program(["cdpr", *sys.argv[1:]])


if __name__ == "__main__":
    sys.exit(main())
