"""What was seen on a port at one baud rate, for the walk through the causes of silence."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum


class Saw(Enum):
    """What came back after a bare Enter."""

    SILENCE = "silence"
    GARBAGE = "garbage"
    """Bytes that cannot be read: wrong baud rate, or the receiving pair swapped."""
    ECHO = "echo"
    """Our own bytes and nothing else: the adapter hears itself, or a deadlocked shell."""
    TEXT = "text"
    """Text that is not a prompt: a dish that boots, or something else."""
    PROMPT = "prompt"
    """A prompt of the firmware."""


@dataclass(frozen=True, slots=True)
class BaudFinding:
    """One baud rate, tried."""

    baud: int
    saw: Saw
    sample: str
    """The first printable characters of what came, unprintable ones as dots; empty for silence."""
    count: int
    """How many bytes came."""
    waited_s: float
