"""`birdcage health`: what of the dish needs its owner, from its history and from the dish itself."""

from __future__ import annotations

from datetime import UTC, datetime, timedelta

import pytest
from birdcage.base.journal_rows import IncidentKind
from birdcage.base.paths import Paths

from tests.diagnostics import made_history
from tests.diagnostics.made_history import G2, MadeHistory

from .test_words_printed import wrong_in


@pytest.fixture
def made(monkeypatch):
    """An empty history whose days count back from now."""
    monkeypatch.setattr(made_history, "NOW", datetime.now(UTC) - timedelta(minutes=1))
    return MadeHistory()


def branch(made):
    for days_ago in (12, 9, 4, 2):
        made.stall(days_ago, "azimuth", 118.0, 30.0)
    return made


def test_the_worst_comes_first_with_what_to_do_and_the_status_says_that_something_is_wrong(run, made):
    branch(made.ordinary()).limit(3, "floor", "10.0").write(Paths.default().journal)
    said = run("health", "--quick")
    assert said.exit_code == 1
    lines = said.stdout.splitlines()
    assert lines[0].startswith("✗ AZ stalled 4 times since ")
    assert lines[0].endswith("each time at 118°. Something probably stands in its way there.")
    assert lines[2].startswith("  → Cut its power, and look at what the dish meets at azimuth 118°, elevation 30°")
    assert "! Lowest elevation (NVS 101) changed " in said.stdout
    assert "18.00° before, 10.00° now." in said.stdout
    assert lines.index("link and power, 30 days") > lines.index(
        "motors, 30 days; turns before: in the 30 days before them"
    )
    assert next(line for line in lines if line.startswith("azimuth ")).split()[1] == "4"
    assert "2 findings need attention." in said.stderr


def test_what_was_acknowledged_is_gone_until_it_happens_again(run, made, as_json):
    journal = Paths.default().journal
    branch(made.ordinary()).write(journal)
    said = run("health", "--quick", "--acknowledge", "stall.azimuth")
    assert said.exit_code == 0
    assert "Acknowledged until it happens again: AZ stalled 4 times" in said.stderr
    quiet = run("health", "--quick")
    assert (quiet.exit_code, quiet.stdout.splitlines()[0]) == (0, "✓ Nothing needs attention.")
    MadeHistory().stall(0, "azimuth", 118.0, 30.0, hour=0.0).write(journal)
    again = as_json(run("health", "--quick", "--json"))
    assert [(each["id"], each["count"]) for each in again["findings"]] == [("stall.azimuth", 5)]


@pytest.mark.parametrize("name", ["stall.elevation", "nosuch"])
def test_a_finding_that_is_not_there_is_named_and_nothing_is_acknowledged(run, made, name):
    branch(made.ordinary()).write(Paths.default().journal)
    said = run("health", "--quick", "--acknowledge", "stall.azimuth", "--acknowledge", name)
    assert said.exit_code == 2
    assert f"No finding is called {name}. There is: stall.azimuth." in said.stderr
    assert run("health", "--quick").exit_code == 1


def test_the_dish_itself_is_asked_and_nothing_is_moved(run, as_json, pty_dish):
    said = run("health", "--json", port=pty_dish.path)
    told = as_json(said)
    assert told["dish"] == f"{G2.name}"
    assert told["link"]["homed"] is True
    assert [each["driver"] for each in told["motors"]] == ["OK", "OK"]
    assert {"sleep"} <= {each["id"] for each in told["findings"]}
    assert said.exit_code == 0
    lines = [line for _at, line in pty_dish.device.shell.received]
    assert "diag" in lines
    assert not [line for line in lines if line.startswith(("a ", "g ", "h ", "e "))]


def test_a_program_that_has_the_port_is_asked(run, as_json, owner, pty_dish):
    told = as_json(run("health", "--json", port=pty_dish.path))
    assert told["link"]["homed"] is True
    assert [each["driver"] for each in told["motors"]] == ["OK", "OK"]


