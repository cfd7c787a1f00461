"""`birdcage downlinks`."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from birdcage.cli.exits import DATA_EPILOG
from birdcage.cli.options import flags, global_options

if TYPE_CHECKING:
    from datetime import datetime

    from birdcage.base.config import FeedProfile
    from birdcage.base.paths import Paths
    from birdcage.sky.downlinks import Downlink, Downlinks
    from birdcage.sky.downlinks_hearing import FeedHearing


HEAD = ("SATELLITE", "MHZ", "MODE", "POL", "SYMBOLS", "SATDUMP", "ON THE AIR", "REMARK")
SPARED = ("SYMBOLS", "REMARK", "SATDUMP", "POL")
"""What a narrow terminal goes without, the first one first."""
SHORTEST_MODE = 8


@click.command("downlinks", short_help="List downlinks, and which of them your feed can hear.", epilog=DATA_EPILOG)
@click.argument("satellite", nargs=-1)
@click.option("--all", "every", is_flag=True, help="Also what the feed cannot hear, and what is off the air.")
@global_options("config", "json", "verbose")
def command(satellite: tuple[str, ...], every: bool) -> None:
    """List what the active feed can hear: of every satellite, or of those with SATELLITE in a name.

    SATELLITE may also be what `birdcage where` takes for one, or for a place on the arc: 25544, dish 119, 28.2E.

    The table ships with birdcage; your own file counts before it (`birdcage paths` says where it is). SATDUMP is the
    name of the pipeline that `satdump live` takes. An entry is doubtful unless its source knows it on the air within
    the last three years.
    """
    from datetime import UTC, datetime

    from birdcage.cli.options import find_paths, load_settings
    from birdcage.cli.say import say, tell_json
    from birdcage.sky.downlinks_hearing import has_band, hearing
    from birdcage.sky.downlinks_read import load_downlinks

    paths = find_paths()
    settings = load_settings(paths)
    feed = settings.active_feed
    table = load_downlinks(paths.downlinks_file)
    for problem in table.problems:
        say(problem)
    if not has_band(feed):
        say(f"Feed {settings.feed.active} has no freq_min_hz and freq_max_hz: this is all there is.")
        every = True
    text, now = " ".join(satellite), datetime.now(UTC)
    chosen = _named(text, table, paths) if text else tuple(table)
    rows = [(each, hearing(each, feed)) for each in chosen]
    if not every:
        rows = [(each, heard) for each, heard in rows if heard is not None and each.alive is not False]
    if flags().json:
        tell_json([_values(each, heard, now) for each, heard in rows])
    else:
        _tell(rows, now)
    if not chosen:
        from birdcage.cli.named_target import resolver_of

        problem = resolver_of(paths, None, say).resolve(text).problem
        say(problem or f"No downlink of {text} is known.")
    elif not rows:
        from birdcage.base.config import feed_label

        name = feed_label(settings.feed.active)
        say(f"Feed {name} ({_band(feed)}) hears nothing of it; --all lists what it cannot hear.")


def _named(text: str, table: Downlinks, paths: Paths) -> tuple[Downlink, ...]:
    """Return what is sent by those with a text in a name, else by the one target that it names; nothing for none."""
    from birdcage.cli.named_target import sender_of
    from birdcage.sky.targets.names import plain

    wanted = plain(text)
    rows = tuple(each for each in table if any(wanted in plain(name) for name in (each.satellite, *each.names)))
    if rows and wanted:
        return rows
    try:
        return sender_of((text,), paths, table)[1]
    except click.UsageError:
        return ()


def _band(feed: FeedProfile) -> str:
    if feed.freq_min_hz is None or feed.freq_max_hz is None:
        return "its band is not set"
    return f"{feed.freq_min_hz / 1e6:g} to {feed.freq_max_hz / 1e6:g} MHz"


def _values(each: Downlink, heard: FeedHearing | None, now: datetime) -> dict[str, object]:
    from birdcage.sky.downlinks_words import downlink_values

    return {
        **downlink_values(each, now),
        "hearable": heard is not None,
        "polarization_loss_db": None if heard is None else heard.loss_db,
    }


def _tell(rows: list[tuple[Downlink, FeedHearing | None]], now: datetime) -> None:
    from birdcage.cli.say import say
    from birdcage.cli.table import cut, fitting, room, tell_table, widths_of
    from birdcage.sky.downlinks_words import air_words, baud_words, satdump_words

    cells = [
        (
            each.satellite,
            "-".join(f"{hz / 1e6:.10g}" for hz in dict.fromkeys((each.freq_min_hz, each.freq_max_hz))),
            each.mode or "-",
            each.polarization or "-",
            baud_words(each.symbol_rate_baud) or "-",
            satdump_words(each) or "-",
            air_words(each, now) or "-",
            "not in this feed's band" if heard is None else heard.remark or "-",
        )
        for each, heard in rows
    ]
    if not cells:
        return
    shown, mode_width = fitting(HEAD, widths_of(HEAD, cells), room(), SPARED, "MODE", SHORTEST_MODE)
    mode = HEAD.index("MODE")
    lines = [(*line[:mode], cut(line[mode], mode_width), *line[mode + 1 :]) for line in cells]
    tell_table(
        [HEAD[column] for column in shown], [[line[column] for column in shown] for line in lines],
        "".join("r" if HEAD[column] == "MHZ" else " " for column in shown),
    )  # fmt: skip
    missing = [name for column, name in enumerate(HEAD) if column not in shown]
    if missing:
        say(f"No room for {', '.join(missing)}: a wider terminal or --json has all.")
