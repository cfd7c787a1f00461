"""What the lessons of a map share on the command line: the map that is meant, and where things are kept."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from birdcage.cli.options import wanted

if TYPE_CHECKING:
    from birdcage.base.paths import Paths
    from birdcage.skymap.lesson_inputs import LessonInputs


def map_meant(number: int) -> tuple[LessonInputs, Paths]:
    """Return the map of that number with what its lessons go by. StoreError where there is none."""
    from birdcage.cli.say import say
    from birdcage.signal.level_scale import load_scales
    from birdcage.skymap.lesson_inputs import inputs_for
    from birdcage.skymap.map_file import read_map

    wants = wanted()
    sky_map = read_map(wants.paths.signal_recordings, number)
    if sky_map.demo:
        say("DEMO: this map is of a simulated sky.")
    scales = load_scales(wants.paths.known_levels).entries
    return inputs_for(sky_map, wants.settings, scales, wants.beam), wants.paths


def refuse_demo(meant: LessonInputs, paths: Paths) -> None:
    """Raise UsageError where a map of a simulated sky would teach the settings of another dish."""
    from birdcage.skymap.demo_kept import why_demo_not_kept

    why = why_demo_not_kept(meant.sky_map, paths.config_file)
    if why:
        raise click.UsageError(why)
