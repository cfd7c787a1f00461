"""A sweep that the dish makes by itself, over the wire: what is heard, and what keeps it, or ends it."""

from __future__ import annotations

import itertools
import math
import random

import pytest
from birdcage.antenna.alignment import Alignment
from birdcage.antenna.axis_sweep import AxisSweep
from birdcage.base.errors import CommandRefused, MotionRefused, PositionUnknown
from birdcage.base.no_go import NoGoSector
from birdcage.rotator.ladder import MoveKind
from birdcage.rotator.sweep import SweepOrder
from birdcage.signal.firmware_sweep_task import FirmwareSweepTask, raggedness
from birdcage.signal.signal_tasks import signal_tasks
from birdcage.station.events import ActivityChanged, PositionRead, TaskChanged
from birdcage.station.requests import BeginTask, Home
from birdcage.station.state import Activity, LinkPhase

from tests.signal.test_peak_task import ALONE, off_deg, slot
from tests.station.conftest import Bench

KIND = "firmware sweep"


def made(options="", **settings):
    return Bench(f"g2?seed=1{options}", {"tasks": signal_tasks(), **settings}).connect(6.0)


def begin(bench, axis="az", az_deg=150.0, el_deg=40.0, **values):
    wanted = {"axis": axis, "az_deg": az_deg, "el_deg": el_deg, "span_deg": 16.0, "step_deg": 1.0, "width_deg": 6.4}
    return bench.do(BeginTask(KIND, {**wanted, **values}, "you"))


def end_of(bench, seconds=300.0):
    end = bench.clock.monotonic() + seconds
    while bench.state.tasks and bench.clock.monotonic() < end:
        bench.step(0.5)
    return told(bench)[-1]


def told(bench):
    return [event.task for event in bench.events if isinstance(event, TaskChanged)]


def sent(bench):
    return [line for line in bench.lines() if line.startswith("azscan")]


@pytest.mark.parametrize(("axis", "off", "span_deg"), [("az", (1.7, 0.0), 16.0), ("el", (0.0, 1.2), 8.0)])
@pytest.mark.parametrize("transponders", [1, 3])
@pytest.mark.parametrize("style", ["plain", "labelled", "blank"])
def test_the_middle_is_found_on_the_line_and_gone_to(axis, off, span_deg, transponders, style):
    bench = made(f"&xponder_style={style}")
    az_deg, el_deg = to = slot(bench, ALONE)
    begin(bench, axis, az_deg + off[0], el_deg + off[1], go=True, span_deg=span_deg, transponders=transponders)
    ended = end_of(bench)
    points = int(span_deg) + 1
    assert (ended.is_done, ended.done, ended.of) == (True, points, points), ended.why
    assert sent(bench) == [f"azscanwxp {int(axis == 'el')} {points} 100 {transponders}"]
    assert off_deg(bench, to) < 0.25
    assert ended.found["rise"] == pytest.approx(143.0, abs=15.0 if axis == "az" else 50.0)  # no floor is seen there
    assert {row[4] for row in ended.found["line"]} == {transponders}
    assert ended.why.endswith("The transponder may have changed.")
    assert bench.state.activity is Activity.IDLE


def test_each_direction_is_told_and_shown_as_it_comes():
    bench = made()
    az_deg, el_deg = slot(bench, ALONE)
    begin(bench, az_deg=az_deg, el_deg=el_deg)
    end_of(bench)
    lengths = [len(task.found.get("line", ())) for task in told(bench)]
    assert lengths == sorted(lengths)
    assert set(range(18)) <= set(lengths)
    begun = next(index for index, event in enumerate(bench.events) if isinstance(event, ActivityChanged)
                 and event.activity is Activity.SWEEPING)  # fmt: skip
    shown = [round(event.position.az_deg) for event in bench.events[begun:] if isinstance(event, PositionRead)]
    assert {round(az_deg - 8.0 + each) for each in range(17)} <= set(shown)
    assert shown[:17] == sorted(shown[:17])


def test_the_dish_turned_on_its_base_is_told_in_true_directions():
    straight, turned = made(), made(alignment=Alignment(az_offset_deg=40.0, el_offset_deg=1.0))
    for bench in (straight, turned):
        begin(bench, az_deg=150.0, el_deg=40.0, span_deg=6.0)
    lines = [end_of(bench).found["line"] for bench in (straight, turned)]
    for line in lines:
        assert [round(row[0]) for row in line] == list(range(147, 154))
        assert {round(row[1]) for row in line} == {40}
    assert turned.state.position.dish_az_deg == pytest.approx(110.0, abs=0.1)


def test_without_go_it_ends_in_the_middle_of_the_line_and_gives_control_back():
    bench = made()
    az_deg, el_deg = slot(bench, ALONE)
    begin(bench, az_deg=az_deg + 2.0, el_deg=el_deg)
    end_of(bench)
    assert bench.state.position.az_deg == pytest.approx(az_deg + 2.0, abs=0.1)
    assert bench.state.holder is None
    assert bench.state.held is None


