"""One TLE: two lines of 69 columns (CelesTrak, `NORAD Two-Line Element Set Format`), read strictly by column.

A line that lost or gained a character has all later values in the wrong columns, and most of them still look like
numbers: so every separator and every decimal point must be where it belongs. The checksum may be missing, because
nothing else then is in doubt.
"""

from __future__ import annotations

import re
from datetime import UTC, datetime, timedelta
from functools import cache

from birdcage.sky.elements import ElementSet
from birdcage.sky.formats.limits import checked
from birdcage.sky.formats.parse_result import Unreadable

LENGTH = 69
BODY = 68
"""Without the checksum."""
_LETTERS = "ABCDEFGHJKLMNPQRSTUVWXYZ"
"""Of a catalogue number, for 10 to 33; I and O are left out because they look like digits."""

_WEIGHT = bytes(c - 48 if 48 <= c <= 57 else int(c == 45) for c in range(256))
"""A digit counts its value, a minus sign 1, everything else 0."""

type_of_line = re.compile(r"([12]) (?:[ \dA-Z]{3}[ \d]\d(?:[A-Z ]|$)|(?=.{38}))", re.IGNORECASE | re.ASCII).match
"""Tells an element line, whole or damaged, from a name: a number in its place, or simply too long for a name."""

_FIELDS_1 = (
    (8, 9, " ", "a blank"),
    (17, 18, " ", "a blank"),
    (18, 32, r"[\d ]\d[\d ]{2}\d\.\d{1,8} *", "an epoch (two digits of the year, three of the day, a fraction)"),
    (32, 33, " ", "a blank"),
    (33, 43, r" *[-+]?\d?\.\d+ *", "the first derivative of the mean motion"),
    (43, 44, " ", "a blank"),
    (44, 52, r"[-+ ][\d ]{4}\d[-+ ]\d| {8}", "the second derivative of the mean motion"),
    (52, 53, " ", "a blank"),
    (53, 61, r"[-+ ][\d ]{4}\d[-+ ]\d| {8}", "the drag term"),
    (61, 62, " ", "a blank"),
    (62, 63, r"[\d ]", "the ephemeris type"),
    (63, 64, " ", "a blank"),
    (64, 68, r"[\d ]{4}", "the element set number"),
)
_FIELDS_2 = (
    (7, 8, " ", "a blank"),
    (8, 16, r"[\d ]{2}\d\.\d{1,4} *", "the inclination"),
    (16, 17, " ", "a blank"),
    (17, 25, r"[\d ]{2}\d\.\d{1,4} *", "the right ascension of the node"),
    (25, 26, " ", "a blank"),
    (26, 33, r"[\d ]{6}\d", "the eccentricity"),
    (33, 34, " ", "a blank"),
    (34, 42, r"[\d ]{2}\d\.\d{1,4} *", "the argument of perigee"),
    (42, 43, " ", "a blank"),
    (43, 51, r"[\d ]{2}\d\.\d{1,4} *", "the mean anomaly"),
    (51, 52, " ", "a blank"),
    (52, 63, r"[\d ]\d\.\d{1,8} *", "the mean motion"),
    (63, 68, r"[\d ]{5}", "the revolution number"),
)


def _whole(fields: tuple[tuple[int, int, str, str], ...], start: int) -> re.Pattern[str]:
    """Return one pattern for a line from column `start` on; each field is held to its width."""
    parts = [f"(?=(?:{pattern}).{{{BODY - end}}}$).{{{end - begin}}}" for begin, end, pattern, _ in fields]
    return re.compile(f".{{{start}}}" + "".join(parts), re.ASCII)


def checksum(line: str) -> int:
    """Return the sum of the first 68 columns, modulo 10."""
    return sum(line[:BODY].encode("ascii", "replace").translate(_WEIGHT)) % 10


def catalogue_number(field: str) -> int:
    """Return the number of five columns: five digits, or a letter and four digits (Space-Track's Alpha-5).

    Leading blanks count as zeros. Raise Unreadable for anything else.
    """
    if field.isascii():
        if field.isdigit():
            return int(field)
        if len(field) == 5 and field[1:].isdigit() and field[0] in _LETTERS:
            return (_LETTERS.index(field[0]) + 10) * 10_000 + int(field[1:])
        if field.strip().isdigit() and not field.endswith(" "):
            return int(field)
        if field[:1] in ("I", "O") and field[1:].isdigit():
            raise Unreadable(f"catalogue number {field}: the letters I and O are never used, a digit was meant")
    raise Unreadable(f"catalogue number {field!r} is neither five digits nor a letter and four digits")


@cache
def _new_year(year: int) -> datetime:
    return datetime(year, 1, 1, tzinfo=UTC)


def century(two_digits: int) -> int:
    """Return the year: 57 to 99 are of the last century, since nothing flew before 1957."""
    return two_digits + (1900 if two_digits >= 57 else 2000)


