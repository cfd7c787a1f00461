"""How many functions in how many files of ours an arrow key runs, from the key to the bytes of the jog at the dish.

The second key of a person who has control, at a dish that has come to rest since the first. The app's side ends where
it hands the jog to the station; the station's begins there. A function counts once, however often it runs. Exact, not
timed: the same on every machine. Peer: the same script in a checkout of another commit.
"""

from __future__ import annotations

import asyncio
import json
import sys
from pathlib import Path
from types import CodeType, FrameType

from birdcage.base.clock import VirtualClock
from birdcage.link.link import Link
from birdcage.sim.port import SimPort, open_device
from birdcage.station.session import Session
from birdcage.station.settings import StationSettings
from birdcage.station.station import Station
from birdcage_tui.feeds.settings import AppOptions
from birdcage_tui.shell.birdcage_app import BirdcageApp
from birdcage_tui.shown.options import SitePlace

JOG = b"a 0 "
SIMULATOR = "birdcage.sim"
RUNS = 3
"""On a busy machine the app may paint a frame between the key and its command: the run with the fewest calls counts."""


class Seen:
    """The functions of birdcage that run while it is on, in the order of their first call."""

    def __init__(self) -> None:
        self.calls: list[tuple[int, CodeType]] = []
        self._ours: dict[CodeType, bool] = {}
        self._depth = 0

    def on(self) -> None:
        self._depth = 0
        sys.setprofile(self._note)

    @staticmethod
    def off() -> None:
        sys.setprofile(None)

    def _note(self, frame: FrameType, event: str, _arg: object) -> None:
        if event not in ("call", "return"):
            return
        code = frame.f_code
        ours = self._ours.get(code)
        if ours is None:
            name = frame.f_globals.get("__name__", "")
            ours = name.partition(".")[0] in ("birdcage", "birdcage_tui") and not name.startswith(SIMULATOR)
            self._ours[code] = ours
        if not ours:
            return
        if event == "return":
            self._depth = max(0, self._depth - 1)
            return
        self.calls.append((self._depth, code))
        self._depth += 1

    @property
    def functions(self) -> dict[CodeType, None]:
        return dict.fromkeys(
            code for _depth, code in self.calls if not code.co_name.startswith("<") and code.co_filename != "<string>"
        )

    @property
    def files(self) -> dict[str, None]:
        return dict.fromkeys(code.co_filename for code in self.functions)

    def tree(self) -> str:
        return "\n".join(
            f"{'  ' * depth}{code.co_qualname}"
            f"  {Path(code.co_filename).parent.name}/{Path(code.co_filename).name}:{code.co_firstlineno}"
            for depth, code in self.calls
        )


class Stepped(Session):
    """Begins without a thread: this script steps it."""

    def start(self) -> None:
        return


async def play(app_side: Seen, station_side: Seen) -> None:
    clock = VirtualClock()
    device = open_device("g2?seed=1", clock=clock)

    class Port(SimPort):
        def write(self, data: bytes) -> None:
            if data.startswith(JOG):
                station_side.off()
            super().write(data)

    settings = StationSettings("sim:g2", "g2", lambda port, _baud: Link(Port(device, port), clock))
    station = Station(clock, settings)
    session = Stepped(clock, station)
    app = BirdcageApp(session, AppOptions(place=SitePlace(39.1, -95.7)))
    submit = station.submit

    def handed_over(request: object, **more: object) -> object:
        app_side.off()
        return submit(request, **more)

    async with app.run_test(size=(120, 36)) as pilot:
        session.step(12)
        await pilot.press("f2")
        await pilot.press("left")
        session.step(6)
        app.paint()
        await pilot.pause()
        station.submit = handed_over  # type: ignore[method-assign]
        app_side.on()
        await pilot.press("right")
        app_side.off()
        del station.submit
        station_side.on()
        station.step(clock.monotonic() + 1.0)
        station_side.off()


def main() -> None:
    runs = []
    for _ in range(RUNS):
        runs.append((Seen(), Seen()))
        asyncio.run(play(*runs[-1]))
    app_side, station_side = (min(sides, key=lambda seen: len(seen.calls)) for sides in zip(*runs, strict=True))
    if "--tree" in sys.argv:
        print(app_side.tree(), "\n----\n", station_side.tree(), sep="")
    figures: dict[str, dict[str, int]] = {}
    for name, seen in (("app", app_side), ("station", station_side)):
        figures[name] = {"functions": len(seen.functions), "files": len(seen.files), "calls": len(seen.calls)}
        print(f"{name:8} {len(seen.functions):4} functions in {len(seen.files):3} files, {len(seen.calls):5} calls")
    both = {"functions": app_side.functions | station_side.functions, "files": app_side.files | station_side.files}
    figures["together"] = {name: len(found) for name, found in both.items()}
    print(f"together {len(both['functions']):4} functions in {len(both['files']):3} files")
    print(json.dumps(figures))


if __name__ == "__main__":
    main()
