"""The codec: how the stream is split can't matter, and only a known token at a line start is a prompt."""

from __future__ import annotations

from birdcage.console.codec import LONGEST_LINE, Codec
from birdcage.console.dialect import ConsoleDialect
from birdcage.console.events import Reply, ReplyLine, Stray, StrayPrompt
from hypothesis import given
from hypothesis import strategies as st

DIALECT = ConsoleDialect(prompts={"root": "TRK>", "mot": "MOT>", "dvb": "DVB>"})
TEXT = st.lists(
    st.sampled_from(
        [
            b"MOT>",
            b"TRK>",
            b"a\r\n",
            b"a",
            b"\r",
            b"\n",
            b"\r\n",
            b"?\r\n",
            b"Enter <mot> - MOT>\n",
            b"\xff\x00",
            b"7",
            b"\x1b[32m",
            b"\x1b[",
        ]
    ),
    max_size=25,
).map(b"".join)


def events_of(data: bytes, cuts: list[int], marks: list[tuple[int, str | None]]) -> list:
    """Feed `data` in pieces; at each mark a command is expected, or, for None, idle is fed."""
    codec, events, at = Codec(DIALECT), [], 0
    for position in sorted({*cuts, *(mark for mark, _ in marks), len(data)}):
        events += codec.feed(data[at:position])
        at = position
        for mark, command in marks:
            if mark == position:
                if command is None:
                    events += codec.idle()
                else:
                    codec.expect(command)
    return [*events, codec.owed, codec.noise]


@given(st.data(), TEXT)
def test_the_split_does_not_matter(data, stream):
    place = st.integers(0, len(stream))
    marks = data.draw(st.lists(st.tuples(place, st.sampled_from(["a", "?", "", None])), max_size=6))
    cuts = data.draw(st.lists(place, max_size=10))
    whole = events_of(stream, [], marks)
    assert events_of(stream, cuts, marks) == whole
    assert events_of(stream, list(range(len(stream))), marks) == whole


def test_help_that_holds_angle_brackets_is_read_whole():
    codec = Codec(DIALECT)
    codec.expect("?")
    text = b"?\r\nhelp [<command>]\r\nEnter <dvb> - DVB Tuner\r\n a > b MOT>\r\nMOT>"
    reply = codec.feed(text)[-1]
    assert reply == Reply(
        "?", ("help [<command>]", "Enter <dvb> - DVB Tuner", " a > b MOT>"), menu="mot", token="MOT>", ticket=1
    )


def test_a_prompt_before_the_echo_is_stale():
    codec = Codec(DIALECT)
    codec.expect("a")
    assert codec.feed(b"TRK>a\r\n1\r\nMOT>") == [
        StrayPrompt("root"),
        ReplyLine("1", 1),
        Reply("a", ("1",), "mot", "MOT>", 1),
    ]


def test_what_nobody_asked_for_is_stray():
    assert Codec(DIALECT).feed(b"Ant ID\r\nTRK>") == [Stray("Ant ID"), StrayPrompt("root")]


def test_a_lost_command_does_not_hold_up_the_next():
    codec = Codec(DIALECT)
    codec.expect("a")
    codec.expect("a 0 12")
    assert codec.feed(b"a 0 12\r\nAngle = 12.00\r\nMOT>")[-1].command == "a 0 12"
    assert codec.owed == 0


def test_an_echo_in_the_middle_of_an_earlier_reply_belongs_to_the_next():
    codec = Codec(DIALECT)
    codec.expect("h 0")
    codec.feed(b"h 0\r\n")
    codec.expect("a 0 12")
    replies = [e for e in codec.feed(b"a 0 12\r\nwrap\r\nMOT>Angle = 12\r\nMOT>") if isinstance(e, Reply)]
    assert [(r.command, r.lines) for r in replies] == [("h 0", ("wrap",)), ("a 0 12", ("Angle = 12",))]


def test_idle_lets_a_key_and_the_stream_that_it_ended_share_a_prompt():
    codec = Codec(DIALECT)
    codec.expect("agc")
    codec.expect("")
    codec.feed(b"agc\r\n5\r\nDVB>")
    assert codec.owed == 1
    assert codec.idle() == [Reply("", (), "dvb", "DVB>", 2)]


def test_an_old_prompt_answers_nothing_new():
    codec = Codec(DIALECT)
    codec.feed(b"MOT>")
    codec.expect("")
    assert codec.idle() == []


def test_a_console_without_echo_answers_by_its_prompt():
    codec = Codec(ConsoleDialect(prompts={"root": "TRK>"}, echo=False))
    codec.expect("a")
    assert codec.feed(b"1\r\nTRK>")[-1] == Reply("a", ("1",), "root", "TRK>", 1)


def test_a_flood_of_noise_takes_no_memory():
    codec = Codec(DIALECT)
    assert codec.feed(b"\xff" * 100_000) == []
    assert codec.noise == 100_000
    (stray,) = codec.feed(b"\r")
    assert len(stray.text) == LONGEST_LINE


def test_noise_before_an_echo_does_not_hide_it():
    codec = Codec(DIALECT)
    codec.expect("a")
    events = codec.feed(b"\x91\xfea\r\nAngle[0] = 1.00\r\nMOT>")
    assert [event.lines for event in events if isinstance(event, Reply)] == [("Angle[0] = 1.00",)]
    assert codec.noise == 2
