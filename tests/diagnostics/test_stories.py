"""Months that an owner would know again: what the page says first, and what to do."""

from __future__ import annotations

from dataclasses import replace
from datetime import timedelta

import pytest
from birdcage.base.journal_rows import IncidentKind
from birdcage.diagnostics.finding import Weight
from birdcage.diagnostics.health import read_health
from birdcage.diagnostics.history import acknowledge
from birdcage.station.state import LinkPhase, LinkState, TvSearch

from .made_history import NOW, TRAVLER, MadeHistory, answering, out_of_reach


@pytest.fixture
def judged(tmp_path):
    """Write a history, and return the health of its dish."""

    def judged(made, state=None, **more):
        path = made.write(tmp_path / "journal.sqlite")
        return read_health(path, answering() if state is None else state, NOW, dish=made.dish, **more)

    return judged


def branch(made):
    for days_ago, az, el in ((16, 117.6, 25), (11, 118.2, 31), (4, 118.0, 28), (1, 117.9, 24)):
        made.stall(days_ago, "azimuth", az, el)
    return made


def weak_supply(made):
    for days_ago in (20, 17, 12, 9, 6, 3, 2):
        made.restart(days_ago, moving=True)
    return made.restart(15)


def corroded_plug(made):
    for days_ago in range(14):
        made.replies(days_ago, 1000, max(0, 30 - 2 * days_ago), stray=40)
    return made


def worn_belt(made):
    for days_ago, az in ((22, 310), (15, 40), (11, 205), (8, 133), (5, 268), (2, 71)):
        made.stall(days_ago, "azimuth", az, 40)
    return made


def ice(made):
    for hour, axis, el in ((5.6, "elevation", 45.0), (6.2, "elevation", 31.0), (7.1, "azimuth", 45.0)):
        made.stall(15, axis, 180.0, el, hour)
    return made


def home_failure(made):
    return made.fault(0, "stall", 7.5, axis="elevation", homing=True)


def test_a_branch_at_one_azimuth(judged):
    health = judged(branch(MadeHistory().ordinary()))
    first = health.findings[0]
    assert (first.id, first.weight, first.count) == ("stall.azimuth", Weight.FAULT, 4)
    assert (
        first.text
        == "AZ stalled 4 times since 11 November, each time at 118°. Something probably stands in its way there."
    )
    assert "azimuth 118°, elevation 24° to 31°" in first.todo[0]
    assert "a branch" in first.todo[0]
    assert len(health.findings) == 1


def test_a_weak_supply(judged):
    first = judged(weak_supply(MadeHistory().ordinary())).findings[0]
    assert (first.id, first.weight, first.count) == ("restarts", Weight.FAULT, 8)
    assert first.text.startswith("The dish restarted 8 times since 7 November, 7 of them while it moved.")
    assert "supply is probably too weak" in first.text
    assert first.todo[0].startswith("Measure the voltage at the dish while both axes move.")


def test_a_corroded_plug(judged):
    first = judged(corroded_plug(MadeHistory().ordinary())).findings[0]
    assert (first.id, first.weight) == ("replies", Weight.WARN)
    assert first.text.startswith("Replies get lost on the line: 169 of ")
    assert "in the last 7 days. Before, it was " in first.text
    assert "bytes of noise" in first.why
    assert first.todo[0].startswith("Pull each plug between dish and adapter.")


def test_a_worn_belt(judged):
    first = judged(worn_belt(MadeHistory().ordinary())).findings[0]
    assert (first.id, first.weight, first.count) == ("stall.azimuth", Weight.FAULT, 6)
    assert first.text == "AZ stalled 6 times since 5 November, between 40° and 310°: at no one place."
    assert "belt" in first.why
    assert "belt" in first.todo[1]


def test_ice_on_one_morning(judged):
    health = judged(ice(MadeHistory().ordinary()))
    assert [each.id for each in health.findings] == ["stall.elevation", "stall.azimuth"]
    first = health.findings[0]
    assert first.weight is Weight.WARN
    assert first.text == "EL stalled twice on 12 November, 05:36 to 06:12 UTC, and not since."
    assert "ice or snow" in first.why
    assert "look for ice before the first move" in first.todo[0]


def test_elevation_home_failure(judged):
    state = answering(TRAVLER, homed=None, search=TvSearch.OFF_UNTIL_POWER_UP)
    first = judged(home_failure(MadeHistory(TRAVLER.name).ordinary()), state).findings[0]
    assert (first.id, first.weight) == ("homing.elevation", Weight.FAULT)
    assert first.text == "EL failed to home today."
    steps = " ".join(first.todo)
    for words in ("press POWER", "hold ENTER for 2 s", "User Menu", "INSTALLATION", "Calibrate EL", "hard stop"):
        assert words in steps
    by_hand = first.todo[-1]
    assert by_hand.startswith("Last resort")
    for words in ("5/16 in socket", "6 in extension", "clockwise, slowly", "rear label", "damages the motor"):
        assert words in by_hand