def test_an_empty_sky_has_no_peak():
    bench = made()
    begin(bench, az_deg=10.0, el_deg=50.0)
    ended = end_of(bench)
    assert ended.is_done
    assert ended.why == "No source stands out of the floor on this line. The transponder may have changed."


def test_the_turn_of_the_cable_is_counted_on():
    bench = made()
    bench.do(Home("you"), 60.0)
    before = bench.state.position.cable_deg
    assert before is not None
    begin(bench, az_deg=330.0, el_deg=40.0, span_deg=60.0, step_deg=2.0)
    end_of(bench)
    assert bench.state.position.cable_deg == pytest.approx(-30.0, abs=0.2)


# What is refused before anything is sent


@pytest.mark.parametrize(("values", "settings", "words"), [
    ({"axis": "el", "el_deg": 40.0, "span_deg": 20.0}, {}, "9.00° is 9.00° below the floor of 18.00°"),
    ({"axis": "el", "el_deg": 60.0, "span_deg": 12.0}, {}, "2.00° above the limit of 65.00°"),
    ({"el_deg": 70.0}, {}, "5.00° above the limit of 65.00°"),
    ({"span_deg": 175.0}, {}, "more than the 170° allowed"),
    ({"step_deg": 0.055}, {}, "no multiple of 0.01°"),
    ({"span_deg": 10.0, "el_deg": 30.0}, {"sectors": (NoGoSector(155.5, 170.0, 35.0, "mast"),)}, "(mast)"),
    ({"span_deg": 10.0, "el_deg": 30.0}, {"sectors": (NoGoSector(130.0, 134.5, 35.0, "tree"),)}, "(tree)"),
    ({"axis": "el", "span_deg": 6.0}, {"sectors": (NoGoSector(149.0, 151.0, 31.0, "wall"),)}, "(wall)"),
    ({"az_deg": 345.0, "span_deg": 60.0}, {}, "could turn the cable"),
])  # fmt: skip
def test_a_line_that_does_not_fit_is_refused_whole(values, settings, words):
    bench = made(**settings)
    at = bench.clock.monotonic()
    begin(bench, **values)
    ended = end_of(bench)
    assert not ended.is_done
    assert words in ended.why
    assert "Nothing was sent." in ended.why
    assert not bench.moves_since(at)
    assert not sent(bench)


def test_a_sector_that_the_line_only_nears_forbids_nothing():
    near = (
        NoGoSector(156.5, 170.0, 35.0, "mast"), NoGoSector(130.0, 133.5, 35.0, "tree"),
        NoGoSector(100.0, 200.0, 29.0, "roof"),
    )  # fmt: skip
    bench = made("&az=-210&el=45", sectors=near)
    begin(bench, az_deg=150.0, span_deg=10.0, el_deg=30.0)
    ended = end_of(bench)
    assert ended.is_done, ended.why
    assert len(sent(bench)) == 1


def test_an_axis_that_is_not_homed_gets_no_sweep():
    bench = Bench("g2?seed=1&unhomed=1", {"tasks": signal_tasks()}).connect(6.0)
    begin(bench)
    ended = end_of(bench)
    assert not ended.is_done
    assert "Home it first" in ended.why
    assert not sent(bench)


def test_nor_does_a_script_send_one_to_it():
    bench = Bench("g2?seed=1&unhomed=1", {"tasks": signal_tasks()}).connect(6.0)
    with pytest.raises(PositionUnknown):
        bench.station._antenna.rotator.sweep(SweepOrder("azimuth", 10.0, 1.0), lambda _reading: None)
    assert not sent(bench)


def test_a_dish_that_forgets_on_the_way_gets_no_sweep():
    """Its power dips between the move to the start and the sweep: the last look is just before the line."""
    bench = made()
    antenna, look = bench.station._antenna, bench.station._antenna.rotator._rotator.protocol.read_position

    def forgetful(**options):
        if antenna.moving.busy is MoveKind.SWEEP:
            bench.device.board.dish.axes[1].homed = False
        return look(**options)

    antenna.rotator._rotator.protocol.read_position = forgetful
    begin(bench)
    ended = end_of(bench)
    assert not ended.is_done
    assert not sent(bench)
    assert bench.device.shell.alive


def test_it_is_judged_anew_from_where_the_dish_stands_when_it_begins():
    """A hand has turned it since the last look: there its cable would not allow the sweep."""
    bench = made("&az=-210")
    axis = bench.device.board.dish.axes[0]
    axis.retarget(bench.device.board.now_s, -10.0)
    bench.clock.advance(6.0)
    assert bench.state.position.az_deg == pytest.approx(150.0, abs=0.1)
    with pytest.raises(MotionRefused, match="could turn the cable"):
        AxisSweep(bench.station._antenna).run(0, 60.0, 1.0, 1, lambda _dish, _level: None, lambda: None)
    assert not sent(bench)


