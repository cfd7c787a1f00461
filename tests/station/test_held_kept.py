"""HELD is a fact about a dish: the next program finds it, whatever ended the one that latched it."""

from __future__ import annotations

import threading

import pytest
from birdcage.base.errors import Held
from birdcage.base.held import HeldFile, HeldNote
from birdcage.station.held_keeper import HeldKeeper
from birdcage.station.requests import Connect, Goto, Release

from .conftest import Bench


class Desk:
    """The state folder of a person, and the dishes that are plugged in: by the name of their port."""

    def __init__(self, folder):
        self.state, self.dishes = folder / "state", {"sim:test": "usb:0403:6001:A5"}
        self.keepers = []

    def start(self):
        """Another program at the same dish; what was on its way to the disk has arrived, as after `kill -9`."""
        self.flush()
        self.keepers.append(HeldKeeper(self.state, lambda port: self.dishes.get(port)))
        return Bench("g2?seed=1&az=-180", {"held_keeper": self.keepers[-1]}).connect()

    def flush(self):
        for keeper in self.keepers:
            assert keeper.flush(10)

    def latches(self):
        self.flush()
        return [path.read_text() for path in sorted(self.state.rglob("held.json"))]


@pytest.fixture
def desk(tmp_path, monkeypatch):
    monkeypatch.setenv("LOGNAME", "anna")
    desk = Desk(tmp_path)
    yield desk
    for keeper in desk.keepers:
        keeper.close(5)


def moved(bench):
    return [line for line in bench.lines() if line.startswith(("a ", "h "))]


def test_the_next_program_finds_it_held_and_moves_nothing(desk):
    first = desk.start()
    first.station.stop("you")
    first.step(1)
    later = desk.start()
    held = later.state.held
    assert (held.by, held.reason, held.earlier) == ("anna", "stop", True)
    assert held.utc == first.state.held.utc
    with pytest.raises(Held, match=r"HELD by anna since .* `birdcage release`"):
        later.do(Goto(200, 45, "you"))
    assert moved(later) == []
    later.do(Release("you"))
    assert desk.latches() == []
    later.do(Goto(200, 45, "you"))
    assert desk.start().state.held is None


def test_the_first_bytes_are_out_before_the_latch_is_kept_and_the_disk_has_another_thread(desk, monkeypatch):
    bench = desk.start()
    bench.station.submit(Goto(60, 45, "you"))
    bench.step(1)
    happened, threads = [], []
    latch, write, send = HeldKeeper.latch, HeldFile.write, bench.sim.write

    def latching(keeper, note):
        happened.append("latched")
        latch(keeper, note)

    def writing(file, note):
        threads.append(threading.current_thread())
        write(file, note)

    def sending(data):
        happened.append(data[:2])
        send(data)

    monkeypatch.setattr(HeldKeeper, "latch", latching)
    monkeypatch.setattr(HeldFile, "write", writing)
    bench.sim.write = sending
    bench.station.stop("you")
    assert happened == [b"a ", "latched"]
    desk.flush()
    assert len(threads) == 1
    assert threads[0] is not threading.current_thread()


def test_a_stop_whose_program_dies_at_once_is_kept(desk):
    first = desk.start()
    first.station.stop("you")  # the station's own thread never learns of it
    assert desk.start().state.held.by == "anna"


def test_a_program_that_leaves_stops_the_dish_and_does_not_hold_it(desk):
    first = desk.start()
    first.station.submit(Goto(60, 45, "you"))
    first.step(1)
    before = len(moved(first))
    first.session.close()
    assert len(moved(first)) > before
    assert desk.latches() == []
    assert desk.start().state.held is None


def test_a_fault_holds_the_dish_for_the_next_program_too(desk):
    first = desk.start()
    first.device.wander(0, 40.0)
    first.watch("position")
    first.step(5)
    assert first.state.held.reason == "fault"
    later = desk.start()
    assert (later.state.held.by, later.state.held.reason) == ("birdcage", "fault")


def test_a_damaged_latch_holds_and_says_so(desk):
    desk.start().station.stop("you")
    desk.flush()
    next(desk.state.rglob("held.json")).write_bytes(b"\0")
    later = desk.start()
    with pytest.raises(Held, match=r"by whom is not known: .*held\.json is damaged"):
        later.do(Goto(200, 45, "you"))
    later.do(Release("you"))
    assert desk.latches() == []


def test_where_nothing_can_be_written_stop_goes_out_and_the_board_says_that_it_is_not_kept(desk):
    desk.state.mkdir()
    (desk.state / "dishes").write_text("in the way")
    bench = desk.start()
    bench.station.submit(Goto(60, 45, "you"))
    bench.step(1)
    before = len(moved(bench))
    bench.station.stop("you")
    bench.step(3)
    desk.flush()
    assert len(moved(bench)) > before
    assert bench.state.held is not None
    assert "held.json cannot be written" in bench.state.held_trouble
    assert "HELD ends with this program" in bench.state.held_trouble


def test_a_release_that_cannot_be_kept_is_told(desk, monkeypatch):
    bench = desk.start()
    bench.station.stop("you")
    bench.step(1)
    desk.flush()

    def refuse(_file):
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(HeldFile, "remove", refuse)
    bench.do(Release("you"))
    desk.flush()
    assert bench.state.held is None
    assert "The next program finds it HELD" in bench.state.held_trouble


def test_a_port_that_comes_back_as_another_is_held_and_released_under_both(desk):
    bench = desk.start()
    bench.station.stop("you")
    bench.step(1)
    assert len(desk.latches()) == 1
    desk.dishes["sim:test"] = "path:/dev/ttyUSB1"
    bench.device.unplug()
    bench.step(1)
    bench.device.plug()
    bench.connect(8)
    assert len(desk.latches()) == 2
    assert desk.start().state.held is not None
    bench.do(Release("you"))
    assert desk.latches() == []


def test_a_release_at_another_dish_leaves_the_first_one_held(desk):
    bench = desk.start()
    bench.station.stop("you")
    bench.step(5)
    desk.dishes["sim:other"] = "usb:0403:6001:B7"
    bench.do(Connect("sim:other", None))
    bench.connect(3)
    assert bench.state.held is not None
    bench.do(Release("you"))
    assert len(desk.latches()) == 1
    assert desk.start().state.held.by == "anna"


def test_a_slow_disk_loses_no_latch_to_a_release_at_another_dish(desk, tmp_path):
    note, keeper, disk = HeldNote("anna", None), HeldKeeper(tmp_path / "slow", desk.dishes.get), threading.Event()
    keeper.on_trouble = lambda _sentence: disk.wait(10)
    desk.dishes |= {"first": "usb:0403:6001:A1", "other": "usb:0403:6001:B7"}
    keeper.meet("other")
    keeper.latch(note)  # this keeps the writer busy
    keeper.release()
    keeper.meet("first")
    keeper.latch(note)
    keeper.expect_another_dish()
    keeper.meet("other")
    keeper.release()
    disk.set()
    keeper.close(10)
    assert [path.read_text() for path in (tmp_path / "slow").rglob("held.json")]


def test_a_simulator_of_the_program_itself_is_held_by_nobody_afterwards(desk):
    desk.dishes.clear()
    bench = desk.start()
    bench.station.stop("you")
    bench.step(1)
    assert bench.state.held is not None
    assert desk.latches() == []
