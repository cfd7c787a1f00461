"""One client's side of the protocol: bytes in, whole replies out. No socket, no clock, no thread."""

from __future__ import annotations

import logging
from collections import deque
from collections.abc import Iterator
from concurrent.futures import Future
from itertools import chain
from typing import Any

from birdcage.rotctld.client_context import ClientContext
from birdcage.rotctld.command_lines import CommandLines
from birdcage.rotctld.parser import CommandParser, ParsedCommand
from birdcage.rotctld.result import AwaitedResult, CommandResult, reply
from birdcage.rotctld.rotor import Rotor
from birdcage.rotctld.rprt import RotctldError, Rprt

BACKLOG = 8192
"""Bytes of lines that may wait behind a command that waits for the dish."""
_log = logging.getLogger(__name__)


class ClientConversation:
    """What one client says, and what it is answered: each command once, in order, each reply in one piece.

    Never raises, whatever comes. Take the replies after each piece that is fed. While it is `waiting` feed little or
    nothing: what comes beyond `BACKLOG` is dropped, and gets one `RPRT -1`. All calls on one thread.
    """

    def __init__(self, rotor: Rotor) -> None:
        self._context = ClientContext(rotor)
        self._parser = CommandParser(self._context)
        self._lines = CommandLines()
        self._queue: deque[bytes | None] = deque()
        self._queued = 0
        self._commands: Iterator[ParsedCommand] = iter(())
        self._awaited: tuple[ParsedCommand, AwaitedResult] | None = None
        self._replies: list[bytes] = []
        self._ended = False

    @property
    def waiting(self) -> Future[Any] | None:
        """What a command waits for. Whatever follows waits behind it. Call `resume` when it is done."""
        return self._awaited[1].future if self._awaited else None

    @property
    def closed(self) -> bool:
        """Whether the client said `q`: write the replies, then hang up."""
        return self._context.closed

    def feed(self, data: bytes) -> None:
        """Take what the client has sent, cut anywhere. Nothing counts after `q`."""
        for line in self._lines.feed(data):
            if self.closed:
                return
            self._take(line)

    def end_of_input(self) -> None:
        """Take that the client sends no more: a last line without its end counts."""
        for line in self._lines.finish():
            self._take(line)
        self._ended = True
        self._run()

    def take_replies(self) -> list[bytes]:
        """Return the replies since the last call, each to be written in one piece."""
        replies, self._replies = self._replies, []
        return replies

    def resume(self) -> None:
        """Go on after what was waited for is done. Does nothing before that."""
        if self._awaited and self._awaited[1].future.done():
            (command, awaited), self._awaited = self._awaited, None
            self._settle(command, awaited)
            self._run()

    def give_up(self) -> None:
        """Answer the command that waits with ETIMEOUT, and go on; what its future brings later is dropped."""
        if self._awaited:
            (command, _), self._awaited = self._awaited, None
            self._fail(command, RotctldError(Rprt.ETIMEOUT, "The dish did not answer in time. Is it switched on?"))
            self._run()

    def _take(self, line: bytes | None) -> None:
        size = len(line) if line is not None else 0
        if self._awaited and (line is None or self._queued + size > BACKLOG):
            if not self._queue or self._queue[-1] is not None:
                self._queue.append(None)  # however many are dropped in a row
            return
        self._queue.append(line)
        self._queued += size
        self._run()

    def _run(self) -> None:
        """Do what was said, up to a command that waits."""
        while self._awaited is None and not self.closed:
            if (command := next(self._commands, None)) is not None:
                self._do(command)
            elif self._queue:
                self._commands = self._read(self._queue.popleft())
            elif self._ended and (command := next(self._parser.finish(), None)) is not None:
                self._do(command)
            else:
                return

    def _read(self, line: bytes | None) -> Iterator[ParsedCommand]:
        if line is None:
            return chain(self._parser.finish(), [ParsedCommand(None, fault=Rprt.EINVAL)])
        self._queued -= len(line)
        return self._parser.read(line.decode("utf-8", "replace"))

    def _do(self, command: ParsedCommand) -> None:
        if command.row is None or command.fault is not None:
            self._fail(command, _refusal(command))
            return
        try:
            result = command.row.call(self._context, command.arguments)
        except RotctldError as error:
            self._fail(command, error)
            return
        if isinstance(result, AwaitedResult):
            if result.future.done():
                self._settle(command, result)
            else:
                self._awaited = command, result
        elif not self.closed:
            self._answer(command, result)

    def _settle(self, command: ParsedCommand, awaited: AwaitedResult) -> None:
        future = awaited.future
        error = RotctldError(Rprt.EIO, "It was taken back.") if future.cancelled() else future.exception()
        if error is None:
            self._answer(command, awaited.finish(future.result()))
        elif isinstance(error, RotctldError):
            self._fail(command, error)
        else:
            _log.error("%s failed", command.header, exc_info=error)
            self._fail(command, RotctldError(Rprt.EIO, f"It failed: {error}. The log has more."))

    def _fail(self, command: ParsedCommand, error: RotctldError) -> None:
        if _log.isEnabledFor(logging.DEBUG):
            _log.debug("%s %s", command.header or "unknown:", error)
        self._answer(command, error.code)

    def _answer(self, command: ParsedCommand, result: CommandResult | Rprt) -> None:
        header = "" if command.separator is None else command.header
        self._replies.append(reply(result, header, command.separator))


def _refusal(command: ParsedCommand) -> RotctldError:
    if command.fault is Rprt.ENIMPL:
        return RotctldError(Rprt.ENIMPL, "Unknown command. The rest of its line was dropped.")
    if command.row is None:
        return RotctldError(Rprt.EINVAL, "The line was too long, or too much came at once: it was dropped.")
    return RotctldError(Rprt.EINVAL, f"Wrong or missing argument of {command.row.long}.")
