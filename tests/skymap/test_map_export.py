"""Files of a map: what is in them, how they are called, and what is never written over."""

from __future__ import annotations

import csv
import io
import sys
from dataclasses import replace
from datetime import UTC, datetime

import pytest
from birdcage.base.errors import StoreError
from birdcage.skymap.map_export import base_name, write_files
from birdcage.skymap.place_blur import blurred
from birdcage.skymap.plan import MapFrame, MapPlan
from birdcage.skymap.raw_read import read_raw_text
from birdcage.skymap.sample_columns import columns_of

from tests.skymap.made import made_map, sample

PLAN = MapPlan(160.0, 162.0, 25.0, 26.0, 1.0)
BEGUN = datetime(2026, 11, 27, 23, 0, 0, tzinfo=UTC)
PLACE = {"latitude_deg": 52.01234, "longitude_deg": 4.35678, "height_m": 37.0, "dish": "Carryout G2"}


def counts(az, el):
    return 400.0 + az + el


def a_map(**other):
    return made_map(PLAN, counts, **{"number": 12, "begun": BEGUN, "about": PLACE, **other})


def table(path):
    lines = path.read_text().splitlines()
    head = [line for line in lines if line.startswith("#")]
    return head, list(csv.DictReader(io.StringIO("\n".join(lines[len(head) :]))))


def test_csv_has_every_field_of_every_sample_with_its_time_in_utc(tmp_path):
    cross = sample(None, 170.0, 40.0, 900.0, cross_number=0, lock=True, snr_db=9.5, polarisation="H")
    sky_map = replace(a_map(heard=5), crosses=(cross,))
    done = write_files(sky_map, tmp_path / "new", ("csv",))
    assert done.paths == [tmp_path / "new/map-12-20261127-230000.csv"]
    head, rows = table(done.paths[0])
    assert head[0] == "# DEMO: a simulated dish, not a real one"
    assert "# step: 1 deg, directions heard: 5 of 6" in head
    assert "# begun: 2026-11-27T23:00:00.000Z, ended: " in head
    assert "# latitude_deg: 52.01234" in head
    assert "# settings 0: transponder 1" in head
    first = sky_map.samples[0]
    assert len(rows) == 6
    assert rows[0] == {
        "cell": "0", "cross_number": "", "utc": "2026-03-20T06:00:00.000Z", "x_deg": "160.0", "y_deg": "25.0",
        "az_deg": "160.0", "el_deg": "25.0", "aim_az_deg": "", "aim_el_deg": "", "value": str(first.value),
        "scatter": "0.7", "n": "10", "integration_s": "0.5", "snr_db": "", "lock": "", "polarisation": "",
        "settings": "0", "target": "", "state": "slewing",
    }  # fmt: skip
    assert (rows[5]["cell"], rows[5]["cross_number"], rows[5]["lock"], rows[5]["polarisation"]) == ("", "0", "1", "H")


def test_every_field_of_a_sample_has_its_column():
    from dataclasses import fields

    from birdcage.skymap.sky_map import MapSample

    assert {each.name for each in fields(MapSample)} <= {each.name for each in columns_of(a_map())}


def test_raw_text_is_called_as_its_programs_call_it_and_is_read_back(tmp_path):
    done = write_files(a_map(demo=False), tmp_path, ("text",))
    assert [each.name for each in done.paths] == [
        "2026_11_27_23_00_00.txt", "raw-data-20261127-230000.txt", "scan-settings-20261127-230000.txt",
    ]  # fmt: skip
    assert (done.notes, done.left_out) == ([], [])
    for path in done.paths[:2]:
        read, _ = read_raw_text(path)
        assert read.grid().tolist() == a_map().grid().tolist()
    again = write_files(read, tmp_path / "again", ("text",))
    assert [each.name for each in again.paths] == [each.name for each in done.paths]


