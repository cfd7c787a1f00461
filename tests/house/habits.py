"""The worst habits of sentences: in the source, on the screen and on paper."""

from __future__ import annotations

import re

from tests.house.sentences import Sentence

MOST_WORDS = 25
"""Of one sentence on a screen."""

DOUBLED = re.compile(
    r"(?<![.\w])\.\.(?!\.|/|\w)|(?<=\w)\.\.(?![./\w])|,\.|:\.|;\.|,,|;;|\?\.|!\.|\.,(?!\d)|\.:(?!\w)|\.;"
)
FORBIDDEN = re.compile(r"\b(nobody|such as|that which|by now|so that it|as far as is known)\b", re.IGNORECASE)

ONE_TERM = {
    r"\bplaces? that counts?\b": "active place",
    r"\bpresent (?:step|object)\b": "current step, current object",
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

JOINED = re.compile(r"[.,:;] [.,:;](?!\w)|[.:;,] ?[.:;,](?= |$)(?<!\.\.)|\w +[.,;](?= |$)")
"""Marks that meet where two texts were put together."""

OF_THE_PROGRAM = re.compile(
    r"\b(?:None|nan|inf)\b|[{}]|\w+(?:Error|Exception)\b|<\w+ object|datetime\.|\bTrue\b|\bFalse\b"
)
"""What only the program's author should ever see."""

JSON = re.compile(r'\{".*?\}')


def habits(sentence: Sentence, *, on_screen: bool = True) -> list[str]:
    """Return what is wrong with a sentence."""
    text = sentence.text
    found = [f"doubled punctuation {match.group()!r}" for match in DOUBLED.finditer(text)]
    found += [f"says {match.group()!r}" for match in FORBIDDEN.finditer(text)]
    found += [f"{term} is our term" for pattern, term in ONE_TERM.items() if re.search(pattern, text, re.IGNORECASE)]
    if on_screen and sentence.words > MOST_WORDS:
        found.append(f"{sentence.words} words")
    return found


def habits_filled_in(sentence: Sentence) -> list[str]:
    """Return what is wrong with a sentence whose values are filled in."""
    text = JSON.sub("…", sentence.text)
    found = [f"joined badly {match.group()!r}" for match in JOINED.finditer(text)]
    found += [f"shows {match.group()!r}" for match in OF_THE_PROGRAM.finditer(text)]
    return [*habits(sentence), *found]
