"""The conformance corpus of the PyPI package gpconf: all of it is read, by value, or told by line and reason."""

from __future__ import annotations

import json
from collections.abc import Iterator
from datetime import UTC, datetime
from functools import cache
from pathlib import Path
from typing import Any

import gpconf
import pytest
from birdcage.sky.elements import ElementSet
from birdcage.sky.formats import omm, read_path, read_text
from birdcage.sky.formats.parse_result import Unreadable
from birdcage.sky.formats.tle import catalogue_number
from gpconf.runner import Runner
from gpconf.tle import omm_fields_from_record, render, to_alpha5

CORPUS = Path(gpconf.__file__).parent / "corpus"
READABLE = (".tle", ".json", ".csv", ".xml", ".kvn")
FIXTURES = sorted(
    path.relative_to(CORPUS).as_posix()
    for path in (CORPUS / "derived").rglob("*")
    if path.suffix in READABLE and "provenance" not in path.name
)
DAMAGED = {
    "c1-checksum-digit.tle": (5, "checksum of line 1 is 1"),
    "c2-line-2-short.tle": (6, "line 2 has 68 characters"),
    "c3-letter-in-epoch.tle": (5, "letters where digits belong"),
    "c4-line-2-missing.tle": (5, "line 2 is missing"),
    "c5-cut-last-row.csv": (4, "16 columns where the head has 17"),
    "c5-cut-closing-bracket.json": (1, "before the ] that closes the list"),
}
"""Which line of the corpus's negative files is wrong, and why."""

UNEDITED = {
    "unedited-sets.tle": "c1-checksum-digit.tle",
    "unedited-rows.csv": "c5-cut-last-row.csv",
    "unedited-array.json": "c5-cut-closing-bracket.json",
}
"""A file without damage, and one whose three records are the same."""


@cache
def expected(case: str) -> dict[str, Any]:
    found: dict[str, Any] = json.loads((CORPUS / "fixtures" / case / "expected.json").read_text())
    return found


def values(record: dict[str, Any], source: str) -> ElementSet:
    """The elements that a record of the corpus stands for."""
    return ElementSet(
        name=record["object_name"] or str(record["norad_cat_id"]),
        norad_id=record["norad_cat_id"],
        epoch=datetime.fromisoformat(record["epoch"]).replace(tzinfo=UTC),
        inclination_deg=float(record["inclination"]),
        raan_deg=float(record["ra_of_asc_node"]),
        eccentricity=float(record["eccentricity"]),
        argument_of_perigee_deg=float(record["arg_of_pericenter"]),
        mean_anomaly_deg=float(record["mean_anomaly"]),
        mean_motion_rev_day=float(record["mean_motion"]),
        bstar=float(record["bstar"]),
        mean_motion_dot=float(record["mean_motion_dot"]),
        mean_motion_ddot=float(record["mean_motion_ddot"]),
        international_designator=record["object_id"] or "",
        revolution=record["rev_at_epoch"] or 0,
        source=source,
    )


def wanted(file: str) -> list[ElementSet]:
    """What the corpus says that one of its files holds, without the damaged set."""
    name, folder, source = Path(file).name, Path(file).parent.name, str(CORPUS / file)
    if folder == "corrupt-input":
        edited = UNEDITED.get(name, name)
        records = [r for r in expected("corrupt-input")["records"] if r["file"] == edited]
        assert len(records) == 3, name
        whole = name in UNEDITED or name == "c5-cut-closing-bracket.json"
        return [values(r["expected"], source) for r in records if whole or r["role"] != "corrupt"]
    case = "alpha5-tle-derived" if folder == "alpha5-tle" else "kvn-syntax-variants"
    records = [r for r in expected(case)["records"] if r["derived_file"] == name]
    if name.startswith("v07"):
        records = [r for r in expected(case)["records"] if r["derived_file"].startswith("v01")]
    assert records, name
    found = []
    for record in records:
        canonical = dict(record["canonical"])
        canonical.update(record.get("by_format", {}).get("tle", {}).get("differs_from_omm", {}))
        if name.startswith("v05"):
            # It leaves out what may be left out, and the catalogue number is among that.
            canonical["rev_at_epoch"] = canonical["norad_cat_id"] = 0
        if folder == "alpha5-tle":
            canonical["object_name"] = canonical["object_name"][:24]
        found.append(values(canonical, source))
    return found


def test_the_corpus_is_all_there() -> None:
    assert len(FIXTURES) == 22
    assert {Path(file).suffix for file in FIXTURES} == set(READABLE)


@pytest.mark.parametrize("file", FIXTURES)
def test_every_fixture_gives_every_value_or_says_which_line_is_wrong(file: str) -> None:
    harvest = read_path(CORPUS / file)
    assert list(harvest.elements) == wanted(file)
    damage = DAMAGED.get(Path(file).name)
    if damage is None:
        assert harvest.complaints == ()
    else:
        (complaint,) = harvest.complaints
        assert complaint.source == str(CORPUS / file)
        assert (complaint.line, damage[1] in complaint.why) == (damage[0], True), complaint


