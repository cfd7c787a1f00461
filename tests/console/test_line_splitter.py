"""Plain lines: any run of CR and LF ends one, and how the stream was split can't matter."""

from __future__ import annotations

from birdcage.console.line_splitter import LONGEST_LINE, UNREADABLE, HeardLine, LineSplitter
from hypothesis import given
from hypothesis import strategies as st

PIECES = [b"AZ180.0", b" EL45.0", b"\r", b"\n", b"\r\n", b"\n\r", b"\t", b"\xff\x00", b"\x1b[32m", b"\x1b[", b"q", b" "]
STREAM = st.lists(st.sampled_from(PIECES), max_size=25).map(b"".join)


def heard(data, cuts):
    splitter, lines, at = LineSplitter(), [], 0
    for position in sorted({*cuts, len(data)}):
        lines += [line.text for line in splitter.feed(data[at:position], float(position))]
        at = position
    return lines, splitter.unfinished, splitter.noise


@given(st.data(), STREAM)
def test_the_split_does_not_matter(data, stream):
    cuts = data.draw(st.lists(st.integers(0, len(stream)), max_size=10))
    whole = heard(stream, [])
    assert heard(stream, cuts) == whole
    assert heard(stream, range(len(stream))) == whole


@given(st.lists(st.text("AZEL0123456789.-+ ", min_size=1, max_size=12).filter(str.strip), max_size=6))
def test_every_line_end_is_one(texts):
    texts = [text.rstrip() for text in texts]
    for end in (b"\r", b"\n", b"\r\n"):
        stream = b"".join(text.encode() + end for text in texts)
        assert heard(stream, []) == (texts, "", 0)


@given(st.binary(max_size=200), st.lists(st.integers(0, 200), max_size=8))
def test_no_bytes_are_too_much_and_none_that_is_no_text_gets_through(data, cuts):
    lines, unfinished, noise = heard(data, [cut for cut in cuts if cut <= len(data)])
    assert all(line and all(" " <= letter <= "~" or letter == UNREADABLE for letter in line) for line in lines)
    assert "".join([*lines, unfinished]).count(UNREADABLE) <= noise


def test_a_line_has_the_time_of_its_first_byte():
    splitter = LineSplitter()
    assert splitter.feed(b"AZ1", 10.0) == []
    assert splitter.unfinished == "AZ1"
    assert splitter.feed(b"80.0\r", 10.5) == [HeardLine("AZ180.0", 10.0)]
    assert splitter.feed(b"\nEL45.0\n", 11.0) == [HeardLine("EL45.0", 11.0)]


def test_a_line_without_end_is_kept_up_to_a_length():
    splitter = LineSplitter()
    splitter.feed(b"7" * (LONGEST_LINE + 100), 0.0)
    (line,) = splitter.feed(b"\n", 1.0)
    assert (len(line.text), splitter.noise) == (LONGEST_LINE, 100)
