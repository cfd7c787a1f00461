"""A port that does not answer: listening at other rates, and changing over, without a byte too many."""

from __future__ import annotations

import pytest
from birdcage.base.errors import BirdcageError, LinkError, Stopped
from birdcage.detection import probe as module
from birdcage.detection.detecting import heard_firmware
from birdcage.detection.machine_probe import questions
from birdcage.detection.probe import USUAL_BAUDS, Saw
from birdcage.sim.port import open_device
from birdcage.station.events import LinkChanged
from birdcage.station.requests import Connect, Goto, Jog, ProbePort
from birdcage.station.state import LinkPhase, TvSearch

from .conftest import Bench


class Wires(Bench):
    """Counts what is opened, and what each opening sends."""

    def __post_init__(self):
        self.asked = []
        self.refuse = set()
        super().__post_init__()

    def _open(self, port, baud):
        if baud in self.refuse or port in self.refuse:
            raise LinkError(f"{port} is in use by screen: end that program first.", reason="busy")
        link = super()._open(port, baud)
        sent = []
        write = link.write

        def record(data):
            sent.append(data)
            write(data)

        link.write = record
        self.asked.append((port, baud, sent))
        return link

    def bauds(self):
        return [baud for _port, baud, _sent in self.asked]

    def sent_since(self, index):
        return [b"".join(sent) for _port, _baud, sent in self.asked[index:]]


@pytest.fixture
def wrong():
    """A G2 that is addressed at 9600 baud, and is silent there (`docs/reference/g2.md`, *Line*)."""
    bench = Wires("g2?seed=1&wrong_baud=silent", {"baud": 9600})
    bench.step(3)
    assert bench.state.link.state is LinkPhase.SILENT
    return bench


def test_the_right_rate_is_found_by_enter_and_a_question_mark_where_it_answers(wrong):
    before = len(wrong.asked)
    findings = wrong.do(ProbePort())
    assert [(each.baud, each.saw) for each in findings] == [(9600, Saw.SILENCE), (115200, Saw.PROMPT)]
    assert findings[1].sample.endswith("TRK>")
    assert wrong.bauds()[before : before + 2] == [9600, 115200]
    assert wrong.sent_since(before)[:2] == [b"\r", b"\r?\r"]
    wrong.step(3)
    assert wrong.bauds()[-1] == 9600
    assert wrong.state.link.state is LinkPhase.SILENT


def test_connect_at_the_rate_that_was_found(wrong):
    wrong.do(Connect("sim:test", 115200))
    wrong.step(3)
    assert wrong.state.link.state is LinkPhase.UP
    assert wrong.state.position is not None


def test_garbage_is_told_from_silence():
    bench = Wires("g2?seed=1&wrong_baud=garbage", {"baud": 57600})
    bench.step(3)
    findings = bench.do(ProbePort((115200,)))
    assert [each.saw for each in findings] == [Saw.GARBAGE, Saw.PROMPT]


def test_all_usual_rates_are_tried_where_none_answers(wrong):
    wrong.device.power_off()
    findings = wrong.do(ProbePort())
    usual = [9600, *(baud for baud in USUAL_BAUDS if baud != 9600)]
    asked = [baud for _question, baud in questions()]
    assert [each.baud for each in findings] == [*usual, *asked]
    assert {each.saw for each in findings} == {Saw.SILENCE}
    assert all(port._closed for port in wrong.opened[:-1])
    assert sum(each.waited_s for each in findings) == pytest.approx(0.7 * (len(usual) + len(asked)))


def test_a_machine_without_a_prompt_is_asked_last_and_named(wrong):
    """By the question that it offers, where every rate is silent: then Setup can offer to speak its language."""
    rotator = open_device("easycomm?seed=1", clock=wrong.clock)
    wrong.device = rotator
    findings = wrong.do(ProbePort())
    assert [each.saw for each in findings[:-1]] == [Saw.SILENCE] * (len(findings) - 1)
    assert heard_firmware(findings[-1], "/dev/ttyACM0") == "easycomm"
    assert not rotator.truth().moving


def test_a_dish_that_answers_is_heard_at_its_own_rate_and_goes_on():
    bench = Wires().connect()
    bench.step(2)
    talked = bench.sent_since(0)
    (finding,) = bench.do(ProbePort())
    assert (finding.baud, finding.saw) == (115200, Saw.PROMPT)
    # Closing the port beforehand sends nothing either: not a `q`, not an Enter.
    assert bench.sent_since(0)[: len(talked) + 1] == [*talked, b"\r?\r"]
    bench.step(3)
    assert bench.state.link.state is LinkPhase.UP


def test_it_says_at_which_rate_it_listens(wrong):
    wrong.events.clear()
    wrong.do(ProbePort())
    details = [each.link.detail for each in wrong.events if isinstance(each, LinkChanged)]
    assert "listening on sim:test at 115200 baud" in details


def test_no_probe_and_no_change_while_the_dish_moves():
    bench = Wires().connect()
    bench.step(3)
    moving = bench.station.submit(Goto(90.0, 30.0, "test"))
    bench.step(0.3)
    for request in (ProbePort(), Connect("sim:other")):
        with pytest.raises(BirdcageError, match="while the dish moves") as refused:
            bench.do(request, 0.3)
        assert refused.value.reason == "moving"
    assert len(bench.asked) == 1
    bench.step(10)
    assert moving.result(0) is not None
    assert bench.do(ProbePort())[0].saw is Saw.PROMPT


