"""Reads the tables of downlinks, ours and the user's own, and says by file, line and key what is wrong with them."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Mapping
from functools import cache
from importlib.resources import files
from pathlib import Path

from birdcage.base.config.value import did_you_mean
from birdcage.base.text import clean_all
from birdcage.base.user_file import read_user_file
from birdcage.sky.downlinks import POLARIZATIONS, Downlink, Downlinks, plain
from birdcage.sky.slots import slots

KEYS = ("satellite", "freq_mhz", "mode", "polarization", "alive", "silent_since", "source", "date", "norad_id",
        "longitude_deg", "names", "note", "symbol_rate_baud", "pipeline", "pipeline_live")  # fmt: skip
MOST_BYTES = 2_000_000
"""A larger file is not written by a person."""
_HEADING = re.compile(r"\s*\[\[\s*[\"']?downlink[\"']?\s*\]\]")
_PIPELINE = re.compile(r"[A-Za-z0-9_-]+")
_DATE = re.compile(r"\d{4}(-(0[1-9]|1[0-2])(-(0[1-9]|[12]\d|3[01]))?)?")

Read = tuple[tuple[Downlink, ...], tuple[str, ...]]


@cache
def shipped() -> tuple[Downlink, ...]:
    """Return the table that ships, in its order: by band, then by satellite."""
    text = (files("birdcage.sky") / "data" / "downlinks.toml").read_text(encoding="utf-8")
    entries, problems = read_table(text, "downlinks.toml")
    if problems:
        raise ValueError(problems[0])
    return entries


def load_downlinks(user_file: Path | None = None) -> Downlinks:
    """Return the table with the user's file over it: an entry of the same satellite and frequency replaces ours.

    A file that is absent is empty. Nothing is raised: what is wrong with it stands in `problems` and does not count.
    """
    own, problems = ((), ()) if user_file is None else read_file(user_file)
    replaced = {each.key for each in own}
    return Downlinks((*own, *(each for each in shipped() if each.key not in replaced)), problems)


def read_file(path: Path) -> Read:
    """Return the entries of the user's file and its problems. One that is absent is empty."""
    try:
        text = read_user_file(path, MOST_BYTES).decode("utf-8-sig")
    except FileNotFoundError:
        return (), ()
    except OSError as error:
        return (), (f"{path} can't be read ({error.strerror or error}).",)
    except UnicodeDecodeError as error:
        return (), (f"{path} is not UTF-8 text (byte {error.start}).",)
    return read_table(text, str(path), own=True)


def read_table(text: str, where: str, *, own: bool = False) -> Read:
    """Return the entries of a text and what is wrong with it; `own` entries need neither source nor date."""
    try:
        data = clean_all(tomllib.loads(text))
    except tomllib.TOMLDecodeError as error:
        return (), (f"{where} is not valid TOML: {error}.",)
    except (RecursionError, ValueError) as error:
        # tomllib lets both through: brackets nested without end, numbers with thousands of digits.
        return (), (f"{where} is not valid TOML: {type(error).__name__}.",)
    problems = [
        f"{where}: {key} is no table of it{did_you_mean(key, ('downlink',))}." for key in data if key != "downlink"
    ]
    rows = data.get("downlink", [])
    if not isinstance(rows, list):
        return (), (*problems, f"{where}: `downlink` must be tables: [[downlink]].")
    lines = [number for number, line in enumerate(text.splitlines(), 1) if _HEADING.match(line)]
    entries: dict[tuple[str, int, int], Downlink] = {}
    for index, row in enumerate(rows):
        place = f"{where}:{lines[index]}" if len(lines) == len(rows) else f"{where}, downlink {index + 1}"
        try:
            entry = _downlink(row, own)
        except ValueError as wrong:
            problems.append(f"{place}: {wrong}.")
            continue
        if entry.key in entries:
            problems.append(f"{place}: satellite {entry.satellite!r} has that freq_mhz before.")
        entries.setdefault(entry.key, entry)
    return tuple(entries.values()), tuple(problems)


