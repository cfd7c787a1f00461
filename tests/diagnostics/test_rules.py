"""Where each rule draws its line, and what the present state of a dish adds to its history."""

from __future__ import annotations

from dataclasses import replace

import pytest
from birdcage.base.journal_rows import IncidentKind
from birdcage.base.reason import Reason
from birdcage.diagnostics import wording
from birdcage.diagnostics.finding import Weight
from birdcage.diagnostics.health import features_for_health, read_health
from birdcage.diagnostics.history import list_dishes
from birdcage.station.state import Fault, FaultReason, LinkPhase, LinkState, StationState, TvSearch

from .made_history import G2, NOW, TRAVLER, MadeHistory, answering, out_of_reach


@pytest.fixture
def judged(tmp_path):
    def judged(made, state=None, **more):
        path = made.write(tmp_path / "journal.sqlite")
        return read_health(path, answering() if state is None else state, NOW, dish=made.dish, **more)

    return judged


@pytest.fixture
def now(judged):
    """Judge a dish without trouble in its history, by its present state; the weights by id."""

    def now(state):
        return {each.id: each for each in judged(MadeHistory().ordinary(), state).findings}

    return now


def test_stalls_of_this_morning_may_go_on_so_they_are_no_spell_that_is_over(judged):
    made = MadeHistory().ordinary().stall(0, "elevation", 180, 45, 6.0).stall(0, "elevation", 180, 45, 7.0)
    [first] = judged(made).findings
    assert first.weight is Weight.FAULT
    assert first.text == "EL stalled twice today, each time at 45°. Something probably stands in its way there."


def test_three_at_one_place_with_no_move_since_are_no_ice(judged):
    made = MadeHistory()
    for hour in (6.0, 6.5, 7.0):
        made.stall(3, "elevation", 180, 45, hour)
    [first] = judged(made).findings
    assert first.text == "EL stalled 3 times on Tuesday, each time at 45°. Something probably stands in its way there."


def test_ice_is_over_only_for_an_axis_that_has_moved_on_a_later_day(judged):
    made = MadeHistory()
    for axis, el in (("elevation", 45), ("elevation", 20), ("azimuth", 45)):
        made.stall(3, axis, 180, el, 6.0)
    found = {each.id: each.text for each in judged(made.turned(3, 1, 2.0).turned(2, 0, 2.0)).findings}
    assert found == {
        "stall.elevation": "EL stalled twice on Tuesday, at 20° and 45°.",
        "stall.azimuth": "AZ stalled once on Tuesday, 06:00 UTC, and not since.",
    }
    made = MadeHistory().turned(2, 1, 2.0)
    assert all(each.text.endswith("and not since.") for each in judged(made).findings)


def test_a_stall_of_one_axis_on_another_day_is_none_of_the_ice_on_the_other(judged):
    made = MadeHistory().ordinary().stall(15, "elevation", 180, 45, 6.0).stall(15, "elevation", 180, 31, 6.5)
    found = {each.id: each.text for each in judged(made.stall(9, "azimuth", 100, 40)).findings}
    assert found["stall.elevation"].endswith("and not since.")
    assert found["stall.azimuth"] == "AZ stalled on 18 November, at 100°."


def test_a_failed_homing_of_an_axis_that_is_not_known(judged):
    made = MadeHistory().fault(2, "stall", 9.0, homing=True)
    [first] = judged(made).findings
    assert (first.id, first.text) == ("homing.unknown", "An axis failed to home on Wednesday.")
    assert "Cut its power. Find what blocks it, and free it." in first.todo
    assert judged(MadeHistory().homed(1.5, "azimuth")).findings[0].weight is Weight.FAULT
    assert judged(MadeHistory().homed(1.2, "elevation")).findings[0].weight is Weight.WARN


def test_two_of_many_at_one_angle_are_no_obstacle(judged):
    made = MadeHistory().ordinary()
    for days_ago, az in ((20, 50), (17, 50), (12, 120), (9, 200), (5, 260), (2, 330)):
        made.stall(days_ago, "azimuth", az, 40)
    assert "at no one place" in judged(made).findings[0].text


def test_an_azimuth_beside_north_is_one_place(judged):
    made = MadeHistory().ordinary().stall(9, "azimuth", 359.6, 30).stall(2, "azimuth", 0.6, 30)
    assert "each time at 0°" in judged(made).findings[0].text
    assert "each time at 0°" in judged(made.stall(1, "azimuth", 359.1, 30)).findings[0].text, "and not at 360°"


