"""Keys one at a time: each has done all that it does before the next is looked at, however many arrive together.

Textual hands a key to what has the focus at that moment, and does not wait for what comes of it. The next key of the
same write would go to the same widget: to a dialog that the first one has closed, or past the field that it has opened.
"""

from __future__ import annotations

import asyncio
from collections import deque
from collections.abc import Awaitable, Callable
from contextlib import suppress

from textual.app import App
from textual.events import Event, Key, MouseDown, Paste
from textual.message_pump import MessagePump
from textual.widget import Widget

Typed = Key | Paste
PATIENCE_S = 1.0
"""How long a key waits for the one before it, at most: a page takes a while on its first visit."""
READ_AHEAD = 1024
"""Keys that are remembered while the app's thread takes none: it paints, or is stuck."""
LOOK_S = 0.005
"""Between two looks at whether a page, or a search of the palette, is ready."""


class KeyQueue:
    """Deals with what is typed, in its order; only STOP overtakes.

    `means_stop` says whether a key means STOP now, `stop` stops the dish, on any thread; `tell_stop` says so on the
    screen.
    """

    def __init__(
        self,
        app: App[None],
        deal: Callable[[Typed], Awaitable[None]],
        means_stop: Callable[[Key], bool],
        stop: Callable[[], object],
        tell_stop: Callable[[], object],
    ) -> None:
        self._app, self._deal, self._tell_stop = app, deal, tell_stop
        self._means_stop, self._stop = means_stop, stop
        self._read: deque[tuple[Key, bool, int]] = deque(maxlen=READ_AHEAD)
        """Keys that were read and not taken yet, whether each means STOP, and how many STOPs were typed before it."""
        self._presses: deque[tuple[MouseDown, int]] = deque(maxlen=READ_AHEAD)
        """Presses of the mouse that were read and not taken yet, and how many STOPs had been typed before each."""
        self._waiting: deque[tuple[Typed, int]] = deque()
        """What waits for its turn, and how many STOPs had been typed before it."""
        self._settling: asyncio.Task[None] | None = None
        self._stops_typed = self._stops_before = 0
        """STOPs so far, and those before what was dealt with last."""
        self.closed = False
        """Whether the app ends: nothing is dealt with any more, STOP excepted."""

    @property
    def is_idle(self) -> bool:
        """Whether all that was typed has been dealt with."""
        return not self._waiting and self._settling is None

    @property
    def is_overtaken(self) -> bool:
        """Whether STOP was typed after what the app does now: an Enter under way must not let go of HELD."""
        return self._stops_before != self._stops_typed

    def let_go(self, release: Callable[[], object]) -> None:
        """Let go of HELD by what is dealt with now, unless STOP was typed after it."""
        if self.is_overtaken:
            return
        release()
        if self.is_overtaken:
            self._stop()  # it was typed in this moment, and may have been taken for one that is released

    def read(self, key: Key) -> None:
        """Stop at once if that is what it means. Called on the thread that reads the keys, before `take`."""
        stops = self._means_stop(key)
        # First: while STOP goes out, the app's thread may take what was typed before it.
        self._read.append((key, stops, self._stops_typed))
        if stops:
            self._stop_now()

    def read_press(self, press: MouseDown) -> None:
        """Note that the mouse was pressed now, by the order of what is typed. Called as `read` is."""
        self._presses.append((press, self._stops_typed))

    def _stops(self, key: Key) -> bool:
        """Stop the dish if that is what a key means; return whether it does."""
        stops = self._means_stop(key)
        if stops:
            self._stop_now()
        return stops

    def _stop_now(self) -> None:
        self._stops_typed += 1  # first: what is under way may come to its end at any moment
        self._stop()

    async def take(self, event: Event) -> bool:
        """Deal with a key or a paste now, or as soon as its turn comes; return False for what goes on by itself."""
        if isinstance(event, MouseDown):
            self._stops_before = self._before_press(event)
        if not isinstance(event, Typed):
            return False
        if event.is_forwarded:
            return self.closed or not self._app.screen_stack  # no page is left for it
        stopped, stops = self._as_read(event)
        if isinstance(event, Key) and (stopped or self._stops(event)):
            self._spent_on_stop()
        elif self.closed or any(each_stops for _, each_stops, _ in tuple(self._read)):
            pass  # a STOP was typed after it, and has gone out: it comes too late
        elif self._waiting or self._settling is not None:
            self._waiting.append((event, stops))
        else:
            await self._begin(event, stops)
        return True

    def _before_press(self, press: MouseDown) -> int:
        """Return how many STOPs had been typed when the mouse was pressed."""
        while self._presses:
            read, stops = self._presses.popleft()
            if read is press:
                return stops
        return self._stops_typed

    def _as_read(self, typed: Typed) -> tuple[bool, int]:
        """Return whether it has stopped the dish when it was read, and how many STOPs had been typed before it.

        What was read before it is taken.
        """
        while any(each is typed for each, _, _ in tuple(self._read)):
            each, stopped, before = self._read.popleft()
            if each is typed:
                return stopped, before
        return False, self._stops_typed

    def _spent_on_stop(self) -> None:
        self._waiting.clear()  # done after STOP, an Enter that was typed before it would let go of HELD
        self._tell_stop()

    def close(self) -> None:
        """Deal with nothing any more."""
        self.closed = True
        self._waiting.clear()

    async def _begin(self, typed: Typed, stops_before: int) -> None:
        self._stops_before = stops_before
        await self._deal(typed)
        self._settling = asyncio.create_task(self._settle())

    async def _settle(self) -> None:
        try:
            with suppress(TimeoutError):
                await asyncio.wait_for(settled(self._app), PATIENCE_S)
        finally:
            self._settling = None
            if self._waiting:
                self._app.call_later(self._next)

    async def _next(self) -> None:
        """Deal with the one that has waited longest. What came before it may have left a text field."""
        if not self._waiting or self._settling is not None:
            return
        typed, stops = self._waiting.popleft()
        if stops != self._stops_typed:
            self._waiting.clear()  # a STOP was typed after all of it, and has gone out
        elif isinstance(typed, Key) and self._stops(typed):
            self._spent_on_stop()
        else:
            await self._begin(typed, stops)


async def settled(app: App[None]) -> None:
    """Wait until a key that the app was given has gone its way: from what has the focus outward, with what it began.

    Each of them works through its own queue, in order; so a callback at the end of a queue runs when all before it is
    done. What a widget tells the layer around it takes a second lap, and what opens another layer one more.
    """
    first = True
    while app.screen_stack:  # it is empty when the app ends
        screen, focused = app.screen, app.focused
        outward: list[MessagePump] = [screen if focused is None else focused]
        while isinstance(outward[-1], Widget) and outward[-1].parent is not None:
            outward.append(outward[-1].parent)
        # One that is closed does nothing any more, whatever its queue holds: waiting for it would be for ever.
        taking = [pump for pump in (*outward, app) if await idle(pump)]
        while any(not worker.is_finished for worker in app.workers):
            await asyncio.sleep(LOOK_S)
        same = bool(app.screen_stack) and app.screen is screen and app.focused is focused
        if same and not first and not any(pump.message_queue_size for pump in outward if pump in taking):
            return
        first = False
        await asyncio.sleep(0.0)  # another lap gives the rest of the app its turn, and patience its end


async def idle(pump: MessagePump) -> bool:
    """Wait until it has done what its queue holds now; return False at once for one that is closed."""
    done = asyncio.Event()
    if not pump.call_later(done.set):
        return False
    await done.wait()
    return True
