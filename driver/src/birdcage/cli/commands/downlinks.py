"""`birdcage downlinks`."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from birdcage.cli.exits import DATA_EPILOG
from birdcage.cli.options import flags, global_options

if TYPE_CHECKING:
    from birdcage.base.config import FeedProfile
    from birdcage.sky.downlinks import Downlink
    from birdcage.sky.downlinks_hearing import Hearing


@click.command("downlinks", short_help="List who sends what, and what your feed can hear.", epilog=DATA_EPILOG)
@click.argument("satellite", required=False)
@click.option("--all", "every", is_flag=True, help="Also what the feed cannot hear, and what is off the air.")
@global_options("config", "json", "verbose")
def command(satellite: str | None, every: bool) -> None:
    """List what the active feed can hear: of every SATELLITE, or of those with this in their name.

    The table ships with birdcage; your own file counts before it (`birdcage paths` says where it is). Whether something
    was on the air is told with the date of the source.
    """
    from birdcage.cli.options import find_paths, load_settings
    from birdcage.cli.say import say, tell_json
    from birdcage.sky.downlinks import load_downlinks, plain
    from birdcage.sky.downlinks_hearing import has_band, hearing

    paths = find_paths()
    settings = load_settings(paths)
    feed = settings.active_feed
    table = load_downlinks(paths.downlinks_file)
    for problem in table.problems:
        say(problem)
    if not has_band(feed):
        say(f"Feed {settings.feed.active} has no freq_min_hz and freq_max_hz: this is all there is.")
        every = True
    wanted = plain(satellite or "")
    rows = [
        (each, hearing(each, feed))
        for each in table
        if not wanted or any(wanted in plain(name) for name in (each.satellite, *each.names))
    ]
    if not every:
        rows = [(each, heard) for each, heard in rows if heard is not None and each.alive is not False]
    if flags().json:
        tell_json([_values(each, heard) for each, heard in rows])
    else:
        _tell(rows)
    if not rows:
        say(f"Feed {settings.feed.active} ({_band(feed)}) hears nothing of it; --all lists what it cannot hear.")


def _band(feed: FeedProfile) -> str:
    if feed.freq_min_hz is None or feed.freq_max_hz is None:
        return "its band is not set"
    return f"{feed.freq_min_hz / 1e6:g} to {feed.freq_max_hz / 1e6:g} MHz"


def _values(each: Downlink, heard: Hearing | None) -> dict[str, object]:
    return {
        "satellite": each.satellite,
        "norad_id": each.norad_id or None,
        "longitude_deg": each.longitude_deg,
        "freq_min_hz": each.freq_min_hz,
        "freq_max_hz": each.freq_max_hz,
        "mode": each.mode or None,
        "polarization": each.polarization,
        "alive": each.alive,
        "silent_since": each.silent_since or None,
        "date": each.date or None,
        "source": each.source,
        "note": each.note or None,
        "hearable": heard is not None,
        "polarization_loss_db": None if heard is None else heard.loss_db,
    }


def _on_the_air(each: Downlink) -> str:
    if each.silent_since:
        return f"off since {each.silent_since}"
    return {True: f"on {each.date}", False: f"off {each.date}", None: "?"}[each.alive]


def _tell(rows: list[tuple[Downlink, Hearing | None]]) -> None:
    from birdcage.cli.table import tell_table

    cells = [
        (
            each.satellite,
            "-".join(f"{hz / 1e6:.10g}" for hz in dict.fromkeys((each.freq_min_hz, each.freq_max_hz))),
            each.mode or "-",
            each.polarization or "-",
            _on_the_air(each),
            "not in this feed's band" if heard is None else heard.remark or "-",
        )
        for each, heard in rows
    ]
    if cells:
        tell_table(("SATELLITE", "MHZ", "MODE", "POL", "ON THE AIR", "REMARK"), cells, right=" r")