@pytest.mark.parametrize("address", ["hal205?seed=1", "carryout?seed=1"])
def test_a_machine_without_one_says_so(address):
    bench = Bench(address, {"tasks": signal_tasks()}, firmware=address.partition("?")[0]).connect(10.0)
    begin(bench)
    ended = end_of(bench)
    assert not ended.is_done
    assert "has no sweep of its own. Sweep it by steps." in ended.why


@pytest.mark.parametrize("values", [
    {"axis": "skew"}, {"transponders": 0}, {"transponders": 33}, {"transponders": math.nan}, {"source": "meter"},
    {"span_deg": 0.0},
])  # fmt: skip
def test_values_that_make_no_sweep_are_refused_and_the_station_lives_on(values):
    bench = made()
    with pytest.raises(CommandRefused):
        begin(bench, **values)
    bench.step(1.0)
    assert not bench.state.tasks
    assert bench.state.link.state is LinkPhase.UP


# What the stream may be


def damaged(bench, change):
    """Have each line of a sweep changed on its way, by its number from 0 on."""
    shell, say, count = bench.device.shell, bench.device.shell.say, itertools.count()

    def saying(text):
        say(change(next(count), text) if text.startswith("Motor:") else text)

    shell.say = saying


def test_lines_that_are_cut_short_or_garbled_are_left_out_and_told():
    bench = made()
    az_deg, el_deg = to = slot(bench, ALONE)
    wrong = {3: "Motor:0 Ang\n", 5: "x\x7fy\n", 7: "Motor:0 Angle:9 RSSI:400 Lock:0 SNR:0 Scan Delta:100\n", 9: ""}
    damaged(bench, lambda number, text: wrong.get(number, text))
    begin(bench, az_deg=az_deg, el_deg=el_deg, go=True)
    ended = end_of(bench)
    assert ended.is_done, ended.why
    assert len(ended.found["line"]) == 13
    assert "3 lines could not be read." in ended.why
    assert off_deg(bench, to) < 0.25
    assert bench.state.held is None


def test_a_direction_with_fewer_transponders_than_the_others_does_not_count():
    bench = made()
    az_deg, el_deg = slot(bench, ALONE)
    damaged(bench, lambda number, text: "Motor:\n" if number == 13 else text)
    begin(bench, az_deg=az_deg, el_deg=el_deg, transponders=3)
    ended = end_of(bench)
    assert len(ended.found["line"]) == 16
    assert {row[4] for row in ended.found["line"]} == {3}
    assert "One line could not be read." in ended.why


def test_lines_of_an_unknown_form_alone_are_no_sweep_and_the_dish_is_looked_at():
    bench = made()
    damaged(bench, lambda _number, _text: "RSSI 523\n")
    begin(bench)
    ended = end_of(bench)
    assert ended.is_done
    assert "17 lines could not be read." in ended.why
    assert "line" in ended.found
    assert bench.state.position.az_deg == pytest.approx(150.0, abs=0.1)


def test_a_dish_that_goes_where_nothing_was_judged_is_stopped():
    bench = made("&sweep_key=abort")
    damaged(bench, lambda _number, text: text.replace("Angle:1", "Angle:2"))
    begin(bench)
    ended = end_of(bench)
    assert not ended.is_done
    bench.step(5.0)
    assert bench.state.held is not None
    assert bench.state.last_stop.confirmed is True
    assert len(bench.lines()[bench.lines().index(sent(bench)[0]) :]) > 1


def test_a_stream_that_stalls_has_a_deadline_and_says_what_that_may_be():
    bench = made()
    hang(bench, after=6)
    begin(bench)
    start = bench.clock.monotonic()
    ended = end_of(bench)
    assert bench.clock.monotonic() - start < 30.0
    assert not ended.is_done
    assert "The adapter is still there. Its shell may be deadlocked" in ended.why
    assert "`azscanwxp 0 17 100 1` printed 6 lines, then nothing for 12 s" in ended.why
    assert bench.state.link.state is LinkPhase.SILENT
    assert bench.state.position_lost is not None
    bench.step(20.0)
    assert bench.lines()[-1] == sent(bench)[0]


def hang(bench, after):
    """Have the shell die in the middle of a sweep."""
    shell, say, count = bench.device.shell, bench.device.shell.say, itertools.count(1)

    def saying(text):
        say(text)
        if text.startswith("Motor:") and next(count) == after:
            shell.reset(alive=False)

    shell.say = saying


def test_a_port_that_goes_is_told_apart():
    bench = made()
    bench.later(6.0, lambda: bench.device.unplug())
    begin(bench, span_deg=60.0)
    ended = end_of(bench)
    assert not ended.is_done
    assert bench.state.link.state is LinkPhase.LOST


def test_how_ragged_a_line_is_tells_its_noise_and_a_beam_does_not():
    chance = random.Random(4)
    line = [400.0 + 150.0 * math.exp(-2.77 * ((each - 20) / 6.4) ** 2) + chance.gauss(0.0, 2.0) for each in range(41)]
    assert raggedness(line) == pytest.approx(2.0, rel=0.4)
    assert raggedness(line[:3]) == 0.0
    assert FirmwareSweepTask.kind == KIND
