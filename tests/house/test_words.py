"""The worst habits of our sentences, counted over all that a person reads: app, command line, README and docs.

How many are left stands below for each package. The number may only fall: whoever mends some lowers it.
"""

from __future__ import annotations

import re
from functools import cache

import pytest

from tests.house.sentences import HOLE, Sentence, of_markdown, of_package, of_source

MOST_WORDS = 25
"""Of one sentence on a screen."""

LEFT = {"driver": 0, "tui": 0, "docs": 0}


@cache
def read(package: str) -> list[Sentence]:
    """Return all sentences of a package, or of the docs."""
    return of_markdown() if package == "docs" else of_package(f"{package}/src")


DOUBLED = re.compile(
    r"(?<![.\w])\.\.(?!\.|/|\w)|(?<=\w)\.\.(?![./\w])|,\.|:\.|;\.|,,|;;|\?\.|!\.|\.,(?!\d)|\.:(?!\w)|\.;"
)
FORBIDDEN = re.compile(r"\b(nobody|such as|that which|by now|so that it|as far as is known)\b", re.IGNORECASE)

ONE_TERM = {
    r"\bplaces? that counts?\b": "active place",
    r"\bpresent step\b": "current step",
    r"\bknocks?\b": "run into",
    r"\bmute\b": "silent",
    r"\bin need\b": "in an emergency",
    r"\bauto[- ]track": "autotrack",
    r"\bTV[- ]finder\b": "TV search",
    r"\bcatalogs?\b": "catalogue",
    r"\bfavorite": "favourite",
    r"\bcent(?:er)\b": "centre",
    r"\bto mend\b": "to fix",
    r"\bspacecraft\b": "satellite",
    r"\bend of following\b": "ends",
    r"\bone in ten\b": "90 %",
}
"""What one would also say, and the term that is ours: one word for one thing."""


def habits(sentence: Sentence, *, on_screen: bool = True) -> list[str]:
    """Return what is wrong with a sentence."""
    text = sentence.text
    found = [f"doubled punctuation {match.group()!r}" for match in DOUBLED.finditer(text)]
    found += [f"says {match.group()!r}" for match in FORBIDDEN.finditer(text)]
    found += [f"{term} is our term" for pattern, term in ONE_TERM.items() if re.search(pattern, text, re.IGNORECASE)]
    if on_screen and sentence.words > MOST_WORDS:
        found.append(f"{sentence.words} words")
    return found


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
