"""The entry point: arguments first, heavy imports after, the last line on stdout says where the dish is."""

from __future__ import annotations

import gc
import io
import os
import sys
from collections.abc import Sequence
from typing import TYPE_CHECKING

from birdcage.base.signals import interrupt_quits

if TYPE_CHECKING:
    import argparse

EPILOG = (
    "Exit status: 0 normal end, 1 could not start (the reason is printed), 2 wrong command line, 70 internal error. "
    "128 + n: ended by signal n (129: the terminal was closed). If the dish moves, STOP goes out before the app ends."
)


def parser() -> argparse.ArgumentParser:
    """Return the command line's description."""
    import argparse

    class Version(argparse.Action):
        """Prints the version; finding that out takes longer than all else here, so only when it is asked for."""

        def __call__(self, parser: argparse.ArgumentParser, *_given: object) -> None:
            from importlib.metadata import version

            print(f"birdcage-tui {version('birdcage-tui')}")
            parser.exit()

    class Help(argparse.Action):
        """Prints the help; which machines there are is looked up only when it is asked for."""

        def __call__(self, parser: argparse.ArgumentParser, *_given: object) -> None:
            from birdcage.station.known import list_models

            known = ", ".join(f"{model.firmware} ({model.name})" for model in list_models())
            firmware.help = f"the dish's console: {known}; default: ask the dish".replace("%", "%%")
            parser.print_help()
            parser.exit()

    parse = argparse.ArgumentParser(
        prog="birdcage-tui",
        description="A ground station in a terminal: points, follows and listens with a dish.",
        epilog=EPILOG,
        add_help=False,
    )
    parse.add_argument("-h", "--help", action=Help, nargs=0, help="show this help and exit")
    parse.add_argument("--demo", action="store_true", help="use a simulated dish; your files stay untouched")
    parse.add_argument("--port", help="serial port or URL: /dev/ttyUSB0, COM4, socket://host:port, sim:NAME")
    firmware = parse.add_argument("--firmware", help="the dish's console; default: ask the dish")
    parse.add_argument("--baud", type=int, help="baud rate; default: that of the dish")
    parse.add_argument(
        "--also", metavar="FILE", help="drive a second dish, by a birdcage.toml of its own; with --demo, its firmware"
    )
    parse.add_argument("--speed", type=float, help="run the simulated dish this many times faster; only with --demo")
    parse.add_argument("--theme", choices=("dusk", "daylight", "night"), help="theme; T changes it in the app")
    parse.add_argument(
        "--glyphs", choices=("braille", "block", "ascii"), help="glyph set; default: what the terminal supports"
    )
    parse.add_argument("--skip-init", action="store_true", help="don't wait for the dish to boot; change no settings")
    parse.add_argument("--config", help="use another birdcage.toml")
    parse.add_argument("--log", metavar="FILE", help="write decisions and every exchange to FILE; older files are kept")
    parse.add_argument("--version", action=Version, nargs=0, help="print the version and exit")
    return parse


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the app. Return its exit status, as `EPILOG` tells."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):  # a terminal without a degree sign is no reason to tell nothing
            stream.reconfigure(errors="replace")
    with interrupt_quits():
        options = _options(arguments)
        # Textual waits this long to tell Esc from the start of a sequence.
        os.environ.setdefault("ESCDELAY", "60")
        # A thread that waits behind a painting one wakes within a millisecond.
        sys.setswitchinterval(0.001)

        # What is made up to the first frame stays: looking through it for garbage would only hold that frame up.
        gc.disable()
        from birdcage_tui.run import EXIT_FAULT, run

        try:
            status = run(options)
        except Exception:  # noqa: BLE001 - the exit status has to say that it was a fault of ours
            import traceback

            traceback.print_exc()
            return EXIT_FAULT
        # The rest goes with the process: looking through all of it for garbage first takes a quarter of the quitting.
        gc.freeze()
        return status


def _options(arguments: Sequence[str] | None) -> argparse.Namespace:
    """Return the options; SystemExit 2 with a sentence where they make no sense."""
    parse = parser()
    options = parse.parse_args(arguments)
    if options.speed is not None and not options.demo:
        parse.error("--speed needs --demo. A real dish has its own speed.")
    if options.demo and options.port:
        parse.error("--demo brings its own dish. Leave out --port.")
    if not (sys.stdin.isatty() and sys.stdout.isatty()):
        parse.error("birdcage-tui needs a terminal. Scripts can use `birdcage status --json`.")
    return options


if __name__ == "__main__":
    raise SystemExit(main())
