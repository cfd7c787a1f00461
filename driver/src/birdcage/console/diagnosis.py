"""Why the dish did not answer, as a reason and a sentence."""

from __future__ import annotations

import re

from birdcage.base.errors import NoReply
from birdcage.base.reason import Reason
from birdcage.console.dialect import ConsoleDialect
from birdcage.console.escapes import without_escapes

KEPT = 512
"""Bytes of a failed exchange that are kept to judge it by."""
_PROMPT = re.compile(r"[!-~][ -~]{0,31}(?<=[>#$%:\]])")
"""What a prompt looks like: all that are known of these and like dishes end in a sign, not in a letter."""
_GARBAGE_SHARE = 0.3
_QUOTED = 60


def is_garbage(seen: bytes) -> bool:
    """Return whether so many of these bytes are unprintable that they are no text."""
    bad = sum(1 for byte in seen if not (0x20 <= byte < 0x7F or byte in b"\r\n\t"))
    return bad > _GARBAGE_SHARE * len(seen)


def looks_like_prompt(text: str) -> bool:
    """Return whether what stands without a line end may be a prompt."""
    return _PROMPT.fullmatch(text) is not None


def stranger(dialect: ConsoleDialect, standing: str) -> NoReply | None:
    """Return what to say when a dish that has never shown a known prompt shows another; None when it does not."""
    if dialect.learnt or not dialect.stranger or not looks_like_prompt(standing):
        return None
    return NoReply(dialect.stranger.format(prompt=standing), reason=Reason.WRONG_FIRMWARE)


def no_reply(port: str, command: str, seen: bytes, waited_s: float, *, busy: bool = False) -> NoReply:
    """Judge `seen`, what arrived within `waited_s` after `command` was sent.

    Reasons: `silent`, `garbage`, `echo` (nothing but our own line came back), `blocked` (it talks, but shows no
    prompt that answers the command), `busy` (the same as `echo`, after a move that may not be over).
    """
    asked = f"`{command}`" if command else "Enter"
    seen = without_escapes(seen)
    text = "".join(chr(byte) if 0x20 <= byte < 0x7F else "." for byte in seen.strip())
    if busy and text == command:
        return NoReply(
            f"The dish is busy with the last move: it has echoed {asked} on {port}, and not answered in "
            f"{waited_s:.1f} s. Wait until it stands still. If it then stays silent, switch it off and on.",
            reason=Reason.BUSY,
        )
    quoted = text if len(text) <= _QUOTED else "…" + text[-_QUOTED:]
    if not seen:
        return NoReply(
            f"The dish is silent: {asked} on {port} brought nothing in {waited_s:.1f} s. Check its power, the cable "
            "at the dish, and the baud rate. It may still be starting; a deadlocked shell needs a power cycle.",
            reason=Reason.SILENT,
        )
    if is_garbage(seen):
        return NoReply(
            f"What arrives on {port} cannot be read ({len(seen)} bytes after {asked}). Check the baud rate, the two "
            "wires of the receiving pair, and what is connected.",
            reason=Reason.GARBAGE,
        )
    if not text or text == command:
        return NoReply(
            f"Only our own {asked} came back on {port}. The adapter hears itself, or the dish's shell is deadlocked: "
            "then only a power cycle helps.",
            reason=Reason.ECHO,
        )
    came_back = command in text if command else any(byte in b"\r\n" for byte in seen)
    if not came_back and looks_like_prompt(text[-1:]):
        return NoReply(
            f"The dish answered {asked} on {port} (last: `{quoted}`), but the echo is missing. Use an RS-422 adapter "
            "with all four wires: half duplex swallows the echo. Or bytes were lost.",
            reason=Reason.BLOCKED,
        )
    return NoReply(
        f"The dish talks on {port}, but nothing that answers {asked} came in {waited_s:.1f} s (last: `{quoted}`). It "
        "may be starting or busy, or bytes were lost.",
        reason=Reason.BLOCKED,
    )


def fell_silent(port: str, command: str, lines: int, silent_s: float) -> NoReply:
    """Say of a command that printed some lines, and then nothing more and no prompt, what may have happened.

    The adapter is there: a port that is gone is a LinkError.
    """
    return NoReply(
        f"The dish fell silent on {port}: `{command}` printed {lines} lines, then nothing for {silent_s:.0f} s, and no "
        "prompt. The adapter is still there. Its shell may be deadlocked, which only a power cycle ends; or its power "
        "or the cable at the dish is out.",
        reason=Reason.SILENT,
    )
