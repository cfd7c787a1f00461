"""Files, folders and texts of several formats: the format is found, nothing good is lost, nothing bad is silent."""

from __future__ import annotations

import itertools
import json
import os
from pathlib import Path

import pytest
from birdcage.sky.formats import NumberGroup, ParseResult, read_path, read_text

LINE_1 = "1 25544U 98067A   18020.89808844  .00001789  00000-0  34232-4 0  9990"
LINE_2 = "2 25544  51.6424 359.2893 0003646 356.2318 141.8186 15.54186379 95535"
VALUES = {
    "EPOCH": "2018-01-20T21:33:14.841216",
    "MEAN_MOTION": "15.54186379",
    "ECCENTRICITY": "0.0003646",
    "INCLINATION": "51.6424",
    "RA_OF_ASC_NODE": "359.2893",
    "ARG_OF_PERICENTER": "356.2318",
    "MEAN_ANOMALY": "141.8186",
    "NORAD_CAT_ID": "25544",
    "OBJECT_ID": "1998-067A",
    "REV_AT_EPOCH": "9553",
    "BSTAR": "0.000034232",
    "MEAN_MOTION_DOT": "0.00001789",
    "MEAN_MOTION_DDOT": "0",
}


def checksummed(line: str) -> str:
    return line[:68] + str(sum(int(c) if c.isdigit() else c == "-" for c in line[:68]) % 10)


LINE_1, LINE_2 = checksummed(LINE_1), checksummed(LINE_2)


def tle(name: str) -> str:
    return f"{name}\n{LINE_1}\n{LINE_2}\n"


def written(name: str) -> dict[str, str]:
    """One satellite in every notation that is read."""
    row = {"OBJECT_NAME": name, **VALUES}
    leaves = "".join(f"<{key}>{value}</{key}>" for key, value in row.items())
    omm = f"<omm>\n<body><segment><data>{leaves}</data></segment></body>\n</omm>"
    return {
        "tle": tle(name),
        "json": json.dumps([row]) + "\n",
        "csv": f"{','.join(row)}\n{','.join(row.values())}\n",
        "kvn": "".join(f"{key} = {value}\n" for key, value in {"CCSDS_OMM_VERS": "2.0", **row}.items()),
        "xml": f'<?xml version="1.0"?>\n<ndm>\n{omm}\n</ndm>\n',
        "sat": f"[Satellite]\nVERSION=1.1\nNAME={name}\nNICKNAME={name}\nTLE1={LINE_1}\nTLE2={LINE_2}\n",
    }


def names(harvest: ParseResult) -> list[str]:
    return [one.name for one in harvest.elements]


def test_one_satellite_is_the_same_in_every_format() -> None:
    found = {kind: read_text(text, "x") for kind, text in written("ISS (ZARYA)").items()}
    assert all(len(harvest.elements) == 1 and not harvest.complaints for harvest in found.values()), found
    assert len({harvest.elements[0] for harvest in found.values()}) == 1


@pytest.mark.parametrize(("first", "second"), list(itertools.permutations(written("x"), 2)))
@pytest.mark.parametrize("gap", ["", "\n\n"])
def test_formats_one_after_another(first: str, second: str, gap: str) -> None:
    harvest = read_text(written("ONE")[first] + gap + written("TWO")[second] + gap + written("THREE")[first], "x")
    assert names(harvest) == ["ONE", "TWO", "THREE"]
    assert harvest.complaints == ()


def test_names_that_look_like_something_else() -> None:
    odd = ["[-]", "<3 SAT", "{X}", "A,B,C", "OBJECT_NAME = 5", "# 5", "1 KUNS", "2 BE", "0 0 DAY", "X, Y, NORAD_CAT_ID"]
    harvest = read_text("".join(map(tle, odd)), "x")
    assert len(harvest.elements) == len(odd)
    assert names(harvest) == [*odd[:5], "25544", *odd[6:8], "0 DAY", odd[9]]
    assert harvest.complaints == ()


def test_doubles_are_kept() -> None:
    assert names(read_text(tle("A") + tle("B") + tle("A"), "x")) == ["A", "B", "A"]


def test_a_file_of_gpredict_with_many_sections(tmp_path: Path) -> None:
    good = written("ONE")["sat"]
    bad = good.replace("ONE", "BAD").replace("51.6424", "51.642A")
    half = "[40069]\nVERSION=1.1\nNAME=HALF\n" + f"TLE1={LINE_1}\n"
    file = tmp_path / "satellites.dat"
    file.write_text(f"\n{good.replace('Satellite', '25544')}\n{bad}\n{half}\n{good.replace('ONE', 'TWO')}")
    harvest = read_path(file)
    assert names(harvest) == ["ONE", "TWO"]
    assert {one.source for one in harvest.elements} == {str(file)}
    lines = file.read_text().splitlines()
    assert [lines[c.line - 1][:10] for c in harvest.complaints] == ["TLE2=2 255", "[40069]"]
    assert "letters where digits belong" in harvest.complaints[0].why
    assert harvest.complaints[1].why == "TLE2 is missing in this section"


