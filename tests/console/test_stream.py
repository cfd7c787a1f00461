"""A stream of lines goes on where an answer is lost, and no answer is ever taken for another's (decision 0018)."""

from __future__ import annotations

import re
import sys

import pytest
from birdcage.base.errors import BirdcageError, Cancelled, NoReply
from birdcage.console.codec import MARK
from birdcage.console.damage import may_become
from birdcage.console.late import MOST_LATE
from birdcage.console.pace import LEAST_S, Pace
from birdcage.console.session import Console
from hypothesis import given, settings
from hypothesis import strategies as st

bench, scripted = sys.modules["console_bench"], sys.modules["console_scripted"]
READING = re.compile(r"R(\d{4})=(\d{4})")
MOVED = re.compile(r"Angle = (\d+\.\d\d)")


class Dish(scripted.Dish):
    """Tells the readings apart: each is a number of its own, and the difference to 9999."""

    def __init__(self, clock, **options) -> None:
        super().__init__(clock, **options)
        self.read_at: list[float] = []

    def _line(self, line: str, at: float) -> None:
        if self.menu == "mot" and line == "a":
            self.heard.append((self.menu, line))
            number = len(self.read_at)
            self.read_at.append(at)
            self.say(f"R{number:04}={9999 - number:04}\r\n{self.prompts[self.menu]}", at)
        else:
            super()._line(line, at)


@pytest.fixture
def dish(clock):
    return Dish(clock)


@pytest.fixture
def steering(console):
    console.enter("mot")
    console.hurry("mot", "a 0 100.00")
    return console


def took(clock, deed):
    began = clock.monotonic()
    try:
        deed()
    except NoReply as error:
        return clock.monotonic() - began, error.reason
    return clock.monotonic() - began, ""


def test_a_lost_answer_costs_a_few_round_trips_and_the_next_line_goes_out(dish, steering, clock):
    dish.out_fault = lambda _byte: []
    waited_s, reason = took(clock, lambda: steering.hurry("mot", "a 0 101.00"))
    assert (reason, waited_s) == ("late", pytest.approx(LEAST_S))
    dish.out_fault = scripted.clean
    assert steering.hurry("mot", "a 1 30.00").lines == ("Angle = 30.00",)
    assert steering.hurry("mot", "a", asks=True).lines == ("R0000=9999",), "all is accounted for"


@pytest.mark.parametrize("lost", ["MOT>", "T>", ">", "MO", "O"])
def test_a_lost_prompt_or_a_part_of_it_costs_no_more(dish, steering, clock, lost):
    dish.out_fault = lambda byte: [] if chr(byte) in lost else [(0.0, bytes([byte]))]
    assert took(clock, lambda: steering.hurry("mot", "a 0 101.00"))[1] == "late"
    dish.out_fault = scripted.clean
    assert steering.hurry("mot", "a 1 30.00").lines == ("Angle = 30.00",)
    assert steering.hurry("mot", "a", asks=True).lines == ("R0000=9999",)


def test_nothing_is_asked_while_an_answer_is_due(dish, steering, clock):
    dish.out_fault = lambda _byte: []
    took(clock, lambda: steering.hurry("mot", "a 0 101.00"))
    dish.out_fault = scripted.clean
    assert took(clock, lambda: steering.hurry("mot", "a", asks=True)) == (0.0, "late")
    assert dish.heard[-1] == ("mot", "a 0 101.00"), "it was not sent"


def test_a_move_that_became_a_question_on_its_way_answers_none(dish, steering, clock):
    dish.in_fault = lambda byte: [(0.0, bytes([byte]))] if chr(byte) in "a\r" else []
    dish.out_fault = lambda byte: [(1.0, bytes([byte]))]
    assert took(clock, lambda: steering.hurry("mot", "a 0 101.00"))[1] == "late"
    dish.in_fault = dish.out_fault = scripted.clean
    assert took(clock, lambda: steering.hurry("mot", "a", asks=True))[1] == "late"
    clock.advance(1.0)
    assert steering.hurry("mot", "a 1 30.00").lines == ("Angle = 30.00",)
    assert steering.hurry("mot", "a", asks=True).lines == ("R0001=9998",)


def test_a_line_that_another_may_have_become_proves_nothing(dish, steering, clock):
    dish.out_fault = lambda _byte: []
    took(clock, lambda: steering.hurry("mot", "a 0 12.34"))
    dish.out_fault = scripted.clean
    steering.hurry("mot", "a 0 12.33")
    assert took(clock, lambda: steering.hurry("mot", "a", asks=True)) == (0.0, "late")
    steering.hurry("mot", "a 1 30.00")
    assert steering.hurry("mot", "a", asks=True).lines == ("R0000=9999",)


