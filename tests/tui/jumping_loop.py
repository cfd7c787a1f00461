"""An event loop in which waiting takes no time: with nothing left to do, its clock jumps to the next timer.

So a test meets the same order of timers, messages and frames on an idle machine and on a loaded one. Work that was
given to another thread of the loop's pool is waited for in real time.
"""

from __future__ import annotations

import asyncio
import time

import textual._time
import textual.app
import textual.pilot

SETTLE_S = 0.02
"""How long Textual's pilot watches the process at least before it takes it for idle."""


class JumpingLoop(asyncio.SelectorEventLoop):
    def __init__(self):
        super().__init__()
        self._now = time.monotonic()
        self._elsewhere = 0
        self._for_idle = []
        self._really_select = self._selector.select
        self._selector.select = self._select

    def time(self):
        return self._now

    def run_in_executor(self, executor, func, *args):
        future = super().run_in_executor(executor, func, *args)
        self._elsewhere += 1
        future.add_done_callback(self._is_back)
        return future

    def _is_back(self, _):
        self._elsewhere -= 1

    async def idle(self):
        """Wait until nothing is left to do before the next timer."""
        future = self.create_future()
        self._for_idle.append(future)
        await future

    def _select(self, timeout):
        found = self._really_select(0)
        if found or timeout == 0:
            return found
        if self._for_idle and not self._elsewhere:
            for future in self._for_idle:
                if not future.done():
                    future.set_result(None)
            self._for_idle.clear()
        elif timeout is None or self._elsewhere:
            before = time.monotonic()
            found = self._really_select(timeout)
            self._now += time.monotonic() - before
        else:
            self._now += timeout
        return found


async def settle(*_):
    """Stand in for `textual._wait.wait_for_idle`, which compares the process's time with that on the wall."""
    await asyncio.sleep(SETTLE_S)
    await asyncio.get_running_loop().idle()


class Policy(asyncio.DefaultEventLoopPolicy):
    def new_event_loop(self):
        return JumpingLoop()


def loop_time():
    """The time for Textual's timers: that of the loop, on its thread; any other thread has none."""
    try:
        return asyncio.get_running_loop().time()
    except RuntimeError:
        return time.monotonic()


async def all_is_taken_in(pilot, timeout=30.0):
    """Stand in for the pilot's way to ask each widget to call back: the loop itself knows that none has a message."""
    await asyncio.get_running_loop().idle()
    return not pilot.app._exception_event.is_set()


def let_time_jump(put=setattr):
    """Have Textual go by the time of this loop; `put` sets an attribute. Loops made from now on are of this kind."""
    asyncio.set_event_loop_policy(Policy())
    put(textual._time, "get_time", loop_time)
    put(textual.pilot.Pilot, "_wait_for_screen", all_is_taken_in)
    put(textual.app, "wait_for_idle", settle)
    put(textual.pilot, "wait_for_idle", settle)
