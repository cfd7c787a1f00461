"""OMM in JSON, CSV, XML and KVN: equal to sgp4's own reading, and what is damaged is told by line."""

from __future__ import annotations

import csv
import io
import json
from datetime import UTC, datetime, timedelta
from math import degrees, pi

import pytest
from birdcage.sky.formats import ParseResult, read_text
from sgp4 import omm as sgp4_omm
from sgp4.api import Satrec

ROW = {
    "OBJECT_NAME": "ISS (ZARYA)",
    "OBJECT_ID": "1998-067A",
    "EPOCH": "2026-09-20T12:42:37.141056",
    "MEAN_MOTION": "15.49196792",
    "ECCENTRICITY": ".00048259",
    "INCLINATION": "51.6308",
    "RA_OF_ASC_NODE": "188.2246",
    "ARG_OF_PERICENTER": "162.2847",
    "MEAN_ANOMALY": "197.8311",
    "EPHEMERIS_TYPE": "0",
    "CLASSIFICATION_TYPE": "U",
    "NORAD_CAT_ID": "25544",
    "ELEMENT_SET_NO": "999",
    "REV_AT_EPOCH": "58653",
    "BSTAR": ".15975118E-3",
    "MEAN_MOTION_DOT": ".8422E-4",
    "MEAN_MOTION_DDOT": "0",
}
NUMBERS = [key for key in ROW if key not in ("OBJECT_NAME", "OBJECT_ID", "EPOCH", "CLASSIFICATION_TYPE")]
META = {"CENTER_NAME": "EARTH", "REF_FRAME": "TEME", "TIME_SYSTEM": "UTC", "MEAN_ELEMENT_THEORY": "SGP4"}


def as_csv(*rows: dict[str, str]) -> str:
    return "\n".join([",".join(ROW), *(",".join(row.get(key, "") for key in ROW) for row in rows)]) + "\n"


def as_kvn(*rows: dict[str, str]) -> str:
    return (
        "\n".join("\n".join(["CCSDS_OMM_VERS = 3.0", *(f"{k} = {v}" for k, v in row.items())]) for row in rows) + "\n"
    )


def as_json(*rows: dict[str, str]) -> str:
    return json.dumps(
        [{k: float(v) if k in NUMBERS and "." in v else v for k, v in row.items()} for row in rows], indent=1
    )


def omm_xml(row: dict[str, str]) -> str:
    mean = [key for key in row if key in (*ROW,) and key not in ("OBJECT_NAME", "OBJECT_ID")]
    lines = ['<omm id="CCSDS_OMM_VERS" version="2.0">', "<body><segment>", "<metadata>"]
    lines += [f"<{k}>{row[k]}</{k}>" for k in row if k not in mean]
    lines += ["</metadata>", "<data><meanElements>", *(f"<{k}>{row[k]}</{k}>" for k in mean)]
    return "\n".join([*lines, "</meanElements>", "<tleParameters/>", "</data>", "</segment></body>", "</omm>"])


def as_xml(*rows: dict[str, str]) -> str:
    return "\n".join(['<?xml version="1.0" encoding="UTF-8"?>', "<ndm>", *map(omm_xml, rows), "</ndm>"]) + "\n"


WRITERS = {"json": as_json, "csv": as_csv, "xml": as_xml, "kvn": as_kvn}


def read(text: str) -> ParseResult:
    return read_text(text, "pasted")


@pytest.mark.parametrize("notation", list(WRITERS))
def test_the_same_as_sgp4_reads_of_an_omm(notation: str) -> None:
    (ours,) = read(WRITERS[notation](ROW)).elements
    theirs = Satrec()
    fields = next(iter(sgp4_omm.parse_csv(io.StringIO(as_csv(ROW)))))
    sgp4_omm.initialize(theirs, fields)
    assert (ours.norad_id, ours.revolution) == (theirs.satnum, theirs.revnum)
    assert ours.international_designator[2:].replace("-", "") == theirs.intldesg
    assert ours.eccentricity == theirs.ecco
    assert ours.bstar == theirs.bstar
    assert ours.inclination_deg == pytest.approx(degrees(theirs.inclo), rel=1e-14)
    assert ours.raan_deg == pytest.approx(degrees(theirs.nodeo), rel=1e-14)
    assert ours.argument_of_perigee_deg == pytest.approx(degrees(theirs.argpo), rel=1e-14)
    assert ours.mean_anomaly_deg == pytest.approx(degrees(theirs.mo), rel=1e-14)
    assert ours.mean_motion_rev_day == pytest.approx(theirs.no_kozai * 720.0 / pi, rel=1e-14)
    assert ours.mean_motion_dot == pytest.approx(theirs.ndot * 1440.0**2 / (2.0 * pi), rel=1e-12)
    day = timedelta(days=theirs.jdsatepoch - 2451544.5 + theirs.jdsatepochF)
    assert abs(ours.epoch - datetime(2000, 1, 1, tzinfo=UTC) - day) < timedelta(microseconds=5)


