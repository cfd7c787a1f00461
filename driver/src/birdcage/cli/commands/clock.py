"""`birdcage clock`."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from birdcage.cli.exits import EPILOG
from birdcage.cli.options import find_paths, flags, global_options, load_settings

if TYPE_CHECKING:
    from datetime import datetime

    from birdcage.gps.verdict import ClockVerdict


@click.command("clock", epilog=EPILOG)
@click.option("--utc", metavar="HH:MM:SS", help="UTC on a watch at the moment of pressing Enter: good to a second.")
@click.option("--gps", "receiver", is_flag=False, flag_value="", metavar="[RECEIVER]",
              help="Compare with a GPS receiver: gpsd, gpsd://host:port or its port.")  # fmt: skip
@click.option("--rate", "rate_deg_s", type=click.FloatRange(0.0, 90.0), metavar="DEG_S",
              help="Greatest speed of a pass, for what an error costs on it.  [default: 1, ISS overhead]")  # fmt: skip
@global_options("config", "json", "verbose")
def command(utc: str | None, receiver: str | None, rate_deg_s: float | None) -> None:
    """Say whether this machine's clock can be trusted, and what an error of it costs in degrees.

    Without an option the system is asked what it knows (chrony, systemd). If it can't tell, the last good comparison
    counts, for less with every day since. A clock found wrong forgets all of that. Nothing is sent to the network, and
    the clock is never set.
    """
    from birdcage.base.clock import RealClock
    from birdcage.cli.say import say, tell, tell_json
    from birdcage.gps.clock_check import check_clock, remember
    from birdcage.gps.verdict import OVERHEAD_DEG_S, by_watch, cost_sentence

    now = RealClock().utc()  # before anything else: the key was pressed a moment ago
    if utc is not None and receiver is not None:
        raise click.UsageError("--utc and --gps are two ways to compare: give one.")
    paths = find_paths()
    if utc is not None:
        verdict = by_watch(_told(utc, now), now)
    elif receiver is not None:
        verdict = _by_gps(receiver)
    else:
        verdict = check_clock(now, paths.state)
    if (utc is not None or receiver is not None) and not remember(paths.state, verdict):
        say(f"The result could not be kept in {paths.state}.")
    if flags().json:
        tell_json(_values(verdict, OVERHEAD_DEG_S if rate_deg_s is None else rate_deg_s))
        return
    tell(verdict.sentence)
    tell(cost_sentence(verdict, OVERHEAD_DEG_S) if rate_deg_s is None else
         cost_sentence(verdict, rate_deg_s, "that pass"))  # fmt: skip


def _told(text: str, now: datetime) -> datetime:
    from birdcage.setup.step import NoSuchChoice
    from birdcage.setup.typed import time_of_day

    try:
        return time_of_day(text, now)
    except NoSuchChoice as error:
        raise click.BadParameter(str(error), param_hint="--utc") from None


def _by_gps(receiver: str) -> ClockVerdict:
    from birdcage.base.clock import RealClock
    from birdcage.gps.fix import NoFix
    from birdcage.gps.locate import locate
    from birdcage.gps.verdict import by_gps

    settings = load_settings(find_paths())
    fix = locate(receiver or settings.place.gps or "gpsd", RealClock(), timeout_s=30.0, dish_port=settings.dish.port)
    verdict = by_gps(fix)
    if verdict is None:
        raise NoFix(f"{fix.source} gives a position but no time.")
    return verdict


def _values(verdict: ClockVerdict, rate_deg_s: float) -> dict[str, object]:
    from birdcage.cli.say import iso
    from birdcage.gps.verdict import cost_deg

    worst_s = verdict.worst_s
    return {
        "doubtful": verdict.doubtful,
        "doubt": verdict.doubt or None,
        "source": verdict.source,
        "kind": verdict.kind,
        "checked_at": iso(verdict.checked_at),
        "offset_s": verdict.offset_s,
        "precision_s": verdict.precision_s,
        "rate_deg_s": rate_deg_s,
        "cost_deg_per_s": cost_deg(1.0, rate_deg_s),
        "worst_deg": None if worst_s is None else cost_deg(worst_s, rate_deg_s),
    }
