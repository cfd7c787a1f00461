"""The demo shows itself: once its dish is ready it follows pass after pass, until somebody stops or moves it."""

from __future__ import annotations

from collections.abc import Callable

from birdcage_tui.shown.view import YOU, View

HOLDERS = (None, YOU, "tracker")
"""With whom in control it begins: not with one who moves it."""


class Tour:
    """Switches autotrack on, once. STOP, a hold, a fault, or a motion by hand before that ends it for ever."""

    def __init__(self, set_autotrack: Callable[[bool], object]) -> None:
        self._set_autotrack = set_autotrack
        self._begun = self._ended = False
        self.says = ""
        """What it says, empty when there is none."""

    @property
    def running(self) -> bool:
        """Whether it is still to begin: the dish may move by itself then, though nothing says so yet."""
        return not self._begun and not self._ended

    def end(self) -> None:
        """End it for ever. What is followed already ends with STOP, or when somebody takes over."""
        self._ended, self.says = True, ""

    def step(self, view: View) -> None:
        """Begin as soon as the dish is ready and passes are known."""
        self.says = self._step(view)

    def _step(self, view: View) -> str:
        """Return what it says."""
        state, desk = view.state, view.track
        if self._ended or not state.demo:
            return ""
        if state.held is not None or state.fault is not None or state.holder not in HOLDERS:
            self.end()
            return ""
        if not self._begun:
            ready = view.link_up and state.surveyed and state.homed and state.position is not None
            ready = ready and not state.motion_refused_because
            if ready and desk is not None and any(one.kept for one in desk.schedule):
                self._begun = True
                self._set_autotrack(True)
            return ""
        if desk is None or not desk.autotrack:
            return ""
        return "Demo: tracks pass after pass. Space stops, an arrow takes over."