def _epoch(field: str) -> datetime:
    year = century(int(field[:2]))
    day = int(field[2:5])
    if not 1 <= day <= (366 if year % 4 == 0 else 365):
        raise Unreadable(f"day {day} of {year} in the epoch does not exist", "line 1")
    # By whole numbers: eight decimals of a day are 864 microseconds, and a float would be off by some.
    fraction = field[6:].strip()
    microseconds = (int(fraction) * 86_400_000_000 + 10 ** len(fraction) // 2) // 10 ** len(fraction)
    return _new_year(year) + timedelta(days=day - 1, microseconds=microseconds)


def _power(field: str) -> float:
    """Return a number with an assumed decimal point: ` 12345-4` is 0.12345e-4."""
    if not field.strip():
        return 0.0
    digits = field[1:6].replace(" ", "0")
    exponent = field[6:].replace(" ", "+")
    return float(f"{field[0].strip()}0.{digits}e{exponent}")


def _designator(field: str) -> str:
    """Return `98067A` as `1998-067A`; what is not of that form stays as it is."""
    text = field.strip()
    if len(text) > 5 and text[:5].isdigit():
        return f"{century(int(text[:2]))}-{text[2:]}"
    return text


def _check(line: str, number: str, fields: tuple[tuple[int, int, str, str], ...]) -> None:
    """Raise Unreadable, as precisely as can be, unless every column holds what belongs there."""
    where = f"line {number}"
    wrong_length = len(line) not in (BODY, LENGTH)
    for begin, end, pattern, what in fields:
        text = line[begin:end]
        if re.fullmatch(pattern, text, re.ASCII) and len(text) == end - begin:
            continue
        if len(line) != LENGTH:
            break
        columns = f"columns {begin + 1} to {end}" if end - begin > 1 else f"column {end}"
        if what == "a blank":
            raise Unreadable(f"{where} has {text!r} in {columns}, where a blank belongs", where)
        letters = "letters where digits belong: " if re.search("[A-Za-z]", text) else ""
        raise Unreadable(f"{letters}{text!r} in {columns} of {where} is not {what}", where)
    else:
        if not wrong_length:
            return
    raise Unreadable(f"{where} has {len(line)} characters instead of {LENGTH}", where)


_LINE_1 = _whole(_FIELDS_1, 8)
_LINE_2 = _whole(_FIELDS_2, 7)


def _body(line: str, number: str) -> str:
    """Return the line, checked, in capitals and without what somebody wrote behind it."""
    line = line.rstrip().upper()
    if len(line) > LENGTH and line[LENGTH] == " ":
        line = line[:LENGTH].rstrip()
    fields, whole = (_FIELDS_1, _LINE_1) if number == "1" else (_FIELDS_2, _LINE_2)
    if len(line) not in (BODY, LENGTH) or not whole.match(line[:BODY]):
        _check(line, number, fields)
    if len(line) == LENGTH and line[BODY] != str(checksum(line)):
        raise Unreadable(
            f"checksum of line {number} is {line[BODY]}, its digits give {checksum(line)}: a character is wrong",
            f"line {number}",
        )
    return line


def parse(name: str, line_1: str, line_2: str, source: str) -> ElementSet:
    """Return the elements of the two lines; a set without a name is called by its number.

    Raise Unreadable, with `line 1` or `line 2` as the part, when either is damaged or they do not belong together.
    """
    line_1, line_2 = _body(line_1, "1"), _body(line_2, "2")
    numbers = []
    for line, where in ((line_1, "line 1"), (line_2, "line 2")):
        try:
            numbers.append(catalogue_number(line[2:7]))
        except Unreadable as unreadable:
            raise Unreadable(str(unreadable), where) from None
    if numbers[0] != numbers[1]:
        raise Unreadable(f"line 1 is of satellite {numbers[0]}, line 2 of {numbers[1]}", "line 2")
    if line_1[62] == "4":
        raise Unreadable("made for SGP4-XP (ephemeris type 4), which birdcage does not compute", "line 1")
    try:
        return checked(
            ElementSet(
                name=name or str(numbers[0]),
                norad_id=numbers[0],
                epoch=_epoch(line_1[18:32].replace(" ", "0", 4)),
                inclination_deg=float(line_2[8:16]),
                raan_deg=float(line_2[17:25]),
                eccentricity=float("0." + line_2[26:33].replace(" ", "0")),
                argument_of_perigee_deg=float(line_2[34:42]),
                mean_anomaly_deg=float(line_2[43:51]),
                mean_motion_rev_day=float(line_2[52:63]),
                bstar=_power(line_1[53:61]),
                mean_motion_dot=float(line_1[33:43]),
                mean_motion_ddot=_power(line_1[44:52]),
                international_designator=_designator(line_1[9:17]),
                revolution=int(line_2[63:68].strip().replace(" ", "0") or 0),
                source=source,
            )
        )
    except Unreadable as unreadable:
        raise Unreadable(str(unreadable), "line 1" if unreadable.where == "line 1" else "line 2") from None
