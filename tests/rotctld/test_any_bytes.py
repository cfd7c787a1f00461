"""Properties: any bytes, cut anywhere, give the same replies, never raise, and move nothing by chance."""

from __future__ import annotations

import re
from itertools import pairwise

from birdcage.rotctld.conversation import ClientConversation
from hypothesis import example, given
from hypothesis import strategies as st

from .scripted_rotor import ScriptedRotor, talk

NUMBER = st.decimals(-999, 999, places=2).map(str)
ANGLES = st.tuples(NUMBER, NUMBER).map(" ".join)
COMMANDS = st.one_of(
    st.sampled_from(["p", "S", "K", "s", "_", "\\dump_state", "\\get_pos", "\\stop", "set_pos 1 2", "M 8 50", "M UP -1",
                     "R 5", "\\get_caps", "v ?", "V SPEED 30", "\\get_conf min_az", "C timeout 1", "w AZ", "3", "1",
                     "P nan 3", "P 10,5 20,5", "l JO62", "\\reset 1", "\\pause 1"]),
    ANGLES.map("P {}".format), ANGLES.map("\\set_pos {}".format), ANGLES.map("P{}".format), NUMBER.map("A {}".format),
)  # fmt: skip
PREFIXES = st.sampled_from(["", "+", ";", "|", ","])
WELL_FORMED = st.tuples(PREFIXES, COMMANDS).map("".join)
ENDS = st.sampled_from([b"\n", b"\r\n", b"\r"])
PIECES = st.one_of(
    st.binary(max_size=40),
    st.tuples(WELL_FORMED.map(str.encode), ENDS).map(b"".join),
    st.sampled_from([b"P 1", b"\n", b" ", b"\r", b"K", b"S\n", b";", b"q", b"# ", b"GET / HTTP/1.1\r\n", b"x" * 1100]),
    st.text("pPSKMRL1;+ \n\r.,-_\\#", max_size=30).map(str.encode),
)
STREAMS = st.lists(PIECES, max_size=12).map(b"".join)
MOVES = re.compile(
    rb"(?:^|[ \t\v\f])[^\w\s\\#]?(?:\\?(?:set_pos)|\\?(?:stop)|\\(?:park|move)|[PM][-+.,\d]?|[KS])"
    rb"(?=[ \t\v\f+;|,\d.]|$)|[+;|,][KS](?=[+;|, \t\v\f]|$)"
)
"""What alone may move the dish: a whole token at the beginning of a line, or behind a blank."""


def pieces(said, cuts):
    edges = [0, *sorted(cut % (len(said) + 1) for cut in cuts), len(said)]
    return [said[begin:end] for begin, end in pairwise(edges)]


@given(STREAMS, st.lists(st.integers(0, 10_000), max_size=8))
@example(b"P 1\r\n2\r\np", [4, 5])
@example(b"x" * 1025 + b"\r\np\n", [1024, 1025, 1026])
def test_any_cut_gives_the_same_replies(said, cuts):
    whole, cut = ScriptedRotor(), ScriptedRotor()
    expected = talk(said, whole)
    conversation = ClientConversation(cut)
    replies = []
    for piece in pieces(said, cuts):
        conversation.feed(piece)
        replies += conversation.take_replies()
    conversation.end_of_input()
    assert replies + conversation.take_replies() == expected
    assert cut.calls == whole.calls


@given(STREAMS)
def test_byte_for_byte_gives_the_same_replies(said):
    conversation = ClientConversation(ScriptedRotor())
    for byte in said:
        conversation.feed(bytes([byte]))
    conversation.end_of_input()
    assert conversation.take_replies() == talk(said)


@given(STREAMS)
def test_whole_replies_and_no_motion_that_was_not_said(said):
    rotor = ScriptedRotor()
    for reply in talk(said, rotor):
        assert reply.endswith(b"\n")
        assert len(reply) < 2048
    moved = [call for call in rotor.calls if call[0] in ("set_position", "park", "stop", "move")]
    said_so = sum(len(MOVES.findall(line)) for line in re.split(rb"[\r\n]", said))
    assert len(moved) <= said_so


@given(st.lists(st.tuples(WELL_FORMED, ENDS), max_size=20))
def test_each_well_formed_command_is_answered_once(commands):
    replies = talk(b"".join(command.encode() + end for command, end in commands))
    assert len(replies) == len(commands)


@given(st.lists(WELL_FORMED.filter(lambda command: "w AZ" not in command and "nan" not in command), max_size=6))
def test_commands_on_one_line_are_answered_one_by_one(commands):
    line = " ".join(commands).encode() + b"\n"
    if len(line) <= 1024 and not line.rstrip().endswith(b"?"):
        assert talk(line) == talk(b"".join(command.encode() + b"\n" for command in commands))
