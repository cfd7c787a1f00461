"""Terminal control sequences: a console that prints in colours is read like any other."""

from __future__ import annotations

import pytest
from birdcage.console.codec import Codec
from birdcage.console.diagnosis import no_reply
from birdcage.console.dialect import ConsoleDialect
from birdcage.console.escapes import without_escapes
from birdcage.console.events import Reply

DIALECT = ConsoleDialect(prompts={"root": "TRK>", "mot": "MOT>"})


@pytest.mark.parametrize("prompt", [b"\x1b[32mMOT>\x1b[0m", b"\x1b[2K\rMOT>", b"\x1b(B\x1b[m\x1b[1;38;5;208mMOT>"])
def test_colours_neither_hide_a_prompt_nor_a_number(prompt):
    codec = Codec(DIALECT)
    codec.expect("a")
    events = codec.feed(b"a\r\nAngle[0] = \x1b[1;33m180.00\x1b[0m\r\n" + prompt)
    assert events[-1] == Reply("a", ("Angle[0] = 180.00",), menu="mot", token="MOT>", ticket=1)
    assert codec.noise == 0


def test_an_escape_that_begins_no_sequence_is_noise_and_swallows_nothing():
    codec = Codec(DIALECT)
    codec.expect("a")
    assert codec.feed(b"\x1ba\r\n12\r\nMOT>")[-1].lines == ("12",)
    (stray,) = codec.feed(b"\n\x1b[" + b"1;" * 40 + b"\n")
    assert stray.text.endswith("1;" * 40), "no sequence is that long"


def test_a_cut_sequence_ends_with_its_line():
    codec = Codec(DIALECT)
    codec.feed(b"\x1b[3\r\n")
    codec.expect("a")
    assert codec.feed(b"a\r\n12\r\nMOT>")[-1].lines == ("12",)


def test_the_diagnosis_quotes_text_and_no_colours():
    told = str(no_reply("/dev/ttyUSB0", "a", b"\x1b[32mTRK\x1b[0m", 2.0))
    assert "`TRK`" in told
    assert without_escapes(b"\x1b[5D 2866\x1b[5D") == b" 2866"


def test_a_prompt_without_our_enter_names_the_missing_echo():
    told = str(no_reply("/dev/ttyUSB0", "", b"MOT>", 2.0))
    assert "half duplex" in told
    assert "may be starting" not in told
