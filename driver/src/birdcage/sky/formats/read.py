"""Reads element sets from any text, file or folder, and finds the format by itself."""

from __future__ import annotations

import codecs
import re
from collections.abc import Callable
from pathlib import Path

from birdcage.base.text import clean
from birdcage.base.user_file import read_user_file
from birdcage.sky.formats import gpredict, omm_json, omm_kvn, omm_table, omm_xml, tle_text
from birdcage.sky.formats.lines import Lines, kind, split
from birdcage.sky.formats.parse_result import Complaint, ParseCollector, ParseResult

LARGEST_FILE = 200_000_000
"""Bytes. All of the world's catalogue as XML is a quarter of this."""

FOLDER_SUFFIXES = frozenset(
    (".sat", ".dat", ".cat", ".tle", ".2le", ".3le", ".txt", ".json", ".csv", ".xml", ".kvn", ".omm")
)
"""What is read of a folder; a file that is named itself may be called anything."""

MOST_BINARY = 20
"""With more than one byte in so many that is a NUL it is no text, but an archive or a picture."""
_PACKED = (b"\x1f\x8b", b"PK\x03\x04", b"BZh", b"\xfd7zXZ\0")
_BINARY = re.compile(r"[\x00-\x08\x0e-\x19\x1c-\x1f\x7f]")
"""What no text holds. Escape sequences in a name are somebody's joke: they go, and the line is good."""

_READERS: dict[str, Callable[[Lines, int, ParseCollector], int]] = {
    "tle": tle_text.read,
    "json": omm_json.read,
    "table": omm_table.read,
    "kvn": omm_kvn.read,
    "xml": omm_xml.read,
    "sections": gpredict.read_sections,
}


def read_text(text: str, source: str) -> ParseResult:
    """Return what a text holds, one format or several one after another. `source` is what complaints call it."""
    return _read(text, source, group=False)


def read_path(path: Path) -> ParseResult:
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
    return ParseResult(
        tuple(item for part in parts for item in part.elements),
        tuple(item for part in parts for item in part.complaints),
        tuple(item for part in parts for item in part.groups),
    )


def _read(text: str, source: str, *, group: bool) -> ParseResult:
    basket, lines = ParseCollector(source), split(text)
    if _BINARY.search(text):
        _name_binary(lines, basket)
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


def _read_file(path: Path) -> ParseResult:
    try:
        raw = read_user_file(path, LARGEST_FILE)
    except OSError as error:
        return _nothing(path, f"cannot be read: {error.strerror}")
    text = _decoded(raw)
    if text is None:
        return _nothing(path, "not a text file; unpack it first if it is an archive")
    return _read(text, str(path), group=path.suffix.lower() == ".cat")


def _name_binary(lines: list[str], basket: ParseCollector) -> None:
    """Name the lines that hold bytes of no text. They are not taken out: `1.0` and `5` around one are no `1.05`."""
    for number, line in enumerate(lines, 1):
        count = len(_BINARY.findall(line))
        if count:
            basket.complain(number, f"binary in this line: {count} {'byte' if count == 1 else 'bytes'} of no text")
            lines[number - 1] = _BINARY.sub("\ufffd", line)


def _nothing(path: Path, why: str) -> ParseResult:
    return ParseResult(complaints=(Complaint(clean(str(path)), 0, clean(why)),))


def _decoded(raw: bytes) -> str | None:
    """Return the text: UTF-8, UTF-16 with its mark (a redirect in PowerShell), else Latin-1; None for no text."""
    if raw.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        try:
            return raw.decode("utf-16")
        except UnicodeDecodeError:
            return None
    if raw.startswith(_PACKED) or raw.count(b"\0") * MOST_BINARY > len(raw):
        return None
    try:
        return raw.decode("utf-8-sig")
    except UnicodeDecodeError:
        return "\n".join(map(_line_of, raw.split(b"\n")))


def _line_of(raw: bytes) -> str:
    """Return one line: only names hold letters outside ASCII, and every byte is one in Latin-1."""
    try:
        return raw.decode("utf-8-sig")
    except UnicodeDecodeError:
        return raw.decode("latin-1")
