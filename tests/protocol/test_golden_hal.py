"""Reference transcripts T-HAL205, and the tokens of T-HAL000 that it shares, from the driver's side, byte by byte."""

from __future__ import annotations

import itertools
import math

import pytest
from birdcage.base.clock import VirtualClock
from birdcage.protocol import HAL205Protocol
from birdcage.rotator.values import Position

HELP = {
    "root": ["motor", "ngsearch", "nvs", "os", "stow", "reboot", "q"],
    "motor": ["a", "g", "q"],
    "ngsearch": ["s", "q"],
    "nvs": ["d", "e", "s", "q"],
}
PROMPTS = {
    "named": {"root": "HAL>", "motor": "MOT>", "ngsearch": "NGS>", "nvs": "NVS>"},
    "alike": dict.fromkeys(HELP, ">"),
}
LAYOUTS = {
    "lines": "AZ =   8.34\nEL =  34.33\nSK =   0.00\nWrap position: 455\n",
    "line": "AZ = 8.34 EL = 34.33 SK = 0.00\n",
}


class Transcript:
    """Answers with what `docs/reference/travler.md` shows, in one of the ways that it leaves open. Also the port."""

    name, demo = "transcript", True

    def __init__(self, prompts: str, layout: str, line_end: str) -> None:
        self.prompts, self.position, self.line_end = PROMPTS[prompts], LAYOUTS[layout], line_end
        self.menu = "root"
        self.out = b""
        self.sent = b""
        self._line = b""
        self.say("HAL 2.05.003\nAZ calibrating\nNo LNB Voltage\n")

    def say(self, text: str) -> None:
        self.out += text.replace("\n", self.line_end).encode()

    def write(self, data: bytes) -> None:
        self.sent += data
        for byte in data:
            if byte != 0x0D:
                self._line += bytes([byte])
                self.out += bytes([byte])
                continue
            line, self._line = self._line.decode(), b""
            self.say("\n")
            self._answer(line)
            self.say(self.prompts[self.menu])

    def _answer(self, line: str) -> None:
        if line == "?":
            self.say("".join(f"{name}\n" for name in HELP[self.menu]))
        elif line == "q":
            assert self.menu != "root", "a q at the root may end the shell"
            self.menu = "root"
        elif self.menu == "root" and line in HELP:
            self.menu = line
        elif line == "a":
            self.say(self.position)
        elif line.strip() and line.split(maxsplit=1)[0] not in HELP[self.menu]:
            self.say("Invalid command\n")

    def pending(self) -> bool:
        return bool(self.out)

    def read(self) -> bytes:
        data, self.out = self.out, b""
        return data

    def next_event(self) -> float:
        return math.inf

    def fileno(self) -> None:
        return None

    def discard(self) -> None:
        self.out = b""

    def close(self) -> None:
        pass

    @property
    def lines(self) -> list[str]:
        """What was sent, without what only asks: bare Enters, marks of blanks, and `?`."""
        return [line for line in self.sent.decode().split("\r")[:-1] if line.strip() not in ("", "?")]


def talk(sent: bytes) -> list[str]:
    """What was said, line by line; a question that is asked again at once, to be sure, counts once."""
    assert sent.endswith(b"\r")
    return [line for line, _ in itertools.groupby(sent.decode().split("\r")[:-1])]


WAYS = list(itertools.product(PROMPTS, LAYOUTS, ("\n", "\r\n")))


@pytest.fixture(params=WAYS, ids=lambda way: f"{way[0]}-{way[1]}-{'crlf' if len(way[2]) > 1 else 'lf'}")
def dish(request):
    return Transcript(*request.param)


@pytest.fixture
def trav_ler(dish):
    protocol = HAL205Protocol()
    protocol.attach(dish, VirtualClock())
    return protocol


def test_t_hal205(trav_ler, dish):
    told = []
    trav_ler.initialize(told.append)
    assert dish.lines == ["ngsearch", "s", "q", "motor"]
    before = len(dish.sent)
    assert trav_ler.get_position() == Position(8.34, 34.33, 0.0)
    trav_ler.move_motor(0, 180.0)
    assert talk(dish.sent[before:]) == ["a", "a 0 180.00"]
    assert told


def test_the_moves_of_t_hal000(trav_ler, dish):
    trav_ler.enter_motor_menu()
    before = len(dish.sent)
    trav_ler.get_position()
    trav_ler.move_motor(0, 8.16)
    trav_ler.move_motor(1, 35.16)
    dish.position = dish.position.replace("8.34", "8.12").replace("34.33", "34.70")
    assert trav_ler.get_position() == Position(8.12, 34.70, 0.0)
    assert talk(dish.sent[before:]) == ["a", "a 0 8.16", "a 1 35.16", "a"]


def test_a_combined_move_and_the_byte_that_ends_it(trav_ler, dish):
    trav_ler.get_position()
    before = len(dish.sent)
    trav_ler.begin_slew(120.0, 40.0, 0.0)
    trav_ler.interject(trav_ler.abort_lines())
    assert dish.sent[before:] == b"g 120.00 40.00 0.00\r\r\r"
    assert len(trav_ler.console.settle(2.0)) == 2
    assert trav_ler.slew_is_over()


def test_the_lowest_elevations_are_read_and_not_written(trav_ler, dish):
    trav_ler.enter_motor_menu()
    before = len(dish.lines)
    trav_ler.survey()
    assert dish.lines[before:] == ["q", "nvs", "e 125", "e 127"]