def test_an_old_single_stall_is_a_note(judged):
    [only] = judged(MadeHistory().ordinary().stall(22, "elevation", 100, 62)).findings
    assert (only.weight, only.text) == (Weight.NOTE, "EL stalled on 5 November, at 62°.")


def test_a_stall_of_an_older_birdcage_counts_without_axis_and_angle(judged):
    made = MadeHistory().ordinary().fault(2, "stall")
    made.rows[-1] = replace(made.rows[-1], dish="")
    assert [each.text for each in judged(made).findings] == ["An axis stalled on Wednesday."]
    made.rows[-1] = replace(made.rows[-1], sentence="DEMO: of a simulated dish", utc=made.at(1))
    assert len(judged(made).findings[0].text) < 40, "a simulated dish's stall is none of this one"


def test_a_line_that_always_loses_as_much_has_not_become_worse(judged):
    assert judged(MadeHistory().ordinary(lost=0.006)).findings == ()


def test_a_new_line_that_loses_much_is_told_though_nothing_is_known_of_before(judged):
    made = MadeHistory()
    for days_ago in range(3):
        made.replies(days_ago, 500, 20)
    [only] = judged(made).findings
    assert only.text == "Replies get lost on the line: 60 of 1,500 (1 in 25) in the last 7 days."


def test_a_changed_adapter_is_named_where_the_loss_began_with_it(judged):
    made = MadeHistory().ordinary()
    made.rows = [row for row in made.rows if getattr(row, "day", None) is None or (NOW.date() - row.day).days > 6]
    for days_ago in range(7):
        made.replies(days_ago, 1000, 30, adapter="usb:2")
    assert "The adapter changed meanwhile. Try the one that was there before." in judged(made).findings[0].why


def test_an_adapter_that_was_there_before_has_not_changed(judged):
    made = MadeHistory().ordinary().replies(30, 1000, 0, adapter="usb:2")
    made.rows = [row for row in made.rows if getattr(row, "day", None) is None or (NOW.date() - row.day).days > 6]
    for days_ago in range(7):
        made.replies(days_ago, 1000, 30, adapter="usb:2")
    [only] = judged(made).findings
    assert only.id == "replies"
    assert "adapter changed" not in only.why


def test_a_limit_that_changed_long_ago_is_not_told_again(judged):
    assert judged(MadeHistory().ordinary().limit(40, "floor", "10.0")).findings == ()


def test_a_limit_is_compared_with_what_held_before_the_days_that_are_judged(judged):
    made = MadeHistory().ordinary().limit(9, "ceiling", "75.0").limit(3, "ceiling", "85.0")
    [only] = judged(made).findings
    assert only.text.endswith("changed on Tuesday: 65.00° before, 85.00° now.")
    assert "set it back to 65.00°" in only.todo[1]
    assert judged(MadeHistory().limit(1, "ceiling", "65.0")).findings == (), "it is as it was"


def test_a_limit_that_was_told_for_the_first_time_lately_is_compared_with_that(judged):
    made = MadeHistory().limit(9, "ceiling", "65.0").limit(6, "ceiling", "85.0")
    assert "65.00° before, 85.00° now." in judged(made).findings[0].text
    assert judged(MadeHistory().limit(3, "ceiling", "65.0")).findings == ()


@pytest.mark.parametrize(("restarts", "weight"), [(1, Weight.NOTE), (2, Weight.NOTE), (3, Weight.WARN)])
def test_restarts_at_rest_are_a_loose_contact_once_there_are_some(judged, restarts, weight):
    made = MadeHistory().ordinary()
    for days_ago in range(restarts):
        made.restart(3 + 2 * days_ago)
    [only] = judged(made).findings
    assert (only.id, only.weight, only.count) == ("restarts", weight, restarts)
    assert "supply is probably too weak" not in only.text


def test_a_restart_without_boot_text_counts_too(judged):
    made = MadeHistory().ordinary().fault(4, "unhomed").restart(2)
    health = judged(made)
    assert health.findings[0].count == 2
    assert health.figures.link.restarts == 2
    assert sum(each.restarts for each in health.figures.by_day) == 2


@pytest.mark.parametrize("kind", [IncidentKind.RESTART, IncidentKind.START])
def test_a_boot_text_and_a_lost_reference_beside_it_are_one_restart(judged, kind):
    made = MadeHistory().ordinary().incident(4, kind, 12.0).fault(4, "unhomed", 12.01)
    health = judged(made)
    assert health.figures.link.restarts == 1
    assert [each.count for each in health.findings] == ([1] if kind is IncidentKind.RESTART else [])


