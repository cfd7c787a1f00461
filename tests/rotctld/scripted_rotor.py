"""A dish that notes what one client asks of it, for tests of the protocol without a station."""

from __future__ import annotations

from concurrent.futures import Future

from birdcage.rotctld.conversation import ClientConversation
from birdcage.rotctld.rotor import Advertised, SignalCounts
from birdcage.rotctld.rprt import RotctldError


def done(value):
    future = Future()
    future.set_result(value)
    return future


class ScriptedRotor:
    def __init__(self):
        self.calls = []
        self.where = (123.456, 45.678)
        self.flags = ()
        self.range = Advertised()
        self.able = ("rssi", "lna")
        self.refuses = {}
        self.exchanges = {"read_signal": done(SignalCounts(10, 512, 498)), "enable_lna": done(None), "send": done(())}

    def _noted(self, name, *arguments):
        self.calls.append((name, *arguments))
        if name in self.refuses:
            raise RotctldError(self.refuses[name], f"{name} is refused by this test.")
        return self.exchanges.get(name)

    def position(self):
        self._noted("position")
        return self.where

    def set_position(self, az_deg, el_deg):
        self._noted("set_position", az_deg, el_deg)

    def stop(self):
        self._noted("stop")

    def park(self):
        self._noted("park")

    def move(self, direction, speed):
        self._noted("move", direction, speed)

    def status(self):
        self._noted("status")
        return self.flags

    def name(self):
        return "Winegard Trav'ler RS-485 Rotor"

    def advertised(self):
        return self.range

    def abilities(self):
        return self.able

    def read_signal(self, reads):
        return self._noted("read_signal", reads)

    def enable_lna(self):
        return self._noted("enable_lna")

    def send(self, line):
        return self._noted("send", line)

    @property
    def moves(self):
        """What moves the dish or switches something, of all that was asked."""
        return [call for call in self.calls if call[0] not in ("position", "status")]


def talk(said, rotor=None):
    """Return all replies to what one client says, and nothing more."""
    conversation = ClientConversation(rotor or ScriptedRotor())
    conversation.feed(said)
    conversation.end_of_input()
    return conversation.take_replies()
