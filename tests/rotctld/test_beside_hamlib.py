"""What does not depend on the machine is answered as Hamlib's own rotctld answers it, byte for byte."""

from __future__ import annotations

import random
import re

import pytest

from .hamlib_daemon import hamlib_daemon
from .scripted_rotor import ScriptedRotor, talk


@pytest.fixture(scope="module")
def hamlib():
    with hamlib_daemon() as ask:
        yield ask


def ours(said):
    rotor = ScriptedRotor()
    rotor.where = (0.0, 0.0)  # where the dummy begins
    rotor.name = lambda: "Dummy rotator"
    return b"".join(talk(said, rotor))


@pytest.mark.parametrize("said", [
    # computations
    "L -170.0 -85.0 12", "L 13.4 52.5 6", "L 13.4 52.5 5", "L 13.4 52.5 0", "L 13.4 52.5 14", "L 180 90 12",
    "L -180 -90 12", "L 540 90 4", "l JO62", "l JO62qm", "l jo62QM55", "l J", "l ZZ99", "l JO6", "l AA55AA00AA00BB",
    "D 10 30 30 0", "D 10 30 30.5 1", "D -10 -30 -30 0", "D 0 30 0 1", "d 10.508333", "d -10.508333", "d 180", "d -180",
    "d 540", "d 359.999999", "d -0.0", "d 1e3", "E 10 30.5 0", "E -10 30.5 1", "E 10 30.5 2", "E 10 -30.5 -2",
    "e 10.508333", "e -10.508333", "e 190", "B 13 52 -74 40", "B 13 52 13 52", "B 0 0 180 0", "B 0 90 0 -90",
    "B 0 91 0 0", "B 181 0 0 0", "B 0 0 0 45", "B 0 0 -90 0", "B 10 90 20 0", "B 0 0 0.05 0", "B 0 0 179.95 0",
    "B 0 0 179.999 0.001", "B 0 0 0.000001 0", "B 10 -90 20 0", "A 10", "A 190", "A -1",
    "A 361", "A 0", "A 180", "A 360", "A 1e1", "A +10", "A .5", "A nan", "a 1000", "a -1", "a 50000", "a 0",
    "A\n10", "B 13 52\n-74 40", "L\t1  2 \r\n 4",
    # forms
    "p", "\\get_pos", "p p", "p\np", "p # c\np", "# p", "p\r", "\n\n p \n", "p;p", "_", "\\get_info", "S", "\\stop",
    "U ?", "u ?", "X ?", "x ?", "x FOO", "u FOO", "v FOO", "X FOO 1", "C foo 1", "\\pause 0", "s", "q", "Q", "p q p",
    "P abc 10", "M 3 50", "M 10 10",
])  # fmt: skip
def test_our_answer_is_hamlibs(hamlib, said):
    for form in ("", "+", ";", "|"):
        line = f"{form}{said}\n".encode()
        if said.startswith(("#", "\n")) and form:
            continue
        assert ours(line) == hamlib(line), line


@pytest.mark.parametrize("separator", ["?", ":", ",", "!", "~", "$"])
def test_any_punctuation_parts_the_records(hamlib, separator):
    said = f"{separator}p\n{separator}S\n".encode()
    assert ours(said) == hamlib(said)


@pytest.fixture(scope="module")
def moving_hamlib():
    with hamlib_daemon() as ask:
        yield ask


@pytest.mark.parametrize("said", [
    "P 11\n22", "P 10 20", "P10 20", "\\set_pos 1 2", "P 1 2 P 3 4", "P 1e1 2", "P -10.5 +20", "K", "\\park", "M 8 50",
    "M UP 50", "M 8 -1", "\\move 2 5",
])  # fmt: skip
def test_a_motion_is_acknowledged_as_hamlib_does(moving_hamlib, said):
    for form in ("", "+", ";", "|"):
        line = f"{form}{said}\n".encode()
        assert ours(line) == moving_hamlib(line), line


def test_without_a_final_newline_the_dummy_says_nothing_more_than_we(hamlib):
    assert ours(b"p\n_") == hamlib(b"p\n_\n")


def test_the_shape_of_dump_state_is_hamlibs(hamlib):
    for form in (b"", b"+", b";"):
        theirs = hamlib(form + b"\\dump_state\n")
        model = b"Rotor Model: %d" if form else b"1\n%d\n"
        assert model % 1 in theirs
        assert ours(form + b"\\dump_state\n") == theirs.replace(model % 1, model % 2)


def test_the_words_of_dump_caps_are_hamlibs(hamlib):
    theirs = [re.match(rb"[^:]*:?\t*", line)[0] for line in hamlib(b"1\n").splitlines()]
    lines = ours(b"1\n").splitlines()
    assert lines[-1] == b"RPRT 0"
    missing = [line for line in lines if re.match(rb"[^:]*:?\t*", line)[0] not in theirs]
    assert missing == []
    for form in (b"+", b";"):
        opening, _, rest = hamlib(form + b"1\n").partition(b"Caps dump")
        assert ours(form + b"1\n") == opening + ours(b"1\n")
        assert rest.endswith(b"Overall backend warnings: 0\nRPRT 0\n")


NUMBERS = random.Random(1)


def places(count):
    return [f"{NUMBERS.uniform(-180, 180):.6f} {NUMBERS.uniform(-90, 90):.6f}" for _ in range(count)]


def test_computations_of_anywhere_on_the_earth_are_hamlibs(hamlib):
    here, there = places(300), places(300)
    lines = [f"B {one} {other}" for one, other in zip(here, there, strict=True)]
    lines += [f"L {place} {2 + 2 * (index % 6)}" for index, place in enumerate(here)]
    lines += [f"l {''.join(talk(f'L {place} 10'.encode())[0].decode().split())}" for place in there]
    lines += [f"{letter} {NUMBERS.uniform(-400, 400):.7f}" for letter in "deda" for _ in range(100)]
    lines += [f"A {NUMBERS.uniform(0, 360):.7f}" for _ in range(100)]
    lines += [f"D {NUMBERS.randint(-180, 180)} {NUMBERS.randint(0, 59)} {NUMBERS.uniform(0, 60):.3f} {sign}"
              for sign in (0, 1) for _ in range(50)]  # fmt: skip
    said = "".join(f"+{line}\n" for line in lines).encode()
    assert ours(said).splitlines() == hamlib(said).splitlines()