def test_a_failed_homing_is_over_with_a_homing_and_not_with_an_angle_that_is_told(judged):
    made = MadeHistory().ordinary().fault(2, "stall", 9.0, axis="elevation", homing=True)
    first = judged(made).findings[0]  # it answers, tells an angle, and its fault was acknowledged
    assert (first.id, first.weight) == ("homing.elevation", Weight.FAULT)
    assert judged(MadeHistory().homed(1.5, "azimuth")).findings[0].weight is Weight.FAULT
    first = judged(MadeHistory().homed(1, "azimuth, elevation")).findings[0]
    assert (first.id, first.weight) == ("homing.elevation", Weight.WARN)
    assert first.text == "EL failed to home on Wednesday. Since then it has homed without that."


def test_a_dish_that_homes_by_itself_has_to_start_once_more_for_that(judged):
    made = MadeHistory(TRAVLER.name).ordinary().fault(2, "stall", 9.0, axis="elevation", homing=True)
    made.incident(2, IncidentKind.RESTART, 9.1)  # the boot text of the start in which it failed
    state = answering(TRAVLER)
    assert judged(made, state).findings[0].weight is Weight.FAULT
    later = MadeHistory(TRAVLER.name).incident(1, IncidentKind.RESTART)
    assert judged(later, state).findings[0].weight is Weight.WARN


def test_everything_fine(judged):
    health = judged(MadeHistory().ordinary().off_and_on(3).off_and_on(9).gap(12, 4.0))
    assert health.findings == ()
    assert health.headline == "Nothing needs attention."
    assert not health.needs_you
    assert health.looked_at.startswith("Looked at 30 days of the Carryout G2. Counted 1,")
    assert "0 stalls, 2 restarts, lost replies: " in health.looked_at
    assert health.looked_at.endswith("The dish answers, and its present state is included.")


def test_old_faults_long_acknowledged_return_only_when_it_happens_again(tmp_path):
    path = tmp_path / "journal.sqlite"
    made = MadeHistory().ordinary().stall(20, "elevation", 100, 62).stall(18, "elevation", 100, 40)
    made.write(path)
    seen_at = NOW - timedelta(days=10)
    [before] = read_health(path, answering(), seen_at, dish=made.dish).findings
    acknowledge(path, made.dish, before, seen_at)
    assert read_health(path, answering(), NOW, dish=made.dish).findings == ()
    assert read_health(path, answering(), NOW, dish="another dish").findings == ()
    MadeHistory().stall(2, "elevation", 100, 51).write(path)
    [again] = read_health(path, answering(), NOW, dish=made.dish).findings
    assert (again.id, again.count) == ("stall.elevation", 3)
    assert again.text == "EL stalled 3 times since 7 November, at 40°, 51° and 62°: at no one place."


def test_it_gets_worse_after_it_was_acknowledged(tmp_path):
    path = tmp_path / "journal.sqlite"
    made = MadeHistory().ordinary()
    for days_ago in range(7):
        made.replies(days_ago, 1000, 20)
    made.write(path)
    [before] = read_health(path, answering(), NOW, dish=made.dish).findings
    acknowledge(path, made.dish, before, NOW)
    assert read_health(path, answering(), NOW, dish=made.dish).findings == ()
    MadeHistory().replies(0, 1000, 900).write(path)
    [again] = read_health(path, answering(), NOW, dish=made.dish).findings
    assert (again.id, again.weight) == ("replies", Weight.FAULT)


def test_what_is_still_so_returns_after_the_days_that_are_judged(tmp_path):
    path = tmp_path / "journal.sqlite"
    made = MadeHistory().ordinary()
    made.write(path)
    state = answering(told={"sleep_timer": (420.0, "s")})
    [sleep] = read_health(path, state, NOW, dish=made.dish).findings
    acknowledge(path, made.dish, sleep, NOW - timedelta(days=29))
    assert read_health(path, state, NOW, dish=made.dish).findings == ()
    [again] = read_health(path, state, NOW + timedelta(days=2), dish=made.dish).findings
    assert again.id == "sleep"
    [again] = read_health(path, state, NOW, dish=made.dish, days=20).findings
    assert again.id == "sleep"


