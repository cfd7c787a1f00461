"""`birdcage export`."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from birdcage.cli import exits
from birdcage.cli.options import find_paths, flags, global_options

if TYPE_CHECKING:
    from birdcage.skymap.sky_map import SkyMap


@click.command("export", epilog=exits.DATA_EPILOG)
@click.argument("names", metavar="MAP...", nargs=-1, required=True)
@click.option(
    "--out", type=click.Path(path_type=Path), default=".", metavar="FOLDER", help="Where to write.  [default: here]"
)
@click.option("--as", "kinds", metavar="KINDS", help="csv, png, fits, text, parted by commas.  [default: all]")
@click.option("--blur-place", is_flag=True, help="Round the place to whole degrees, and leave out what tells it.")
@click.option("--mean", is_flag=True, help="Average these maps into one.")
@click.option("--minus", metavar="MAP", help="Subtract this map.")
@click.option("--without-drift", is_flag=True, help="Take out the drift of gain that the reference crosses tell.")
@click.option("--replace", is_flag=True, help="Write over files that hold something else.")
@global_options("config", "json", "verbose")
def command(
    names: tuple[str, ...], out: Path, kinds: str | None, blur_place: bool, mean: bool, minus: str | None,
    without_drift: bool, replace: bool,
) -> None:  # fmt: skip
    """Write maps of the sky into files: CSV, a picture, FITS, raw text of other sky-scan programs.

    MAP is a number of `birdcage maps`, or the path of a raw text file that another sky-scan program wrote. Files are
    called `map-12-20261127-230000.fits`: number and begin of the map, in UTC.
    """
    from birdcage.cli.say import say, tell, tell_json
    from birdcage.skymap import combine
    from birdcage.skymap.map_export import KINDS, write_files

    wanted = KINDS if kinds is None else tuple(dict.fromkeys(each.strip().lower() for each in kinds.split(",")))
    if unknown := [each for each in wanted if each not in KINDS]:
        raise click.UsageError(f"“{unknown[0]}” is no kind of file. There are {', '.join(KINDS)}.")
    maps = [_named(name, without_drift=without_drift) for name in dict.fromkeys(names)]
    if mean:
        maps = [combine.mean_of(maps)]
    if minus is not None:
        taken = _named(minus, without_drift=without_drift)
        maps = [combine.minus(each, taken) for each in maps]
    paths, notes, failed = [], [], False
    for each in maps:
        done = write_files(each, out, wanted, blur_place=blur_place, replace=replace)
        paths += done.paths
        notes += [note for note in done.notes if note not in notes]
        failed = failed or not done.paths or (kinds is not None and bool(done.left_out)) or bool(done.kept)
    for note in notes:
        say(note)
    if flags().json:
        tell_json({"files": [str(each) for each in paths], "notes": notes})
    else:
        for path in paths:
            tell(str(path))
    if failed:
        raise SystemExit(exits.NOT_DONE)


def _named(name: str, *, without_drift: bool) -> SkyMap:
    from birdcage.skymap import drift

    sky_map = _as_heard(name)
    return drift.without_drift(sky_map) if without_drift else sky_map


def _as_heard(name: str) -> SkyMap:
    """Return a map by its number, or out of a file of raw text."""
    from birdcage.cli.say import say
    from birdcage.skymap.map_file import read_map
    from birdcage.skymap.raw_read import read_raw_text

    if name.isascii() and name.isdigit() and len(name) < 10 and not Path(name).exists():
        return read_map(find_paths().signal_recordings, int(name))
    if not Path(name).exists():
        raise click.UsageError(f"There is no map and no file “{name}”. `birdcage maps` lists the maps.")
    sky_map, notes = read_raw_text(Path(name))
    for note in notes:
        say(f"{sky_map.about['file']}: {note}")
    return sky_map