def test_what_raw_text_cannot_tell_is_a_note(tmp_path):
    half = replace(a_map(), plan=replace(PLAN, step_deg=0.5))
    done = write_files(half, tmp_path, ("text",))
    assert [each.name for each in done.paths] == ["2026_11_27_23_00_00.txt"]
    assert done.notes == ["No matrix of raw text: it has whole degrees, and this map steps of 0.5°."]
    assert done.left_out == []
    around = replace(a_map(), plan=MapPlan(-1.0, 1.0, -1.0, 1.0, 1.0, frame=MapFrame.TARGET))
    done = write_files(around, tmp_path, ("text", "csv"))
    assert [each.name for each in done.paths] == ["map-12-20261127-230000.csv"]
    assert done.notes == ["No raw text: it has no form for a map around a target."]
    assert done.left_out == ["text"]


def test_a_file_that_holds_something_else_stays_until_somebody_asks(tmp_path):
    path = tmp_path / "map-12-20261127-230000.csv"
    path.write_text("mine")
    done = write_files(a_map(), tmp_path, ("csv", "text"))
    assert path.read_text() == "mine"
    assert done.notes == [f"{path} exists and holds something else. --replace writes over it."]
    assert (done.left_out, len(done.paths)) == (["csv"], 3)
    assert write_files(a_map(), tmp_path, ("csv",), replace=True).left_out == []
    assert "DEMO" in path.read_text()
    assert write_files(a_map(), tmp_path, ("csv",)).paths == [path]
    assert sorted(each.name for each in tmp_path.iterdir() if each.name.startswith(".")) == []


def test_the_files_of_a_map_grow_with_it(tmp_path):
    assert write_files(a_map(heard=3), tmp_path).kept == []
    done = write_files(a_map(), tmp_path)
    assert (done.kept, len(done.paths)) == ([], 6)
    assert "directions heard: 6 of 6" in done.paths[0].read_text()
    less = write_files(a_map(heard=3), tmp_path)
    assert [each.suffix for each in less.kept] == [".csv", ".txt", ".txt"], "what is in them would be lost"


@pytest.mark.parametrize("name", ["map-12-20261127-230000.png", "map-12-20261127-230000.fits"])
def test_a_picture_of_another_program_stays(tmp_path, name):
    (tmp_path / name).write_bytes(b"\x89PNG of another program")
    assert write_files(a_map(), tmp_path).kept == [tmp_path / name]


@pytest.mark.parametrize(
    ("name", "change"),
    [
        ("map-12-20261127-230000.csv", lambda text: text + "a remark of mine\n"),
        ("raw-data-20261127-230000.txt", lambda text: text.replace("e+02", "e+01", 1)),
        ("2026_11_27_23_00_00.txt", lambda text: text.replace("160.0 25.0 ", "160.0 25.0 9", 1)),
    ],
)
def test_what_somebody_wrote_into_a_file_is_not_lost(tmp_path, name, change):
    write_files(a_map(demo=False), tmp_path)
    (tmp_path / name).write_text(change((tmp_path / name).read_text()))
    assert [each.name for each in write_files(a_map(demo=False), tmp_path).kept] == [name]


