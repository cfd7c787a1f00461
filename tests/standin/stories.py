"""What a person types in an evening, and every complaint about it."""

from __future__ import annotations

from .typed import Terminal
from .verdicts import Verdict

REST_S = 40.0
EVENING: tuple[tuple[str, ...] | float, ...] = (
    ("detect", "--json"),
    ("pos", "--json"),
    ("status",),
    ("init",),
    ("home", "--yes"),
    ("move", "--az", "0", "--el", "30"),
    ("pos", "--json"),
    ("move", "--az", "200", "--el", "60", "^C"),
    ("stop",),
    ("release",),
    ("move", "--az", "90", "--el", "20", "--no-wait"),
    ("stop",),
    ("release",),
    90.0,
    ("pos", "--json"),
    ("move", "--az", "90", "--el", "90"),
    ("move", "--az", "91.3", "--el", "44"),
    ("stop",),
)
"""Commands, and seconds in which nothing is done; `^C`: Ctrl+C soon after the dish has begun to move."""
FOLLOWING = (
    ("home", "--yes"),
    ("track", "az 170 el 40", "--lat", "52", "--lon", "4", "--engage", "^C"),
    ("calibrate", "next"),
    ("setup", "--list"),
    ("log",),
    ("status", "--json"),
)


def tell(terminal: Terminal, story=EVENING, *, strict: bool = True) -> list[str]:
    """Live through a story; return all complaints, each with the command that it is about."""
    wrong = []
    for words in story:
        if isinstance(words, float):
            terminal.wait(words)
            continue
        verdict = Verdict(terminal, strict=strict)
        stops = words[-1] == "^C"
        said = terminal.run(*(words[:-1] if stops else words), interrupted=stops)
        found = verdict.of(said)
        if terminal.dish.moves():
            terminal.wait(REST_S)
        found += verdict.afterwards(said)
        wrong += [f"{' '.join(words)} (exit {said.code}): {each}" for each in found]
    return wrong