def test_a_late_reading_is_not_taken_for_the_next(dish, steering, clock):
    dish.out_fault = lambda byte: [(1.0, bytes([byte]))]
    assert took(clock, lambda: steering.hurry("mot", "a", asks=True))[1] == "late"
    dish.out_fault = scripted.clean
    clock.advance(1.0)
    steering.hurry("mot", "a 0 102.00")
    assert steering.hurry("mot", "a", asks=True).lines == ("R0001=9998",)


def test_after_three_it_finds_its_feet_as_ever(dish, steering, clock):
    dish.out_fault = lambda _byte: []
    for number in range(MOST_LATE):
        assert took(clock, lambda deg=110 + number: steering.hurry("mot", f"a 0 {deg}.00"))[1] == "late"
    dish.out_fault = scripted.clean
    waited_s, reason = took(clock, lambda: steering.hurry("mot", "a 0 120.00"))
    assert (waited_s, reason) == (pytest.approx(2 * bench.D - 2 * LEAST_S, abs=0.1), "")


def test_any_other_line_waits_until_all_is_quiet(dish, steering, clock):
    dish.out_fault = lambda _byte: []
    took(clock, lambda: steering.hurry("mot", "a 0 101.00"))
    dish.out_fault = scripted.clean
    waited_s, _ = took(clock, lambda: steering.run("mot", "a"))
    assert waited_s > 3.0


def test_no_q_goes_out_before_the_late_line_is_accounted_for(dish, steering, clock):
    dish.out_fault = lambda _byte: []
    took(clock, lambda: steering.hurry("mot", "a 0 101.00"))
    dish.out_fault = scripted.clean
    steering.hurry("mot", "a 0 102.00")
    before = len(dish.written)
    steering.leave()
    assert dish.written[before:] == MARK.encode() + b"\r\rq\r"
    assert dish.menu == "root"


@pytest.mark.parametrize("line", ["q", "freqs"])
def test_a_line_that_could_leave_is_not_hurried(steering, line):
    with pytest.raises(ValueError, match="could leave"):
        steering.hurry("mot", line)


def test_a_console_without_echo_is_waited_for(clock):
    dish = Dish(clock, echo=False)
    console = Console(dish, clock, bench.replace(bench.DIALECT, echo=False), delay_s=bench.D)
    console.enter("mot")
    dish.out_fault = lambda _byte: []
    waited_s, reason = took(clock, lambda: console.hurry("mot", "a 0 101.00"))
    assert (waited_s, reason) == (pytest.approx(bench.D), "silent")


@pytest.mark.parametrize(
    ("sent", "line", "may"),
    [
        ("a 0 12.34", "a", True), ("a 0 12.34", "a 0 12.33", True), ("a 0 12.34", "a 0 122.34", True),
        ("a 0 12.34", "a 0 12.35", False), ("a", "a 0 1.00", False), ("a 0 1.20", "a 0 1.2000", False),
    ],
)  # fmt: skip
def test_what_damage_can_make_of_a_line(sent, line, may):
    assert may_become(sent, line) is may


def test_patience_follows_the_round_trips():
    pace = Pace()
    for _ in range(40):
        pace.take(0.02)
    assert pace.patience_s(1.0, 2.0) == LEAST_S
    for number in range(40):
        pace.take(0.05 + 0.25 * (number % 2))
    assert 0.35 < pace.patience_s(1.0, 2.0) < 0.9
    for _ in range(5):
        pace.miss()
    assert pace.patience_s(1.0, 2.0) == 2.0


# The property

ANGLES = [f"{number * 37.13 % 360:.2f}" for number in range(1, 400)]
DEEDS = st.lists(
    st.tuples(
        st.tuples(bench.LAGS, bench.LAGS),
        st.sampled_from(["", "", "", "", "no answer", "no line", "a question"]),
        st.one_of(st.none(), st.none(), st.none(), bench.NUDGES),
        st.one_of(
            *[st.just("steer")] * 4, *[st.just("glance")] * 2,
            st.sampled_from(["read", "leave", "tuner", "interject", "settle", "synchronize"]),
            st.sampled_from([0.05, 0.3, 1.0, 2.5]),
        ),
    ),
    min_size=3,
    max_size=24,
)  # fmt: skip


