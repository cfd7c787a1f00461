"""A Trav'ler that answers as its reference shows, in one of the ways that this leaves open; also the port."""

from __future__ import annotations

import itertools
import math

HELPS = {
    "hal205": {
        "root": ["motor", "ngsearch", "nvs", "os", "stow", "reboot", "q"],
        "motor": ["a", "g", "q"],
        "ngsearch": ["s", "q"],
        "nvs": ["d", "e", "s", "q"],
    },
    "hal000": {
        "root": ["mot", "nvs", "os", "stow", "reboot", "q"],
        "mot": ["a", "g", "q"],
        "os": ["tasks", "kill <name>", "q"],
        "nvs": ["d", "e", "s", "q"],
    },
}
LOGS = {"hal205": "HAL 2.05.003\nAZ calibrating\nNo LNB Voltage\n", "hal000": "AZ calibrating\nNoGPS\n"}
KINDS = "named", "alike"
LAYOUTS = {
    "lines": "AZ =   8.34\nEL =  34.33\nSK =   0.00\nWrap position: 455\n",
    "line": "AZ = 8.34 EL = 34.33 SK = 0.00\n",
}


class Transcript:
    """Answers with what `docs/reference` shows, in one of the ways that it leaves open. Also the port."""

    name, demo = "transcript", True

    def __init__(self, prompts: str, layout: str, line_end: str, firmware: str = "hal205") -> None:
        self.help, self.position, self.line_end = HELPS[firmware], LAYOUTS[layout], line_end
        self.prompts = {menu: f"{menu.upper()}>" if prompts == "named" else ">" for menu in self.help}
        self.menu = "root"
        self.out = b""
        self.sent = b""
        self._line = b""
        self.say(LOGS[firmware])

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
            self.say("".join(f"{name}\n" for name in self.help[self.menu]))
        elif line == "q":
            assert self.menu != "root", "a q at the root may end the shell"
            self.menu = "root"
        elif self.menu == "root" and line in self.help:
            self.menu = line
        elif line == "a":
            self.say(self.position)
        elif line.strip() and line.split(maxsplit=1)[0] not in {each.split()[0] for each in self.help[self.menu]}:
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


WAYS = tuple(itertools.product(KINDS, LAYOUTS, ("\n", "\r\n")))
"""All that no source tells: prompts of their own or alike, one line or more, and the line end."""


def named(way: tuple[str, str, str]) -> str:
    """Return what a test calls one of them."""
    return f"{way[0]}-{way[1]}-{'crlf' if len(way[2]) > 1 else 'lf'}"
