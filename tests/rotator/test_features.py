"""The table of features at the seam: what is read, written, refused, and what it costs on the wire."""

from __future__ import annotations

from datetime import timedelta

import pytest
from birdcage.base.clock import VirtualClock
from birdcage.base.errors import CommandRefused, NoReply, OutOfRange
from birdcage.base.reason import Reason
from birdcage.base.trouble import MotorTrouble
from birdcage.link.link import Link
from birdcage.rotator import machines
from birdcage.rotator.feature import WELL_FORMED, Feature, FeatureKind, Range, Writer
from birdcage.rotator.feature_table import FeatureRow, FeatureTable
from birdcage.rotator.hooks import Hooks
from birdcage.sim.port import SimPort, open_device


@pytest.fixture
def opened():
    """Open a machine on its simulator; return it, what it has received, and its clock."""

    def opened(firmware="g2", address="g2?seed=1"):
        clock = VirtualClock()
        device = open_device(address, clock=clock)
        rotator = machines.make(firmware)
        rotator.open("sim", None, clock, Hooks(dial=lambda _name, baud: Link(SimPort(device, "sim", baud=baud), clock)))
        rotator.meet()
        rotator.make_ready()
        return rotator, lambda: [line for _at, line in device.shell.received], clock

    return opened


@pytest.mark.parametrize("firmware", machines.names())
def test_ids_are_well_formed_and_known_before_a_port_is_open(firmware):
    facts = machines.facts_of(firmware)
    for name, feature in facts.features.items():
        assert name == feature.id
        assert WELL_FORMED.fullmatch(name)
        assert feature.label
        assert feature.is_readable or feature.is_writable
    assert machines.make(firmware).features == facts.features


def test_one_line_serves_all_that_it_answers(opened):
    g2, received, _clock = opened()
    before = len(received())
    told = g2.read(["version", "antenna_id", "system_id", "speed.azimuth", "speed.elevation"])
    values = {name: reading.value for name, reading in told.items()}
    assert values["mcu_package"] == "144-pin", "what the same answer tells is told, too"
    assert {name: value for name, value in values.items() if not name.startswith(("mcu_", "flash_"))} == {
        "version": "02.02.48", "antenna_id": "12-IN G2", "system_id": "TWELINCH",
        "speed.azimuth": pytest.approx(65.0, abs=0.01), "speed.elevation": pytest.approx(45.0, abs=0.01),
    }  # fmt: skip
    assert [line for line in received()[before:] if line in ("id", "mv")] == ["id", "mv"]


def test_a_reading_has_its_unit_and_is_of_the_middle_of_its_exchange(opened):
    g2, _received, clock = opened()
    g2.read(["rssi"])
    asked, asked_utc = clock.monotonic(), clock.utc()
    (reading,) = g2.read(["rssi"]).values()
    took_s = clock.monotonic() - asked
    assert reading.unit == "counts"
    assert reading.at == pytest.approx(asked + took_s / 2.0, abs=0.02)
    assert reading.utc - asked_utc == pytest.approx(timedelta(seconds=took_s / 2.0), abs=timedelta(seconds=0.02))


def test_what_is_written_is_read_back(opened):
    g2, received, _clock = opened()
    assert g2.write("speed.azimuth", 10.0).value == pytest.approx(10.0, abs=0.01)
    assert received()[-2:] == ["mv 0 1111", "mv"]
    assert g2.write("tv_search", True).value is True
    assert g2.write("tv_search", False).value is False
    assert g2.read(["tv_search"])["tv_search"].value is False


@pytest.mark.parametrize(("feature", "value", "sentence"), [
    ("speed.azimuth", 70.0, "70 deg/s is 5 deg/s beyond its limit of 65 deg/s. Nothing was sent. Give 0.009 to 65"),
    ("speed.azimuth", float("nan"), "no number"),
    ("speed.azimuth", True, "no number"),
    ("tv_search", 1.0, "neither on nor off"),
])  # fmt: skip
def test_a_value_out_of_range_is_refused_with_number_limit_and_way_out(opened, feature, value, sentence):
    g2, received, _clock = opened()
    before = received()
    with pytest.raises(ValueError, match=sentence) as refused:
        g2.write(feature, value)
    assert isinstance(refused.value, OutOfRange)
    assert received() == before


