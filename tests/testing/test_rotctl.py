"""The contract, kept by what stands behind a rotctld: Hamlib's own, and servers that know less."""

from __future__ import annotations

from dataclasses import replace

import pytest
from birdcage.base.errors import CommandRefused
from birdcage.base.reason import Reason
from birdcage.rotator.ladder import StopBy, StopOrder
from birdcage.rotator.values import Look
from birdcage.testing import ConsoleScene, Contract, Golden, MachineBench, StopScene
from rotctl_twin import server

STOPS = (
    StopScene("command", (60.0, 15.0), 2.0),
    StopScene("retarget", (60.0, 15.0), 2.0, twin=server("seed=1&az=100&el=30&stop=ignore")),
)


DUMP = (
    b"1\n1\nmin_az=-180.000000\nmax_az=450.000000\nmin_el=0.000000\nmax_el=90.000000\nsouth_zero=0\nrot_type=AzEl\n"
    b"done\n"
)
MEETING = (b"\\dump_state\n", DUMP)


def met(rotator):
    rotator.meet()
    return rotator


def moved_and_stopped(rotator):
    met(rotator).look()
    taken = rotator.send({"azimuth": 180.0, "elevation": 45.0}), rotator.send({"azimuth": -90.456})
    rotator.stop_now(StopOrder(StopBy.COMMAND))
    return [each.said for each in taken], rotator.settle(0.3)


def range_error(rotator):
    met(rotator).look()
    try:
        rotator.send({"azimuth": 181.0, "elevation": 95.0})
    except CommandRefused as refused:
        return str(refused), refused.reason
    return None


def asked_in_words(rotator):
    return {name: reading.value for name, reading in met(rotator).read(rotator.features).items()}


GOLDENS = (
    Golden("p", (MEETING, (b"p\n", b"0.00\n0.00\n")), lambda rotator: met(rotator).look(),
           Look({"azimuth": 0.0, "elevation": 0.0})),
    Golden("p, before 4.5", (MEETING, (b"p\n", b"-134.500000\n10.000000\n")), lambda rotator: met(rotator).look(),
           Look({"azimuth": -134.5, "elevation": 10.0})),
    Golden("P and S", (MEETING, (b"p\n", b"0.00\n0.00\n"), (b"P 180.00 45.00\n", b"RPRT 0\n"),
                       (b"P -90.46 45.00\n", b"RPRT 0\n"), (b"S\n", b"RPRT 0\n")),
           moved_and_stopped, (["RPRT 0", "RPRT 0"], (None,))),
    Golden("P out of range, up to 4.5", (MEETING, (b"p\n", b"0.00\n0.00\n"), (b"P 181.00 95.00\n", b"RPRT -1\n")),
           range_error, ("The server answered `P 181.00 95.00` with RPRT -1 (invalid parameter, or beyond its range).",
                         Reason.BAD_PARAMETER)),
    Golden("P out of range, from 4.6", (MEETING, (b"p\n", b"0.00\n0.00\n"), (b"P 181.00 95.00\n", b"RPRT -21\n")),
           range_error,
           ("The server answered `P 181.00 95.00` with RPRT -21 (beyond its range).", Reason.OUT_OF_RANGE)),
    Golden("_, s and v SPEED",
           (MEETING, (b"_\n", b"Dummy rotator\n"),
            (b"+s\n", b"get_status:\nStatus flags: MOVING MOVING_AZ MOVING MOVING_AZ \nRPRT 0\n"),
            (b"v SPEED\n", b"3\n")),
           asked_in_words, {"info": "Dummy rotator", "status_flags": "MOVING MOVING_AZ", "speed_level": 3.0}),
    Golden("no dump_state", ((b"\\dump_state\n", b"RPRT -4\n"), (b"p\n", b"350.0\r\n12.5\r\n")),
           lambda rotator: (met(rotator).facts.cable, rotator.features), (None, {})),
)  # fmt: skip
"""As docs/reference/rotctl.md has them: measured at Hamlib's 4.5.4 and 4.7.2."""


def bench_of(options, **more):
    return MachineBench(
        "rotctl", server(f"seed=1&az=100&el=30&{options}"), stops=STOPS,
        console=ConsoleScene("_", "Dummy rotator", "P 200 40"), goldens=GOLDENS, **more,
    )  # fmt: skip


@pytest.fixture
def bench():
    return bench_of("min_az=-180")


class TestHamlibRotator(Contract):
    pass


class TestServerThatTellsNoRanges(Contract):
    """As the Discovery Drive: nothing but `p` and `P` is known, and no word is said of anything else."""

    @pytest.fixture
    def bench(self):
        options = "min_az=0&max_az=360&dump_state=silent&stop=ignore&knows=pP&code_space=1"
        stops = (replace(STOPS[0], twin=server("seed=1&az=100&el=30")), STOPS[1])
        return MachineBench(
            "rotctl", server(f"seed=1&az=100&el=30&{options}"), stops=stops,
            console=ConsoleScene("p", "100.00", "P 200 40"), ready_s=30.0,
        )  # fmt: skip


class TestServerOfTheOldForm(Contract):
    """Bare numbers, whole degrees, a position in two segments, and a range of less than a turn and a half."""

    @pytest.fixture
    def bench(self):
        return bench_of("min_az=-90&max_az=400&dump_state=bare&split=1&range_code=-21&flags_twice=1")