def _downlink(row: object, own: bool) -> Downlink:
    if not isinstance(row, dict):
        raise ValueError("a downlink is a table: [[downlink]]")
    for key in row:
        if key not in KEYS:
            raise ValueError(f"{key} is not a key of a downlink{did_you_mean(key, KEYS)}")
    low_mhz, high_mhz = _frequencies(row)
    polarization = row.get("polarization")
    if polarization is not None and polarization not in POLARIZATIONS:
        raise ValueError(f"polarization is {polarization!r}, not one of {', '.join(POLARIZATIONS)}")
    alive = row.get("alive", "unknown")
    if not isinstance(alive, bool) and alive != "unknown":
        raise ValueError(f'alive is {alive!r}, not true, false or "unknown"')
    date = str(row.get("date", ""))
    if (date or not own) and not _DATE.fullmatch(date):
        raise ValueError(f"date is {date!r}, not a date. Write 2026-10-16, 2026-10 or 2026")
    silent_since = str(row.get("silent_since", ""))
    if silent_since and not _DATE.fullmatch(silent_since):
        raise ValueError(f"silent_since is {silent_since!r}, not a date. Write 2025-08-13, 2025-08 or 2025")
    if silent_since and alive is not False:
        raise ValueError("silent_since goes with alive = false")
    norad_id = row.get("norad_id", 0)
    if isinstance(norad_id, bool) or not isinstance(norad_id, int) or not 0 <= norad_id <= 999_999_999:
        raise ValueError(f"norad_id is {norad_id!r}, not a catalogue number")
    satellite, names = _text(row, "satellite"), _names(row)
    return Downlink(
        satellite=satellite,
        freq_min_hz=low_mhz * 1e6,
        freq_max_hz=high_mhz * 1e6,
        mode=_text(row, "mode", "" if own else None),
        polarization=polarization,
        alive=alive if isinstance(alive, bool) else None,
        source=_text(row, "source", "your own file" if own else None),
        date=date,
        silent_since=silent_since,
        norad_id=norad_id,
        longitude_deg=_longitude(row, (satellite, *names)),
        names=names,
        note=_text(row, "note", ""),
        symbol_rate_baud=_symbol_rate(row),
        pipeline=_pipeline(row),
        pipeline_live=_flag(row, "pipeline_live", default=True),
        own=own,
    )


def _text(row: Mapping[str, object], key: str, default: str | None = None) -> str:
    value = row.get(key, default)
    if not isinstance(value, str) or (default is None and not value.strip()):
        raise ValueError(f"{key} is missing" if value is None else f"{key} is {value!r}, not a text")
    return " ".join(value.split())


def _number(value: object, key: str, low: float, high: float) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float) or not low <= value <= high:
        raise ValueError(f"{key} is {value!r}, not a number from {low:g} to {high:g}")
    return float(value)


def _frequencies(row: Mapping[str, object]) -> tuple[float, float]:
    value = row.get("freq_mhz")
    if value is None:
        raise ValueError("freq_mhz is missing: one number of MHz, or [from, to]")
    if not isinstance(value, list):
        freq = _number(value, "freq_mhz", 0.1, 1e6)
        return freq, freq
    if len(value) != 2:
        raise ValueError(f"freq_mhz has {len(value)} numbers, not one or [from, to]")
    low, high = (_number(each, "freq_mhz", 0.1, 1e6) for each in value)
    if low >= high:
        raise ValueError(f"freq_mhz goes from {low:g} to {high:g}, which is not upward")
    return low, high


def _longitude(row: Mapping[str, object], names: tuple[str, ...]) -> float | None:
    """Return its place on the arc: as the row says, else as the table of slots has a satellite of one of its names."""
    value = row.get("longitude_deg")
    if value is not None:
        return _number(value, "longitude_deg", -180.0, 180.0)
    return next((_places()[plain(each)] for each in names if plain(each) in _places()), None)


@cache
def _places() -> Mapping[str, float]:
    return {plain(name): slot.longitude_deg for slot in slots() for name in (slot.name, *slot.aliases)}


def _symbol_rate(row: Mapping[str, object]) -> float | None:
    value = row.get("symbol_rate_baud")
    return None if value is None else _number(value, "symbol_rate_baud", 1.0, 1e9)


def _pipeline(row: Mapping[str, object]) -> str:
    value = row.get("pipeline", "")
    # It goes into a command line: nothing but what SatDump's own names are made of.
    if not isinstance(value, str) or (value and not _PIPELINE.fullmatch(value)):
        raise ValueError(f"pipeline is {value!r}, not the name of a pipeline. Write metop_ahrpt")
    return value


def _flag(row: Mapping[str, object], key: str, *, default: bool) -> bool:
    value = row.get(key, default)
    if not isinstance(value, bool):
        raise ValueError(f"{key} is {value!r}, not true or false")
    return value


def _names(row: Mapping[str, object]) -> tuple[str, ...]:
    value = row.get("names", [])
    if not isinstance(value, list) or not all(isinstance(each, str) and each.strip("* ") for each in value):
        raise ValueError(f'names is {value!r}, not a list of names. Write ["IRIDIUM*"]')
    return tuple(value)
