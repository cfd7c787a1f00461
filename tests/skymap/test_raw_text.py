"""The raw text of other sky-scan programs: read in each published form, and written so that they read it."""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np
import pytest
from birdcage.base.errors import StoreError
from birdcage.skymap.plan import MapFrame, MapOrder, MapPlan
from birdcage.skymap.raw_read import read_raw_text
from birdcage.skymap.raw_text import NotInThisForm, as_lines, as_matrix

from tests.skymap.made import made_map


def matrix(folder, values, settings, stamp="20230321-193653"):
    path = folder / f"raw-data-{stamp}.txt"
    np.savetxt(path, values)
    np.savetxt(folder / f"scan-settings-{stamp}.txt", settings)
    return path


def value_at(sky_map, az, el):
    found = [
        each.value for each in sky_map.samples if abs(each.az_deg - az) < 1e-6 and abs(each.el_deg - el) < 1e-6
    ]  # fmt: skip
    assert len(found) <= 1
    return found[0] if found else None


def test_lines_of_the_g2(tmp_path):
    path = tmp_path / "2024_05_01_12_00_00.txt"
    lines = [f"{az}.0 {el}.0 {398 + (az * 7 + el) % 164}" for az in range(110, 241) for el in range(18, 59)]
    lines[3] = "110.0 21.0 -1"
    path.write_text("\n".join(lines) + "\n")
    sky_map, notes = read_raw_text(path)
    assert (sky_map.plan.columns, sky_map.plan.rows, len(sky_map.samples), notes) == (131, 41, 5370, [])
    assert (value_at(sky_map, 110, 18), value_at(sky_map, 240, 58)) == (398 + 788 % 164, 398 + 1738 % 164)
    assert value_at(sky_map, 110, 21) is None
    assert (sky_map.unit, sky_map.decibels, sky_map.begun, sky_map.demo) == ("counts", False, None, False)
    assert sky_map.about["file"] == path.name


def test_lines_in_steps_of_half_a_degree_with_rows_missing_at_the_end(tmp_path):
    path = tmp_path / "scan.txt"
    path.write_text("110.0 18.0 400\n110.0 18.5 401\n110.5 18.0 402\n")
    sky_map, _ = read_raw_text(path)
    assert (sky_map.plan.step_deg, sky_map.plan.cells, len(sky_map.samples)) == (0.5, 4, 3)
    assert np.isnan(sky_map.grid()[1, 1])
    assert sky_map.grid()[0].tolist() == [400.0, 402.0]


def test_the_tailgater_has_the_highest_angles_first(tmp_path):
    values = np.zeros((66, 181))
    values[1:, 1:] = 2738 + np.arange(65 * 180).reshape(65, 180) % 1111
    sky_map, notes = read_raw_text(matrix(tmp_path, values, (90, 270, 5, 70, 1)))
    assert (sky_map.plan.columns, sky_map.plan.rows, len(sky_map.samples)) == (181, 66, 65 * 180)
    assert value_at(sky_map, 269, 69) == 2738.0
    assert value_at(sky_map, 90, 69) == 2738.0 + 179
    assert value_at(sky_map, 269, 5) == values[65, 1]
    assert value_at(sky_map, 270, 70) is None
    assert any("counterclockwise" in note for note in notes)


@pytest.mark.parametrize("above", [3, 5])
def test_the_high_resolution_of_the_tailgater(tmp_path, above):
    values = 3000.0 + np.arange((10 * above + 1) * 101).reshape(10 * above + 1, 101)
    sky_map, _ = read_raw_text(matrix(tmp_path, values, (90, 110, 30, 40, 2)))
    assert (sky_map.plan.columns, sky_map.plan.rows) == (101, 10 * above + 1)
    assert value_at(sky_map, 110, 40) == 3000.0
    assert value_at(sky_map, 109.8, 40) == 3001.0
    assert value_at(sky_map, 110, 40 - 1 / above) == 3101.0


def test_the_fork_that_keeps_elevation_in_steps(tmp_path):
    values = np.full((61, 181), 2476.0)
    values[0, 0], values[60, 180], values[5, 5] = 3719.0, 2500.0, -1.0
    sky_map, _ = read_raw_text(matrix(tmp_path, values, (90, 270, 400, 1420, 2)))
    assert (sky_map.plan.y_low_deg, sky_map.plan.y_high_deg, sky_map.plan.step_deg) == (0.0, 60.0, 1.0)
    assert (value_at(sky_map, 270, 60), value_at(sky_map, 90, 0)) == (3719.0, 2500.0)
    assert value_at(sky_map, 265, 55) is None
    assert len(sky_map.samples) == 61 * 181 - 1