class Helm:
    """Steers, reads and does other things, and holds every answer against what the dish did."""

    def __init__(self, dish, clock) -> None:
        self.dish, self.clock, self.nudge = dish, clock, ""
        self.console = Console(
            dish, clock, bench.DIALECT, delay_s=bench.D, wake=clock.wake, on_wake=self.woken, on_line=lambda _: None
        )
        self.angles = iter(ANGLES)
        self.sent: set[str] = set()
        self.answered = self.read = 0

    def woken(self) -> None:
        self.clock.wake.clear()
        if self.nudge == "cancel":
            raise Cancelled("test")
        self.console.interject(["a 0 12", "a 1 30"])

    def act(self, nudge, deed) -> None:
        self.nudge, self.clock.countdown = nudge or ("", 0)
        began = self.clock.monotonic()
        try:
            self._act(deed, began)
        except BirdcageError:
            pass
        finally:
            self.clock.countdown = 0

    def _act(self, deed, began: float) -> None:
        console = self.console
        if isinstance(deed, float):
            self.clock.advance(deed)
        elif deed == "steer":
            angle = next(self.angles)
            self.sent.add(angle)
            self._moved(angle, console.hurry("mot", f"a {len(self.sent) % 2} {angle}"))
        elif deed == "glance":
            self._seen(began, console.hurry("mot", "a", asks=True))
        elif deed == "read":
            self._seen(began, console.run("mot", "a"))
        elif deed == "tuner":
            console.enter("dvb")
        elif deed == "interject":
            console.interject(["a 0 20", "a 1 31"])
        elif deed == "settle":
            console.settle(bench.D)
        else:
            getattr(console, deed)()

    def _moved(self, angle: str, reply) -> None:
        """A damaged angle may be any; another line's may not come out."""
        told = MOVED.findall(" ".join(reply.lines))
        assert not [one for one in told if one != angle and one in self.sent], (angle, reply)
        self.answered += 1

    def _seen(self, began: float, reply) -> None:
        for found in READING.findall(" ".join(reply.lines)):
            number, rest = map(int, found)
            if number + rest == 9999 and number < len(self.dish.read_at):
                assert self.dish.read_at[number] >= began, (reply, "was read before it was asked")
                self.read += 1


def only(through: str | None, fault):
    """Let only these letters through, and nothing else of what `fault` leaves; None: all."""
    return fault if through is None else lambda byte: fault(byte) if chr(byte) in through else []


def steer(deeds, to_dish, to_host) -> Helm:
    clock, lanes = bench.NudgingClock(), (bench.Faults(to_dish), bench.Faults(to_host))
    dish = Dish(clock)
    guide = Helm(dish, clock)
    for lags, fault_mix, nudge, deed in deeds:
        through = {"no line": "", "a question": "a\r"}.get(fault_mix)
        dish.in_fault = only(through, lanes[0].scripted)
        dish.out_fault = only("" if fault_mix == "no answer" else None, lanes[1].scripted)
        for lane, lag_s in zip(lanes, lags, strict=True):
            lane.lag_s = lag_s
        guide.act(nudge, deed)
        dish.pending()
        assert dish.alive, deed
    clock.advance(60.0)
    dish.pending()
    assert dish.alive
    clock.wake.close()
    return guide


drawn = given(DEEDS, bench.FAULTS, bench.FAULTS)


@settings(max_examples=300, derandomize=True, deadline=None, database=None)
@drawn
def test_no_answer_of_a_stream_is_taken_for_anothers(deeds, to_dish, to_host):
    steer(deeds, to_dish, to_host)


@pytest.mark.soak
@settings(max_examples=1000, deadline=None, database=None)
@drawn
def test_no_answer_of_many_streams_is_taken_for_anothers(deeds, to_dish, to_host):
    steer(deeds, to_dish, to_host)


def test_a_stream_on_a_clear_line_is_answered():
    guide = steer([((0.0, 0.0), "", None, deed) for deed in ["steer", "steer", "glance", "steer", "glance"]], [], [])
    assert (guide.answered, guide.read) == (3, 2)


def test_a_slow_answer_is_waited_for_where_the_stream_ends(dish, steering, clock):
    dish.out_fault = lambda byte: [(1.0, bytes([byte]))]
    assert took(clock, lambda: steering.hurry("mot", "a 0 101.00"))[1] == "late"
    dish.out_fault = scripted.clean
    waited_s, _ = took(clock, lambda: steering.run("mot", "a"))
    assert waited_s == pytest.approx(1.0 - LEAST_S), "no more than that"
