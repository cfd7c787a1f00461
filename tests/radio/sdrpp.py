"""SDR++ at the other end, as the source of its module rigctl_server behaves (misc_modules/rigctl_server/src/main.cpp).

Blanks separate words; a first word of several letters is run letter by letter unless it begins with a backslash or is
AOS or LOS; what it does not know is answered with `RPRT 1`; a frequency that is no number ends the program.
"""

from __future__ import annotations

import socket
import threading

from .scripted import HANG_UP

MODES = ("FM", "WFM", "AM", "DSB", "USB", "CW", "LSB", "RAW")
DONE, WRONG = b"RPRT 0\n", b"RPRT 1\n"
GET_LEVELS = "0x40000020"
"""SQL and STRENGTH, though no `l` is answered."""
STATE = "\n".join([
    "0", "2", "1", "0.000000 10000000000.000000 0x2ef -1 -1 0x1 0x0", "0 0 0 0 0 0 0", "0 0 0 0 0 0 0", "0xef 1",
    "0xef 0", "0 0", "0x82 500", "0x0c 2700", "0x40 160000", "0 0", "0", "0", "0", "0", "0", "0", "0", "0", GET_LEVELS,
    "0x20", "0", "0", "",
])  # fmt: skip


class SdrPlusPlus:
    """Answers lines; `recordings` counts those that it began."""

    def __init__(self, *, tuning=True, armed=False):
        self.tuning, self.armed = tuning, armed
        self.frequency_hz, self.mode, self.width_hz = 100_000_000, "FM", 12_500
        self.recording, self.recordings = False, 0

    def __call__(self, line):
        words = [word for word in line.split(" ") if word]
        if not words:
            return b""
        if len(words[0]) > 1 and words[0][0] != "\\" and words[0] not in {"AOS", "LOS"}:
            replies = [self(" ".join([letter, *words[1:]])) for letter in words[0]]
            return HANG_UP if HANG_UP in replies else b"".join(replies)
        return self._one(words)

    def _one(self, words):
        match words:
            case ["F" | "\\set_freq", value]:
                if not value.lstrip("-").isdigit():
                    return HANG_UP  # std::stoll throws, and nothing catches
                if self.tuning:
                    self.frequency_hz = int(value)
                return DONE
            case ["f" | "\\get_freq", *_]:
                return b"%d\n" % self.frequency_hz
            case ["M" | "\\set_mode", "?", *_]:
                return (" ".join(MODES) + "\n").encode()
            case ["M" | "\\set_mode", mode, width] if mode in MODES and width.lstrip("-").isdigit():
                return DONE
            case ["m" | "\\get_mode", *_]:
                return f"{self.mode}\n{self.width_hz}\n".encode()
            case ["V" | "\\set_vfo", "?"]:
                return b"VFO\n"
            case ["V" | "\\set_vfo", "VFO"] | ["S", *_]:
                return DONE
            case ["v" | "\\get_vfo", *_]:
                return b"VFO\n"
            case ["\\chk_vfo", *_]:
                return b"CHKVFO 0\n"
            case ["s", *_]:
                return b"0\nVFOA\n"
            case ["AOS" | "\\recorder_start", *_]:
                if self.armed and not self.recording:
                    self.recording, self.recordings = True, self.recordings + 1
                return DONE
            case ["LOS" | "\\recorder_stop", *_]:
                if self.armed:
                    self.recording = False
                return DONE
            case ["q" | "\\quit" | "\\start" | "\\stop", *_]:
                return b""
            case ["\\dump_state", *_]:
                return STATE.encode()
        return WRONG


class OneAtATime:
    """Its listener: the next program is taken when the one before it has hung up; till then it waits, connected."""

    def __init__(self, sdr):
        self.sdr, self.heard = sdr, []
        self._socket = socket.create_server(("127.0.0.1", 0))
        self.port = self._socket.getsockname()[1]
        self.address = f"127.0.0.1:{self.port}"
        self._client = None
        threading.Thread(target=self._run, daemon=True).start()

    def _run(self):
        while True:
            try:
                self._client, _ = self._socket.accept()
            except OSError:
                return
            with self._client as client, client.makefile("rb") as lines:
                try:
                    for raw in lines:
                        line = raw.decode().removesuffix("\n")
                        self.heard.append(line)
                        reply = self.sdr(line)
                        if reply is HANG_UP:
                            break
                        client.sendall(reply)
                except OSError:
                    continue

    def close(self):
        self._socket.shutdown(socket.SHUT_RDWR)
        self._socket.close()
        if self._client is not None:
            self._client.close()