def test_one_restart_in_motion_of_two_is_no_weak_supply(judged):
    [only] = judged(MadeHistory().ordinary().restart(4, moving=True).restart(2)).findings
    assert (only.id, only.weight) == ("restarts", Weight.NOTE)
    [only] = judged(MadeHistory().restart(1, moving=True)).findings
    assert "supply is probably too weak" in only.text


def test_the_finding_says_how_many_more_restarts_the_figures_have(judged):
    health = judged(MadeHistory().ordinary().restart(4).off_and_on(6).off_and_on(9))
    [only] = health.findings
    assert (only.count, health.figures.link.restarts) == (1, 3)
    assert "Not counted here: 2 that look like its switch." in only.why


def test_a_dish_switched_off_on_the_day_before_the_first_has_not_restarted_by_itself(judged):
    health = judged(MadeHistory().ordinary().off_and_on(30))
    assert (health.findings, health.figures.link.restarts) == ((), 1)


def test_the_start_of_another_program_does_not_end_an_outage(judged):
    made = MadeHistory().ordinary().incident(5, IncidentKind.SILENT, moving=True)
    made.incident(3, IncidentKind.START)
    assert judged(made).findings == ()
    made = MadeHistory().incident(2, IncidentKind.RESTART)
    assert [each.id for each in judged(made).findings] == ["restarts"], "it ends none either"


def test_a_driver_that_reports_a_fault(now):
    found = now(answering(told={"driver.azimuth": ("FAULT", "")}))["driver.azimuth"]
    assert (found.weight, found.text) == (Weight.FAULT, "The driver of the AZ motor reports FAULT.")
    assert found.lasts


@pytest.mark.parametrize(
    ("volts", "polarisation", "weight"),
    [(13.1, "V", None), (18.2, "H", None), (18.2, "V", Weight.NOTE), (13.0, "H", Weight.NOTE), (0.2, "V", Weight.WARN),
     (24.0, "H", Weight.WARN), (14.9, "", None)],
)  # fmt: skip
def test_the_supply_of_the_lnb(now, volts, polarisation, weight):
    found = now(answering(told={"lnb_supply": (volts, "V"), "polarisation": (polarisation, "")})).get("lnb")
    assert (None if found is None else found.weight) is weight


@pytest.mark.parametrize(
    ("state", "weight"),
    [
        (answering(told={"tv_search": (True, "")}), Weight.FAULT),
        (answering(search=TvSearch.RUNNING), Weight.FAULT),
        (answering(), None),
        (answering(search=TvSearch.UNKNOWN), None),  # its setting says that it is off
        (answering(TRAVLER, search=TvSearch.OFF_UNTIL_POWER_UP), Weight.NOTE),
    ],
)
def test_the_tv_search(now, state, weight):
    found = now(state).get("search")
    assert (None if found is None else found.weight) is weight


def test_a_search_that_the_dish_does_not_tell_of_is_unknown(now):
    state = answering(search=TvSearch.UNKNOWN)
    state = replace(state, readings={name: each for name, each in state.readings.items() if name != "tv_search"})
    assert now(state)["search"].weight is Weight.WARN


def test_a_sleep_timer_is_a_note_and_none_where_it_is_off(now):
    assert now(answering(told={"sleep_timer": (420.0, "s")}))["sleep"].text == (
        "Sleep timer (NVS 38): 420 s. What sleep does is unknown."
    )
    assert "sleep" not in now(answering())


def test_what_a_dish_out_of_reach_told_before_says_nothing_of_now(now):
    state = answering(told={"driver.azimuth": ("FAULT", "")}, homed=False)
    assert "homed" in now(state)
    assert set(now(replace(state, link=LinkState(LinkPhase.SILENT, detail="Silent.")))) == {"silent"}
    assert now(out_of_reach()) == {}


@pytest.mark.parametrize(
    ("reason", "text"),
    [(None, "The port of the dish is gone."), (Reason.BUSY, "Another program has the port of the dish.")],
)
def test_a_port_that_is_gone_or_taken(now, reason, text):
    state = StationState(port="/dev/ttyUSB0", dish=G2, link=LinkState(LinkPhase.LOST, detail="Why.", reason=reason))
    assert now(state)["port"].text == text