@pytest.mark.parametrize("pty_dish", ["seed=1&unhomed=1"], indirect=True)
def test_a_dish_that_is_not_homed_says_so_and_that_cannot_be_acknowledged(run, pty_dish):
    said = run("health", port=pty_dish.path)
    assert said.exit_code == 1
    assert said.stdout.splitlines()[0] == "✗ The dish is not homed: it does not know where it points."
    refused = run("health", "--acknowledge", "homed", port=pty_dish.path)
    assert refused.exit_code == 2
    assert "it goes with its cause" in refused.stderr


def test_a_port_that_is_gone_leaves_the_history(run, made):
    branch(made.ordinary()).write(Paths.default().journal)
    said = run("health", port="/dev/no-such-port")
    assert said.exit_code == 1
    assert [line for line in said.stdout.splitlines() if line[:1] in ("✗", "!", "·")][
        1
    ] == "✗ The port of the dish is gone."


def test_a_named_dish_out_of_reach_has_its_own_history_and_not_that_of_the_demo(run, as_json, made):
    journal = Paths.default().journal
    demo = MadeHistory(dish=f"{G2.name} (demo)").ordinary()
    branch(demo).write(journal)
    said = run("health", port="/dev/no-such-port")
    assert "stalled" not in said.stdout
    assert (
        f"Looked at 30 days of the {G2.name}. Counted 0 moves, 0 stalls, 0 restarts, lost replies: --." in said.stdout
    )
    assert as_json(run("health", "--quick", "--json"))["dish"] == G2.name


def test_a_dish_that_is_not_named_is_a_real_one_if_there_is_any(run, as_json, made):
    journal = Paths.default().journal
    MadeHistory(dish=f"{G2.name} (demo)").ordinary().write(journal)
    unnamed = {"BIRDCAGE_PORT": "", "BIRDCAGE_FIRMWARE": ""}
    told = as_json(run("health", "--quick", "--json", env=unnamed))
    assert told["dish"] == f"{G2.name} (demo)"
    made.replies(40, 100, 0).write(journal)
    assert as_json(run("health", "--quick", "--json", env=unnamed))["dish"] == G2.name


def test_what_is_only_so_is_acknowledged_for_some_days(run, made):
    for days_ago in range(3):
        made.replies(days_ago, 500, 20)
    made.write(Paths.default().journal)
    said = run("health", "--quick", "--acknowledge", "replies")
    assert "Acknowledged for 30 days, or until it gets worse: Replies get lost" in said.stderr


def test_a_journal_that_cannot_be_read_is_told(run):
    journal = Paths.default().journal
    journal.parent.mkdir(parents=True, exist_ok=True)
    journal.write_text("no database, but a text of some length: more than a header has")
    said = run("health", "--quick")
    assert said.exit_code == 1
    assert said.stdout.startswith("! The dish's history is not available, so this is only its present state.")
    assert "is damaged" in said.stdout


def test_its_sentences_are_plain(run, made):
    branch(made.ordinary()).limit(3, "floor", "10.0")
    for days_ago in (20, 9, 2):
        made.restart(days_ago, moving=True).gap(days_ago, 3).deadlock(days_ago, 15)
        made.incident(days_ago, IncidentKind.LOST, 18).incident(days_ago, IncidentKind.BACK, 18.1)
        made.incident(0, IncidentKind.SAVED, 8).fault(days_ago, "moved").fault(days_ago, "speed")
        made.fault(days_ago, "stall", axis="elevation", homing=True).stall(days_ago, "elevation", 100, 20 + days_ago)
        made.replies(days_ago, 1000, 300, 4000)
    made.write(Paths.default().journal)
    said = run("health", "--quick")
    assert len([line for line in said.stdout.splitlines() if line[:1] in ("✗", "!", "·")]) >= 10
    assert wrong_in(said.stdout, "health") == []
