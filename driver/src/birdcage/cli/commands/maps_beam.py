"""`birdcage maps beam`."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from birdcage.cli.exits import DATA_EPILOG
from birdcage.cli.map_lesson import map_meant, refuse_demo
from birdcage.cli.options import flags, global_options

if TYPE_CHECKING:
    from birdcage.skymap.sun_lesson import SunLesson


@click.command("beam", short_help="Measure beam, system temperature and G/T by the Sun in a map.", epilog=DATA_EPILOG)
@click.argument("number", metavar="MAP", type=click.IntRange(1))
@click.option("--keep", is_flag=True, help="Write beam and system temperature into the feed of the map.")
@global_options("config", "json", "firmware", "verbose")
def beam(number: int, keep: bool) -> None:
    """Measure the beam by the Sun in MAP; by its rise, system temperature and G/T. Nothing is kept without --keep.

    MAP lies around the Sun, or has the Sun in it, with 1.3 beams of sky on all sides. It is in decibels, or in counts
    with two known levels (`birdcage levels`). The Sun counts as quiet; an active one is up to half brighter, which the
    spans allow for.
    """
    from birdcage.cli.say import say, tell, tell_json
    from birdcage.skymap.sun_kept import keep_lesson, lesson_lines, why_not_kept

    meant, paths = map_meant(number)
    found = meant.sun()
    if flags().json:
        tell_json(_values(found, demo=meant.sky_map.demo))
    else:
        for line in lesson_lines(found):
            tell(line)
        if meant.scale is not None and not meant.sky_map.decibels:
            say(f"Counts became decibels by two known levels, {meant.scale.words(meant.sky_map.unit)}.")
    if not keep:
        return
    refuse_demo(meant, paths)
    feed = meant.feed
    if feed is None:
        raise click.UsageError(f"The map was made with the feed {meant.feed_name}, which birdcage.toml does not have.")
    why = why_not_kept(found)
    if why:
        raise click.UsageError(why)
    say(keep_lesson(paths.config_file, meant.feed_name, feed, found))


def _values(found: SunLesson, *, demo: bool) -> dict[str, object]:
    noise = found.noise
    return {
        "beam_az_deg": round(found.az_deg, 3), "beam_el_deg": round(found.el_deg, 3),
        "beam_az_sigma_deg": round(found.az_sigma_deg, 3), "beam_el_sigma_deg": round(found.el_sigma_deg, 3),
        "sun_right_deg": round(found.right_deg, 3), "sun_up_deg": round(found.up_deg, 3),
        "rise_db": round(found.rise_db, 3), "rise_sigma_db": round(found.rise_sigma_db, 3),
        "freq_hz": found.freq_hz, "points": found.points, "demo": demo,
        "sun_k": None if noise is None else round(noise.sun_k),
        "system_k": None if noise is None else round(noise.system_k, 1),
        "system_span_k": None if noise is None else [round(each, 1) for each in noise.system_span_k],
        "g_over_t_db": None if noise is None else round(noise.gt_db, 2),
        "g_over_t_span_db": None if noise is None else [round(each, 2) for each in noise.gt_span_db],
    }  # fmt: skip
