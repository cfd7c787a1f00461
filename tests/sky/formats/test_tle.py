"""TLEs: what is tolerated, what is not, and how that is told."""

from __future__ import annotations

import itertools
from datetime import UTC, datetime, timedelta
from math import degrees, pi
from pathlib import Path

import pytest
import sgp4
from birdcage.sky.formats import ParseResult, read_text
from sgp4.api import Satrec

NAME = "ISS (ZARYA)"
LINE_1 = "1 25544U 98067A   26263.52959654  .00008215  00000+0  15975-3 0  9992"
LINE_2 = "2 25544  51.6320 177.5190 0007710 244.6210 115.4136 15.49331404588501"


def checksummed(line: str) -> str:
    """The first 68 columns with the digit that belongs behind them."""
    return line[:68] + str(sum(int(c) if c.isdigit() else c == "-" for c in line[:68]) % 10)


LINE_1, LINE_2 = checksummed(LINE_1), checksummed(LINE_2)


def read(*lines: str, end: str = "\n") -> ParseResult:
    return read_text(end.join(lines), "pasted")


def only_complaint(harvest: ParseResult) -> tuple[int, str]:
    assert harvest.elements == ()
    assert len(harvest.complaints) == 1, harvest.complaints
    assert harvest.complaints[0].source == "pasted"
    return harvest.complaints[0].line, harvest.complaints[0].why


def test_all_values_of_a_set() -> None:
    (iss,) = read(NAME, LINE_1, LINE_2).elements
    assert (iss.name, iss.norad_id, iss.international_designator, iss.revolution) == (NAME, 25544, "1998-067A", 58850)
    assert iss.epoch == datetime(2026, 9, 20, 12, 42, 37, 141056, tzinfo=UTC)
    assert (iss.inclination_deg, iss.raan_deg, iss.eccentricity) == (51.632, 177.519, 0.000771)
    assert (iss.argument_of_perigee_deg, iss.mean_anomaly_deg) == (244.621, 115.4136)
    assert (iss.mean_motion_rev_day, iss.mean_motion_dot, iss.mean_motion_ddot) == (15.49331404, 0.00008215, 0.0)
    assert (iss.bstar, iss.source) == (0.00015975, "pasted")


@pytest.mark.parametrize(
    "text",
    [
        f"{NAME}\r\n{LINE_1}\r\n{LINE_2}\r\n",
        f"\ufeff{NAME}\n{LINE_1}\n{LINE_2}",
        f"{NAME}\r{LINE_1}\r{LINE_2}\r",
        f"\n\n{NAME}   \n\n{LINE_1}  \n\n{LINE_2}\t\n\n",
        f"0 {NAME}\n{LINE_1}\n{LINE_2}\n",
        f"{NAME}\n{LINE_1.lower()}\n{LINE_2.lower()}\n",
        f"{NAME}\n{LINE_1[:68]}\n{LINE_2[:68]}\n",
        f"# of this morning\n{NAME}\n  {LINE_1}\n  {LINE_2}\n",
        f"{NAME}\n{LINE_1}\n{LINE_2}      0.00      1440.0       20.00\n",
    ],
    ids=["crlf", "bom", "cr", "blanks", "numbered name", "lower case", "no checksum", "indented", "text behind"],
)
def test_what_is_tolerated(text: str) -> None:
    harvest = read_text(text, "pasted")
    assert harvest.complaints == ()
    assert harvest.elements == read(NAME, LINE_1, LINE_2).elements


def test_a_set_without_a_name_is_called_by_its_number() -> None:
    assert [e.name for e in read(LINE_1, LINE_2, LINE_1, LINE_2).elements] == ["25544", "25544"]


@pytest.mark.parametrize(
    ("lines", "line", "word"),
    [
        ([NAME, LINE_1[:68] + "0", LINE_2], 2, "checksum of line 1 is 0"),
        ([NAME, LINE_1, LINE_2[:68] + "9"], 3, "checksum of line 2 is 9"),
        ([NAME, LINE_1, LINE_2[:30] + LINE_2[31:]], 3, "68 characters instead of 69"),
        ([NAME, LINE_1, LINE_2[:50]], 3, "50 characters instead of 69"),
        ([NAME, LINE_1, LINE_2[:30] + "1" + LINE_2[30:]], 3, "70 characters instead of 69"),
        ([NAME, LINE_1[:8], LINE_2], 2, "8 characters instead of 69"),
        ([NAME, checksummed(LINE_1.replace("52959654", "5295965O")), LINE_2], 2, "letters where digits belong"),
        ([NAME, LINE_1, checksummed(LINE_2.replace("51.6320", "51,6320"))], 3, "is not the inclination"),
        ([NAME, LINE_1, checksummed(LINE_2.replace(" 51.6320", "181.6320"))], 3, "inclination 181.632"),
        ([NAME, LINE_1, checksummed(LINE_2.replace("177.5190", "377.5190"))], 3, "node 377.519"),
        ([NAME, LINE_1, checksummed(LINE_2.replace("15.49331404", " 0.00000000"))], 3, "mean motion 0"),
        ([NAME, checksummed(LINE_1.replace("26263", "26366")), LINE_2], 2, "day 366 of 2026"),
        ([NAME, checksummed(LINE_1.replace("26263", "26000")), LINE_2], 2, "day 0 of 2026"),
        ([NAME, LINE_1, checksummed(LINE_2.replace("25544", "25545"))], 3, "of satellite 25544, line 2 of 25545"),
        ([NAME, checksummed(LINE_1.replace("25544", "I5544")), LINE_2], 2, "letters I and O are never used"),
        ([NAME, checksummed(LINE_1[:62] + "4" + LINE_1[63:]), LINE_2], 2, "SGP4-XP"),
        ([NAME, LINE_1], 2, "line 2 is missing"),
        ([NAME, LINE_2], 2, "line 1 is missing"),
        ([NAME], 1, "no elements follow"),
        (["No GP data found"], 1, "nothing for this request"),
    ],
)
def test_a_damaged_set_is_told_by_line_and_reason_and_costs_no_other(lines: list[str], line: int, word: str) -> None:
    at, why = only_complaint(read(*lines))
    assert (at, word in why) == (line, True), why
    good = ["GOOD", LINE_1, LINE_2]
    around = read(*good, *lines, "", *good)
    assert [e.name for e in around.elements] == ["GOOD", "GOOD"]
    assert [(c.line, word in c.why) for c in around.complaints] == [(line + 3, True)]