DAMAGE = [
    ("EPOCH", "2026-09-31T00:00:00", "no such day"),
    ("EPOCH", "26263.5", "not a time"),
    ("EPOCH", "", "EPOCH is empty"),
    ("MEAN_MOTION", "fast", "not a number"),
    ("MEAN_MOTION", "nan", "not a number"),
    ("MEAN_MOTION", "1_5", "not a number"),
    ("MEAN_MOTION", "155.0", "mean motion 155"),
    ("ECCENTRICITY", "1.5", "eccentricity 1.5"),
    ("ECCENTRICITY", "-0.1", "eccentricity -0.1"),
    ("INCLINATION", "181", "inclination 181"),
    ("RA_OF_ASC_NODE", "1e9", "right ascension"),
    ("BSTAR", "", "BSTAR is empty"),
    ("NORAD_CAT_ID", "A0000", "not a whole number"),
    ("EPHEMERIS_TYPE", "4", "SGP4-XP"),
]


@pytest.mark.parametrize("notation", list(WRITERS))
@pytest.mark.parametrize(("key", "value", "word"), DAMAGE)
def test_a_wrong_value_is_told_with_its_line_and_costs_no_other(notation: str, key: str, value: str, word: str) -> None:
    good = {**ROW, "OBJECT_NAME": "GOOD"}
    text = WRITERS[notation](good, {**ROW, key: value or " "}, good)
    harvest = read(text.replace('" "', '""'))
    assert [one.name for one in harvest.elements] == ["GOOD", "GOOD"]
    (complaint,) = harvest.complaints
    assert word in complaint.why, complaint
    line = text.splitlines()[complaint.line - 1]
    if notation == "csv":
        assert complaint.line == 3
    else:
        assert key in line
        assert value in line or notation == "json"


@pytest.mark.parametrize("notation", ["xml", "kvn", "json"])
@pytest.mark.parametrize(("key", "value"), [("REF_FRAME", "EME2000"), ("TIME_SYSTEM", "GPS"), ("CENTER_NAME", "MARS")])
def test_elements_in_another_frame_are_not_taken_for_ours(notation: str, key: str, value: str) -> None:
    assert read(WRITERS[notation]({**META, **ROW})).complaints == ()
    harvest = read(WRITERS[notation]({**META, **ROW, key: value}))
    assert harvest.elements == ()
    assert f"{key} is {value!r}" in harvest.complaints[0].why


def test_satnogs_and_space_track_lines_in_json() -> None:
    line_1 = "1 25544U 98067A   18020.89808844  .00001789  00000-0  34232-4 0  9998"
    line_2 = "2 25544  51.6424 359.2893 0003646 356.2318 141.8186 15.54186379 95531"
    found = [{"tle0": "0 ISS", "tle1": line_1, "tle2": line_2, "norad_cat_id": 25544, "updated": "2026-11-20"}]
    harvest = read(json.dumps(found))
    complaint = [c.why for c in harvest.complaints]
    pair = read_text(f"ISS\n{line_1}\n{line_2}", "pasted")
    assert harvest.elements == pair.elements
    assert len(complaint) == len(pair.complaints)
    assert len(harvest.elements) + len(complaint) == 1


@pytest.mark.parametrize(
    ("damage", "kept", "word"),
    [
        (lambda text: text.rstrip().removesuffix("]"), 3, "before the ]"),
        (lambda text: text[: text.rindex("EPHEMERIS")], 2, "the text ends inside"),
        (lambda text: text.replace('"B",\n  "OBJECT_ID"', '"B"\n  "OBJECT_ID"'), 2, "damaged JSON"),
        (lambda text: text.replace('"INCLINATION": 51.6308', '"INCLINATION": 51.', 1), 2, "damaged JSON"),
        (lambda text: text.replace("},", "}, 7,", 1), 3, "no element set: '7"),
        (lambda text: text.rstrip() + " garbage", 3, "behind the JSON"),
    ],
)
def test_damaged_json_costs_only_what_is_damaged(damage: object, kept: int, word: str) -> None:
    text = json.dumps([{**ROW, "OBJECT_NAME": name} for name in "ABC"], indent=2).replace('"51.6308"', "51.6308")
    broken = damage(text.replace("  ", " ").replace('\n  "', '\n  "').replace('\n "', '\n  "'))  # type: ignore[operator]
    harvest = read(broken)
    assert len(harvest.elements) == kept, harvest.complaints
    assert any(word in complaint.why for complaint in harvest.complaints), harvest.complaints