def test_a_folder_that_is_none_is_an_error_with_the_reason(tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(StoreError, match=r"map-12-20261127-230000\.csv can't be written"):
        write_files(a_map(), tmp_path / "file", ("csv",))


def test_names():
    assert base_name(a_map(begun=None)) == "map-12"
    assert base_name(blurred(a_map())) == "map-12-20261127-230000-blurred"
    mean = a_map(number=None, about={"mean_of": [12, 13]})
    assert base_name(mean) == "map-12-13-mean-20261127-230000"
    assert base_name(a_map(about={"drift_removed": True})) == "map-12-without-drift-20261127-230000"
    assert base_name(a_map(about={"minus": [9]})) == "map-12-minus-9-20261127-230000"
    read = a_map(number=None, begun=None, about={"file": "../raw data\u2026-2023.txt"})
    assert base_name(read) == "map-raw-data-2023"
    assert base_name(blurred(read)) == "map-from-file-blurred"


@pytest.mark.parametrize("frame", MapFrame)
def test_with_the_place_blurred_no_file_tells_it(tmp_path, frame):
    plan = MapPlan(10.0, 12.0, 5.0, 6.0, 1.0, frame=frame)
    around = {"aim_az_deg": 171.31313, "aim_el_deg": 33.31313}
    sky_map = made_map(plan, counts, number=12, begun=BEGUN, about={
        **PLACE, "reference_az_deg": 171.31313, "file": "garden in Delft.txt",
        **({"mean_of": [12, "garden.txt"]} if frame is MapFrame.AZEL else {}),
    }, settings=({"gain_db": "20", "url": "http://garden.example"},))  # fmt: skip
    sky_map = sky_map.with_samples(
        tuple(
            replace(each, az_deg=each.az_deg + 0.31313, **(around if frame is MapFrame.TARGET else {}))
            for each in sky_map.samples
        )
    )
    sky_map = replace(sky_map, crosses=(sample(None, 171.31313, 33.31313, 900.0, cross_number=0),))
    plain = write_files(sky_map, tmp_path, ("csv",)).paths[0].read_text()
    assert all(word in plain for word in ("52.01234", "31313", "garden", "37.0"))
    done = write_files(sky_map, tmp_path, blur_place=True)
    assert done.paths
    for path in done.paths:
        told = path.name.encode() + path.read_bytes()
        for word in (b"52.01", b"4.35", b"37.0", b"171.31", b"33.31", b"garden", b"Delft"):
            assert word not in told, (path.name, word)
        if path.suffix == ".csv":
            assert b"# latitude_deg: 52.0\n# longitude_deg: 4.0\n" in told
            assert b"rounded to whole degrees" in told
            assert (b"az_deg" in told) is (frame is MapFrame.AZEL)


@pytest.mark.parametrize(
    ("hidden", "kinds", "left_out", "words"),
    [
        (("PIL", "astropy"), ("csv", "text"), ["png", "fits"], "No PNG and no FITS without Pillow and astropy. "),
        (("PIL",), ("csv", "fits", "text"), ["png"], "No PNG without Pillow. "),
        (("astropy",), ("csv", "png", "text"), ["fits"], "No FITS without astropy. "),
    ],
)
def test_without_the_extra_all_else_is_written_and_one_line_says_how_to_get_it(
    tmp_path, monkeypatch, hidden, kinds, left_out, words
):
    for module in [each for each in sys.modules if each.partition(".")[0] in hidden]:
        monkeypatch.delitem(sys.modules, module)
    for module in hidden:
        monkeypatch.setitem(sys.modules, module, None)
    done = write_files(a_map(), tmp_path)
    assert {each.suffix for each in done.paths} == {f".{'txt' if kind == 'text' else kind}" for kind in kinds}
    assert done.left_out == left_out
    assert done.notes == [f"{words}`python -m pip install pillow astropy` brings what pictures and FITS files need."]


def test_all_kinds_are_written_with_the_extra(tmp_path):
    done = write_files(a_map(), tmp_path)
    assert [each.suffix for each in done.paths] == [".csv", ".png", ".fits", ".txt", ".txt", ".txt"]
    assert (done.notes, done.left_out) == ([], [])
    assert write_files(a_map(), tmp_path).kept == [], "the same map makes the same files"


def test_files_of_two_raw_files_of_one_name_do_not_replace_each_other(tmp_path):
    kinds = ("png", "fits")
    one = a_map(number=None, begun=None, about={"file": "garden.txt"})
    other = made_map(PLAN, lambda az, el: az - el, number=None, begun=None, about={"file": "garden.txt"})
    first = write_files(one, tmp_path, kinds)
    before = [each.read_bytes() for each in first.paths]
    done = write_files(other, tmp_path, kinds)
    assert (done.kept, done.left_out) == (first.paths, ["png", "fits"])
    assert [each.read_bytes() for each in first.paths] == before
    assert write_files(one, tmp_path, kinds).kept == []
    assert write_files(other, tmp_path, kinds, replace=True).paths == first.paths


def test_a_map_without_its_drift_has_no_raw_text_to_collide(tmp_path):
    assert write_files(a_map(), tmp_path).kept == []
    done = write_files(a_map(about={**PLACE, "drift_removed": True}), tmp_path)
    assert (done.kept, done.left_out) == ([], ["text"])
    assert "named by time alone" in done.notes[0]
