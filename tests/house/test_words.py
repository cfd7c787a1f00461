"""The worst habits of our sentences, counted over all that a person reads: app, command line, README and docs.

How many are left stands below for each package. The number may only fall: whoever mends some lowers it.
"""

from __future__ import annotations

from functools import cache

import pytest

from tests.house.habits import habits
from tests.house.sentences import HOLE, Sentence, of_markdown, of_package, of_source

LEFT = {"driver": 0, "tui": 0, "docs": 0}


@cache
def read(package: str) -> list[Sentence]:
    """Return all sentences of a package, or of the docs."""
    return of_markdown() if package == "docs" else of_package(f"{package}/src")


@pytest.mark.parametrize("package", LEFT)
def test_the_worst_habits_only_get_fewer(package: str) -> None:
    offenders = [
        f"{sentence.where}: {', '.join(wrong)}: {sentence.text}"
        for sentence in read(package)
        if (wrong := habits(sentence, on_screen=package != "docs"))
    ]
    assert len(offenders) <= LEFT[package], "\n".join([f"{len(offenders)} in {package}", *offenders])


@pytest.mark.parametrize(("package", "known"), [
    ("driver", "No place is set"), ("driver", "Print the plan and nothing else."),
    ("tui", "TV search off until power-up"), ("docs", "used Winegard satellite dish"),
])  # fmt: skip
def test_it_reads_what_people_read(package: str, known: str) -> None:
    assert any(known in sentence.text for sentence in read(package))


@pytest.mark.parametrize(("source", "text", "wrong"), [
    ('say(f"It stopped at {here}..")', f"It stopped at {HOLE}..", True),
    ('say("Reading …")', "Reading …", False),
    ('say("Nobody moves it.")', "Nobody moves it.", True),
    ('say("word " * 3)', "word", False),
    ('x = "' + "a " * 26 + '."', "a " * 26 + ".", True),
    ('x = "' + "a " * 25 + '"', ("a " * 25).strip(), False),
    ('say("It knocks at its stops.")', "It knocks at its stops.", True),
])  # fmt: skip
def test_the_habits_are_seen(source: str, text: str, wrong: bool) -> None:
    sentences = of_source(source, "x.py")
    assert [each.text for each in sentences] == [text]
    assert bool(habits(sentences[0])) is wrong


@pytest.mark.parametrize("source", [
    're.compile("nobody is here")', '_log.info("nobody is here")', 'def f():\n    """Nobody is here."""',
    'x = {"nobody is here": 1}', 'db.execute("SELECT nobody FROM here")',
])  # fmt: skip
def test_what_is_not_shown_is_not_read(source: str) -> None:
    assert of_source(source, "x.py") == []


def test_the_help_of_a_command_is_read() -> None:
    source = '@main.command()\ndef stop():\n    """Stop it.\n\n    Nobody moves it then.\n    """'
    assert [each.text for each in of_source(source, "x.py")] == ["Stop it.", "Nobody moves it then."]
