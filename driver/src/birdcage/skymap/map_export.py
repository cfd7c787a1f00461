"""Writes a map into files that others read: CSV, a picture, FITS, and the raw text of other sky-scan programs."""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass, field
from datetime import UTC
from importlib.util import find_spec
from pathlib import Path

from birdcage.base.errors import StoreError
from birdcage.base.paths import write_aside_and_rename
from birdcage.base.text import clean
from birdcage.base.user_file import read_user_file
from birdcage.skymap.csv_table import csv_lines
from birdcage.skymap.earlier_file import is_earlier
from birdcage.skymap.place_blur import blurred, is_blurred, made_from
from birdcage.skymap.raw_text import NotInThisForm, as_lines, as_matrix
from birdcage.skymap.sky_map import SkyMap

KINDS = ("csv", "png", "fits", "text")
NEEDS = {"png": ("PIL", "Pillow"), "fits": ("astropy", "astropy")}
"""The module that a kind needs, and the package that holds it: both are the extra `science`."""
HOW_TO_GET = "`python -m pip install pillow astropy` brings what pictures and FITS files need."
MOST_BYTES = 200_000_000
_STAMP = re.compile(r"(\d{4})[-_]?(\d\d)[-_]?(\d\d)[-_](\d\d)[-_]?(\d\d)[-_]?(\d\d)")
_LONGEST = 80


@dataclass(frozen=True)
class FilesWritten:
    """What came of it."""

    paths: list[Path] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    """Sentences: what was left out, and why."""
    left_out: list[str] = field(default_factory=list)
    """Kinds of which there is no file, or an incomplete set."""
    kept: list[Path] = field(default_factory=list)
    """Files of the same name that hold something else, and stay."""


def write_files(
    sky_map: SkyMap, folder: Path, kinds: Collection[str] = KINDS, *, blur_place: bool = False, replace: bool = False
) -> FilesWritten:
    """Write a map in each of these kinds, each file aside and renamed. StoreError if the folder can't be written to.

    A file that is there stays, unless `replace`, or it holds an earlier state of the map. Without Pillow or astropy,
    which are the extra `science`, the other kinds are written. `blur_place`: see `place_blur.blurred`.
    """
    told = blurred(sky_map) if blur_place else sky_map
    done, name, stamp = FilesWritten(), base_name(told), _stamp(sky_map)
    one_map = _is_one_map(sky_map)
    missing = [kind for kind in KINDS if kind in kinds and kind in NEEDS and find_spec(NEEDS[kind][0]) is None]
    if missing:
        lacks = " and ".join(NEEDS[kind][1] for kind in missing)
        done.notes.append(f"No {' and no '.join(each.upper() for each in missing)} without {lacks}. {HOW_TO_GET}")
        done.left_out.extend(missing)
    for kind in (each for each in KINDS if each in kinds and each not in missing):
        files = _text_files(told, stamp, done) if kind == "text" else {f"{name}.{kind}": _MADE[kind](told)}
        written = [_write(folder / each, data, done, replace=replace, one_map=one_map) for each, data in files.items()]
        if not written or not all(written):
            done.left_out.append(kind)
    return done


def base_name(sky_map: SkyMap) -> str:
    """Return how its files are called, without the ending: `map-12-20261127-230000`."""
    mean_of, minus = made_from(sky_map, "mean_of"), made_from(sky_map, "minus")
    file = sky_map.about.get("file")
    if mean_of:
        parts = ["map", *map(str, mean_of), *(["mean"] if len(mean_of) > 1 else [])]
    elif sky_map.number is not None:
        parts = ["map", str(sky_map.number)]
    else:
        parts = ["map", Path(str(file)).stem if file else "from-file"]
    if sky_map.about.get("drift_removed"):
        parts.append("without-drift")
    if minus:
        parts += ["minus", *map(str, minus)]
    plain = re.sub(r"[^A-Za-z0-9_]+", "-", "-".join(parts))[:_LONGEST].strip("-")
    begun = "" if sky_map.begun is None else f"-{sky_map.begun.astimezone(UTC):%Y%m%d-%H%M%S}"
    return f"{plain}{begun}{'-blurred' if is_blurred(sky_map) else ''}"


def _is_one_map(sky_map: SkyMap) -> bool:
    """Return whether no other map has its `base_name`: it is made of numbers alone, and of a begin."""
    from_maps = [*made_from(sky_map, "mean_of"), *made_from(sky_map, "minus")] or [sky_map.number]
    short = len("-".join(map(str, from_maps))) < _LONGEST // 2
    return short and sky_map.begun is not None and all(isinstance(each, int) for each in from_maps)


def _stamp(sky_map: SkyMap) -> tuple[str, ...] | None:
    """Return year to second for the names of raw text: of its beginning, else out of the name of its file."""
    if sky_map.begun is not None:
        return tuple(f"{sky_map.begun.astimezone(UTC):%Y %m %d %H %M %S}".split())
    found = _STAMP.search(str(sky_map.about.get("file") or ""))
    return None if found is None else found.groups()


def _text_files(sky_map: SkyMap, stamp: tuple[str, ...] | None, done: FilesWritten) -> dict[str, bytes]:
    if stamp is None:
        done.notes.append("No raw text: its files are named by the time of the beginning, which is not known here.")
        return {}
    if any(sky_map.about.get(name) for name in ("mean_of", "minus", "drift_removed")):
        done.notes.append("No raw text: its files are named by time alone, and hold a map as it was heard.")
        return {}
    files: dict[str, bytes] = {}
    try:
        files[f"{'_'.join(stamp)}.txt"] = as_lines(sky_map)
    except NotInThisForm as why:
        done.notes.append(str(why))
    try:
        day = f"{''.join(stamp[:3])}-{''.join(stamp[3:])}"
        files[f"raw-data-{day}.txt"], files[f"scan-settings-{day}.txt"] = as_matrix(sky_map)
    except NotInThisForm as why:
        if str(why) not in done.notes:
            done.notes.append(str(why))
    return files


def _csv(sky_map: SkyMap) -> bytes:
    return "".join(f"{line}\n" for line in csv_lines(sky_map)).encode()


def _fits(sky_map: SkyMap) -> bytes:
    from birdcage.skymap.fits_file import as_fits

    return as_fits(sky_map)


def _png(sky_map: SkyMap) -> bytes:
    from birdcage.skymap.picture import as_png

    return as_png(sky_map)


_MADE: Mapping[str, Callable[[SkyMap], bytes]] = {"csv": _csv, "png": _png, "fits": _fits}


def _write(path: Path, data: bytes, done: FilesWritten, *, replace: bool, one_map: bool) -> bool:
    try:
        if not replace and path.exists() and _is_other(read_user_file(path, MOST_BYTES), data, path.name, one_map):
            done.notes.append(f"{clean(str(path))} exists and holds something else. --replace writes over it.")
            done.kept.append(path)
            return False
        write_aside_and_rename(path, data)
    except OSError as error:
        raise StoreError(f"{clean(str(path))} can't be written: {error.strerror or error}.") from error
    done.paths.append(path)
    return True


def _is_other(old: bytes, new: bytes, name: str, one_map: bool) -> bool:
    return old != new and not is_earlier(old, new, name, one_map=one_map)
