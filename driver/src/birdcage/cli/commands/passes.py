"""`birdcage passes`."""

from __future__ import annotations

from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING

import click

from birdcage.cli import exits
from birdcage.cli.known_satellites import find_elements
from birdcage.cli.options import NO_DISH, Wanted, flags, global_options, wanted
from birdcage.cli.sky_options import FREQUENCY, at_option, elements_option, find_observer, observer_options

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from birdcage.sky.export.fields import Heard
    from birdcage.sky.observer import Observer
    from birdcage.sky.pass_row import PassRow
    from birdcage.sky.passes.table import PassTable
    from birdcage.sky.reach_limits import ReachLimits
    from birdcage.sky.watch_source import Watched

SHOWN = 40
"""Rows of the table unless `--limit` says otherwise."""


@click.command("passes", epilog=exits.EPILOG)
@click.argument("target", nargs=-1, metavar="[SATELLITE]")
@elements_option
@observer_options
@at_option("When the list begins.", old_name="--start")
@click.option(
    "--hours", type=click.FloatRange(0.0, 240.0, min_open=True), default=24.0, show_default=True, help="How far ahead."
)
@click.option(
    "--min-elevation", type=click.FloatRange(-5.0, 89.0), default=0.0, show_default=True, metavar="DEG",
    help="A pass is the time above this geometric elevation.",
)  # fmt: skip
@click.option("--name", metavar="TEXT", help="Only satellites with this in one of their names, or with this number.")
@click.option(
    "--hearable/--any",
    default=None,
    help="Only what sends in the band of the active feed, or all.  [default: hearable if a feed is set, and no --name]",
)
@click.option(
    "--sort", type=click.Choice(("aos", "max", "reach")), default="aos", show_default=True,
    help="By rise, by highest elevation, or by how long this dish can follow.",
)  # fmt: skip
@click.option(
    "--limit",
    type=click.IntRange(1),
    metavar="N",
    help=f"The first N.  [default: {SHOWN}; all with --json, --csv, --ics]",
)
@click.option("--freq", "freq_hz", type=FREQUENCY, help="Add the Doppler shift there: 137.1M; a bare number is in MHz.")
@click.option("--csv", "csv_file", type=click.Path(path_type=Path), metavar="FILE", help="Write CSV; `-` is stdout.")
@click.option("--ics", "ics_file", type=click.Path(path_type=Path), metavar="FILE", help="Write a calendar.")
@global_options("config", "firmware", "json", "verbose", firmware=NO_DISH)
def command(
    target: tuple[str, ...], elements: Path | None, lat: float | None, lon: float | None, alt: float | None,
    at: datetime | None, hours: float, min_elevation: float, name: str | None, hearable: bool | None, sort: str,
    limit: int | None, freq_hz: float | None, csv_file: Path | None, ics_file: Path | None,
) -> None:  # fmt: skip
    """List what comes over: rise, highest point, set, and when this dish can follow it; of SATELLITE alone if named.

    SATELLITE is named as for `birdcage where`: iss, AO-91, METEOR-M N2-3, 25544.
    AOS and LOS are of the satellite. *Reach* is the part that the dish can point at. Floor, ceiling, horizon, no-go
    sectors, cable, and speed near the zenith limit it. `<` was up before, `>` stays up.
    What is always up makes no passes. The table lists it only by name, JSON and CSV give it no duration, calendars
    leave it out. DOWNLINK is what of it the active feed listens to, in MHz, with `?` where it is doubtful; SATDUMP is
    SatDump's name for it.
    Times and elevations are without refraction, which `birdcage track` adds: near the horizon the dish points up to
    half a degree higher.
    """
    from datetime import UTC

    import numpy as np

    from birdcage.cli.named_passes import one_satellite, with_name
    from birdcage.cli.say import say, tell_json
    from birdcage.sky.export.fields import values_of

    wants = wanted()
    observer = find_observer(wants.settings, lat, lon, alt)
    if target and name is not None:
        raise click.UsageError("Name one satellite, or give --name: not both.")
    named = bool(target) or name is not None
    watched = find_elements(wants.paths, elements, say)
    if target:
        watched = one_satellite(watched, target, wants.paths, elements)
    elif name is not None:
        watched = with_name(watched, name, wants.paths, elements)
    watched = _heard(watched, wants, hearable, named)
    limits = _limits(wants)
    begin = at if at is not None else datetime.now(UTC)
    table_wanted = csv_file is None and ics_file is None and not flags().json
    found = _search(watched, observer, begin, hours, min_elevation)
    which = np.arange(len(found))
    if table_wanted and not named:
        which = _that_move(found, hours)
    shown = SHOWN if limit is None and table_wanted else limit
    rows = _rows(found, which, watched, observer, limits, sort, shown)
    now = datetime.now(UTC)
    heard = _first_heard(wants)
    if csv_file is not None:
        from birdcage.sky.export.as_csv import passes_csv

        _write(csv_file, passes_csv(rows, freq_hz, heard, now).encode(), len(rows))
    if ics_file is not None:
        from birdcage.sky.export.as_ics import passes_ics

        dated = [row for row in rows if not row.passing.always_up]
        _write(ics_file, passes_ics(dated, observer, now, watched.note), len(dated))
    if flags().json:
        tell_json([values_of(row, freq_hz, heard, now) for row in rows])
    elif table_wanted:
        from birdcage.cli.pass_table import tell_passes
        from birdcage.cli.table import room
        from birdcage.sky.decay import reentry_warning

        missing = tell_passes(rows, begin, freq_hz, room(), heard=heard, now=now)
        if rows:
            say("Times and elevations are without refraction.")
        if missing:
            say(f"No room for {', '.join(missing)}: a wider terminal, --csv or --json has all.")
        warning = reentry_warning((row.elements, row.passing.tca) for row in rows)
        if warning is not None:
            say(warning)
        if len(which) > len(rows) and limit is None:
            more = len(which) - len(rows)
            say(f"{more} more are not listed: --limit N shows them; --name or --min-elevation narrows.")
    if not len(found):
        say(f"Nothing rises above {min_elevation:g}° within {hours:g} hours.")


