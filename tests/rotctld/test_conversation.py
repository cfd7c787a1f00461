"""A conversation whose commands wait for the dish, what it tells of itself, and what bounds it."""

from __future__ import annotations

from concurrent.futures import Future

from birdcage.rotctld.conversation import BACKLOG, ClientConversation
from birdcage.rotctld.rprt import RotctldError, Rprt

from .scripted_rotor import ScriptedRotor

HERE = b"123.46\n45.68\n"


def waiting():
    """Return a conversation that waits for the dish, with what it waits for."""
    rotor = ScriptedRotor()
    rotor.exchanges["send"] = Future()
    conversation = ClientConversation(rotor)
    conversation.feed(b"p w AZ\nP 1 2\n")
    assert conversation.take_replies() == [HERE]
    assert conversation.waiting is rotor.exchanges["send"]
    return conversation, rotor, rotor.exchanges["send"]


def test_commands_wait_behind_one_that_waits_for_the_dish():
    conversation, rotor, answer = waiting()
    conversation.feed(b"p\n")
    conversation.resume()
    assert conversation.take_replies() == []
    assert ("set_position", 1, 2) not in rotor.calls
    answer.set_result(["AZ 1"])
    assert conversation.take_replies() == []
    conversation.resume()
    assert conversation.take_replies() == [b"AZ 1\n", b"RPRT 0\n", HERE]
    assert conversation.waiting is None


def test_each_of_two_in_a_row_is_waited_for():
    conversation, rotor, answer = waiting()
    rotor.exchanges["send"] = second = Future()
    conversation.feed(b"w EL\n")
    answer.set_result(["AZ 1"])
    conversation.resume()
    assert conversation.waiting is second
    second.set_result(["EL 2"])
    conversation.resume()
    assert conversation.take_replies() == [b"AZ 1\n", b"RPRT 0\n", b"EL 2\n"]


def test_an_exchange_that_fails_is_its_code_and_the_rest_goes_on():
    for error, reply in (
        (RotctldError(Rprt.ERJCTED, "no"), b"RPRT -9\n"),
        (RuntimeError("a mistake of ours"), b"RPRT -6\n"),
    ):
        conversation, _, answer = waiting()
        answer.set_exception(error)
        conversation.resume()
        assert conversation.take_replies() == [reply, b"RPRT 0\n"]


def test_an_exchange_that_was_taken_back_is_eio():
    conversation, _, answer = waiting()
    answer.cancel()
    conversation.resume()
    assert conversation.take_replies() == [b"RPRT -6\n", b"RPRT 0\n"]


def test_an_answer_that_does_not_come_is_etimeout_and_a_late_one_is_dropped():
    conversation, _, answer = waiting()
    conversation.give_up()
    assert conversation.take_replies() == [b"RPRT -5\n", b"RPRT 0\n"]
    answer.set_result(["AZ 1"])
    conversation.resume()
    conversation.give_up()
    assert conversation.take_replies() == []


def test_what_a_client_sends_while_it_waits_is_bounded_and_its_loss_is_told_once():
    conversation, _, answer = waiting()
    for _ in range(100):
        conversation.feed(b"P 3 4\n" * 1000)
    assert conversation._queued <= BACKLOG
    assert len(conversation._queue) <= BACKLOG // 5 + 1
    answer.set_result(["AZ 1"])
    conversation.resume()
    replies = conversation.take_replies()
    assert replies[-1] == b"RPRT -1\n"
    assert set(replies[1:-1]) == {b"RPRT 0\n"}
    assert BACKLOG // 5 - 2 <= len(replies) <= BACKLOG // 5 + 2
    conversation.feed(b"p\n")
    assert conversation.take_replies() == [HERE]


def test_memory_of_a_line_without_end_is_bounded():
    conversation = ClientConversation(ScriptedRotor())
    for _ in range(1000):
        conversation.feed(b"\x00" * 4096)
    assert conversation.take_replies() == [b"RPRT -1\n"]
    assert len(conversation._lines._begun) == 0


def test_a_half_closed_connection_gets_its_replies():
    conversation, _, answer = waiting()
    conversation.feed(b"P 1")
    conversation.end_of_input()
    answer.set_result(())
    conversation.resume()
    assert conversation.take_replies() == [b"RPRT 0\n", b"RPRT 0\n", b"RPRT -1\n"]
    assert not conversation.closed


def test_q_ends_it_and_nothing_after_it_is_read():
    rotor = ScriptedRotor()
    conversation = ClientConversation(rotor)
    conversation.feed(b"p\nq\nP 1 2\n")
    conversation.feed(b"K\n")
    conversation.end_of_input()
    assert conversation.take_replies() == [HERE]
    assert conversation.closed
    assert len(conversation._queue) == 0
    assert rotor.calls == [("position",)]


def test_the_log_says_why_a_command_was_not_done(caplog):
    caplog.set_level("DEBUG")
    rotor = ScriptedRotor()
    rotor.refuses = {"park": Rprt.ENAVAIL}
    conversation = ClientConversation(rotor)
    conversation.feed(b"K\nzzz\nM 8 101\n")
    assert [record.message for record in caplog.records] == [
        "park: park is refused by this test.",
        "unknown: Unknown command. The rest of its line was dropped.",
        "move: 8 101 Speed 101 is outside 1 to 100. Send 1 to 100, or -1: unchanged.",
    ]
