"""The turn of the cable outlives the program that counted it, while the dish stands as it was left."""

from __future__ import annotations

import pytest
from birdcage.rotator.facts import CableTurn
from birdcage.station.raw import CONSOLE, Grade
from birdcage.station.report import status_report
from birdcage.station.requests import AcquireLease, Goto, Home, Raw, ReleaseLease

from .conftest import Bench


class Desk:
    """The state folder of a person, at whose dish one program comes after the other."""

    def __init__(self, folder):
        self.state, self.left = folder, None

    def start(self, cable_deg, el_deg=45.0, **options):
        """A program at a dish that stands there."""
        more = "".join(f"&{name}={value}" for name, value in options.items())
        bench = Bench(
            f"g2?seed=1&az={cable_deg}&el={el_deg}{more}",
            {"state_folder": self.state, "identify": lambda _port: "usb:0403:6001:A5"},
        ).connect()
        bench.watch("position", rate_hz=2)
        bench.step(1)
        return bench

    def count(self, az_deg):
        """Home, go there and leave: return where its cable is then."""
        bench = self.start(-100)
        bench.do(Home("you"), 60)
        bench.do(Goto(az_deg, 45, "you"))
        self.leave(bench)
        truth = bench.device.truth()
        self.left = truth.el_deg
        return truth.cable_deg

    @staticmethod
    def leave(bench):
        bench.step(1)
        bench.session.close()

    def note(self):
        found = list(self.state.rglob("turn.json"))
        return found[0] if found else None


@pytest.fixture
def desk(tmp_path):
    return Desk(tmp_path)


@pytest.mark.parametrize("az_deg", [200.0, 310.0, 20.0])
def test_a_turn_that_was_counted_is_remembered_where_the_dish_was_left(desk, az_deg):
    cable_deg = desk.count(az_deg)
    later = desk.start(cable_deg, desk.left)
    assert later.state.turn is CableTurn.REMEMBERED
    assert later.state.position.cable_deg == pytest.approx(cable_deg, abs=0.1)
    assert status_report(later.state, 0.0)["turn_of_cable"] == "remembered"
    later.do(Goto(250, 45, "you"))
    assert later.state.turn is CableTurn.REMEMBERED
    assert later.state.position.cable_deg == pytest.approx(later.device.truth().cable_deg, abs=0.2)
    desk.leave(later)
    truth = later.device.truth()
    assert desk.start(truth.cable_deg, truth.el_deg).state.turn is CableTurn.REMEMBERED


@pytest.mark.parametrize(("by_az", "by_el"), [(0.3, 0.0), (0.0, 0.3), (90.0, 0.0)])
def test_a_dish_that_stands_elsewhere_has_an_unknown_turn_and_the_note_is_gone(desk, by_az, by_el):
    cable_deg = desk.count(200.0)
    later = desk.start(cable_deg + by_az, desk.left + by_el)
    assert later.state.turn is CableTurn.UNKNOWN
    assert later.state.position.cable_deg is None
    desk.leave(later)
    assert desk.note() is None
    assert desk.start(cable_deg, desk.left).state.turn is CableTurn.UNKNOWN, "it was away meanwhile"


def test_a_dish_at_its_reference_may_have_homed_meanwhile(desk):
    """At azimuth 0 with the cable wound up, it would stand just there after a power cut, too, unwound."""
    bench = desk.start(-100)
    bench.do(Home("you"), 60)
    for az_deg in (200, 90, 0.5):
        bench.do(Goto(az_deg, 45, "you"))
    truth = bench.device.truth()
    assert truth.cable_deg < -300
    desk.leave(bench)
    assert desk.start(truth.cable_deg, truth.el_deg).state.turn is CableTurn.UNKNOWN


@pytest.mark.parametrize(
    "spoil",
    [
        lambda _told: "", lambda _told: "[]", lambda _told: "{}", lambda _told: "[" * 900,
        lambda told: told.replace('"g2"', '"hal205"'), lambda told: told.replace("cable_deg", "x"),
        lambda told: told.replace('"cable_deg": -', '"cable_deg": -9'),
    ],
)  # fmt: skip
def test_what_another_kind_of_dish_or_a_damaged_file_tells_is_not_believed(desk, spoil):
    cable_deg = desk.count(200.0)
    desk.note().write_text(spoil(desk.note().read_text()))
    assert desk.start(cable_deg, desk.left).state.turn is CableTurn.UNKNOWN


def test_after_a_restart_of_the_dish_nothing_is_remembered(desk):
    cable_deg = desk.count(200.0)
    later = desk.start(cable_deg, desk.left)
    assert later.state.turn is CableTurn.REMEMBERED
    later.device.reboot()
    later.step(3)
    later.session.close()
    assert desk.note() is None


def test_a_motion_typed_past_the_station_ends_it(desk):
    cable_deg = desk.count(200.0)
    later = desk.start(cable_deg, desk.left)
    later.do(AcquireLease(CONSOLE))
    later.do(Raw("h 0", CONSOLE, confirmed=Grade.RUINS), 60)
    later.do(ReleaseLease(CONSOLE))
    later.step(20)
    assert later.state.turn is not CableTurn.REMEMBERED
    desk.leave(later)
    assert desk.note() is None


def test_a_link_that_comes_back_finds_the_turn_again(desk):
    cable_deg = desk.count(200.0)
    later = desk.start(cable_deg, desk.left)
    later.device.unplug()
    later.step(2)
    assert later.state.turn is CableTurn.UNKNOWN
    later.device.plug()
    later.connect(10)
    assert later.state.turn is CableTurn.REMEMBERED


def test_a_folder_that_cannot_be_written_costs_nothing_but_the_memory(tmp_path):
    (tmp_path / "dishes").write_text("in the way")
    desk = Desk(tmp_path)
    cable_deg = desk.count(200.0)
    assert desk.start(cable_deg, desk.left).state.turn is CableTurn.UNKNOWN
