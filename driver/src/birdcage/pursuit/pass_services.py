"""Tells whatever goes along with a pass how it goes, each apart from the others."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TypeVar

from birdcage.pursuit.pass_listener import LivePass, PassFile, PassListener, PassRemark
from birdcage.station.events import Event
from birdcage.station.station import Station

Answer = TypeVar("Answer")


class PassServices:
    """For the desk's thread, but where a method says otherwise."""

    def __init__(self, station: Station, changed: Callable[[], None]) -> None:
        """`changed` is called on any thread once `problem` may be another one."""
        self._station, self._changed = station, changed
        self._listeners: tuple[PassListener, ...] = ()
        self._live: LivePass | None = None
        self._faults: dict[int, str] = {}
        """What ended a listener, by its `id`."""
        self._unsubscribe = station.subscribe(self._hear)

    def add(self, listener: PassListener) -> None:
        """Let it go along from now on; it is told of a pass that is under way as of one that begins."""
        self._listeners += (listener,)
        live = self._live
        if live is not None:
            self._guard(listener, lambda each: each.begins(live), None)

    def follow(self, live: LivePass | None) -> None:
        """Go along with the pass that is live; None when none is any more."""
        before, self._live = self._live, live
        if live is not None and before is None:
            self._each(lambda listener: listener.begins(live))
        elif live is not None and before is not None and live.differs(before):
            self._each(lambda listener: listener.changes(live))
        elif live is None and before is not None:
            self._each(lambda listener: listener.ends())

    def step(self) -> float:
        """Let each do what is due; return when to come again, in monotonic seconds."""
        return min((self._guard(each, lambda one: one.step(), math.inf) for each in self._listeners), default=math.inf)

    @property
    def busy(self) -> bool:
        """Whether closing has something to end or to write. Any thread."""
        return self._live is not None or any(
            self._guard(each, lambda one: one.busy, otherwise=False) for each in self._listeners
        )

    @property
    def problem(self) -> str:
        """What is not done, and why; empty when all is well."""
        told = [self._guard(each, lambda one: one.problem, "") for each in self._listeners]
        return " ".join(filter(None, [*told, *self._faults.values()]))

    def signal(self, value: float, unit: str, at: float) -> None:
        """Tell a receiver's strength, at a monotonic time. Any thread."""
        self._each(lambda listener: listener.signal(value, unit, at))

    def remark(self, remark: PassRemark) -> None:
        """Tell what a listener says of a pass. Any thread."""
        self._each(lambda listener: listener.remark(remark))

    def made(self, file: PassFile) -> None:
        """Tell of a file that a listener has of a pass. Any thread."""
        self._each(lambda listener: listener.made(file))

    def close(self) -> None:
        """End them all, the newest first; a second time does nothing."""
        self._unsubscribe()
        listeners, self._listeners = self._listeners, ()
        for each in reversed(listeners):
            self._faults.pop(id(each), None)
            self._guard(each, lambda one: one.close(), None)

    def _hear(self, event: Event) -> None:
        demo = self._station.state.demo
        self._each(lambda listener: listener.hear(event, demo=demo))

    def _each(self, tell: Callable[[PassListener], None]) -> None:
        for listener in self._listeners:
            self._guard(listener, tell, None)

    def _guard(self, listener: PassListener, call: Callable[[PassListener], Answer], otherwise: Answer) -> Answer:
        """Return what a listener answers; `otherwise` of one that has raised before, or does so now."""
        if id(listener) in self._faults:
            return otherwise
        try:
            return call(listener)
        except Exception as fault:  # noqa: BLE001 - whatever it is: the pass and the other listeners go on
            self._faults[id(listener)] = f"The {listener.label} stopped: {fault!r}."
            self._changed()
            return otherwise
