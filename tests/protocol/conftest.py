"""A G2 dialect at the end of a scripted wire, and one at the end of a simulated one."""

from __future__ import annotations

import importlib.util
import sys
from pathlib import Path

import pytest
from birdcage.base.clock import VirtualClock
from birdcage.link.link import Link
from birdcage.protocol.g2 import CarryoutG2Protocol

spec = importlib.util.spec_from_file_location("protocol_script", Path(__file__).with_name("script.py"))
script = importlib.util.module_from_spec(spec)
sys.modules[spec.name] = script
spec.loader.exec_module(script)


@pytest.fixture
def clock():
    return VirtualClock()


@pytest.fixture
def play(clock):
    """Return a dialect that talks to a dish which says what is written down, and the port."""
    ports = []

    def make(text, line_end="\r\n"):
        port = script.ScriptedPort(clock, script.dialogue(text, line_end) if isinstance(text, str) else text)
        ports.append(port)
        protocol = CarryoutG2Protocol()
        protocol.attach(Link(port, clock), clock)
        return protocol, port

    yield make
    for port in ports:
        assert not port.steps, f"never asked for: {[step[0] for step in port.steps]}"


@pytest.fixture
def ask(play):
    """Ask one question in a menu of a dish that answers with these lines."""

    def make(menu, line, answer, question):
        text = "".join(f"{each}\r\n" for each in answer.split("\n") if each)
        g2, _port = play(
            [
                (b"\r", f"\r\n{CarryoutG2Protocol.dialect.prompts[menu]}".encode()),
                (f"{line}\r".encode(), f"{line}\r\n{text}{CarryoutG2Protocol.dialect.prompts[menu]}".encode("latin-1")),
            ]
        )
        return question(g2)

    return make


@pytest.fixture
def simulated(clock):
    """Return a dialect in front of a simulated dish, with options."""

    from birdcage.sim.port import SimPort, open_device

    def make(options="seed=1"):
        device = open_device(f"g2?{options}", clock=clock)
        protocol = CarryoutG2Protocol()
        protocol.attach(Link(SimPort(device, "sim:g2"), clock), clock)
        return protocol

    return make