def test_a_fault_that_is_shown_counts_though_the_journal_lacks_it(judged):
    fault = Fault(FaultReason.STALL, "The elevation is stalled", "", "", NOW, "elevation", False, 100.0, 61.0)
    made = MadeHistory().ordinary()
    assert judged(made, answering(fault=fault)).findings[0].text == "EL stalled today, at 61°."
    made.rows = made.rows[:0]
    made.wear = []
    made.rows.append(MadeHistory().stall(0, "elevation", 100, 61).rows[0])
    made.rows[0] = replace(made.rows[0], utc=NOW)
    assert judged(made, answering(fault=fault)).findings[0].count == 1


def test_the_figures(judged):
    made = MadeHistory().ordinary().stall(3, "elevation", 100, 62).restart(5).gap(4, 3.0)
    made.incident(6, IncidentKind.LOST).incident(6, IncidentKind.BACK, 12.1)
    figures = judged(made).figures
    azimuth, elevation = figures.motors
    assert (azimuth.axis, azimuth.stalls, azimuth.driver.value, azimuth.driver_is_good) == ("azimuth", 0, "OK", True)
    assert (elevation.stalls, elevation.axis) == (1, "elevation")
    assert azimuth.turns == pytest.approx(120, rel=0.1)
    assert azimuth.turns_before == pytest.approx(120, rel=0.1)
    assert azimuth.turns_in_all == pytest.approx(azimuth.turns + azimuth.turns_before)
    assert azimuth.moves == pytest.approx(10 * azimuth.turns, rel=0.05)
    link = figures.link
    assert 30 * 900 < link.asked < 30 * 1900
    assert (link.restarts, link.silences, link.port_losses) == (1, 1, 1)
    assert link.last_restart.utc == made.at(5)
    assert (link.homed, link.search, link.lnb_supply.value) == (True, TvSearch.OFF, 13.1)
    assert link.round_trip_s == 0.009


def test_sums_are_those_of_the_days_they_are_shown_beside(judged):
    made = MadeHistory().ordinary()
    for hour in (8.0, 10.0):
        made.stall(30, "elevation", 100, 62, hour).incident(30, IncidentKind.LOST, hour).restart(30, hour)
    made.stall(29, "elevation", 100, 62, 1.0).incident(29, IncidentKind.LOST, 1.0).restart(29, 1.0)
    figures = judged(made).figures
    assert [len(figures.by_day), figures.motors[1].stalls, figures.link.port_losses, figures.link.restarts] == [
        30, 1, 1, 1,
    ]  # fmt: skip
    first = figures.by_day[0]
    assert (first.day, first.stalls, first.losses, first.restarts) == (made.at(29).date(), 1, 1, 1)


def test_the_dish_that_was_used_last_comes_first(tmp_path):
    path = tmp_path / "journal.sqlite"
    assert list_dishes(path) == []
    MadeHistory("old").replies(9, 10, 0).write(path)
    MadeHistory("new").turned(2, 0, 3.0).write(path)
    assert list_dishes(path) == ["new", "old"]


def test_what_is_read_for_it_is_what_the_dish_has():
    assert set(features_for_health(G2)) == {
        "lnb_supply", "polarisation", "sleep_timer", "tv_search", "driver.azimuth", "driver.elevation",
    }  # fmt: skip
    assert features_for_health(TRAVLER) == ()


def test_words():
    day = MadeHistory().at
    assert wording.how_often([day(0)], NOW) == "today"
    assert wording.how_often([day(1), day(1, 13)], NOW) == "twice yesterday"
    assert wording.how_often([day(40), day(6), day(0)], NOW) == "3 times since 18 October"
    assert wording.how_often([day(6)], NOW) == "on Saturday"
    assert wording.day(day(400), NOW) == "23 October 2025"
    assert wording.at_angles([62.2, 65.4, 62.0]) == "at 62° and 65°"
    assert wording.at_angles(range(0, 100, 10)) == "between 0° and 90°"
    assert wording.at_angles([350, 355, 359.7, 4, 8], turns=True) == "between 350° and 8°"
    assert wording.at_angles([358, 2], turns=True) == "at 358° and 2°"
    assert wording.at_angles([40, 71, 133, 205, 268, 310], turns=True) == "between 40° and 310°"
    assert wording.share(0, 41220) == "none of 41,220"


@pytest.mark.parametrize("subject", ["journal", "wear"])
def test_a_journal_that_is_not_being_kept_now(now, subject):
    found = now(answering(warnings={subject: "Faults are not being kept: the disk is full."}))["journal"]
    assert (found.weight, found.why) == (Weight.WARN, "Faults are not being kept: the disk is full.")
