"""The rows of F4: each feature once, both axes abreast, values as a person reads them."""

from itertools import pairwise

import pytest
import stand_in
from birdcage.protocol.carryout.model import CARRYOUT_2003
from birdcage.protocol.g2.model import CARRYOUT_G2
from birdcage.rotator.feature import Feature, FeatureKind, FeaturePage, Reading
from birdcage_tui.shown.system_sheet import absent_groups, cell_text, sheet_rows


def test_the_values_of_both_axes_stand_abreast_under_one_label():
    rows = {row.key: row for row in sheet_rows(CARRYOUT_G2, FeaturePage.HARDWARE)}
    row = rows["torque.azimuth"]
    assert row.label.startswith("Torque of the motor")
    assert row.axes == ("azimuth", "elevation")
    assert [each.id for each in row.cells] == ["torque.azimuth", "torque.elevation"]


def test_every_feature_of_a_page_stands_once_and_groups_stand_together():
    everywhere = []
    for page in (FeaturePage.HARDWARE, FeaturePage.MOTORS, FeaturePage.RECEIVER):
        rows = sheet_rows(CARRYOUT_G2, page)
        everywhere += [each.id for row in rows for each in row.cells]
        groups = [row.group for row in rows]
        assert len([a for a, b in pairwise(groups) if a != b]) == len(set(groups)) - 1
    wanted = {*CARRYOUT_G2.features, "boot_log"} - {"settings"}  # the whole table has a tab of its own
    assert sorted(everywhere) == sorted(wanted)


def test_a_machine_that_is_not_known_or_tells_nothing_has_no_rows():
    assert sheet_rows(None, FeaturePage.MOTORS) == ()
    assert sheet_rows(CARRYOUT_2003, FeaturePage.RECEIVER) == ()
    assert absent_groups("carryout", FeaturePage.RECEIVER)[:2] == ("Signal", "Channel")
    assert absent_groups("g2", FeaturePage.HARDWARE) == ()
    assert absent_groups("rotctl", FeaturePage.HARDWARE) == (), "it has no kin"


@pytest.mark.parametrize(
    ("feature", "value", "unit", "shown"),
    [
        (Feature("a", "A", "deg/s"), 64.998, "deg/s", "64.998 deg/s"),
        (Feature("a", "A", "KB"), 512.0, "KB", "512 KB"),
        (Feature("a", "A", kind=FeatureKind.SWITCH), True, "", "on"),
        (Feature("a", "A", kind=FeatureKind.LINES), "one\ntwo", "", "2 lines"),
        (Feature("a", "A", kind=FeatureKind.TEXT), "OK", "", "OK"),
    ],
)
def test_a_value_is_shown_as_a_person_reads_it(feature, value, unit, shown):
    assert cell_text(feature, {"a": Reading(value, unit, 100.0, stand_in.VirtualClock().utc())}, 110.0).value == shown


def test_what_was_not_told_is_a_dash_without_an_age():
    told = cell_text(Feature("a", "A"), {}, 110.0)
    assert (told.value, told.age_s) == ("--", None)
