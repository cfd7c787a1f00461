"""`birdcage if`."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from birdcage.cli.exits import DATA_EPILOG
from birdcage.cli.options import flags, global_options
from birdcage.cli.sky_options import FREQUENCY

if TYPE_CHECKING:
    from collections.abc import Sequence
    from datetime import datetime

    from birdcage.base.paths import Paths
    from birdcage.sky.band import Conversion, FrequencyRange
    from birdcage.sky.downlinks import Downlink, Downlinks


MOST_SENDERS = 4
"""So many are told with what they send; of more only the names are."""
MOST_NAMES = 6


@click.command("if", short_help="Compute the frequency behind a converter.", epilog=DATA_EPILOG)
@click.argument("target", nargs=-1)
@click.option("--rf", "rf_hz", type=FREQUENCY, help="What the satellite sends: 10489.5M, 1.7013G.")
@click.option("--if", "if_hz", type=FREQUENCY, help="The other way: what the receiver is tuned to.")
@click.option("--lo", "lo_hz", type=FREQUENCY, help="Local oscillator.  [default: the active feed's, else none]")
@global_options("config", "json", "verbose")
def command(
    target: tuple[str, ...], rf_hz: float | None, if_hz: float | None, lo_hz: float | None
) -> None:  # fmt: skip
    """Work out the intermediate frequency behind a converter, what it is for, and which receivers tune to it.

    TARGET, named as for `birdcage where` (QO-100, METEOR-M N2-3, dish 119), stands for all that it sends.
    Frequencies are in MHz unless they say Hz, k, M or G. --if lists what may have been received.
    """
    from datetime import UTC, datetime

    from birdcage.base.config import feed_label
    from birdcage.cli.options import find_paths, load_settings
    from birdcage.cli.say import say, tell, tell_json
    from birdcage.sky.band import Conversion, rf_of
    from birdcage.sky.downlinks_read import load_downlinks

    if [bool(target), rf_hz is not None, if_hz is not None].count(True) != 1:
        raise click.UsageError(
            "Give --rf (what the satellite sends), --if (what the receiver is tuned to), or a target."
        )
    paths = find_paths()
    settings = load_settings(paths)
    if lo_hz is None:
        lo_hz = settings.active_feed.lo_hz or 0.0
        told = f"LO {lo_hz / 1e6:.10g} MHz" if lo_hz else "no LO is set"
        say(f"Feed {feed_label(settings.feed.active)}: {told}.")
    downlinks, now = load_downlinks(paths.downlinks_file), datetime.now(UTC)
    for problem in downlinks.problems:
        say(problem)
    if target:
        found = tuple(Conversion(each, lo_hz) for each in _sent_by(target, paths, downlinks))
    else:
        found = (Conversion(rf_hz, lo_hz),) if rf_hz is not None else rf_of(lo_hz, if_hz or 0.0)
    if flags().json:
        tell_json([values(each, downlinks, now) for each in found])
        return
    for index, each in enumerate(found):
        for line in ([""] if index else []) + lines(each, downlinks, now):
            tell(line)


def _sent_by(words: tuple[str, ...], paths: Paths, downlinks: Downlinks) -> tuple[float, ...]:
    """Return the middles of all that a target sends, in Hz. ConfigError where nothing is known of it.

    What is known to be silent is left out, unless all of it is.
    """
    from birdcage.base.errors import ConfigError
    from birdcage.cli.named_target import sender_of
    from birdcage.cli.say import say

    name, rows, note = sender_of(words, paths, downlinks)
    if note:
        say(note)
    if not rows:
        raise ConfigError(f"No downlink of {name} is known. Give --rf. `birdcage downlinks --all` lists all that are.")
    rows = tuple(each for each in rows if each.alive is not False) or rows
    return tuple(dict.fromkeys(each.center_hz for each in rows))


def values(conversion: Conversion, downlinks: Downlinks, now: datetime) -> dict[str, object]:
    """Return a conversion for JSON."""
    from birdcage.sky.band import lnbs, plans, receivers
    from birdcage.sky.downlinks_words import downlink_values

    rf_hz, sent = conversion.rf_hz, senders(conversion, downlinks)
    return {
        "rf_hz": rf_hz,
        "lo_hz": conversion.lo_hz,
        "if_hz": conversion.if_hz,
        "inverted": conversion.inverted,
        "image_hz": conversion.image_hz,
        "bands": [each.name for each in plans() if each.holds(rf_hz)],
        "lnbs": [each.name for each in lnbs() if each.holds(rf_hz) and each.lo_hz == conversion.lo_hz],
        "satellites": sorted({each.satellite for each in sent}),
        "downlinks": [downlink_values(each, now) for each in sent],
        "receivers": [
            {"name": each.name, "reaches": each.holds(conversion.if_hz), "beside_hz": each.beside_hz(conversion.if_hz)}
            for each in receivers()
        ],
    }


def lines(conversion: Conversion, downlinks: Downlinks, now: datetime) -> list[str]:
    """Return it for people."""
    from birdcage.sky.band import lnbs, megahertz, plans, receivers

    rf_hz, if_hz = conversion.rf_hz, conversion.if_hz
    told = [f"RF         {megahertz(rf_hz)}"]
    told += [f"           {each.name}" for each in plans() if each.holds(rf_hz)]
    told += _sender_lines(senders(conversion, downlinks), now)
    if conversion.lo_hz:
        side = "above the signal: the spectrum is inverted" if conversion.inverted else "below the signal: not inverted"
        told.append(f"LO         {megahertz(conversion.lo_hz)}, {side}")
        made_for = [each for each in lnbs() if each.lo_hz == conversion.lo_hz]
        for each in made_for:
            told.append(f"           as in a {each.name}, for {each.low_hz / 1e6:g} to {each.high_hz / 1e6:g} MHz")
            if not each.holds(rf_hz):
                told.append("           not made for this frequency: expect less, or nothing")
    else:
        told.append("LO         none: the receiver is tuned to the signal itself")
    told.append(f"IF         {megahertz(if_hz)}")
    if conversion.image_hz is not None:
        told.append(f"           so is {megahertz(conversion.image_hz)}, its image, where no filter holds it back")
    for each in receivers():
        verdict, *more = _verdict(each, conversion)
        told += [f"{each.name:24} {verdict}", *(f"{'':27}{line}" for line in more)]
    return told


def senders(conversion: Conversion, downlinks: Downlinks) -> list[Downlink]:
    """Return who is known to send there, and not known to be off the air, in order of their names."""
    rf_hz = conversion.rf_hz
    there = (each for each in downlinks if each.alive is not False and each.freq_min_hz <= rf_hz <= each.freq_max_hz)
    return sorted(there, key=lambda each: each.satellite)


def _sender_lines(sent: Sequence[Downlink], now: datetime) -> list[str]:
    """Return a line for each sender, or only their names where there are many, `?` behind a doubtful one."""
    import textwrap

    from birdcage.sky.downlinks_age import is_doubtful
    from birdcage.sky.downlinks_words import air_words, satdump_words, signal_words

    indent = " " * 11
    if len(sent) > MOST_SENDERS:
        names = list(dict.fromkeys(f"{each.satellite}{' ?' if is_doubtful(each, now) else ''}" for each in sent))
        more = " and more" if len(names) > MOST_NAMES else ""
        return textwrap.wrap(", ".join(names[:MOST_NAMES]) + more, 80, initial_indent=indent, subsequent_indent=indent)
    told: list[str] = []
    for each in sent:
        pipeline = satdump_words(each)
        parts = (each.satellite, signal_words(each), f"SatDump {pipeline}" if pipeline else "", air_words(each, now))
        line = "  ".join(part for part in parts if part)
        told += textwrap.wrap(line, 80, initial_indent=indent, subsequent_indent=f"{indent}  ")
    return told


def _verdict(receiver: FrequencyRange, conversion: Conversion) -> list[str]:
    """Return whether a receiver tunes there; else by how much not, and below it which oscillator would do."""
    from birdcage.sky.band import megahertz

    note = f" ({receiver.note})" if receiver.note else ""
    beside_hz = receiver.beside_hz(conversion.if_hz)
    if not beside_hz:
        return [f"✓ reaches it{note}"]
    tunes = f"{receiver.low_hz / 1e6:g} to {receiver.high_hz / 1e6:g} MHz"
    below = beside_hz < 0
    told = [f"✗ {tunes}: {megahertz(abs(beside_hz))} too {'low' if below else 'high'}{note}"]
    wanted_hz = conversion.rf_hz - (receiver.low_hz if below else receiver.high_hz)
    if wanted_hz > 0:
        told.append(f"an LO of {megahertz(wanted_hz)} or {'less' if below else 'more'} would do")
    return told
