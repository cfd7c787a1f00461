"""The commands that ask, follow, and go by themselves, on a dish that shares no code with our simulator."""

from __future__ import annotations

import pytest

from .verdicts import SHOWN, Verdict

HABITS = (
    pytest.param({"colour": True, "pieces": True}, marks=pytest.mark.soak),
    {"second_same": "block", "second_other": "block", "jitter_s": 0.1, "homed": False, "unhomed_as": "hundredths"},
)


def _elements() -> str:
    lines = (
        "1 25544U 98067A   26079.50000000  .00010000  00000+0  18000-3 0  999",
        "2 25544  51.6400 200.0000 0005000  90.0000 270.0000 15.5000000012345",
    )
    sums = [sum(int(c) if c.isdigit() else c == "-" for c in line) % 10 for line in lines]
    return "".join(["ISS\n", *(f"{line}{digit}\n" for line, digit in zip(lines, sums, strict=True))])


def _run(hand, *words: str, answers: tuple[str, ...] = (), codes: tuple[int, ...] = (0,), interrupted: bool = False):
    hand.answers = list(answers)
    verdict = Verdict(hand)
    said = hand.run(*words, interrupted=interrupted)
    assert verdict.of(said) == [], SHOWN.sub("", said.text)
    assert said.code in codes, SHOWN.sub("", said.text)
    return said


@pytest.mark.parametrize("habits", HABITS, ids=str)
def test_setup_calibration_and_following(terminal, tmp_path, habits):
    hand = terminal(**habits)
    tle = tmp_path / "iss.tle"
    tle.write_text(_elements())
    _run(hand, "setup", answers=(*("",) * 3, "yes", *("",) * 10, "l", "q"))
    _run(hand, "place", "add", "Home", "51.9 4.8", "--use")
    _run(hand, "home", "--yes")
    _run(hand, "calibrate", "guide", answers=("", "n", "+", "l", "q"))
    _run(hand, "calibrate", "next")
    _run(hand, "track", "moon", "--engage", "--until", "2026-03-20T12:05:00")
    _run(hand, "elements", "add", str(tle))
    _run(hand, "elements", "favourite", "ISS", "--priority", "1")
    hand.wait(16.95 * 3600.0)  # a pass comes soon
    _run(hand, "autotrack", "--engage", codes=(130,), interrupted=True)
    hand.wait(60.0)
    assert not hand.dish.moves()
    _run(hand, "release")
    _run(hand, "log")
