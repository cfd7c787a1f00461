"""The group `birdcage`: what there is, loaded when it is run, and what errors end as."""

from __future__ import annotations

import os
from importlib import import_module
from keyword import iskeyword
from typing import Any

import click

from birdcage.base.signals import interrupt_quits
from birdcage.base.text import clean
from birdcage.cli import exits
from birdcage.cli.exits import EndedBySignal
from birdcage.cli.options import global_options
from birdcage.cli.say import drop_stdout, say

COMMANDS = {
    "init": "Wait for the dish to boot; look at its TV search, and switch it.",
    "pos": "Print where the dish points.",
    "move": "Point the dish, and wait until it is there.",
    "stop": "Stop the dish, whatever program drives it.",
    "hold": "Stop the dish, and keep every program from moving it.",
    "release": "Let programs move the dish again.",
    "sync": "Sync a rotator that has no reference: say where it points.",
    "home": "Home the dish: run into the end stops to find the reference.",
    "setup": "Go from wires to the first satellite, step by step.",
    "serve": "Drive the dish for Gpredict, SatNOGS, SatDump and others, over the network.",
    "station": "Drive the dish without a face, for programs that attach.",
    "status": "Print the state of the dish.",
    "health": "Show what needs attention, most urgent first, and what to do.",
    "events": "Print what happens to the dish, as the program that drives it reports.",
    "detect": "Find out which firmware answers on the port, with the evidence.",
    "ports": "List the serial ports of this machine.",
    "wiring": "Print which wire goes where, and which adapters work.",
    "sim": "Simulate a dish that any program can talk to.",
    "elements": "Keep the orbital elements of satellites: add, update, list, check, search.",
    "place": "Say where the dish stands: places, GPS, horizon.",
    "clock": "Check whether this machine's clock can be trusted.",
    "where": "Show where a satellite, a body or a slot is.",
    "sky": "List what is up now.",
    "passes": "List passes, and when this dish can follow them.",
    "autotrack": "Show which passes of favourites would be followed, and why others are left out.",
    "track": "Follow a target with the dish, or show the plan.",
    "log": "List followed passes, and how well each went.",
    "downlinks": "List downlinks, and which of them your feed can hear.",
    "if": "Compute the frequency behind a converter, and which receivers tune to it.",
    "ready": "Check what is missing before you leave home.",
    "facts": "List what is known of this dish, with units and sources.",
    "features": "List what this dish reports, and what you can set.",
    "get": "Read features of the dish.",
    "set": "Set a feature of the dish.",
    "nvs": "Read, change, save and restore the settings that the dish keeps itself.",
    "rssi": "Print the signal strength, as often as it is told.",
    "levels": "Make decibels of counts by two levels that you know.",
    "peak": "Find the peak of a satellite by its signal, and point there.",
    "sweep": "Measure the signal along an axis, and fit a beam to it.",
    "on-off": "Compare the signal of a source with the sky beside it.",
    "drift": "Let a source drift through the beam, and measure the beam.",
    "step-track": "Stay on an inclined satellite by its signal.",
    "acquire": "Find a satellite near where it should be, say which it is, and set north by it.",
    "scan": "Make a map of the sky.",
    "recordings": "List recordings of the signal, and print one as CSV.",
    "maps": "List maps of the sky, and see what one teaches.",
    "export": "Write maps of the sky into files for other programs.",
    "gear": "Show this dish's play and overshoot, set the play, or forget both.",
    "motors": "Test the motors: measure speed and acceleration, watch for stalls; or run one.",
    "calibrate": "Measure the alignment: peaks, pointing model, named alignments.",
    "craft": "Ask a prediction server, if you have set one.",
    "config": "Show and check birdcage.toml.",
    "paths": "Print where files are kept.",
}
"""Each has its module in `birdcage.cli.commands`. Kept here so that `--help` loads none of them."""


class Birdcage(click.Group):
    """Loads a command's module when that command is run, and turns errors into a sentence and an exit code."""

    def list_commands(self, ctx: click.Context) -> list[str]:  # noqa: ARG002 - click's signature
        """Return the names, in the order of use."""
        return list(COMMANDS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:  # noqa: ARG002 - click's signature
        """Load a command; None if there is none of that name."""
        if cmd_name not in COMMANDS:
            return None
        # `if` is a word of Python's own, and `on-off` is none: no module that can be imported is called so.
        with interrupt_quits():
            name = f"{cmd_name.replace('-', '_')}{'_' if iskeyword(cmd_name) else ''}"
            module = import_module(f"birdcage.cli.commands.{name}")
        command: click.Command = module.command
        return command

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:  # noqa: ARG002
        """Write the list of commands without loading them."""
        with formatter.section("Commands"):
            formatter.write_dl(list(COMMANDS.items()))

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Take the whole command line. Errors say its words again, so they come in clean."""
        return super().parse_args(ctx, [_printable(each) for each in args])

    def invoke(self, ctx: click.Context) -> Any:  # noqa: ANN401 - click's signature
        """Run the command. Expected errors are one sentence on stderr, never a traceback."""
        from birdcage.base.errors import BirdcageError

        try:
            return super().invoke(ctx)
        except EndedBySignal as ended:
            _say_notes(ended)
            if ended.number == exits.SIGPIPE:
                drop_stdout()
            ctx.exit(exits.SIGNAL + ended.number)
        except click.Abort:
            say("Cancelled: nothing was done.")
            ctx.exit(exits.SIGNAL + 2)
        except KeyboardInterrupt:
            say("Cancelled.")
            ctx.exit(exits.SIGNAL + 2)
        except BirdcageError as error:
            say(str(error))
            _say_notes(error)
            ctx.exit(exits.code_of(error))


def _printable(argument: str) -> str:
    """Return an argument clean, unless it is the name of a file that is called so."""
    return argument if argument.isprintable() or os.path.lexists(argument.replace("\0", "")) else clean(argument)


def _say_notes(error: Exception) -> None:
    """Say what was noted on the way out: what STOP did, and where the dish is."""
    for note in getattr(error, "__notes__", ()):
        say(note)


def _version(context: click.Context, _parameter: click.Parameter, asked: bool) -> None:
    if asked and not context.resilient_parsing:
        from birdcage.base.version import version

        click.echo(f"birdcage {version()}")
        context.exit()


@click.group(cls=Birdcage, epilog=exits.EPILOG, context_settings={"help_option_names": ["-h", "--help"]})
@click.option(
    "--version", is_flag=True, is_eager=True, expose_value=False, callback=_version, help="Print the version."
)
@global_options()
def cli() -> None:
    """Drive a used motorised satellite dish through its serial console.

    Options may stand before or after the command. A flag counts before its variable, and that before birdcage.toml.
    """
