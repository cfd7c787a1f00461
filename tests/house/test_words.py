"""The worst habits of our sentences, counted over all that a person reads: app, command line, README and docs.

How many are left stands below for each package. The number may only fall: whoever mends some lowers it.
"""

from __future__ import annotations

import re
from functools import cache

import pytest

from tests.house.habits import FORBIDDEN, habits
from tests.house.sentences import HOLE, ROOT, Sentence, notes_of, of_markdown, of_package, of_source

LEFT = {"driver": 0, "tui": 0, "docs": 0}

CHAIN = re.compile(r"\bNone (where|when|if|unless)\b[^.;]*[;,] (or )?else\b")
"""A riddle in place of a list of the cases."""


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


@pytest.mark.parametrize("folder", ["driver/src", "tui/src", "tests", "scripts"])
def test_docstrings_and_comments_say_it_plainly(folder: str) -> None:
    offenders = [
        f"{sentence.where}: {sentence.text}"
        for path in sorted((ROOT / folder).rglob("*.py"))
        if ROOT / "tests/house" not in path.parents  # names what it looks for
        for sentence in notes_of(path.read_text(encoding="utf-8"), path.relative_to(ROOT).as_posix())
        if FORBIDDEN.search(sentence.text) or CHAIN.search(sentence.text)
    ]
    assert not offenders, "\n".join(offenders)


@pytest.mark.parametrize("source", [
    '"""Nobody is here."""', "def f():\n    # It waits, so that\n    # it may end.\n    return 1",
    "x = 1  # good by now", '"""It is seen by\n    now."""',
    'class A:\n    x: int\n    """None where it is unknown; else 1."""',
])  # fmt: skip
def test_what_a_reader_of_the_code_stumbles_over_is_seen(source: str) -> None:
    assert any(FORBIDDEN.search(each.text) or CHAIN.search(each.text) for each in notes_of(source, "x.py"))