def test_a_motion_that_fell_silent_counts_until_it_must_have_ended():
    bench = Wires().connect()
    bench.step(3)
    bench.station.submit(Goto(250.0, 30.0, "test"))
    bench.step(0.2)
    bench.device.wire.to_host.silent = True
    bench.step(2.6)
    assert bench.state.link.state is LinkPhase.SILENT
    bench.step(10)
    assert bench.do(ProbePort((115200,)))[0].saw is Saw.SILENCE


def test_stop_ends_the_listening(wrong):
    wrong.device.power_off()
    future = wrong.station.submit(ProbePort())
    listened = module.judge

    def judge(heard, tokens):
        wrong.station.stop("you")
        return listened(heard, tokens)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(module, "judge", judge)
        wrong.step(10)
    with pytest.raises(Stopped, match="STOP"):
        future.result(0)
    assert wrong.state.held is not None
    assert wrong.bauds().count(115200) == 0
    assert wrong.bauds()[-1] == 9600


def test_the_end_of_the_station_ends_the_listening(wrong):
    wrong.device.power_off()
    future = wrong.station.submit(ProbePort())
    listened = module.judge

    def judge(heard, tokens):
        wrong.station.end()
        return listened(heard, tokens)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(module, "judge", judge)
        wrong.step(10)
    with pytest.raises(Stopped, match="ends"):
        future.result(0)
    wrong.station.shut()
    assert wrong.state.link.state is LinkPhase.CLOSED


def test_a_port_that_cannot_be_opened_says_why_and_is_tried_again(wrong):
    wrong.refuse = {9600}
    with pytest.raises(LinkError, match="in use by screen") as refused:
        wrong.do(ProbePort())
    assert refused.value.reason == "busy"
    wrong.refuse = set()
    before = len(wrong.asked)
    wrong.step(3)
    assert wrong.bauds()[before:] == [9600]


def test_a_port_that_is_gone_is_not_probed():
    bench = Wires(options={"find_port": lambda port: None})
    bench.step(1)
    assert bench.state.link.state is LinkPhase.LOST
    with pytest.raises(LinkError, match="plug it in") as gone:
        bench.do(ProbePort(), 2)
    assert gone.value.reason == "missing"


def test_a_server_on_the_network_is_heard_once():
    bench = Wires()
    bench.step(1)
    bench.do(Connect("socket://host:2000", 57600))
    bench.device.power_off()
    findings = bench.do(ProbePort())
    assert [each.baud for each in findings] == [57600] * (1 + len(questions())), "once, and then machines are asked"


def test_rates_do_not_go_on_for_ever():
    bench = Wires()
    bench.step(1)
    bench.device.power_off()
    findings = bench.do(ProbePort(tuple(range(2400, 2600))), 60)
    assert 10 < sum(each.waited_s for each in findings) < 21


@pytest.mark.parametrize("state", [LinkPhase.OPENING, LinkPhase.UP, LinkPhase.SILENT, LinkPhase.LOST])
def test_connect_works_in_every_state(state):
    bench = Wires()
    if state is LinkPhase.UP:
        bench.connect()
    elif state is LinkPhase.SILENT:
        bench.device.power_off()
        bench.step(3)
        bench.device.power_on()
    elif state is LinkPhase.LOST:
        bench.refuse = {"sim:test"}
        bench.step(1)
    else:
        bench.session._begun = True
        bench.station.begin()
    assert bench.state.link.state is state
    bench.do(Connect("sim:other", 115200), 5)
    assert bench.state.port == "sim:other"
    bench.step(60)
    assert bench.state.link.state is LinkPhase.UP
    assert bench.asked[-1][:2] == ("sim:other", 115200)
    # Those who ring for STOP by the name of the port find this program under the new one alone.
    assert bench.state.port == bench.station.asked_port == "sim:other"


def test_what_was_known_of_the_other_dish_is_forgotten():
    bench = Wires().connect()
    bench.watch("position", rate_hz=1.0)
    bench.step(10)
    bench.do(Goto(90.0, 30.0, "test"))
    assert bench.state.firmware_version is not None
    bench.refuse = {"sim:other"}
    bench.do(Connect("sim:other"), 5)
    bench.step(1)
    state = bench.state
    assert state.link.state is LinkPhase.LOST
    assert state.position is state.homed is state.firmware_version is state.target_az_deg is None
    assert state.search is TvSearch.UNKNOWN
    assert not state.readings
    bench.refuse = set()
    bench.step(10)
    assert bench.state.link.state is LinkPhase.UP
    # A step is from where this dish is, not from where the other was sent.
    bench.do(Jog(1.0, 0.0, "test"))
    assert bench.state.fault is None


def test_none_is_the_firmwares_own_rate(wrong):
    wrong.do(Connect("sim:test", None))
    wrong.step(3)
    assert wrong.bauds()[-1] == 115200
    assert wrong.state.link.state is LinkPhase.UP


def test_a_console_that_loses_what_comes_too_soon_is_asked_again_after_its_pause():
    bench = Bench("pro?seed=1", {}, firmware="pro").connect(15.0)
    bench.device.shell.menu = "root"
    found = bench.do(ProbePort())[-1]
    assert found.saw is Saw.PROMPT
    assert "odu" in found.listed
