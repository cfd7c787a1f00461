"""Live records of a Carryout of 2003, from a stream in any pieces."""

from __future__ import annotations

import re

import pytest
from birdcage.base.clock import VirtualClock
from birdcage.protocol.carryout.records import LiveRecord, RecordReader
from birdcage.sim.port import open_port
from hypothesis import given
from hypothesis import strategies as st

MIDDLE = st.text(st.characters(min_codepoint=33, max_codepoint=126), max_size=8)
"""What may stand between: a token of printed characters, perhaps empty."""


def read(*pieces: bytes) -> list[tuple[float, float]]:
    reader = RecordReader()
    return [(each.az_deg, each.el_deg) for piece in pieces for each in reader.feed(piece)]


@st.composite
def streams(draw) -> tuple[bytes, list[LiveRecord]]:
    """A move as a dish with some layout prints it, and what is in it."""
    one, two, three, tail = draw(MIDDLE), draw(MIDDLE), draw(MIDDLE), draw(st.sampled_from(["", ",", " deg", "!"]))
    end = draw(st.sampled_from(["\r\n", "\r", "\n"]))
    places = draw(st.lists(st.tuples(st.integers(0, 36000), st.integers(1000, 9999)), max_size=6))
    text = "target\r\nTARGET>g 180.0 45.0\r\n" + "".join(
        f"az = {az} {one} {two} el {three} {el}{tail}{end}" for az, el in places
    )
    return f"{text}TARGET>".encode(), [LiveRecord(az / 100.0, el / 100.0) for az, el in places]


@given(streams(), st.data())
def test_however_the_stream_is_split_all_records_come_once_and_in_order(stream, data):
    text, records = stream
    cuts = sorted(data.draw(st.lists(st.integers(0, len(text)), max_size=12)))
    reader, found = RecordReader(), []
    for start, end in zip([0, *cuts], [*cuts, len(text)], strict=True):
        found += reader.feed(text[start:end])
    assert found == records


@given(streams())
def test_byte_by_byte_is_the_same(stream):
    text, records = stream
    reader = RecordReader()
    assert [each for byte in text for each in reader.feed(bytes((byte,)))] == records


@given(st.lists(st.binary(max_size=60), max_size=20))
def test_bytes_that_are_no_text_raise_nothing_and_are_forgotten(pieces):
    reader = RecordReader()
    for piece in pieces:
        reader.feed(piece)
    assert reader.feed(b"\r\naz = 17000   el = 4000\r\n")[-1:] == [LiveRecord(170.0, 40.0)]


@given(streams(), st.data())
def test_a_byte_of_noise_loses_records_and_makes_none(stream, data):
    text, records = stream
    at = data.draw(st.integers(0, len(text)))
    noise = data.draw(st.sampled_from([b"\xff", b"\x00", b"~", b"\x80\x81"]))
    found = RecordReader().feed(text[:at] + noise + text[at:])
    rest = iter(records)
    assert all(each in rest for each in found)
    assert len(found) >= len(records) - 2


@pytest.mark.parametrize("record", [
    "az = 17000   el = 4000",
    "az = 17000 ,  el = 4000,",
    "AZ 17000 raw 40000 el : 4000deg",
    "17000 a b el c 4000",
    "az = 17000\r , - el = 4000",
])  # fmt: skip
def test_layouts_that_the_public_program_would_read(record):
    assert read(f"g 170 40\r\n{record}\r\n".encode()) == [(170.0, 40.0)]


@pytest.mark.parametrize("record", [
    "az = 170.00   el = 40.00",
    "az = 17000 el = 4000",
    "az = 17000    el = 4000",
    "az = 17000   EL = 4000",
    "az = 17000   elevation = 4000",
    "az = 17000   el = -4000",
    "az = 17000   el = 40000",
    "az = 17000   el = 400",
    "az = x17000   el = 4000",
    "az = -17000   el = 4000",
    "az = 99000   el = 4000",
    "az = 17000   el 4000",
])  # fmt: skip
def test_what_is_no_record(record):
    assert read(f"\r\n{record}\r\n".encode()) == []


def test_a_number_that_is_cut_at_either_end_is_none():
    assert read(b"7000   el = 4000\r\n") == []
    assert read(b" 17000   el = 40") == []
    assert read(b" 17000   el = 40", b"00") == []
    assert read(b" 17000   el = 40", b"00", b"\r") == [(170.0, 40.0)]


def test_lines_that_a_console_has_cut_and_what_is_to_be_forgotten():
    reader = RecordReader()
    assert reader.feed_line("az = 17000   el = 4000") == [LiveRecord(170.0, 40.0)]
    assert reader.feed(b"\r\naz = 17000   el") == []
    reader.forget()
    assert reader.feed(b" = 4000\r\n") == []


@pytest.mark.parametrize("options", ["seed=1", "record_end=cr", "record=AZ {az} - - el -> {el};", "second_move=block",
                                     "prompt_when=at_once", "pace_baud=57600"])  # fmt: skip
def test_what_a_simulated_dish_tells_is_where_it_was(options):
    clock = VirtualClock()
    port = open_port(f"carryout?speed=10&{options}", clock=clock)
    port.write(b"target\rg 200 50\r")
    reader, seen = RecordReader(), []
    for _ in range(500):
        clock.advance(0.01)
        truth = port.device.truth()
        for record in reader.feed(port.read()):
            seen.append(record)
            assert (record.az_deg, record.el_deg) == pytest.approx((truth.az_deg, truth.el_deg), abs=0.25)
    assert seen[-1] == LiveRecord(200.0, 50.0)
    assert len(seen) > 5
    assert not re.search(r"[^\x00-\x7f]", repr(seen))
