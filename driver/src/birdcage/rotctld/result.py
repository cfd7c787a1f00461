"""What a command gives its client, and its bytes in both forms of Hamlib's protocol."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from concurrent.futures import Future
from dataclasses import dataclass
from typing import Any

from birdcage.rotctld.rprt import Rprt


@dataclass(frozen=True, slots=True)
class CommandResult:
    """A command that was done: its values, a line each, and the same for the extended form, each with its key."""

    plain: tuple[str, ...] = ()
    extended: tuple[str, ...] = ()
    """One that ends as a line gets no separator."""
    acknowledged: bool = False
    """Whether `RPRT 0` follows the values in the default form, too."""


DONE = CommandResult()
"""Of a command that has nothing to tell: `RPRT 0`."""


@dataclass(frozen=True, slots=True)
class AwaitedResult:
    """A command that takes an exchange with the dish: `finish` makes its result of what the future brings."""

    future: Future[Any]
    finish: Callable[[Any], CommandResult]


def keyed(keys: Sequence[str], *values: str) -> CommandResult:
    """Return values, a line each; the extended form has a key before each."""
    return CommandResult(values, tuple(f"{key}: {value}" for key, value in zip(keys, values, strict=True)))


def unkeyed(*lines: str, acknowledged: bool = False) -> CommandResult:
    """Return lines that have no key in the extended form either, and end as lines whatever the separator."""
    return CommandResult(lines, tuple(f"{line}\n" for line in lines), acknowledged)


def reply(result: CommandResult | Rprt, header: str, separator: str | None) -> bytes:
    """Return one whole reply. `separator` is None for the default form, else what ends each record but the last.

    `header` is the long name and the arguments as typed, which opens an extended reply.
    """
    code = result if isinstance(result, Rprt) else Rprt.OK
    values = result if isinstance(result, CommandResult) else DONE
    if separator is None:
        closing = (f"RPRT {code:d}",) if values.acknowledged or not values.plain else ()
        return _encoded("\n".join((*values.plain, *closing, "")))
    opening = [header] if header else []
    records = "".join(
        record if record.endswith("\n") else f"{record}{separator}" for record in (*opening, *values.extended)
    )
    return _encoded(f"{records}RPRT {code:d}\n")


def _encoded(text: str) -> bytes:
    return text.encode("utf-8", "replace")
