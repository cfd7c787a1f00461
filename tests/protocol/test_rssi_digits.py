"""A strength of signal that has lost or won a digit on its way is no reading."""

from __future__ import annotations

import pytest
from birdcage.base.clock import VirtualClock
from birdcage.base.errors import NoReply
from birdcage.link.link import Link
from birdcage.protocol.registry import get_protocol
from birdcage.sim.port import SimPort, open_device
from birdcage.sim.wire import DOUBLE, DROP, Byte


@pytest.mark.parametrize("happens", [DROP, DOUBLE])
def test_a_digit_too_few_or_too_many(happens):
    clock = VirtualClock()
    device = open_device("g2?seed=1", clock=clock)
    protocol = get_protocol("g2")
    protocol.attach(Link(SimPort(device, "sim:test"), clock), clock)
    true = protocol.get_rssi(10)
    heard = bytearray()

    def plan(value):
        heard.append(value)
        return happens if heard.endswith(b"avg: 4") else Byte()

    device.wire.to_host.set_plan(plan)
    with pytest.raises(NoReply) as error:
        protocol.get_rssi(10)
    assert error.value.reason == "garbage"
    device.wire.to_host.set_plan(None)
    assert protocol.get_rssi(10).average == pytest.approx(true.average, rel=0.1)
