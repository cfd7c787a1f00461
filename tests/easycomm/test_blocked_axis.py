"""A rotator that drives a blocked axis on is stopped, and stays where it is once that is free."""

from __future__ import annotations

import pytest
from birdcage.station.requests import AcknowledgeFault, Goto, Release
from birdcage.station.state import FaultReason
from birdcage.testing import MachineBench, Stage
from rotctl_twin import server

from .test_rotator import RP2040, STOCK, met


def stage_of(kind):
    return Stage(MachineBench("rotctl", server("seed=1&az=100&el=30"), stops=())) if kind == "rotctl" else met(kind)


@pytest.mark.parametrize(
    ("kind", "stop", "remedy"),
    [(RP2040, "STOP", "sync it"), (STOCK, "SA SE", "home it"), ("rotctl", "S", "check where it points")],
)
def test_it_is_stopped_and_stays_where_it_is_when_somebody_frees_it(kind, stop, remedy):
    with stage_of(kind) as stage:
        stage.ready()
        twin = stage.twin.device

        def count():
            return sum(line.strip() == stop for _at, line in twin.shell.received)

        stage.station.submit(Goto(140.0, 60.0, "you"))
        stage.step(1.5)
        twin.stall(1)
        stage.until(lambda: stage.state.fault is not None, 90.0, "the stall is seen")
        assert stage.state.fault.reason is FaultReason.STALL
        assert remedy in stage.state.fault.remedy
        stage.step(3.0)
        sent = count()
        assert sent > 0
        stage.station.stop("you")
        stage.step(3.0)
        assert count() > sent, "Space stops it, too"
        stands = stage.truth
        twin.stall(1, blocked=False)
        stage.step(5.0)
        assert stage.truth == stands
        stage.do(AcknowledgeFault("you"))
        stage.do(Release("you"))
        stage.do(Goto(140.0, 60.0, "you"))
        assert stage.truth.el_deg == pytest.approx(60.0, abs=0.2)
