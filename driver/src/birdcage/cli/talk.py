"""The setup in plain lines: says a step, takes an answer, and looks at the dish meanwhile."""

from __future__ import annotations

import queue
import shutil
import textwrap
import threading
from typing import TYPE_CHECKING, TextIO

from birdcage.base.errors import BirdcageError
from birdcage.cli.dish import DishSession
from birdcage.cli.say import say
from birdcage.setup.step import Mark
from birdcage.station.state import LinkPhase

if TYPE_CHECKING:
    from birdcage.setup.engine import Setup
    from birdcage.setup.step import Choice, Field, StepView

KEYS = "s skip   b back   l list   q leave (all that is done is kept)   Ctrl+C stops the dish"
OPEN_S = 5.0
"""How long a port may take to open before the questions begin."""
HANG = 29
"""The column of the evidence in the line of a step."""
CLEARED = "-"
"""What is typed to empty a field that has a value."""


class TypedLines:
    """Lines that a person types, read on a thread of their own: waiting for one never keeps STOP waiting."""

    def __init__(self, stream: TextIO) -> None:
        self._stream = stream
        self._lines: queue.SimpleQueue[str | None] = queue.SimpleQueue()
        threading.Thread(target=self._read, name="answers", daemon=True).start()

    def _read(self) -> None:
        for line in iter(self._stream.readline, ""):
            self._lines.put(line.strip())
        self._lines.put(None)

    def next(self) -> str | None:
        """Return a line that was typed; None at the end of the input. queue.Empty while there is none."""
        return self._lines.get_nowait()


class PersonLeft(Exception):
    """The person has left the setup."""


class Conversation:
    """One conversation."""

    def __init__(self, setup: Setup, dish: DishSession, answers: TypedLines) -> None:
        self._setup, self._dish, self._answers = setup, dish, answers
        self._said: object = None
        self._marks = {view.name: view.mark for view in setup.steps()}

    def run(self) -> bool:
        """Talk until the person leaves; return whether every step is done, skipped or for later."""
        _tell(KEYS)
        self._wait_for_the_port()
        try:
            while not self._setup.begin_anew:
                self._turn()
            return False
        except PersonLeft:
            return self._setup.finished

    def _wait_for_the_port(self) -> None:
        """Give the port a moment, so that the first thing said is how it is."""
        until = self._dish.now + OPEN_S
        while self._dish.state.link.state is LinkPhase.OPENING and self._dish.now < until:
            self._dish.progress.show(f"… {self._dish.state.link.detail}")
            self._look()
        self._dish.progress.clear()

    def _turn(self) -> None:
        while self._setup.busy:
            self._dish.progress.show(f"… {self._setup.busy}")
            self._look()
        self._look()
        view = self._setup.step(self._setup.current)
        if self._shape(view) != self._said:
            self._said = self._shape(view)
            _say_step(view)
            if self._setup.finished:
                self._say_end()
        answer = self._line(f"{view.number} {view.title}> ", watch=True)
        if answer is not None:
            self._said = None
            self._answer(view, answer)

    def _say_end(self) -> None:
        """Sum up, when nothing is open: what was left out is named."""
        skipped = [each.title for each in self._setup.steps() if each.mark is Mark.SKIPPED]
        left = f", but for {', '.join(skipped)} (skipped)" if skipped else ""
        _tell(f"The setup is complete{left}: q leaves, l lists all of it.", 3)
        model = self._dish.state.dish
        if model is not None and model.homing_s is None:
            _tell("After each power-up wait until it has homed: `birdcage init` does, and ends its TV search.", 3)
        else:
            _tell("After each power-up home the dish: `birdcage home`, or H in the app.", 3)

    @staticmethod
    def _shape(view: StepView) -> object:
        """Return what makes a step worth saying again."""
        return view.name, view.mark, tuple((each.name, each.label) for each in view.choices)

    def _look(self) -> None:
        """Look at the dish and at the steps; say which of them have come to an end."""
        self._dish.look()
        self._setup.tick()
        for view in self._setup.steps():
            before, self._marks[view.name] = self._marks.get(view.name), view.mark
            if before is not view.mark and view.mark in (Mark.DONE, Mark.FAILED):
                self._dish.progress.clear()
                _tell(f"{view.number} {view.title}: {view.mark.value}. {view.evidence}".rstrip())

    def _line(self, prompt: str, *, watch: bool = False) -> str | None:
        """Return what is typed; None when the step has changed meanwhile and `watch` is set."""
        say(prompt)
        while True:
            try:
                line = self._answers.next()
            except queue.Empty:
                self._look()
                if watch and self._shape(self._setup.step(self._setup.current)) != self._said:
                    return None
                continue
            if line is None:
                raise PersonLeft
            return line

    def _answer(self, view: StepView, answer: str) -> None:
        word = answer.lower()
        try:
            match word:
                case "q":
                    raise PersonLeft
                case "s":
                    self._setup.skip(view.name)
                case "b":
                    self._setup.back()
                case "l":
                    for line in list_lines(self._setup):
                        _tell(line, hang=HANG)
                case _:
                    self._choose(view, word or "enter")
        except BirdcageError as error:
            _tell(str(error))

    def _choose(self, view: StepView, key: str) -> None:
        choice = next((each for each in view.choices if key in (each.key, each.name)), None)
        if choice is None:
            keys = ", ".join(_key(each) for each in view.choices)
            _tell(f"Unknown answer. Type {keys}." if keys else "Nothing to answer yet. Wait.")
            self._said = self._shape(view)  # what can be answered stands just above
            return
        if choice.moves and not self._setup.area_clear and not self._cleared():
            say("Nothing was moved.")
            return
        values = {field.name: self._type(field) for field in choice.fields}
        self._setup.choose(view.name, choice.name, values)

    def _cleared(self) -> bool:
        from birdcage.setup.engine import clear_question

        _tell(clear_question(self._dish.state.dish))
        if (self._line("yes or no> ") or "").lower() not in ("y", "yes"):
            return False
        self._setup.clear()
        return True

    def _type(self, field: Field) -> str:
        about = ", ".join(part for part in (field.unit, field.hint) if part)
        shown = f" [{field.value}; {CLEARED} for none]" if field.value else ""
        typed = self._line(f"  {field.label}{f' ({about})' if about else ''}{shown}> ") or ""
        return "" if typed == CLEARED else typed or field.value


def list_lines(setup: Setup) -> list[str]:
    """Return the steps and how they are, one line each."""
    return [_line_of(view) for view in setup.steps()]


def _line_of(view: StepView) -> str:
    return f"{view.number:2} {view.title:16} {view.mark.value:8} {view.evidence}".rstrip()


def _say_step(view: StepView) -> None:
    say("")
    _tell(_line_of(view), hang=HANG)
    for words in view.words:
        _tell(words, 3)
    for choice in view.choices:
        _tell(f"{_key(choice):6} {choice.label}{' (moves the dish)' if choice.moves else ''}", 3, hang=10)


def _tell(text: str, indent: int = 0, *, hang: int | None = None) -> None:
    """Say a sentence, wrapped where the terminal ends; further lines begin at column `hang`."""
    width = max(shutil.get_terminal_size().columns - 1, 40)
    first = " " * indent
    rest = first if hang is None else " " * hang
    for line in textwrap.wrap(
        text, width, initial_indent=first, subsequent_indent=rest, break_long_words=False, break_on_hyphens=False
    ):
        say(line)


def _key(choice: Choice) -> str:
    return "Enter" if choice.key == "enter" else choice.key
