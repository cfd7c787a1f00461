"""Reads element sets from any text, file or folder, and finds the format by itself."""

from __future__ import annotations

import codecs
from collections.abc import Callable
from pathlib import Path

from birdcage.sky.formats import gpredict, omm_json, omm_kvn, omm_table, omm_xml, tle_text
from birdcage.sky.formats.harvest import Basket, Complaint, Harvest
from birdcage.sky.formats.lines import Lines, kind, split

LARGEST_FILE = 200_000_000
"""Bytes. All of the world's catalogue as XML is a quarter of this."""

FOLDER_SUFFIXES = frozenset(
    (".sat", ".dat", ".cat", ".tle", ".2le", ".3le", ".txt", ".json", ".csv", ".xml", ".kvn", ".omm")
)
"""What is read of a folder; a file that is named itself may be called anything."""

_READERS: dict[str, Callable[[Lines, int, Basket], int]] = {
    "tle": tle_text.read,
    "json": omm_json.read,
    "table": omm_table.read,
    "kvn": omm_kvn.read,
    "xml": omm_xml.read,
    "sections": gpredict.read_sections,
}


def read_text(text: str, source: str) -> Harvest:
    """Return what a text holds, one format or several one after another. `source` is what complaints call it."""
    return _read(split(text), source, group=False)


def read_path(path: Path) -> Harvest:
    """Return what a file holds, or all files of a folder whose names end like element sets; folders in it are not read.

    A file that cannot be opened or is no text is a complaint like any other.
    """
    if not path.is_dir():
        return _read_file(path)
    try:
        files = sorted(file for file in path.iterdir() if file.suffix.lower() in FOLDER_SUFFIXES and file.is_file())
    except OSError as error:
        return _nothing(path, f"cannot be read: {error.strerror}")
    if not files:
        return _nothing(path, f"no file in this folder ends in {', '.join(sorted(FOLDER_SUFFIXES))}")
    parts = [_read_file(file) for file in files]
    return Harvest(
        tuple(item for part in parts for item in part.elements),
        tuple(item for part in parts for item in part.complaints),
        tuple(item for part in parts for item in part.groups),
    )


def _read(lines: Lines, source: str, *, group: bool) -> Harvest:
    basket = Basket(source)
    if group or gpredict.is_group(lines):
        gpredict.read_group(lines, basket)
        return basket.harvest()
    at = 0
    while at < len(lines):
        if not lines[at].strip():
            at += 1
            continue
        at = _READERS[kind(lines, at)](lines, at, basket)
    if not basket.elements and not basket.complaints:
        basket.complain(0, "nothing in it: no element set was found")
    return basket.harvest()


def _read_file(path: Path) -> Harvest:
    try:
        if path.stat().st_size > LARGEST_FILE:
            return _nothing(path, f"larger than {LARGEST_FILE // 1_000_000} MB: this is no list of elements")
        raw = path.read_bytes()
    except OSError as error:
        return _nothing(path, f"cannot be read: {error.strerror}")
    text = _decoded(raw)
    if text is None:
        return _nothing(path, "not a text file; unpack it first if it is an archive")
    return _read(split(text), str(path), group=path.suffix.lower() == ".cat")


def _nothing(path: Path, why: str) -> Harvest:
    return Harvest(complaints=(Complaint(str(path), 0, why),))


def _decoded(raw: bytes) -> str | None:
    """Return the text: UTF-8, UTF-16 with its mark (a redirect in PowerShell), else Latin-1; None for no text."""
    if raw.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        try:
            return raw.decode("utf-16")
        except UnicodeDecodeError:
            return None
    if b"\0" in raw:
        return None
    try:
        return raw.decode("utf-8-sig")
    except UnicodeDecodeError:
        # Only names hold letters outside ASCII, and every byte is one in Latin-1.
        return None if raw[:2] == b"\x1f\x8b" else raw.decode("latin-1")
