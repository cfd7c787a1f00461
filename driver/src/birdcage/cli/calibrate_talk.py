"""The guided calibration in plain lines: says where the dish is, takes an answer, and looks at the dish meanwhile."""

from __future__ import annotations

import queue
from typing import TYPE_CHECKING

from birdcage.base.errors import BirdcageError
from birdcage.cli.calibrate_words import ENOUGH
from birdcage.cli.say import say

if TYPE_CHECKING:
    from birdcage.base.paths import Paths
    from birdcage.calibration.guide import Guide
    from birdcage.cli.dish import DishSession
    from birdcage.cli.talk import TypedLines
    from birdcage.sky.targets.model import Target

KEYS = (
    "n [NUMBER]  go to the best object, or to one of the list",
    "g TARGET    go to another one; g alone: follow its motion",
    "u d l r     nudge up, down, left, right; with a number: by so many degrees from now on",
    "Enter       peaked here: save it",
    "f           show the fit and its residuals",
    "x NUMBER    delete a peak",
    "a NAME      save the fit as NAME and use it for all pointing",
    "?           these lines      q  leave (all peaks are saved)      Ctrl+C  stop the dish",
)
STEPS = {"u": (0.0, 1.0), "d": (0.0, -1.0), "l": (-1.0, 0.0), "r": (1.0, 0.0)}
FIRST_STEP_DEG = 0.5
LARGEST_STEP_DEG = 10.0
SHOWN = 5


class CalibrationLeft(Exception):
    """The person has left."""


class CalibrateTalk:
    """One conversation."""

    def __init__(self, guide: Guide, dish: DishSession, answers: TypedLines, paths: Paths) -> None:
        self._guide, self._dish, self._answers, self._paths = guide, dish, answers, paths
        self._step_deg = FIRST_STEP_DEG
        self._failure = ""

    def run(self) -> None:
        """Talk until the person leaves."""
        for line in KEYS:
            say(line)
        for problem in self._guide.problems:
            say(problem)
        self._propose()
        try:
            while True:
                self._turn()
        except CalibrationLeft:
            return

    def _turn(self) -> None:
        while self._guide.view().busy:
            self._look()
            self._dish.progress.show(f"… {self._guide.view().busy}")
        self._dish.progress.clear()
        view = self._guide.view()
        if view.failure and view.failure != self._failure:
            say(view.failure)
        self._failure = view.failure
        try:
            self._answer(self._line())
        except (BirdcageError, ValueError) as error:
            say(str(error))

    def _look(self) -> None:
        self._dish.look()
        self._guide.tick()

    def _line(self) -> str:
        say(self._where())
        while True:
            try:
                line = self._answers.next()
            except queue.Empty:
                self._look()
                continue
            if line is None:
                raise CalibrationLeft
            return line

    def _where(self) -> str:
        view = self._guide.view()
        if not view.target:
            return "calibrate>"
        seat = "the dish has not told where it is" if view.position is None else (
            f"dish {view.position.dish_az_deg:.2f}° / {view.position.dish_el_deg:.2f}°"
        )  # fmt: skip
        nudged = "" if view.nudged is None else (
            f", {round(view.nudged[0], 2) + 0.0:+.2f}° right, {round(view.nudged[1], 2) + 0.0:+.2f}° up of expected"
        )  # fmt: skip
        return f"{view.target}: {seat}{nudged}>"

    def _answer(self, line: str) -> None:
        word, _, rest = line.partition(" ")
        rest = rest.strip()
        match word.lower():
            case "":
                self._take()
            case "q":
                raise CalibrationLeft
            case "?":
                for each in KEYS:
                    say(each)
            case "n":
                self._next(rest)
            case "g":
                self._guide.go(self._target(rest) if rest else None)
            case "u" | "d" | "l" | "r":
                self._nudge(word.lower(), rest)
            case "f":
                self._show_fit()
            case "x":
                self._guide.remove(_whole(rest))
                say(f"Forgotten; {len(self._guide.peaks)} left.")
                self._propose()
            case "a":
                kept = self._guide.apply(rest)
                say(f"Saved and in use: {kept.name}.")
            case _:
                say("Unknown answer. Type ? for the list.")

    def _take(self) -> None:
        peak = self._guide.take()
        fit = self._guide.fit
        assert fit is not None, "a peak was taken just now"
        alone = "" if fit.leave_one_out_rms_deg is None else f", leaving each out {fit.leave_one_out_rms_deg:.2f}°"
        say(f"Peak {peak.number} is kept: {peak.target}. {len(fit.residuals)} in all, RMS {fit.rms_deg:.2f}°{alone}.")
        if fit.warning:
            say(fit.warning)
        self._propose()

    def _propose(self) -> None:
        from birdcage.calibration.next_best import enough

        found = self._guide.refresh()
        if not found:
            say("This feed can hear nothing else that is in reach now. g TARGET goes to what you name.")
        elif enough(found):
            say(ENOUGH)
        for number, each in enumerate(found[:SHOWN], 1):
            say(f"{number}  {each.candidate.name} {each.words()}")

    def _next(self, typed: str) -> None:
        found = self._guide.refresh()
        number = _whole(typed) if typed else 1
        if not 1 <= number <= len(found):
            raise ValueError(f"There are {len(found)} objects in the list.")
        self._guide.go(found[number - 1].candidate)

    def _target(self, text: str) -> Target:
        from birdcage.cli.named_target import resolver_of

        found = resolver_of(self._paths, None, say).resolve(text)
        if found.note:
            say(found.note)
        return found.target

    def _nudge(self, way: str, typed: str) -> None:
        if typed:
            step_deg = float(typed)
            if not 0.0 < step_deg <= LARGEST_STEP_DEG:
                raise ValueError(f"A nudge is more than 0 and at most {LARGEST_STEP_DEG:g} degrees.")
            self._step_deg = step_deg
        right, up = STEPS[way]
        self._guide.nudge(right * self._step_deg, up * self._step_deg)

    def _show_fit(self) -> None:
        from birdcage.cli.calibrate_words import tell_fit

        view = self._guide.view()
        if view.fit is None or view.sky_error_deg is None:
            say("No peaks yet.")
        else:
            tell_fit(view.fit, view.sky_error_deg)


def _whole(text: str) -> int:
    if not text.isdigit():
        raise ValueError(f"{text!r} is not a number of the list.")
    return int(text)
