"""Reads messages of the DiSEqC bus: what they are for, in words (docs/reference/diseqc.md).

Pure: bytes or typed text in, words out. What no page explains is shown as the bytes that it is.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

from birdcage.coax import commands as known

LONGEST = 6
"""Bytes that a message has at most here: what a G2 takes."""
_TYPED = re.compile(r"(?:0x)?([0-9A-Fa-f]{1,2})")
_JOINED = re.compile(r"(?:[0-9A-Fa-f]{2})+")


@dataclass(frozen=True, slots=True)
class DiseqcMessage:
    """A message, and what its bytes mean."""

    raw: bytes
    framing: str
    """From whom it is, and whether a reply is wanted; of a reply, how it went."""
    address: str = ""
    """Whom it is for; empty in a reply, and where the message ends before."""
    command: str = ""
    data: str = ""
    """What its data says; empty where it has none."""
    doubt: str = ""
    """What makes it unlikely that a device understands it; empty where nothing does."""

    @property
    def is_reply(self) -> bool:
        """Whether a device has sent it."""
        return self.raw[:1] != b"" and self.raw[0] in known.REPLIES

    @property
    def wants_reply(self) -> bool:
        """Whether a device is to answer."""
        return self.raw[:1] != b"" and self.raw[0] in (0xE2, 0xE3)

    @property
    def hex(self) -> str:
        """The bytes as they are typed: `E0 10 38 F3`."""
        return self.raw.hex(" ").upper()

    @property
    def words(self) -> str:
        """All of it in one line, without the bytes."""
        what = ": ".join(part for part in (self.command, self.data) if part)
        said = "; ".join(part for part in (self.framing, self.address, what) if part)
        return f"{said}. {self.doubt}" if self.doubt else said

    def __str__(self) -> str:
        return f"{self.hex}: {self.words}"


def typed_message(text: str) -> bytes:
    """Return the bytes that a person typed: `E0 10 38 F3`, `e01038f3` or `0xE0,0x10`.

    ValueError, which says what is wrong and what to give, for anything else, and for more than 6 bytes.
    """
    parts = [part for part in re.split(r"[\s,]+", text.strip()) if part]
    if len(parts) == 1 and len(parts[0]) > 2 and _JOINED.fullmatch(parts[0]):
        parts = [parts[0][at : at + 2] for at in range(0, len(parts[0]), 2)]
    values = []
    for part in parts:
        match = _TYPED.fullmatch(part)
        if match is None:
            raise ValueError(f"{part!r} is no byte in hex. Give 1 to {LONGEST} bytes, as E0 10 38 F0.")
        values.append(int(match[1], 16))
    if not 1 <= len(values) <= LONGEST:
        raise ValueError(
            f"A message has 1 to {LONGEST} bytes, and {len(values)} were given. Give 1 to {LONGEST}, as E0 10 38 F0."
        )
    return bytes(values)


def read_message(message: bytes, answers: bytes | None = None) -> DiseqcMessage:
    """Return what a message means; `answers` is the message that a reply answers: it says what its data is.

    ValueError for no bytes at all.
    """
    if not message:
        raise ValueError("a message has at least one byte")
    first = message[0]
    if first in known.REPLIES:
        return DiseqcMessage(message, known.REPLIES[first], data=_answered(message[1:], answers))
    framing = known.FRAMINGS.get(first)
    if framing is None:
        return DiseqcMessage(
            message, f"{first:02X} begins no message of the bus", data=_bytes(message[1:]),
            doubt="A message of the master begins with E0, E1, E2 or E3.",
        )  # fmt: skip
    if len(message) < 3:
        address = _address(message[1]) if len(message) > 1 else ""
        return DiseqcMessage(message, framing, address, doubt="It ends before its command: it needs 3 bytes or more.")
    command, data = message[2], message[3:]
    words = known.COMMANDS.get(command, f"command {command:02X}, which no page of birdcage explains")
    return DiseqcMessage(message, framing, _address(message[1]), words, _data(command, data), _doubt(command, data))


def _address(byte: int) -> str:
    return known.ADDRESSES.get(byte, f"address {byte:02X}")


def _doubt(command: int, data: bytes) -> str:
    """Return what is wrong with the count of its data; empty where nothing is, or where it is not known."""
    if command not in known.COMMANDS:
        return ""
    least, most = known.PARAMETERS.get(command, (0, 0))
    if least <= len(data) <= most:
        return ""
    wanted = f"{least}" if least == most else f"{least} to {most}"
    return f"Its command takes {wanted} {'byte' if wanted == '1' else 'bytes'} of data, not {len(data)}."


def _data(command: int, data: bytes) -> str:
    """Return what the data of a command says; the bytes themselves where no page explains them."""
    if not data:
        return ""
    first = data[0]
    if command == known.WRITE_COMMITTED and len(data) == 1:
        return _flags(first)
    if command == known.WRITE_UNCOMMITTED and len(data) == 1 and first >= 0xF0:
        return f"input {first - 0xF0 + 1} of 16"
    if command in known.DRIVES and len(data) == 1:
        return _drive(first)
    if command == known.STORE and len(data) == 1:
        return f"number {first}" if first else "number 0, which enables the limits and stores nothing"
    if command == known.GO_TO_STORED and len(data) == 1:
        return f"number {first}" if first else "number 0, the reference at 0°"
    if command == known.GO_TO_ANGLE and len(data) == 2:
        return _angle(int.from_bytes(data, "big"))
    return _bytes(data)


def _flags(byte: int) -> str:
    """Return which flags a byte sets and clears: a low bit sets one, the bit four above it clears it before."""
    told = []
    for name, (cleared, is_set), bit in known.COMMITTED_BITS:
        value = is_set if byte >> bit & 1 else cleared if byte >> bit + 4 & 1 else ""
        if value:
            told.append(f"{name} {value}".strip())
    return ", ".join(told) or "no change"


def _drive(byte: int) -> str:
    if byte == 0:
        return "until it is halted"
    if byte < 0x80:
        return f"for {byte} s"
    return f"by {256 - byte} steps" if byte < 0xFF else "by 1 step"


def _angle(word: int) -> str:
    """Return an angle of `6E`: E for east or D for west, then sixteenths of a degree."""
    side = {0xE: "east", 0xD: "west"}.get(word >> 12)
    if side is None:
        return f"{word:04X}, an angle in another way than E… for east and D… for west"
    angle = f"{(word & 0xFFF) / 16:.4f}".rstrip("0").rstrip(".")
    return f"{angle}°" if angle == "0" else f"{angle}° {side}"


def _answered(data: bytes, answers: bytes | None) -> str:
    if not data:
        return ""
    asked = answers[2] if answers is not None and len(answers) > 2 else None
    if asked == known.POSITIONER_STATUS and len(data) == 1:
        return ", ".join(word for bit, word in known.POSITIONER_BITS if data[0] >> bit & 1) or "nothing to tell"
    return _bytes(data)


def _bytes(data: bytes) -> str:
    return f"data {data.hex(' ').upper()}" if data else ""
