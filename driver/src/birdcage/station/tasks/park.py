"""Parking as a task: to the park position, on the turn of the cable that leaves most room either way."""

from __future__ import annotations

from birdcage.antenna.antenna import BirdcageAntenna
from birdcage.station.pursuit_contexts import bounds_of
from birdcage.station.state_store import StateStore
from birdcage.station.task import Task
from birdcage.tracking.steps import PointAt, ReadPosition, SlewTo, Steps


class ParkTask(Task):
    """One way of the dish, over no-go sectors where they are in the way. Whoever takes control meanwhile ends it."""

    kind = "park"
    goes_on = False
    done_words = "Parked."

    def __init__(
        self, store: StateStore, antenna: BirdcageAntenna, holder: str, az_deg: float, el_deg: float
    ) -> None:  # fmt: skip
        """`az_deg` and `el_deg` are true."""
        self._store, self._antenna, self.holder = store, antenna, holder
        self._place = az_deg, el_deg

    def goes_to(self, now_s: float) -> tuple[float, float]:  # noqa: ARG002 - it goes there whenever it begins
        """Return the park position."""
        return self._place

    def steps(self, now_s: float, *, asked: bool) -> Steps:  # noqa: ARG002 - its host counts down
        """Look where the dish is, and go."""
        from birdcage.tracking import ways  # with the first task that plans a way: starting needs none

        antenna, gate = self._antenna, self._antenna.gate
        if antenna.model.mapping is not None:
            yield PointAt(*self._place)
            return
        seen = yield ReadPosition()
        if seen.az_deg is None or seen.el_deg is None:
            return
        az_deg, el_deg = antenna.alignment.to_dish(*self._place)
        cable = gate.cable_limits if gate.cable_deg is not None else None
        middle_deg = seen.az_deg if cable is None else sum(cable) / 2.0
        to = ways.nearest_turn(middle_deg, az_deg, cable), el_deg
        here = seen.az_deg, seen.el_deg
        yield SlewTo(
            ways.way(bounds_of(self._store.state), antenna.model, here, to, turn_known=cable is not None).stops
        )


class ShelterTask(ParkTask):
    """Parks because the owner's command says *not now*: that does not keep the dish from parking."""

    kind = "shelter"
    is_unattended = False
