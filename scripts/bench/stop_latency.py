"""From the key's bytes at the app's terminal to the first STOP byte at the dish's pty, and how soon the dish rests.

The simulator runs in another process; the bench stands between its pty and the app's and notes when each byte passes.
The last three rows are taken while passes of 6,000 satellites are searched for behind the screen, again and again.
Peer: the same keys at a minimal Textual app that writes one byte to a pty in its key handler, in the same run.
"""

from __future__ import annotations

import json
import os
import pty
import select
import statistics
import subprocess
import sys
import threading
import time
import tty
from pathlib import Path

from made_up import fill
from terminal import Terminal, percentile, settle

BIN = Path(sys.executable).parent
PRESSES = 20
SATELLITES = 6000
SEARCHING = ", while the pass search runs"
KEYS = {"Space": b" ", "Ctrl+C": b"\x03", "Esc": b"\x1b"}


class Disturber(threading.Thread):
    """Writes to a catalogue again and again: the app, which looks every five seconds, reads and searches it anew."""

    def __init__(self, catalogue: Path) -> None:
        super().__init__(daemon=True)
        self._catalogue = catalogue
        self.done = threading.Event()

    def run(self) -> None:
        while not self.done.wait(0.5):
            os.utime(self._catalogue)


class Relay(threading.Thread):
    """Passes bytes between the app's serial port and the simulator's, and notes what the app sends, and when."""

    def __init__(self, dish: str) -> None:
        super().__init__(daemon=True)
        self.master, slave = pty.openpty()
        tty.setraw(slave)
        self.port = os.ttyname(slave)
        self._slave = slave
        self._dish = os.open(dish, os.O_RDWR | os.O_NOCTTY)
        tty.setraw(self._dish)
        self.sent: list[tuple[float, bytes]] = []

    def run(self) -> None:
        while True:
            for fd in select.select([self.master, self._dish], [], [])[0]:
                data = os.read(fd, 4096)
                if fd == self.master:
                    self.sent.append((time.monotonic(), data))
                    os.write(self._dish, data)
                else:
                    os.write(self.master, data)

    def first_move(self, after: float, timeout_s: float = 20.0) -> float:
        """Return when the first move line after `after` passed: while the dish slews, only STOP sends one."""
        end = time.monotonic() + timeout_s
        while time.monotonic() < end:
            for at, data in list(self.sent):
                if at >= after and data.startswith((b"a 0 ", b"a 1 ")):
                    return at
            time.sleep(0.001)
        sys.exit(f"no move line within {timeout_s} s; the last that was sent: {self.sent[-5:]}")


def slew(app: Terminal, relay: Relay, direction: bytes) -> None:
    """Send the dish somewhere by the go-to line, and wait until the command has passed."""
    app.press(b"g")
    time.sleep(0.3)
    typed = app.press(direction + b"\r")
    relay.first_move(typed)


def app_rows(port: str, relay: Relay, *, satellites: int = 0) -> dict[str, list[float]]:
    """Press each key in mid-slew, and time it."""
    home = settle(port)
    disturber = Disturber(fill(home, satellites)) if satellites else None
    if disturber is not None:
        disturber.start()
    app = Terminal([str(BIN / "birdcage-tui")])
    app.wait_for(lambda output: b"IDLE" in output)
    app.watch(1.0)
    reader = threading.Thread(target=app.watch, args=(3600.0,), daemon=True)
    reader.start()
    slew(app, relay, b"180,45")
    time.sleep(11.0)  # half a turn at 20 deg/s: from here both ways round are open
    rows: dict[str, list[float]] = {name: [] for name in KEYS}
    east = True
    for _press in range(PRESSES):
        for name, key in KEYS.items():
            east = not east
            slew(app, relay, b"250,30" if east else b"110,60")
            time.sleep(0.6)
            pressed = app.press(key)
            rows[name].append(relay.first_move(pressed) - pressed)
            time.sleep(1.0)
            app.press(b"\r")  # lets go of HELD
            time.sleep(0.5)
    app.kill()
    if disturber is not None:
        disturber.done.set()
    return rows


def floor_row() -> list[float]:
    """Time a minimal app that answers a key with one byte on a pty."""
    master, slave = pty.openpty()
    tty.setraw(slave)
    floor = Terminal([sys.executable, str(Path(__file__).with_name("minimal_key.py")), os.ttyname(slave)])
    floor.wait_for(lambda output: b"ready" in output)
    floor.watch(0.5)
    times = []
    for _press in range(PRESSES):
        pressed = floor.press(b" ")
        select.select([master], [], [], 2.0)
        times.append(time.monotonic() - pressed)
        os.read(master, 16)
        floor.watch(0.05)
    floor.kill()
    return times


def main() -> None:
    sys.setswitchinterval(0.0005)  # the relay's clock must not wait for the thread that reads the screen
    command = [str(BIN / "birdcage"), "sim", "--firmware", "g2", "--json", "-o", "az_speed=20"]
    simulator = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
    assert simulator.stdout is not None
    try:
        relay = Relay(json.loads(simulator.stdout.readline())["port"])
        relay.start()
        rows = {"minimal Textual app": floor_row(), **app_rows(relay.port, relay)}
        found = app_rows(relay.port, relay, satellites=SATELLITES)
        rows |= {name + SEARCHING: times for name, times in found.items()}
    finally:
        simulator.terminate()
        simulator.wait(5)
    floor = percentile(rows["minimal Textual app"], 0.95)
    print(f"{'key to first byte on the wire':36}{'median':>10}{'p95':>10}{'ratio of p95':>14}")
    report = {}
    for name, values in rows.items():
        median, p95 = statistics.median(values), percentile(values, 0.95)
        print(f"{name:36}{median * 1e3:7.1f} ms{p95 * 1e3:7.1f} ms{p95 / floor:14.2f}")
        report[name] = {"median_s": round(median, 5), "p95_s": round(p95, 5), "ratio": round(p95 / floor, 2)}
    budget = {"Space": 0.010, "Ctrl+C": 0.010, "Esc": 0.120}
    budget |= {name + SEARCHING: most_s for name, most_s in budget.items()}
    print(json.dumps({"bench": "stop_latency", "presses": PRESSES, "budget_p95_s": budget, **report}))


if __name__ == "__main__":
    main()