def test_what_a_machine_lacks_is_refused_with_nothing_sent(opened):
    g2, received, _clock = opened()
    before = received()
    for ask in (
        lambda: g2.read(["rssi", "end_tv_search"]),
        lambda: g2.read(["no such"]),
        lambda: g2.write("rssi", 1.0),
        lambda: g2.write("version", "3"),
    ):
        with pytest.raises(CommandRefused, match="Nothing was sent") as refused:
            ask()
        assert refused.value.reason == "unsupported"
    assert received() == before


def test_a_dish_that_only_ends_its_search_has_a_momentary_feature_for_it(opened):
    travler, received, _clock = opened("hal205", "hal205?seed=1")
    assert travler.features["end_tv_search"].kind is FeatureKind.MOMENTARY
    assert travler.write("end_tv_search", True).value is True
    assert [line for line in received() if line.isalpha()][-4:] == ["ngsearch", "s", "q", "motor"]
    assert travler.read(["floor", "floor.search"])["floor"].unit == "deg"


def test_two_features_of_one_name_are_no_table():
    row = FeatureRow(Feature("one", "One"), lambda _dish: {"one": 1.0})
    with pytest.raises(ValueError, match="'one'"):
        FeatureTable(row, row)


def test_a_limit_on_one_side_is_told_as_such():
    low = Feature("level", "Level", "V", FeatureKind.NUMBER, Range(2.0), Writer.AT_ONCE)
    with pytest.raises(OutOfRange, match=r"1 V is 1 V beyond its limit of 2 V. Nothing was sent. Give from 2 V"):
        low.check(1.0)


@pytest.mark.parametrize(("row", "said"), [
    (FeatureRow(Feature("lamp", "Lamp")), "has no `read`.*`told=False`"),
    (FeatureRow(Feature("lamp", "Lamp", writer=Writer.UNTIL_RESTART), read=lambda _: {}),
    "both a `Writer` and a `write`"),
    (FeatureRow(Feature("lamp", "Lamp"), read=lambda _: {}, write=lambda _, value: {}),
    "both a `Writer` and a `write`"),
])  # fmt: skip
def test_a_row_without_the_call_that_it_needs_is_refused_at_once(row, said):
    with pytest.raises(ValueError, match=said):
        FeatureTable(row)


def test_what_a_machine_never_tells_can_be_set_alone():
    lamp = Feature("lamp", "Lamp", kind=FeatureKind.SWITCH, writer=Writer.UNTIL_RESTART, told=False)
    table = FeatureTable(FeatureRow(lamp, write=lambda _machine, on: {"lamp": on}))
    assert (lamp.is_readable, lamp.is_writable) == (False, True)
    assert table.write(None, "head", "lamp", True, lambda value, unit: (value, unit)) == (True, "")
    with pytest.raises(CommandRefused, match="can be read"):
        table.read(None, "head", ["lamp"], lambda value, unit: (value, unit))


def test_each_menu_is_entered_once_whatever_the_order(opened):
    g2, received, _clock = opened()
    before = len(received())
    g2.read(["board_id", "driver.azimuth", "raw_rssi", "torque.azimuth"])
    assert [line for line in received()[before:] if line in ("adc", "a3981")] == ["adc", "a3981"]


@pytest.mark.parametrize(("error", "goes_on"), [
    (CommandRefused("No."), True),
    (CommandRefused("Stalled.", trouble=MotorTrouble("azimuth", homing=False, said="AZ MOTOR STALLED")), False),
    (NoReply("Noise.", reason=Reason.GARBAGE), True),
    (NoReply("No such row.", reason=Reason.NO_ROW), True),
    (NoReply("Nothing.", reason=Reason.SILENT), False),
])  # fmt: skip
def test_what_one_question_comes_to_ends_the_others_only_where_nothing_more_can_be_asked(opened, error, goes_on):
    g2, _received, _clock = opened()

    def fails(_dish):
        raise error

    table = FeatureTable(
        FeatureRow(Feature("broken", "Broken"), fails),
        FeatureRow(Feature("whole", "Whole"), lambda _dish: {"whole": 1.0}),
    )
    stamp = lambda value, unit: (value, unit)  # noqa: E731
    if goes_on:
        assert table.read(g2, "dish", ["broken", "whole"], stamp) == {"whole": (1.0, "")}
    else:
        with pytest.raises(type(error)):
            table.read(g2, "dish", ["broken", "whole"], stamp)
    with pytest.raises(type(error)):
        table.read(g2, "dish", ["broken"], stamp)