def _heard(watched: Watched, wants: Wanted, hearable: bool | None, named: bool) -> Watched:
    """Return the satellites that the feed can hear, and say how many are left out; all where that is not asked for."""
    from birdcage.base.config import feed_label
    from birdcage.cli.say import say
    from birdcage.sky.downlinks_hearing import has_band, listener
    from birdcage.sky.downlinks_read import load_downlinks

    settings, feed = wants.settings, wants.settings.active_feed
    if hearable is None:
        hearable = not named and "feed.active" in settings.sources and has_band(feed)
    if not hearable:
        return watched
    table = load_downlinks(wants.paths.downlinks_file)
    for problem in table.problems:
        say(problem)
    hears = listener(table, feed)
    found = watched.chosen(lambda one: hears(one.norad_id, one.name))
    count = f"{len(found.elements)} of {len(watched.elements)} satellites"
    say(f"{count} are known to send what feed {feed_label(settings.feed.active)} hears. --any lists all.")
    return found


def _first_heard(wants: Wanted) -> Heard:
    """Return which downlink of a satellite is listened to with the active feed."""
    from birdcage.sky.downlinks_hearing import first_heard
    from birdcage.sky.downlinks_read import load_downlinks

    return first_heard(load_downlinks(wants.paths.downlinks_file), wants.settings.active_feed)


def _limits(wants: Wanted) -> ReachLimits:
    """Return what limits this dish, and say where that comes from."""
    from birdcage.cli.say import say
    from birdcage.cli.standing import limits_of

    model, limits = wants.named_model, limits_of(wants)
    whose = "No dish is named (--firmware, or firmware in birdcage.toml)" if model is None else f"The {model.name}"
    words = f"{whose}: reach is taken from {limits.el_floor_deg:g}° to {limits.el_ceiling_deg:g}° of elevation"
    if limits.cable is not None:
        words += f", cable {limits.cable[0]:+.0f}° to {limits.cable[1]:+.0f}° (counted, which takes a homing)"
    say(f"{words}.")
    if wants.settings.motion_problem is not None:
        say("Settings that limit motion could not be read. Reach ignores them.")
    return limits


def _search(watched: Watched, observer: Observer, start: datetime, hours: float, least_deg: float) -> PassTable:
    """Return all passes, and say of whom nothing is known."""
    from birdcage.cli.say import say
    from birdcage.sky.passes.search import search
    from birdcage.sky.propagate import Fleet

    found = search(Fleet(watched.elements), observer, start, hours, least_deg, watched.time_offsets)
    for failure in found.failed:
        say(f"{failure.name} ({failure.norad_id or '-'}): no position, {failure.why}.")
    return found


def _that_move(found: PassTable, hours: float) -> NDArray[np.intp]:
    """Return which passes begin or end within the time, and say how many satellites stay up all through it."""
    import numpy as np

    from birdcage.cli.say import say
    from birdcage.sky.passes.model import DAY_S

    stays = found.already_up & found.still_up
    if stays.any():
        why = "always up" if hours * 3600.0 >= DAY_S else f"up all these {hours:g} hours"
        say(f"Left out, as {why}: {stays.sum()}. `birdcage sky` lists them.")
    return np.flatnonzero(~stays)


def _rows(
    found: PassTable, which: NDArray[np.intp], watched: Watched, observer: Observer, limits: ReachLimits, sort: str,
    limit: int | None,
) -> list[PassRow]:  # fmt: skip
    """Sort some passes, cut, and work out what is left."""
    import numpy as np

    from birdcage.cli.say import Progress
    from birdcage.sky.pass_row import ORDERS, rows_of

    if sort == "max":
        which = which[np.argsort(-found.max_elevation_deg[which], kind="stable")]
    # Only reach has to be worked out for all of them before it can sort.
    some: list[int] = (which if sort == "reach" else which[:limit]).tolist()
    rows: list[PassRow] = []
    progress = Progress()
    for row in rows_of(found, watched, observer, limits, some):
        if rows and len(rows) % 100 == 0:
            progress.show(f"{len(rows)} of {len(some)} passes …")
        rows.append(row)
    progress.clear()
    return sorted(rows, key=ORDERS[sort])[:limit] if sort == "reach" else rows


def _write(file: Path, data: bytes, count: int) -> None:
    """Write a file, or stdout for `-`, and say so. ConfigError if that can't be done."""
    from birdcage.base.errors import ConfigError
    from birdcage.base.paths import write_aside_and_rename
    from birdcage.cli.say import say

    if str(file) == "-":
        click.echo(data, nl=False)
        return
    try:
        write_aside_and_rename(file, data)
    except OSError as error:
        raise ConfigError(f"{file} cannot be written: {error.strerror}.") from error
    say(f"{count} {'pass' if count == 1 else 'passes'} written to {file}.")
