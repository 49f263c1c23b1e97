"""The command ``unwrapd``: as a script, as ``python -m unwrapd``, and as the child that the service starts for each job."""

from __future__ import annotations

import os
import signal
import sys

if not __package__:
    # Started by path, in an interpreter that knows no installed package: see `CHILD`.
    sys.path.append(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))

from unwrapd import _native

# The arguments of an interpreter that is a child. It takes nothing from the environment, and loads nothing but this package.
CHILD = ["-I", "-S", os.path.abspath(__file__)]


def main() -> int:
    """Runs the arguments of this process; its exit status."""
    if not hasattr(_native, "run_command"):
        sys.exit("unwrapd: this system has the Python package only, not the command")
    # Signals do what they do to any program: the command handles some itself.
    for number in (signal.SIGINT, signal.SIGXFSZ):
        signal.signal(number, signal.SIG_DFL)
    arguments = ["unwrapd", *sys.argv[1:]]
    return _native.run_command(arguments, sys.executable, CHILD, _native.__file__)


if __name__ == "__main__":
    sys.exit(main())
