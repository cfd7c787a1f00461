"""What one part of the station finds, and parts above it must act on at once."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Generic, ParamSpec

from birdcage.base.held import HeldReason
from birdcage.base.reason import Reason

Told = ParamSpec("Told")


class Signal(Generic[Told]):
    """Calls its listeners in the order in which they connected, on the thread of whoever sends it."""

    def __init__(self) -> None:
        self._listeners: list[Callable[Told, object]] = []

    def connect(self, listener: Callable[Told, object]) -> None:
        """Call `listener` from now on."""
        self._listeners.append(listener)

    def __call__(self, *args: Told.args, **kwargs: Told.kwargs) -> None:
        """Call them."""
        for listener in self._listeners:
            listener(*args, **kwargs)


@dataclass(frozen=True, slots=True)
class Signals:
    """All of one station. Each is sent on the station's thread, from within the exchange that tells of it.

    Faces hear events (`events`); these are for the parts of the station among themselves.
    """

    port_found: Signal[[str]] = field(default_factory=Signal)
    """A port is about to be opened: what is remembered of the dish at it counts."""
    silent: Signal[[Reason | None]] = field(default_factory=Signal)
    """The dish does not answer, or not what was asked, while its port stays open; sent for each try, with the reason.
    """
    position_read: Signal[[]] = field(default_factory=Signal)
    """The gate has a position that was just read; nothing is told of it yet."""
    forgotten: Signal[[]] = field(default_factory=Signal)
    """The dish was homed and no longer is, though nothing was asked of it."""
    stalled: Signal[[str, str]] = field(default_factory=Signal)
    """The dish stands still away from its target; with the axis that is furthest from it, and a sentence."""
    astray: Signal[[]] = field(default_factory=Signal)
    """The dish moves on though its motion must be over."""
    waits: Signal[[]] = field(default_factory=Signal)
    """The dish was seen to take no command while a motor runs."""
    interrupted: Signal[[HeldReason]] = field(default_factory=Signal)
    """The dish is out of sight, has restarted, or the clock has stepped; HELD follows."""
    restarted: Signal[[]] = field(default_factory=Signal)
    """The dish was heard to start, or counts from elsewhere: nothing that was counted before holds."""
    speed_stuck: Signal[[str]] = field(default_factory=Signal)
    """The dish did not take its own speed back; with a sentence."""