@pytest.mark.parametrize("told", [{"tv_search": (True, "")}, {"lnb_supply": (0.2, "V")}, {"lnb_supply": (18.2, "V")}])
def test_a_search_that_is_on_and_a_wrong_supply_cannot_be_acknowledged(judged, told):
    [only] = judged(MadeHistory().ordinary(), answering(told=told)).findings
    assert only.lasts


@pytest.mark.parametrize(
    ("what", "order"),
    [
        ((branch, weak_supply, corroded_plug), ["stall.azimuth", "restarts", "replies"]),
        ((ice, weak_supply), ["restarts", "stall.elevation", "stall.azimuth"]),
        ((corroded_plug, weak_supply), ["restarts", "replies"]),
        ((home_failure, branch, corroded_plug), ["homing.elevation", "stall.azimuth", "replies"]),
        ((worn_belt, weak_supply), ["stall.azimuth", "restarts"]),
        ((ice, corroded_plug), ["stall.elevation", "stall.azimuth", "replies"]),
    ],
)
def test_a_month_with_more_than_one_trouble_says_the_worst_first(judged, what, order):
    made = MadeHistory().ordinary()
    for each in what:
        each(made)
    state = answering(homed=None) if home_failure in what else answering()
    assert [each.id for each in judged(made, state).findings] == order


def test_a_dish_switched_off_each_night_is_no_weak_supply(judged):
    made = MadeHistory().ordinary()
    for days_ago in range(2, 28):
        made.off_and_on(days_ago)
    health = judged(made)
    assert health.findings == ()
    assert health.figures.link.restarts == 26


def test_a_deadlock_is_a_silence_in_mid_move_that_only_a_restart_ends(judged):
    first = judged(MadeHistory().ordinary().deadlock(3)).findings[0]
    assert first.id == "deadlock"
    assert first.text == "The dish fell silent in mid-move on Tuesday. Only a restart brought it back."
    assert any("12 V switch" in step for step in first.todo)


def test_a_wire_that_opens_for_moments(judged):
    made = MadeHistory().ordinary()
    for days_ago in (8, 6, 5, 3):
        made.gap(days_ago, 14.0, moving=True)
    [only] = judged(made).findings
    assert (only.id, only.weight, only.count) == ("gaps", Weight.WARN, 4)
    assert "4 times it was moving" in only.why


def test_an_adapter_that_goes_away(judged):
    made = MadeHistory().ordinary()
    for hour in (1, 3, 5):
        made.incident(0, IncidentKind.LOST, hour).incident(0, IncidentKind.BACK, hour + 0.1)
    [only] = judged(made).findings
    assert (only.id, only.weight) == ("port_lost", Weight.FAULT)
    assert only.text == "The port of the dish went away 3 times today."


def test_without_the_dish_the_history_speaks_and_says_that_it_is_all(judged):
    health = judged(branch(MadeHistory().ordinary()), out_of_reach())
    assert health.findings[0].id == "stall.azimuth"
    assert health.looked_at.endswith("The dish was not asked: its present state is unknown.")
    assert health.figures.link.homed is None


@pytest.mark.parametrize(("link", "port", "words"), [
    (LinkPhase.SILENT, "/dev/ttyUSB0", "The dish was asked and did not answer: its present state is unknown."),
    (LinkPhase.LOST, "/dev/ttyUSB0", "The dish could not be asked through its port: its present state is unknown."),
    (LinkPhase.LOST, "", "The dish was not asked: its present state is unknown."),
])  # fmt: skip
def test_a_dish_that_does_not_answer_was_asked(judged, link, port, words):
    state = replace(out_of_reach(), link=LinkState(link), port=port)
    assert judged(MadeHistory().ordinary(), state).looked_at.endswith(f". {words}")


def test_what_was_saved_waits_for_a_start_and_is_over_with_it(judged, tmp_path):
    made = MadeHistory().ordinary().incident(2, IncidentKind.SAVED)
    made.rows[-1] = replace(made.rows[-1], sentence="Sleep Mode Timer Secs")
    [only] = judged(made).findings
    assert (only.id, only.weight) == ("pending", Weight.NOTE)
    assert only.text == (
        "Saved in the dish on Wednesday, and not in force before its next power-up: Sleep Mode Timer Secs."
    )
    assert judged(MadeHistory().off_and_on(1, 10, hours=1)).findings == ()


def test_what_was_changed_and_not_saved(judged):
    [only] = judged(MadeHistory().ordinary(), unsaved=("Sleep Mode Timer Secs",)).findings
    assert only.text == "Changed in the dish, and not saved: Sleep Mode Timer Secs."