@pytest.mark.parametrize(
    ("field", "number"),
    [("00005", 5), ("    5", 5), ("A0000", 100000), ("H9999", 179999), ("J0000", 180000), ("Z9999", 339999)],
)
def test_catalogue_numbers_of_five_columns(field: str, number: int) -> None:
    lines = [checksummed(line.replace("25544", field)) for line in (LINE_1, LINE_2)]
    (found,) = read(NAME, *lines).elements
    assert found.norad_id == number


def test_the_century_turns_at_57() -> None:
    years = []
    for two in ("56", "57"):
        (found,) = read(checksummed(LINE_1.replace("26263", two + "263")), LINE_2).elements
        years.append(found.epoch.year)
    assert years == [2056, 1957]


def test_prose_is_one_complaint_not_one_a_line() -> None:
    harvest = read("Hello,", "here are the elements", "that you asked for.", NAME, LINE_1, LINE_2, "Regards", "Jo")
    assert [e.name for e in harvest.elements] == [NAME]
    assert [(c.line, "to line" in c.why) for c in harvest.complaints] == [(1, True), (7, True)]


def test_the_same_numbers_as_sgp4_reads_from_its_own_verification_set() -> None:
    text = (Path(sgp4.__file__).parent / "SGP4-VER.TLE").read_text()
    lines = text.splitlines()
    harvest = read_text(text, "ver")
    # Three sets at its end were made up to fail, and their first lines carry the checksums of others.
    assert [(c.line, c.why.split(":")[0]) for c in harvest.complaints] == [
        (at, f"checksum of line 1 is {lines[at - 1][68]}, its digits give {checksummed(lines[at - 1])[68]}")
        for at in (100, 103, 106)
    ]
    pairs = [(a[:69], b[:69]) for a, b in itertools.pairwise(lines) if a[:2] == "1 " and b[:2] == "2 "]
    pairs = [pair for pair in pairs if checksummed(pair[0]) == pair[0]]
    assert len(harvest.elements) == len(pairs) == 30
    for ours, pair in zip(harvest.elements, pairs, strict=True):
        theirs = Satrec.twoline2rv(*pair)
        assert ours.norad_id == theirs.satnum
        assert ours.eccentricity == pytest.approx(theirs.ecco, rel=1e-14)
        assert ours.inclination_deg == pytest.approx(degrees(theirs.inclo), rel=1e-14)
        assert ours.raan_deg == pytest.approx(degrees(theirs.nodeo), rel=1e-14)
        assert ours.argument_of_perigee_deg == pytest.approx(degrees(theirs.argpo), rel=1e-14)
        assert ours.mean_anomaly_deg == pytest.approx(degrees(theirs.mo), rel=1e-14)
        assert ours.mean_motion_rev_day == pytest.approx(theirs.no_kozai * 720.0 / pi, rel=1e-14)
        assert ours.bstar == pytest.approx(theirs.bstar, rel=1e-14)
        assert ours.mean_motion_dot == pytest.approx(theirs.ndot * 1440.0**2 / (2.0 * pi), rel=1e-12)
        assert ours.mean_motion_ddot == pytest.approx(theirs.nddot * 1440.0**3 / (2.0 * pi), rel=1e-12)
        assert ours.revolution == theirs.revnum
        day = theirs.jdsatepoch - 2451544.5 + theirs.jdsatepochF
        assert ours.epoch - datetime(2000, 1, 1, tzinfo=UTC) == pytest.approx(
            timedelta(days=day), abs=timedelta(microseconds=2)
        )


def test_ten_thousand_sets_are_all_read() -> None:
    assert len(read_text(f"{NAME}\n{LINE_1}\n{LINE_2}\n" * 10_000, "big").elements) == 10_000