def test_the_carryout_has_the_lowest_azimuth_in_its_second_column(tmp_path):
    values = np.zeros((31, 182))
    for el in range(22, 53):  # as the program does it, negative columns and all
        for az in range(90, 271):
            values[abs(el - 52), az - 271] = -42.7 + az / 100.0 + el / 10.0
    sky_map, notes = read_raw_text(matrix(tmp_path, values, (90, 271, 22, 52, 1, 1552.2, 1, 40.0)))
    assert (sky_map.plan.x_low_deg, sky_map.plan.x_high_deg, len(sky_map.samples)) == (90.0, 270.0, 31 * 181)
    assert value_at(sky_map, 90, 22) == pytest.approx(-42.7 + 0.9 + 2.2)
    assert value_at(sky_map, 270, 52) == pytest.approx(-42.7 + 2.7 + 5.2)
    assert (sky_map.unit, sky_map.decibels) == ("dB", True)
    assert sky_map.settings == ({"freq_hz": "1552200000", "bias_tee": "1", "gain_db": "40"},)
    assert any("shifted" in note for note in notes)


def test_the_discovery_drive_scans_beyond_its_ends(tmp_path):
    values = np.full((31, 120), -45.9)
    values[:, 0] = 0.0
    sky_map, _ = read_raw_text(matrix(tmp_path, values, (136, 255, 15, 45, 1, 1694.1, 1, 20.7)))
    assert (sky_map.plan.x_low_deg, sky_map.plan.x_high_deg, sky_map.is_complete) == (136.0, 254.0, True)
    values = np.full((31, 370), -45.9)
    sky_map, notes = read_raw_text(matrix(tmp_path, values, (-4, 365, 15, 45, 1, 1694.1, 1, 20.7)))
    assert (sky_map.plan.x_low_deg, sky_map.plan.x_high_deg) == (0.0, 360.0)
    assert "8 columns beyond a whole turn are left out." in notes


def test_the_tracvision_counts_tenths(tmp_path):
    def line(el):
        told = {abs(az - 3599): 1 + az + el for az in range(0, 3599, 10)}
        return " ".join(f"{told.get(column, 0):.18e}" for column in range(3600))

    path, nothing = tmp_path / "raw-data-20240101-000000.txt", " ".join(["0.000000000000000000e+00"] * 3600)
    filled = {abs(el - 700): el for el in range(100, 700, 10)}
    path.write_text("".join(f"{line(filled[row]) if row in filled else nothing}\n" for row in range(601)))
    (tmp_path / "scan_settings_20240101-000000.txt").write_text("0\n3599\n100\n700\n")
    assert path.stat().st_size > 54_000_000
    sky_map, _ = read_raw_text(path)
    assert (sky_map.plan.columns, sky_map.plan.rows, sky_map.plan.step_deg, sky_map.is_complete) == (360, 60, 1.0, True)
    assert value_at(sky_map, 0, 10) == 101.0
    assert value_at(sky_map, 359, 69) == 1 + 3590 + 690


def counts(az, el):
    return 400.0 + round(az * 3 + el * 5) % 97


def test_lines_are_written_as_the_g2_wants_them_and_read_back(tmp_path):
    plan = MapPlan(350.0, 352.0, 20.0, 21.0, 1.0)
    sky_map = made_map(plan, counts, heard=5, demo=False)
    text = as_lines(sky_map).decode()
    missing = plan.at(next(cell for cell in range(6) if cell not in {each.cell for each in sky_map.samples}))
    assert [line.split()[:2] for line in text.splitlines()] == [
        ["350.0", "20.0"], ["350.0", "21.0"], ["351.0", "20.0"], ["351.0", "21.0"], ["352.0", "20.0"],
        ["352.0", "21.0"],
    ]  # fmt: skip
    assert f"{missing[0]} {missing[1]} -1" in text.splitlines()
    assert re.fullmatch(r"(\d+\.\d \d+\.\d (\d+|-1)\n)+", text)
    path = tmp_path / "2026_11_27_23_00_00.txt"
    path.write_text(text)
    read, _ = read_raw_text(path)
    assert np.array_equal(read.grid(), sky_map.grid(), equal_nan=True)


