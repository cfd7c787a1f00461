"""The command line. `main` is the console script; a command's module is loaded when that command is run."""

from __future__ import annotations

import io
import sys

from birdcage.base.signals import interrupt_quits


def main() -> None:
    """Run `birdcage` with the arguments of this process; ends it with one of `birdcage.cli.exits`."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):  # a terminal without a degree sign is no reason to tell nothing
            stream.reconfigure(errors="replace")
    try:
        with interrupt_quits():
            from birdcage.cli.app import cli
        cli(prog_name="birdcage")
    except KeyboardInterrupt:  # before there was anything to stop
        raise SystemExit(130) from None