@pytest.mark.parametrize(
    "text",
    [
        "[" * 100_000,
        '{"a":' * 100_000,
        "{" * 1000,
        '[{"EPOCH": ' + "9" * 5000 + "}]",
        "[[[]",
        '{"OBJECT_NAME": "',
        "[1e999999]",
    ],
)
def test_hostile_json_is_a_complaint(text: str) -> None:
    harvest = read(text)
    assert harvest.elements == ()
    assert harvest.complaints


BOMB = """<?xml version="1.0"?>
<!DOCTYPE ndm [<!ENTITY a "aaaaaaaaaa"><!ENTITY b "&a;&a;&a;&a;&a;&a;&a;&a;&a;&a;">]>
<ndm><omm><OBJECT_NAME>&b;</OBJECT_NAME></omm></ndm>"""


def test_entities_are_never_expanded() -> None:
    (complaint,) = read(BOMB).complaints
    assert "document type or entities" in complaint.why
    hidden = as_xml(ROW).replace("ISS (ZARYA)", "&b;")
    harvest = read(hidden)
    assert harvest.elements == ()
    assert "undefined entity" in harvest.complaints[0].why
    inside = as_xml(ROW).replace("<body>", '<!DOCTYPE x [<!ENTITY b "c">]><body>')
    assert read(inside).elements == ()


def test_a_damaged_message_in_xml_costs_no_other() -> None:
    rows = [{**ROW, "OBJECT_NAME": name} for name in ("A &amp; B", "BAD", "C")]
    text = as_xml(*rows)
    for damage in ("<NORAD_CAT_ID>", "</EPOCH>", "</segment></body>\n</omm>"):
        at = text.index(damage, text.index("BAD"))
        harvest = read(text[:at] + text[at + len(damage) :])
        assert [one.name for one in harvest.elements] == ["A & B", "C"]
        (complaint,) = harvest.complaints
        assert complaint.why.startswith("BAD: ")
        first, last = text[: text.index("BAD")].count("\n"), text[: text.index(">C<")].count("\n")
        assert first - 5 <= complaint.line <= last


def test_xml_that_was_cut_keeps_what_was_whole() -> None:
    text = as_xml(ROW, {**ROW, "OBJECT_NAME": "SECOND"})
    harvest = read(text[: text.rindex("</MEAN_ANOMALY>")])
    assert [one.name for one in harvest.elements] == ["ISS (ZARYA)"]
    assert any("SECOND: this <omm> is not closed: it was cut" in c.why for c in harvest.complaints)
    assert any("before </ndm>" in c.why for c in harvest.complaints)


@pytest.mark.parametrize(
    ("text", "word"),
    [
        ("<!DOCTYPE html>\n<html><body>502</body></html>", "a web page"),
        ("<html>\n<body>Please log in</body></html>", "a web page"),
        ("<kml><Document/></kml>", "<kml>; element sets are in <ndm> or <omm>"),
        ("<ndm><opm/></ndm>", "holds no <omm>"),
        ("<ndm>" + "<omm>" + "<x>" * 5000, "nested too deep"),
    ],
)
def test_other_xml_is_named(text: str, word: str) -> None:
    harvest = read(text)
    assert harvest.elements == ()
    assert word in harvest.complaints[0].why


def test_tables_in_other_dress() -> None:
    semicolons = as_csv(ROW).replace(",", ";")
    quoted = io.StringIO()
    writer = csv.DictWriter(quoted, list(ROW), quoting=csv.QUOTE_ALL)
    writer.writeheader()
    writer.writerow({**ROW, "OBJECT_NAME": 'A, "B"'})
    assert read(semicolons).elements == read(as_csv(ROW)).elements
    assert [one.name for one in read(quoted.getvalue()).elements] == ['A, "B"']
    (complaint,) = read("OBJECT_NAME,NORAD_CAT_ID,OWNER\nISS,25544,ISS\n").complaints
    assert "a table without EPOCH" in complaint.why


def test_units_only_behind_numbers_and_a_line_that_is_none() -> None:
    text = as_kvn({**ROW, "OBJECT_NAME": "COSMOS 2619 [GLONASS-K1]", "INCLINATION": "51.6308 [deg]"})
    (found,) = read(text).elements
    assert (found.name, found.inclination_deg) == ("COSMOS 2619 [GLONASS-K1]", 51.6308)
    broken = as_kvn({**ROW, "OBJECT_NAME": "A"}, {**ROW, "OBJECT_NAME": "B"}).replace(
        "RA_OF_ASC_NODE =", "RA_OF_ASC_NODE", 1
    )
    harvest = read(broken)
    assert [one.name for one in harvest.elements] == ["B"]
    (complaint,) = harvest.complaints
    assert broken.splitlines()[complaint.line - 1].startswith("RA_OF_ASC_NODE")
