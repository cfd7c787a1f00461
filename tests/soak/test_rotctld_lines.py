"""A million lines of a client that has gone mad: each is answered, whole, and the conversation goes on."""

from __future__ import annotations

import random

import pytest
from birdcage.rotctld.conversation import ClientConversation
from night import by_night

from tests.rotctld.scripted_rotor import ScriptedRotor

WORDS = [
    "p", "P", "S", "K", "M", "R", "L", "D", "_", "s", "w", "v", "V", "SPEED", "?", "1", "10", "20.5", "nan", "+p", ";S",
    "\\dump_state", "\\get_pos", "set_pos", "8", "UP", "p;p", "\\nonsense", "GET", "/", "#", "x" * 200,
]  # fmt: skip


def line(dice):
    """Return noise, or words of the protocol in any order, often with one byte changed."""
    kind = dice.random()
    if kind < 0.2:
        return dice.randbytes(dice.randrange(64))
    said = " ".join(dice.choices(WORDS, k=dice.randrange(1, 6))).encode()
    if kind < 0.6:
        return said
    place = dice.randrange(len(said))
    return said[:place] + dice.randbytes(1) + said[place + 1 :]


@pytest.mark.soak
@pytest.mark.parametrize("count", by_night([100_000, 1_000_000], 1))
def test_a_million_random_lines(count):
    dice, rotor, answered = random.Random(16), ScriptedRotor(), 0
    conversation = ClientConversation(rotor)
    for _ in range(count):
        conversation.feed(line(dice) + b"\n")
        replies = conversation.take_replies()
        assert all(reply.endswith(b"\n") and len(reply) < 2048 for reply in replies)
        answered += len(replies)
        rotor.calls.clear()
        if conversation.closed:
            conversation = ClientConversation(rotor)
    assert answered > count
    conversation.feed(b"\np\np\n")
    assert conversation.take_replies()[-1] == b"123.46\n45.68\n"
