"""Which program a client seems to be: sessions as they were recorded, or read in sources."""

from __future__ import annotations

from pathlib import Path

import pytest
from birdcage.rotctld.program_guess import ProgramGuess
from birdcage.rotctld.session_lines import SessionDirection, parse_session_line
from birdcage.station.network_state import NetworkProgram


@pytest.mark.parametrize(("session", "program"), [
    ("0.1 p, 0.8 P 174.43 29.83, 0.9 p, 1.6 P 174.29 30.06", NetworkProgram.GPREDICT),
    ("0.1 p, 0.9 p, 1.7 p, 2.5 p", NetworkProgram.GPREDICT),
    ("0.0 p, 0.01 P 10.00 20.00, 1.0 p, 1.01 P 11.00 20.00", NetworkProgram.SATDUMP),
    ("0.0 \\dump_state, 0.01 p", NetworkProgram.HAMLIB),
    ("0.0 \\dump_state, 0.01 p, 3.0 p, 6.0 p", NetworkProgram.SATNOGS),
    ("0.0 p, 1.0 P 123.457 45.6781, 2.0 p", NetworkProgram.SDRANGEL),
    ("0.0 P 10.1 20.2, 1.0 P 10.5 20.3, 2.0 P 11 20.4", NetworkProgram.LOOK4SAT),
    ("0.0 set_pos 10.1 20.2, 1.0 set_pos 10.5 20.3, 2.0 set_pos 11.0 20.4", NetworkProgram.LOOK4SAT),
    ("0.0 p, 7.0 p, 20.0 P 10 20, 22.0 p", NetworkProgram.UNKNOWN),
    ("0.0 GET / HTTP/1.1, 0.1 Host: x", NetworkProgram.UNKNOWN),
])  # fmt: skip
def test_it_is_known_by_how_it_talks(session, program):
    guess = ProgramGuess()
    for each in session.split(", "):
        at, _, command = each.partition(" ")
        guess.hear(command, float(at))
    assert guess.program is program


def test_gpredict_is_known_by_its_recording_and_taken_for_no_other():
    recording = Path(__file__).parent / "recordings" / "gpredict-2.3-across-north.txt"
    lines = [parse_session_line(line) for line in recording.read_text("ascii").splitlines()]
    guess, guessed = ProgramGuess(), []
    for line in lines:
        if line.direction is SessionDirection.CLIENT:
            guess.hear(line.data.decode("ascii").strip(), line.utc.timestamp())
            guessed.append(guess.program)
    assert set(guessed) == {NetworkProgram.UNKNOWN, NetworkProgram.GPREDICT}
    assert guessed[3:] == [NetworkProgram.GPREDICT] * len(guessed[3:])
