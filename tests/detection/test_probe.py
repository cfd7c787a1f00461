"""One bare Enter at one baud rate: what is sent, what it is told apart as, and that no rate makes a `q` of it."""

from __future__ import annotations

import itertools

import pytest
from birdcage.base.clock import VirtualClock
from birdcage.base.errors import Stopped
from birdcage.base.wake import Wake
from birdcage.detection.probe import LISTEN_S, USUAL_BAUDS, BaudFinding, Saw, judge, probe

from tests.console.scripted import Dish

TOKENS = ("TRK>", "MOT>")


@pytest.mark.parametrize(
    ("heard", "saw"),
    [
        (b"", Saw.SILENCE),
        (b"\r", Saw.ECHO),
        (b"\r\n", Saw.ECHO),
        (b"\r\nTRK>", Saw.PROMPT),
        (b"TRK>", Saw.PROMPT),
        (b"\x00\xff\xfe\xfd\r\nTRK>", Saw.PROMPT),
        (b"Unknown command\r\nMOT>\r\n", Saw.PROMPT),
        (b"\r\nODU> ", Saw.PROMPT),
        (b"\r\n>", Saw.PROMPT),
        (b"\r\nEnter <dvb> - DVB Tuner\r\n", Saw.TEXT),
        (b"Bootloader v1.01\r\nMotor init", Saw.TEXT),
        (b"AT\r\nAT\r\nATE1", Saw.TEXT),
        (b"\x80\xfe\x00\xfc\x1c", Saw.GARBAGE),
        (b"\x80\xfeabc\x00\xfc\x1c", Saw.GARBAGE),
        (b"\x80\xfe\x00\xfc\r>", Saw.GARBAGE),
        (b"\x00", Saw.GARBAGE),
        (b">", Saw.GARBAGE),
        (b"x\r", Saw.GARBAGE),
    ],
)
def test_what_came_is_told_apart(heard, saw):
    assert judge(heard, TOKENS) is saw


def test_a_prompt_that_must_be_learnt_is_known_by_its_shape_alone():
    assert judge(b"\r\nHAL>", ("",)) is Saw.PROMPT
    assert judge(b"Loc: NoGPS\r\n", ("",)) is Saw.TEXT


def test_one_enter_is_sent_and_a_question_mark_to_the_prompt_that_answers():
    clock = VirtualClock()
    dish = Dish(clock)
    found = probe(dish, clock, 115200, tokens=TOKENS)
    assert dish.written == b"\r?\r"
    assert (found.saw, found.sample, found.count, found.prompt) == (Saw.PROMPT, "TRK>", 6, "TRK>")
    assert found.waited_s < LISTEN_S


def test_only_enter_is_sent_where_no_prompt_answers():
    clock = VirtualClock()
    dish = Dish(clock)
    dish.say("Bootloader v1.01\r\nMotor init")
    dish.muted = True
    assert probe(dish, clock, 115200, tokens=TOKENS).listed == frozenset()
    assert dish.written == b"\r"


def test_a_prompt_that_another_program_has_left_there_answers_nothing():
    clock = VirtualClock()
    dish = Dish(clock)
    dish.say("Angle = 30.00\r\nMOT>")
    dish.muted = True
    found = probe(dish, clock, 57600, tokens=TOKENS)
    assert (found.saw, found.prompt, found.count) == (Saw.SILENCE, "", 0)
    assert dish.written == b"\r?\r\r"


def test_silence_is_waited_for_and_no_longer():
    clock = VirtualClock()
    dish = Dish(clock)
    dish.muted = True
    began = clock.monotonic()
    assert probe(dish, clock, 9600) == BaudFinding(9600, Saw.SILENCE, "", 0, LISTEN_S)
    assert clock.monotonic() - began == pytest.approx(LISTEN_S)


def test_the_sample_is_one_short_printable_line():
    clock = VirtualClock()
    dish = Dish(clock)
    dish.say("Bootloader v1.01\r\n\x80\x81 and so on\r\n" + 20 * "word ")
    found = probe(dish, clock, 115200)
    assert found.sample.startswith("Bootloader v1.01 .. and so on word")
    assert len(found.sample) == 60
    assert found.count > 100


def test_a_dish_that_streams_is_left_in_time():
    clock = VirtualClock()
    dish = Dish(clock)
    dish.menu = "dvb"
    dish.write(b"agc\r")
    clock.advance(1.0)
    dish.written = b""
    assert probe(dish, clock, 115200, tokens=("DVB>",)).saw is Saw.PROMPT
    assert dish.written == b"\r?\r"


def test_a_wake_may_end_it():
    clock, wake = VirtualClock(), Wake()
    wake.set()

    def on_wake():
        wake.clear()
        raise Stopped("STOP")

    with pytest.raises(Stopped):
        probe(Dish(clock), clock, 115200, wake=wake, on_wake=on_wake)
    wake.close()


def test_a_wake_that_means_nothing_does_not():
    clock, wake = VirtualClock(), Wake()
    wake.set()
    assert probe(Dish(clock), clock, 115200, tokens=TOKENS, wake=wake, on_wake=wake.clear).saw is Saw.PROMPT
    wake.close()


def misread(byte, sent_at, read_at, phase):
    """What a receiver at one rate makes of a byte sent at another: 8N1, least bit first, sampled in mid-bit."""
    bits = [0, *((byte >> n) & 1 for n in range(8)), 1]
    ratio = sent_at / read_at

    def level(time):  # in bits of the receiver, from the first edge; the line idles high
        index = int(time * ratio)
        return bits[index] if 0 <= index < len(bits) else 1

    out, time, end = [], 0.0, len(bits) / ratio
    while time < end:
        if level(time):
            time += 0.02
            continue
        samples = [level(time + n + 0.5 + phase) for n in range(10)]
        if samples[0] == 0:
            out.append(sum(bit << n for n, bit in enumerate(samples[1:9])))
        time += 10.0 if samples[9] else 9.5 + phase
        while time < end and not level(time) and not samples[9]:
            time += 0.02  # a break: the line must rise before the next start bit
    return out


def test_the_misreading_reads_right_at_the_right_rate():
    for byte in (0x0D, 0x71, 0x00, 0xFF):
        assert misread(byte, 9600, 9600, 0.0) == [byte]


@pytest.mark.parametrize(("sent_at", "read_at"), list(itertools.permutations(USUAL_BAUDS, 2)))
def test_at_no_wrong_rate_is_enter_taken_for_a_q_or_for_a_line(sent_at, read_at):
    for phase in (-0.3, -0.15, 0.0, 0.15, 0.3):
        taken = misread(0x0D, sent_at, read_at, phase)
        # With and without the eighth bit, in any case: and no CR or LF, which would end a line.
        assert not {byte & 0x7F for byte in taken} & {0x71, 0x51, 0x0D, 0x0A}, (phase, taken)