def test_a_satdata_folder(tmp_path: Path) -> None:
    for number in range(50):
        one = written(f"SAT {number}")["sat"]
        (tmp_path / f"{1000 + number}.sat").write_text(one.replace("\n", "\r\n"))
    (tmp_path / "amateur.cat").write_text("Amateur Radio\n7530\n24278\n\n")
    (tmp_path / "bad.cat").write_text("Weather\n25338\nNOAA 19\n")
    (tmp_path / "empty.cat").write_text("")
    (tmp_path / "readme.md").write_text("not this")
    (tmp_path / "sub").mkdir()
    (tmp_path / "sub" / "x.tle").write_text(tle("DEEP"))
    harvest = read_path(tmp_path)
    assert sorted(names(harvest)) == sorted(f"SAT {number}" for number in range(50))
    assert harvest.groups == (
        NumberGroup("Amateur Radio", (7530, 24278), str(tmp_path / "amateur.cat")),
        NumberGroup("Weather", (25338,), str(tmp_path / "bad.cat")),
    )
    assert [(Path(c.source).name, c.line) for c in harvest.complaints] == [("bad.cat", 3), ("empty.cat", 0)]
    assert str(harvest.complaints[0]) == f"{tmp_path / 'bad.cat'}:3: 'NOAA 19' is not a catalogue number"


def test_a_group_as_text() -> None:
    harvest = read_text("NOAA\n25338\n28654\n33591\n", "pasted")
    assert harvest == ParseResult(groups=(NumberGroup("NOAA", (25338, 28654, 33591), "pasted"),))


@pytest.mark.parametrize(
    ("raw", "name"),
    [
        (tle("É-ST@R").encode("latin-1"), "É-ST@R"),
        (tle("É-ST@R").encode("utf-8-sig"), "É-ST@R"),
        (tle("É-ST@R").replace("\n", "\r\n").encode("utf-16"), "É-ST@R"),
    ],
    ids=["latin-1", "utf-8 with mark", "utf-16"],
)
def test_encodings(tmp_path: Path, raw: bytes, name: str) -> None:
    file = tmp_path / "elements"
    file.write_bytes(raw)
    harvest = read_path(file)
    assert (names(harvest), harvest.complaints) == ([name], ())


@pytest.mark.parametrize(
    ("raw", "word"),
    [
        (b"\x1f\x8b\x08\xff\xfe", "unpack"),
        (b"PK\x03\x04\x00\x00", "unpack"),
        (b"", "nothing in it"),
        (b"\n \n", "nothing"),
    ],
)
def test_what_is_no_list_of_elements(tmp_path: Path, raw: bytes, word: str) -> None:
    file = tmp_path / "elements.txt"
    file.write_bytes(raw)
    (complaint,) = read_path(file).complaints
    assert (complaint.source, complaint.line, word in complaint.why) == (str(file), 0, True)


def test_what_cannot_be_opened(tmp_path: Path) -> None:
    (missing,) = read_path(tmp_path / "none.tle").complaints
    assert "No such file" in missing.why
    (empty,) = read_path(tmp_path).complaints
    assert "no file in this folder ends in" in empty.why
    if os.geteuid():
        closed = tmp_path / "closed.tle"
        closed.write_text(tle("A"))
        closed.chmod(0)
        assert "Permission denied" in read_path(closed).complaints[0].why


@pytest.mark.parametrize("kind", list(written("x")))
def test_any_cut_anywhere_raises_nothing_and_is_told(kind: str) -> None:
    """A text that ends early gives all sets before the cut, none that is wrong, and a word where one is lost."""
    text = "".join(written(name)[kind] for name in ("ONE", "TWO"))
    whole = read_text(text, "x").elements
    for end in range(1, len(text)):
        harvest = read_text(text[:end], "x")
        for one, right in zip(harvest.elements, whole, strict=False):
            assert one == right or kind in ("csv", "kvn"), text[:end][-80:]
        lost = len(written("ONE")[kind]) + 20 < end < len(text) - 80
        assert harvest.complaints or not lost or kind == "kvn", text[:end][-80:]


def test_a_few_binary_bytes_cost_their_own_lines_only(tmp_path):
    good = f"GOOD\n{LINE_1}\n{LINE_2}\n"
    damaged = good.replace("GOOD", "TORN").replace("51.6424", "51.\x0024").replace("25544", "25545")
    named = good.replace("GOOD", "NA\x01ME")
    path = tmp_path / "some.tle"
    path.write_bytes((good + damaged + named).encode() + b"B\x80D \xe9\n" + f"{LINE_1}\n{LINE_2}\n".encode())
    harvest = read_path(path)
    assert [each.name for each in harvest.elements] == ["GOOD", "NA\ufffdME", "BD é"]
    lines = [each.line for each in harvest.complaints]
    assert {6, 7} <= set(lines) <= {5, 6, 7}
    assert "binary in this line: 1 byte of no text" in [each.why for each in harvest.complaints]


PICTURE = bytes(range(256)) * 4 + bytes(99)


@pytest.mark.parametrize("body", [b"\x1f\x8b\x08" + b"x" * 99, b"PK\x03\x04" + b"x" * 99, PICTURE])
def test_what_is_packed_or_a_picture_is_no_list(tmp_path, body):
    path = tmp_path / "some.tle"
    path.write_bytes(body)
    (complaint,) = read_path(path).complaints
    assert "not a text file" in str(complaint)
