"""Lines into commands: whole tokens only, so that no letter is run out of garbage (docs/reference/rotctld.md)."""

from __future__ import annotations

import re
from collections import deque
from collections.abc import Iterator
from dataclasses import dataclass, field
from string import punctuation

from birdcage.base.text import clean
from birdcage.rotctld.arguments import ArgumentShape, pair
from birdcage.rotctld.client_context import ClientContext
from birdcage.rotctld.command_row import CommandRow
from birdcage.rotctld.rprt import Rprt
from birdcage.rotctld.table import BARE, BY_LETTER, BY_LETTER_ALONE, BY_NAME, BY_WORD

SEPARATORS = frozenset(punctuation) - frozenset("\\_#")
"""What may open an extended command: Hamlib takes any punctuation but these three."""
_TEXT = re.compile(r"[ -~\t\v\f]*")
_TOKEN = re.compile(r"[^ \t\v\f]+")
_JOINED = re.compile(r"[+;|,]?[pSKs_](?:[+;|,][pSKs_])+")
"""Commands without arguments, parted by what makes the next one extended: `p;p`."""
_GLUED = re.compile(r"([PM])([-+.,\d].*)")
"""A letter and its first number: `P10`."""
_LISTED = "?"
"""In place of a name it asks for all names: `V ?`."""


@dataclass(slots=True)
class ParsedCommand:
    """One command as it was sent. With a `fault` it must not be done: that is its reply."""

    row: CommandRow | None
    separator: str | None = None
    """What ends the records of an extended reply; None where the default form was asked for."""
    typed: list[str] = field(default_factory=list)
    arguments: list[str] = field(default_factory=list)
    """As typed, but `10.5,20.5` is two."""
    fault: Rprt | None = None

    @property
    def header(self) -> str:
        """What opens an extended reply: the long name, and the arguments as typed. Empty for an unknown command."""
        return clean(" ".join([f"{self.row.long}:", *self.typed])) if self.row else ""


class CommandParser:
    """Reads the commands of one client. Arguments that are missing at the end of a line may stand on the next."""

    def __init__(self, context: ClientContext) -> None:
        self._context = context
        self._begun: tuple[ParsedCommand, CommandRow] | None = None

    def read(self, line: str) -> Iterator[ParsedCommand]:
        """Yield the commands of a line, each when it is asked for: what one does may decide what the next one means.

        One that is unknown or has a wrong argument ends the line: where the next one would begin can't be told.
        """
        if self._begun is None and (row := BARE.get(line)) is not None:
            yield ParsedCommand(row)
            return
        if not _TEXT.fullmatch(line.partition("#")[0]):  # noise, or another protocol: no letter of it counts
            yield from self.finish()
            yield ParsedCommand(None, fault=Rprt.ENIMPL)
            return
        tokens = deque(_TOKEN.findall(line))
        if _is_over(tokens):
            return
        if self._begun:
            command, row = self._begun
            if row.arguments[len(command.arguments)].fits(tokens[0]):
                self._begun = None
                if (whole := self._with_arguments(command, row, tokens)) is None:
                    return
                yield whole
                if whole.fault is not None:
                    return
            else:
                yield from self.finish()
        while not _is_over(tokens):
            token = tokens.popleft()
            for each in re.findall(r"^\w|..", token) if _JOINED.fullmatch(token) else [token]:
                if (whole := self._command(each, tokens)) is None:
                    return
                yield whole
                if whole.fault is not None:
                    return

    def finish(self) -> Iterator[ParsedCommand]:
        """Yield the command that was begun, as wrong: its arguments will not come."""
        if self._begun:
            command, _ = self._begun
            self._begun, command.fault = None, Rprt.EINVAL
            yield command

    def _command(self, token: str, tokens: deque[str]) -> ParsedCommand | None:
        separator, body = (token[0], token[1:]) if token[0] in SEPARATORS else (None, token)
        if glued := _GLUED.fullmatch(body):
            body, number = glued.groups()
            tokens.appendleft(number)
        separator = "\n" if separator == "+" else separator
        if (row := self._row(body, tokens)) is None:
            return ParsedCommand(None, separator, fault=Rprt.ENIMPL)
        return self._with_arguments(ParsedCommand(row, separator), row, tokens)

    def _row(self, body: str, tokens: deque[str]) -> CommandRow | None:
        if body.startswith("\\"):
            return BY_NAME.get(body[1:])
        if body == "R" and self._context.has_dumped_state and tokens and tokens[0] == "1":
            return BY_NAME["reset"]
        if body in BY_LETTER_ALONE and _is_over(tokens):
            return BY_LETTER_ALONE[body]
        return BY_LETTER.get(body) or BY_WORD.get(body)

    def _with_arguments(self, command: ParsedCommand, row: CommandRow, tokens: deque[str]) -> ParsedCommand | None:
        """Return the command with the arguments that stand here; None where the line ends before the last of them."""
        given = command.arguments
        for shape in row.arguments[len(given) :]:
            if given == [_LISTED]:
                break
            if _is_over(tokens):
                return self._ended(command, row, shape)
            if shape is ArgumentShape.LINE:
                argument = " ".join(tokens)
                tokens.clear()
            else:
                argument = tokens.popleft()
            command.typed.append(argument)
            if row.splits and not given and "," in argument and _is_over(tokens):
                if (both := pair(argument)) is None:  # `10,20` is 10.2 or two numbers
                    return _wrong(command, row, tokens)
                given += both
                break
            if not shape.fits(argument):
                return _wrong(command, row, tokens)
            given.append(argument)
        return command

    def _ended(self, command: ParsedCommand, row: CommandRow, missing: ArgumentShape) -> ParsedCommand | None:
        """Return a command whose line ends before an argument; None where that may stand on the next line."""
        if row.alone:
            return command
        if not missing.may_follow:
            return _wrong(command, row, deque())
        self._begun = command, row
        return None


def _is_over(tokens: deque[str]) -> bool:
    """Return whether nothing but a comment is left."""
    return not tokens or tokens[0].startswith("#")


def _wrong(command: ParsedCommand, row: CommandRow, tokens: deque[str]) -> ParsedCommand:
    command.typed += list(tokens)[: len(row.arguments) - len(command.typed)]
    command.fault = Rprt.EINVAL
    return command