def test_a_source_that_had_nothing_is_no_damage() -> None:
    harvest = read_path(CORPUS / "recorded" / "celestrak-no-gp-data-found.txt")
    assert harvest.elements == ()
    assert [(c.line, "nothing for this request" in c.why) for c in harvest.complaints] == [(1, True)]


def all_records() -> Iterator[dict[str, Any]]:
    """Every record of every case whose values the corpus gives; its captures themselves are not shipped."""
    for folder in sorted((CORPUS / "fixtures").iterdir()):
        for record in expected(folder.name)["records"]:
            if "canonical" in record and record.get("expected_behaviour") is None:
                yield record["canonical"]


KEYS = {
    "NORAD_CAT_ID": "norad_cat_id",
    "OBJECT_NAME": "object_name",
    "OBJECT_ID": "object_id",
    "EPOCH": "epoch",
    "MEAN_MOTION": "mean_motion",
    "ECCENTRICITY": "eccentricity",
    "INCLINATION": "inclination",
    "RA_OF_ASC_NODE": "ra_of_asc_node",
    "ARG_OF_PERICENTER": "arg_of_pericenter",
    "MEAN_ANOMALY": "mean_anomaly",
    "EPHEMERIS_TYPE": "ephemeris_type",
    "CLASSIFICATION_TYPE": "classification_type",
    "ELEMENT_SET_NO": "element_set_no",
    "REV_AT_EPOCH": "rev_at_epoch",
    "BSTAR": "bstar",
    "MEAN_MOTION_DOT": "mean_motion_dot",
    "MEAN_MOTION_DDOT": "mean_motion_ddot",
}
META = {"CENTER_NAME": "EARTH", "REF_FRAME": "TEME", "TIME_SYSTEM": "UTC", "MEAN_ELEMENT_THEORY": "SGP4"}


def test_all_records_that_a_tle_can_hold_are_read_from_tles() -> None:
    """As the corpus's own writer, which gives CelesTrak's lines byte for byte, writes them."""
    records = [record for record in all_records() if 0 <= record["norad_cat_id"] < 340_000]
    sets = [render(omm_fields_from_record(record), mantissa_mode="round") for record in records]
    text = "\n".join(line for lines in sets for line in lines)
    harvest = read_text(text, "corpus")
    assert harvest.complaints == ()
    assert len(harvest.elements) == len(records)
    for found, record in zip(harvest.elements, records, strict=True):
        whole = values(record, "corpus")
        assert (found.norad_id, found.name, found.epoch) == (whole.norad_id, whole.name[:24].strip(), whole.epoch)
        assert (found.inclination_deg, found.raan_deg) == (whole.inclination_deg, whole.raan_deg)
        assert (found.mean_anomaly_deg, found.mean_motion_rev_day) == (
            whole.mean_anomaly_deg,
            whole.mean_motion_rev_day,
        )
        assert found.international_designator == whole.international_designator
        # What a TLE has fewer digits for: seven of the eccentricity, five of the drag term.
        assert found.eccentricity == pytest.approx(whole.eccentricity, abs=1.001e-7)
        assert found.bstar == pytest.approx(whole.bstar, rel=1e-4)
        assert found.mean_motion_ddot == pytest.approx(whole.mean_motion_ddot, rel=1e-4)


def written(records: list[dict[str, Any]], notation: str) -> str:
    """The records as CelesTrak would write them."""
    rows = [{key: record[field] for key, field in KEYS.items()} for record in records]
    text = [{key: "" if value is None else str(value) for key, value in row.items()} for row in rows]
    if notation == "json":
        return json.dumps(rows)
    if notation == "csv":
        return "\r\n".join([",".join(KEYS), *(",".join(row.values()) for row in text), ""])
    if notation == "kvn":
        return "".join(
            "CCSDS_OMM_VERS = 2.0\r\nCREATION_DATE =\r\n"
            + "".join(f"{key:19} = {value}\r\n" for key, value in {**META, **row}.items())
            for row in text
        )
    bodies = "".join(
        '<omm id="CCSDS_OMM_VERS" version="2.0"><header><CREATION_DATE/><ORIGINATOR/></header><body><segment><metadata>'
        + "".join(f"<{key}>{value}</{key}>" for key, value in META.items())
        + "</metadata><data><meanElements>"
        + "".join(
            f"<{key}>{value.replace('&', '&amp;')}</{key}>" if value else f"<{key}/>" for key, value in row.items()
        )
        + "</meanElements></data></segment></body></omm>"
        for row in text
    )
    return f'<?xml version="1.0" encoding="UTF-8"?><ndm>{bodies}</ndm>'


@pytest.mark.parametrize("notation", ["json", "csv", "kvn", "xml"])
def test_all_records_of_the_corpus_are_the_same_in_every_notation(notation: str) -> None:
    records = list(all_records())
    assert len(records) > 2000
    assert max(record["norad_cat_id"] for record in records) > 99_999
    harvest = read_text(written(records, notation), "corpus")
    assert harvest.complaints == ()
    assert list(harvest.elements) == [values(record, "corpus") for record in records]


