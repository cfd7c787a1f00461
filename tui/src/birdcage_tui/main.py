"""The entry point: arguments first, heavy imports after, the last line on stdout says where the dish is."""

from __future__ import annotations

import argparse
import gc
import os
import sys
from collections.abc import Sequence


class _Version(argparse.Action):
    """Prints the version; finding that out takes longer than all else here, so only when it is asked for."""

    def __call__(self, parser: argparse.ArgumentParser, *_given: object) -> None:
        from importlib.metadata import version

        print(f"birdcage-tui {version('birdcage-tui')}")
        parser.exit()


def parser() -> argparse.ArgumentParser:
    """Return the command line's description."""
    parse = argparse.ArgumentParser(
        prog="birdcage-tui", description="A ground station in a terminal: points, follows and listens with a dish."
    )
    parse.add_argument("--demo", action="store_true", help="drive a simulated dish; nothing of yours is touched")
    parse.add_argument("--port", help="serial port or URL: /dev/ttyUSB0, COM4, socket://host:port, sim:g2")
    parse.add_argument(
        "--firmware",
        help="the dish's console: g2 (Carryout G2) or hal205 (Trav'ler with HAL 2.05); by default it is asked",
    )
    parse.add_argument("--baud", type=int, help="baud rate, when it is not the dialect's own")
    parse.add_argument("--speed", type=float, help="run the simulated dish this many times faster; only with --demo")
    parse.add_argument("--theme", choices=("dusk", "daylight", "night"), help="the look; T changes it")
    parse.add_argument(
        "--glyphs", choices=("braille", "block", "ascii"), help="what is drawn with; by default what the terminal takes"
    )
    parse.add_argument("--skip-init", action="store_true", help="do not wait for the dish to boot, and change nothing")
    parse.add_argument("--config", help="another birdcage.toml")
    parse.add_argument("--version", action=_Version, nargs=0, help="print the version and leave")
    return parse


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the app. Return its exit status: 0, 1 for an error, 2 for wrong use, 128 + n for a signal."""
    parse = parser()
    options = parse.parse_args(arguments)
    if options.speed is not None and not options.demo:
        parse.error("--speed goes with --demo only: a real dish has its own speed")
    if options.demo and options.port:
        parse.error("--demo has its own dish: leave --port out")
    if not (sys.stdin.isatty() and sys.stdout.isatty()):
        parse.error("birdcage-tui needs a terminal; `birdcage status --json` is for scripts")
    # Textual waits this long to tell Esc from the start of a sequence, but looks every 100 ms: so 60 makes 100.
    os.environ.setdefault("ESCDELAY", "60")
    # A thread that waits behind a painting one wakes within a millisecond (SEAMS, Threads).
    sys.setswitchinterval(0.001)

    # What is made up to the first frame stays: looking through it for garbage would only hold that frame up.
    gc.disable()
    from birdcage_tui.run import run

    status = run(options)
    # The rest goes with the process: looking through all of it for garbage first takes a quarter of the quitting.
    gc.freeze()
    return status


if __name__ == "__main__":
    raise SystemExit(main())
