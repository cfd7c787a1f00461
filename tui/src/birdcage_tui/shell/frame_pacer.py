"""How often a frame is drawn: no more than the setting allows, and none while one still waits to be written."""

from __future__ import annotations

from collections.abc import Callable

from textual.app import App
from textual.timer import Timer

FRESH_S = 0.6
"""A frame younger than this has the time and the ages on it: no other is drawn for them alone."""
LISTEN_S = 0.4
"""Between two looks at how long the dish has been silent."""


class FramePacer:
    """Draws at once when the last frame is a while ago, else as soon as the next may be drawn. The app's thread."""

    def __init__(self, app: App[None], paint: Callable[[], object], frame_s: float) -> None:
        self._app, self._paint = app, paint
        self._frame_s = frame_s
        """Between two frames while something moves, and between two repaints on change, at least."""
        self._soon: Timer | None = None
        self._beat: Timer | None = None
        self._painted = 0.0
        self._late = False
        """Whether the last frame says that the dish owes an answer."""

    def begin(self, tick: Callable[[], object], rest: Callable[[], object], is_late: Callable[[], bool]) -> None:
        """Make the timers. `tick` moves on what moves by itself and draws; `rest` stands in where no frame is due.

        `is_late`: whether the dish owes an answer; a frame is drawn at once when that begins or ends.
        """
        self._tick, self._rest, self._is_late = tick, rest, is_late
        self._beat = self._app.set_interval(self._frame_s, tick, pause=True)
        self._app.set_interval(1.0, self._second)
        self._app.set_interval(LISTEN_S, self._listen)

    def _second(self) -> None:
        """Tick, unless the dish's answers make for frames often enough: at rest each costs unseen work."""
        if self.age_s >= FRESH_S:
            self._tick()
        else:
            self._rest()

    def _listen(self) -> None:
        late = self._is_late()
        if late != self._late:
            self._late = late
            self._paint()

    def run(self, *, animated: bool) -> None:
        """Tick frame by frame, or no longer."""
        if self._beat is not None:
            if animated:
                self._beat.resume()
            else:
                self._beat.pause()

    def painted(self) -> None:
        """Count from now: a frame is being drawn."""
        self._painted = self.now_s()

    @property
    def age_s(self) -> float:
        """How old the last frame is."""
        return self.now_s() - self._painted

    def changed(self) -> None:
        """Draw, now or soon: something to be seen has changed."""
        wait_s = self._frame_s - self.age_s
        if self._lags():
            wait_s = max(wait_s, self._frame_s / 2)
        if wait_s <= 0:
            self._paint()
        elif self._soon is None:
            self._soon = self._app.set_timer(wait_s, self._paint_soon)

    def now_s(self) -> float:
        """Return the time of the app's loop; 0 before there is one."""
        loop = self._app._loop  # noqa: SLF001 - Textual has no other name for it
        return 0.0 if loop is None else loop.time()

    def _paint_soon(self) -> None:
        self._soon = None
        if self._lags():
            self.changed()
        else:
            self._paint()

    def _lags(self) -> bool:
        """Return whether a frame still waits to be written: another one would only stand behind it."""
        return getattr(self._app._driver, "unwritten", 0) > 0  # noqa: SLF001 - ours, made by Textual