@pytest.mark.parametrize("number", [799501621, 999999999])
@pytest.mark.parametrize("notation", ["json", "csv", "kvn", "xml"])
def test_nine_digits_in_every_notation(notation: str, number: int) -> None:
    record = {**next(all_records()), "norad_cat_id": number}
    (found,) = read_text(written([record], notation), "corpus").elements
    assert found.norad_id == number


@pytest.mark.parametrize("notation", ["json", "csv", "kvn", "xml"])
@pytest.mark.parametrize(
    "wrong",
    [
        v["text"]
        for v in json.loads((CORPUS / "vectors/norad-cat-id-text.json").read_text())["invalid_in_omm"]
        if v["text"]
    ],
)
def test_what_is_no_catalogue_number_of_an_omm_is_told(notation: str, wrong: str) -> None:
    harvest = read_text(written([{**next(all_records()), "norad_cat_id": wrong}], notation), "corpus")
    assert harvest.elements == ()
    (complaint,) = harvest.complaints
    assert "NORAD_CAT_ID" in complaint.why or "more than nine digits" in complaint.why


def vectors(name: str) -> dict[str, Any]:
    found: dict[str, Any] = json.loads((CORPUS / "vectors" / name).read_text())
    return found


def test_the_vectors_of_catalogue_numbers() -> None:
    table = vectors("alpha5.json")
    pairs = [*table["official_examples"], *table["boundaries"]]
    assert len(pairs) > 40
    assert [catalogue_number(pair["field"]) for pair in pairs] == [pair["norad_cat_id"] for pair in pairs]
    for letter, value in table["letter_table"].items():
        assert catalogue_number(f"{letter}1234") == value * 10_000 + 1234 == int(f"{value}1234")
        assert to_alpha5(value * 10_000 + 1234) == f"{letter}1234"
    for field in ("I0000", "O1234", "a0000", "A000", "A-001", "1234A", "     ", ""):
        with pytest.raises(Unreadable):
            catalogue_number(field)
    for vector in vectors("norad-cat-id-text.json")["valid"]:
        assert omm.integer(vector["text"], "NORAD_CAT_ID") == vector["value"]


def test_the_vectors_of_times() -> None:
    table = vectors("ccsds-epoch-strings.json")
    for vector in table["valid"]:
        assert omm.epoch(vector["text"]) == datetime.fromisoformat(vector["iso"]).replace(tzinfo=UTC), vector
    for vector in table["invalid"]:
        with pytest.raises(Unreadable, match="EPOCH"):
            omm.epoch(vector["text"])


def test_the_vectors_of_two_digit_years() -> None:
    table = vectors("two-digit-epoch-year.json")
    record = next(all_records())
    for vector in table["vectors"]:
        when = f"{vector['year']}-03-01T00:00:00.000000"
        lines = render(omm_fields_from_record({**record, "epoch": when}))
        (found,) = read_text("\n".join(lines), "made").elements
        assert found.epoch == datetime(vector["year"], 3, 1, tzinfo=UTC)


class Adapter:
    """What the corpus's own runner asks of a reader."""

    def parse(self, raw: bytes, fmt: str) -> list[dict[str, Any]]:
        harvest = read_text(raw.decode(), fmt)
        lines = raw.decode().splitlines()
        records: list[dict[str, Any]] = [{"_adapter": {"refusals": True}}]
        records += [
            {
                "norad_cat_id": one.norad_id or None,
                "object_name": one.name,
                "object_id": one.international_designator,
                "epoch": one.epoch,
                "mean_motion": one.mean_motion_rev_day,
                "eccentricity": one.eccentricity,
                "inclination": one.inclination_deg,
                "ra_of_asc_node": one.raan_deg,
                "arg_of_pericenter": one.argument_of_perigee_deg,
                "mean_anomaly": one.mean_anomaly_deg,
                "bstar": one.bstar,
                "mean_motion_dot": one.mean_motion_dot,
                "mean_motion_ddot": one.mean_motion_ddot,
            }
            for one in harvest.elements
        ]
        for complaint in harvest.complaints:
            line = lines[complaint.line - 1]
            number = line[2:7] if fmt == "tle" else line.partition(",U,")[2].partition(",")[0]
            records.append({"_refused": complaint.why, "_field": number, "_input": line[-60:]})
        return records


def test_the_runner_of_the_corpus_finds_no_fault(tmp_path: Path) -> None:
    results = Runner(Adapter(), root=str(CORPUS), data=str(tmp_path), fetch_hints=False).run()
    items = [(result.case_id, item) for result in results for item in result.items]
    assert [(case, i.check, i.file, i.detail) for case, i in items if i.status == "fail"] == []
    graded = [item for _, item in items if item.status in ("pass", "pass-tolerance")]
    assert len(graded) > 60
