"""`birdcage detect`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from birdcage.cli import exits
from birdcage.cli.options import flags, global_options, wanted

if TYPE_CHECKING:
    from birdcage.cli.options import Wanted
    from birdcage.detection.detecting import Detection


@click.command("detect", epilog=exits.EPILOG)
@global_options("port", "baud", "json", "config", "verbose")
@click.pass_context
def command(context: click.Context) -> None:
    """Find out which firmware answers on the port, with the evidence.

    Sends one bare Enter at each usual speed, and `?` where a prompt answers. Nothing moves; a combined move
    that is under way may end by the first byte. No program that drives the dish is disturbed: its port is busy.
    """
    from birdcage.base.clock import RealClock
    from birdcage.cli.say import say, tell, tell_json
    from birdcage.cli.which import ask_port

    dish = wanted()
    owner = _owner(dish)
    if owner is not None:
        say(owner)
        context.exit(exits.LINK)
    found = ask_port(dish, RealClock())
    if flags().json:
        tell_json(_report(found))
    else:
        tell(found.sentence)
        for line in _lines(found):
            tell(line)
    if found.trouble is not None:
        context.exit(exits.LINK)
    if found.firmware is None:
        context.exit(exits.NOT_DONE)


def _owner(dish: Wanted) -> str | None:
    """Return who has the port, in a sentence; None if no birdcage program has."""
    from birdcage.station.control_client import NoAnswer, OwnerGone, call_owner, find_owner, owners_folder
    from birdcage.station.control_messages import TellStatus

    owner = find_owner(owners_folder(dish.paths), dish.port)
    if owner is None:
        return None
    try:
        firmware = call_owner(owner, TellStatus(), "birdcage detect").get("firmware") or "nothing yet"
    except NoAnswer as error:
        return f"{error}."
    except OwnerGone:
        return None
    return f"Process {owner.pid} has {owner.port} and speaks {firmware} there. Nothing was sent."


def _report(found: Detection) -> dict[str, Any]:
    return {
        "port": found.port,
        "firmware": found.firmware,
        "candidates": list(found.candidates),
        "baud": found.baud,
        "sentence": found.sentence,
        "clues": [{"firmware": clue.firmware, "seen": clue.words} for clue in found.clues],
        "speeds": [
            {
                "baud": each.baud, "saw": each.saw.value, "text": each.sample, "bytes": each.count,
                "prompt": each.prompt or None, "commands": sorted(each.listed), "seconds": each.waited_s,
            }
            for each in found.findings
        ],
    }  # fmt: skip


def _lines(found: Detection) -> list[str]:
    """Return what each speed showed, one line each."""
    from birdcage.setup.case import describe

    lines = []
    for each in found.findings:
        lists = f"; `?` lists {', '.join(sorted(each.listed))}" if each.listed else ""
        lines.append(f"  {describe([each])}{lists}")
    return lines
