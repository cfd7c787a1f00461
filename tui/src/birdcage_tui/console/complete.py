"""Completes a command from the lists of the dish's own menus."""

from __future__ import annotations

from collections.abc import Sequence

from birdcage.station.raw import MenuCommand


def matching(text: str, commands: Sequence[MenuCommand]) -> tuple[MenuCommand, ...]:
    """Return the commands that begin with the only word of `text`; none when it has more than one."""
    word = text.strip().lower()
    if text.lstrip() != text.strip() or " " in word:
        return ()
    return tuple(command for command in commands if command.name.lower().startswith(word))


def named(text: str, commands: Sequence[MenuCommand]) -> MenuCommand | None:
    """Return the command that the first word of `text` names."""
    word = text.strip().lower().partition(" ")[0]
    return next((command for command in commands if word and command.name.lower() == word), None)


def common(names: Sequence[str]) -> str:
    """Return what all names begin with."""
    if not names:
        return ""
    low, high = min(names), max(names)
    same = next((index for index, letter in enumerate(low) if index >= len(high) or high[index] != letter), len(low))
    return low[:same]


class Completion:
    """What Tab does: the common beginning first, then one match after the other."""

    def __init__(self) -> None:
        self._cycle: tuple[MenuCommand, ...] = ()
        self._next = 0
        self._gave = ""

    def press(self, text: str, commands: Sequence[MenuCommand]) -> str:
        """Return the text after one more Tab."""
        if not (self._cycle and text == self._gave):
            self._cycle, self._next = matching(text, commands), 0
            start = common([command.name for command in self._cycle])
            if len(self._cycle) > 1 and len(start) > len(text.strip()):
                self._cycle = ()  # the next Tab begins the round
                return start
        if not self._cycle:
            return text
        command = self._cycle[self._next % len(self._cycle)]
        self._next += 1
        alone = len(self._cycle) == 1 and command.usage.strip() != command.name
        self._gave = f"{command.name} " if alone else command.name
        return self._gave