@pytest.mark.parametrize("decibels", [False, True])
def test_a_matrix_is_written_as_its_program_wants_it_and_read_back(tmp_path, decibels):
    plan = MapPlan(350.0, 380.0, 20.0, 25.0, 1.0, MapOrder.ROWS)
    sky_map = made_map(plan, lambda az, el: counts(az, el) - 450.5, heard=100, demo=True, decibels=decibels,
                       unit="dB" if decibels else "counts", about={"freq_hz": 1694.1e6})  # fmt: skip
    sky_map = replace(sky_map, settings=({"gain_db": "20.7"},))
    raw, settings = as_matrix(sky_map)
    (tmp_path / "raw-data-20261127-230000.txt").write_bytes(raw)
    (tmp_path / "scan-settings-20261127-230000.txt").write_bytes(settings)
    loaded, told = (np.loadtxt(tmp_path / f"{each}-20261127-230000.txt") for each in ("raw-data", "scan-settings"))
    if decibels:
        assert told.tolist() == pytest.approx([350, 381, 20, 25, 1, 1694.1, -1, 20.7])
        assert loaded.shape == (6, 32)
        assert loaded[25 - 20, 355 - 381] == sky_map.grid()[0, 5]
    else:
        assert told.tolist() == [350, 380, 20, 25, 1]
        assert loaded[25 - 20, 380 - 355] == sky_map.grid()[0, 5]
    read, _ = read_raw_text(tmp_path / "raw-data-20261127-230000.txt")
    assert np.array_equal(read.grid(), sky_map.grid(), equal_nan=True)
    assert read.demo
    assert raw.startswith(b"# DEMO")


@pytest.mark.parametrize(
    ("write", "changed", "why"),
    [
        (as_lines, {"decibels": True}, "counts from 0 up only"),
        (as_matrix, {"decibels": True}, "frequency, which is not known"),
        (as_matrix, {"plan": MapPlan(160.0, 161.0, 25.0, 26.0, 0.5)}, "steps of 0.5°"),
        (as_matrix, {"plan": MapPlan(160.3, 161.3, 25.0, 26.0, 1.0)}, "whole degrees"),
        (as_lines, {"plan": MapPlan(-1.0, 1.0, -1.0, 1.0, 1.0, frame=MapFrame.TARGET)}, "around a target"),
    ],
)
def test_what_a_form_cannot_tell_is_refused_with_the_reason(write, changed, why):
    sky_map = replace(made_map(MapPlan(160.0, 162.0, 25.0, 26.0, 1.0), counts), **changed)
    with pytest.raises(NotInThisForm, match=why):
        write(sky_map)


ENEMIES = {
    "no text": (b"\xff\xfe\x00binary", "byte 1 is no ASCII"),
    "empty": (b"", "holds no direction"),
    "two words": (b"110.0 18.0 400\n110.0 19.0\n", "line 2: 2 words"),
    "a word": (b"110.0 eighteen 400\n", "line 1: “eighteen” is no number"),
    "escape": (b"110.0 \x1b[2J 400\n", "is no number"),
    "angle nan": (b"110.0 nan 400\n", "“nan” stands where a finite number belongs"),
    "twice": (b"110.0 18.0 400\n110.0 18.0 401\n", "line 2: line 1 has the same direction"),
    "off the grid": (b"110.0 18.0 4\n111.0 18.0 4\n112.3 18.0 4\n", "azimuth 112.3 lies on no grid"),
    "below ground": (b"110.0 -40.0 4\n111.0 50.0 4\n", "Elevation goes from -5 to 90"),
    "too many": (b"0.0 0.0 4\n0.00001 0.0 4\n359.0 89.0 4\n", "directions. At most"),
    "a line without end": (b"1 " * 300_000, "no map has such long lines"),
    "too many lines": (b"\n" * 400_001 + b"110.0 18.0 400\n", "line 400001: no map has such long lines, or so many"),
    "absurd": (b"110.0 18.0 1e308\n110.0 19.0 -1e308\n", "holds no direction that was measured"),
    "unread": (b"110.0 18.0 -1\n", "each of them is marked as unread"),
}


