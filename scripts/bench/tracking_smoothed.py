"""The peers once more, as clients of a server that smooths their wishes: the smoother itself, on the bench's wire."""

from __future__ import annotations

from collections.abc import Callable, Generator
from dataclasses import dataclass, field
from types import SimpleNamespace
from typing import Any, Literal

from birdcage.base.geometry import wrap_360
from birdcage.rotctld.client_view import WishedDirection
from birdcage.rotctld.wish_smoother import WishSmoother
from birdcage.station.events import MoveStarted
from birdcage.tracking.controller_input import Controller, ControllerInput
from birdcage.tracking.steps import Send, Step, StepResult, Steps, Wait
from tracking_peers import gpredict, move_to_now

CLIENT = "client"


@dataclass
class _Station:
    """As much of a station as the smoother looks at: the dish, the time, and when a motion began."""

    state: Any
    now_s: float
    listeners: list[Callable[[Any], None]] = field(default_factory=list)

    @property
    def clock(self) -> _Station:
        return self

    def monotonic(self) -> float:
        return self.now_s

    def subscribe(self, listener: Callable[[Any], None], *_kinds: type) -> Callable[[], None]:
        self.listeners.append(listener)
        return lambda: self.listeners.remove(listener)

    def begun(self) -> None:
        event = MoveStarted(self.now_s, None, None, CLIENT)  # type: ignore[arg-type]
        for listener in tuple(self.listeners):
            listener(event)


def smoothed(peer: Controller, mode: Literal["on", "auto"]) -> Controller:
    """Return a peer whose wishes go to the dish through the smoother of the network server."""

    def follow(helm: ControllerInput) -> Steps:
        station = _Station(SimpleNamespace(dish=helm.model), helm.now_s)
        smoother = WishSmoother(station, CLIENT, mode)  # type: ignore[arg-type]
        az_axis, el_axis = helm.model.azimuth.index, helm.model.elevation.index

        def point(aim: WishedDirection) -> Generator[Step, StepResult, None]:
            station.now_s = (yield Send(az_axis, round(aim.az_deg, 2))).now_s
            station.begun()
            low, high = helm.model.elevation.min_deg, helm.model.elevation.max_deg
            station.now_s = (yield Send(el_axis, round(min(max(aim.el_deg, low), high), 2))).now_s

        steps, wished = peer(helm), dict[int, float]()
        answer: StepResult | None = None
        while True:
            try:
                step = next(steps) if answer is None else steps.send(answer)
            except StopIteration:
                return
            if isinstance(step, Send):
                wished[step.axis] = step.deg
                if len(wished) == 2:
                    wish = WishedDirection(wrap_360(wished[az_axis]), wished[el_axis])
                    yield from point(smoother.take(wish, station.now_s))
                    wished.clear()
                answer = StepResult(station.now_s)
                continue
            while isinstance(step, Wait) and smoother.due is not None and smoother.due < step.until_s:
                station.now_s = (yield Wait(max(smoother.due, station.now_s))).now_s
                aim = smoother.tick(station.now_s)
                if aim is not None:
                    yield from point(aim)
            answer = yield step
            station.now_s = answer.now_s

    return follow


SMOOTHED: dict[str, Callable[[], Controller]] = {
    "Gpredict, 5°, smoothed": lambda: smoothed(gpredict(5.0, leapfrog=False), "auto"),
    "Gpredict, 5°, smoother on": lambda: smoothed(gpredict(5.0, leapfrog=False), "on"),
    "Gpredict, 1°, smoothed": lambda: smoothed(gpredict(1.0, leapfrog=False), "auto"),
    "Gpredict, 1°, smoother on": lambda: smoothed(gpredict(1.0, leapfrog=False), "on"),
    "move to now, 1 Hz, smoothed": lambda: smoothed(move_to_now(0.0, leapfrog=False), "auto"),
}