@pytest.mark.parametrize("name", ENEMIES)
def test_bad_lines_are_refused_with_what_is_wrong(tmp_path, name):
    data, why = ENEMIES[name]
    path = tmp_path / "scan.txt"
    path.write_bytes(data)
    with pytest.raises(StoreError, match=why) as refused:
        read_raw_text(path)
    assert str(refused.value).isprintable()


MATRICES = {
    "ragged": (b"1 2 3\n1 2\n", b"0\n2\n10\n11\n1\n", "line 2: 2 numbers, where the first line has 3"),
    "a word": (b"1 2 3\n1 x 3\n", b"0\n2\n10\n11\n1\n", "line 2: “x” is no number"),
    "another size": (b"1 2\n3 4\n", b"0\n2\n10\n11\n1\n", "and az 0 to 2, el 10 to 11 makes 2 of 3"),
    "six settings": (b"1 2\n", b"1\n" * 6, "6 numbers, and 4, 5 or 8 are known"),
    "settings nan": (b"1 2\n", b"nan\n1\n1\n1\n1\n", "“nan” stands where a finite number belongs"),
    "huge settings": (b"1 2\n", b"0\n1e300\n1\n1\n1\n", "not in whole numbers"),
    "back to front": (b"1 2\n", b"2\n1\n1\n1\n1\n", "ends before it begins"),
    "zeros": (b"0 0 0\n0 0 0\n", b"0\n2\n10\n11\n1\n", "there is no value in it"),
    "long settings": (b"1 2\n", b"1\n" * 4000, "larger than"),
    "nothing": (b"# only a comment\n", b"0\n2\n10\n11\n1\n", "holds no numbers"),
    "tenths of nothing": (b"0 0\n0 0\n", b"0\n1\n100\n101\n", "nothing was measured"),
}  # fmt: skip


@pytest.mark.parametrize("name", MATRICES)
def test_bad_matrices_are_refused_with_what_is_wrong(tmp_path, name):
    raw, settings, why = MATRICES[name]
    (tmp_path / "raw-data-1.txt").write_bytes(raw)
    (tmp_path / "scan-settings-1.txt").write_bytes(settings)
    with pytest.raises(StoreError, match=why):
        read_raw_text(tmp_path / "raw-data-1.txt")


def test_a_matrix_needs_its_settings_and_the_settings_are_no_map(tmp_path):
    path = matrix(tmp_path, np.ones((2, 3)), (0, 2, 10, 11, 1), stamp="7")
    with pytest.raises(StoreError, match="Give the raw-data file beside it"):
        read_raw_text(tmp_path / "scan-settings-7.txt")
    (tmp_path / "scan-settings-7.txt").unlink()
    with pytest.raises(StoreError, match=r"needs its settings beside it: scan-settings-7\.txt or scan_settings_7\.txt"):
        read_raw_text(path)


def test_silence_in_decibels_is_not_measured_and_it_is_said(tmp_path):
    values = np.full((2, 4), -40.0)
    values[0, 1], values[1, 2] = -np.inf, np.nan
    sky_map, notes = read_raw_text(matrix(tmp_path, values, (10, 13, 20, 21, 1, 1420.4, 0, 30)))
    assert len(sky_map.samples) == 4
    assert "2 of its values are no levels, as inf and nan: those directions count as not measured." in notes


def test_a_last_line_without_an_end_is_left_out_as_its_number_may_be_cut(tmp_path):
    path = tmp_path / "scan.txt"
    path.write_bytes(b"110.0 18.0 409\n110.0 19.0 410\n110.0 20.0 4")
    sky_map, notes = read_raw_text(path)
    assert [each.value for each in sky_map.samples] == [409.0, 410.0]
    assert notes == ["The last line has no end, so it is left out."]


def test_what_is_no_file_or_too_large_is_refused(tmp_path, monkeypatch):
    with pytest.raises(StoreError, match="can't be read"):
        read_raw_text(tmp_path)
    with pytest.raises(StoreError, match="can't be read"):
        read_raw_text(tmp_path / "missing.txt")
    monkeypatch.setattr("birdcage.skymap.raw_numbers.MOST_VALUES", 5)
    path = matrix(tmp_path, np.ones((2, 3)), (0, 2, 10, 11, 1))
    with pytest.raises(StoreError, match="more than 5 numbers are too many"):
        read_raw_text(path)
