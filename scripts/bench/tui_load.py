"""What the app costs while the dish moves, against a bare composite of such widgets, in turn, in one run.

CPU of the process, bytes written to the terminal, key to paint, page switch. The simulator runs in another process and
is slowed to 2 deg/s, so that everything moves all the time; 160x48. At rest, without a peer: CPU and page switch.
F3 hears the signal 10 times a second at rest, beside a bare composite of such a page.
"""

from __future__ import annotations

import json
import os
import statistics
import subprocess
import sys
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path

from terminal import Terminal, percentile, settle

BIN = Path(sys.executable).parent
HERE = Path(__file__).parent
SECONDS = 10.0
ROUNDS = 3
KEYS = 20
SWITCHES = 20
TICKS = os.sysconf("SC_CLK_TCK")
FILLS_S = 20.0
"""Before it is measured what the page of the signal costs: a third of its strip is full then."""
QUIET_S = 0.05
"""A page switch has ended when nothing was painted for so long, or at the next frame."""


def cpu_s(pid: int) -> float:
    """Return the CPU time that a process has used, all its threads, without its children."""
    fields = Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / TICKS


def load(terminal: Terminal, seconds: float) -> tuple[float, float]:
    """Return the share of a core and the bytes per second while reading on."""
    began, used, count = time.monotonic(), cpu_s(terminal.pid), 0
    while (left := began + seconds - time.monotonic()) > 0:
        count += len(terminal.read(min(left, 0.2)))
    elapsed = time.monotonic() - began
    return (cpu_s(terminal.pid) - used) / elapsed, count / elapsed


def painted_after(terminal: Terminal, key: bytes, seen: Callable[[bytes], bool]) -> float:
    """Press, and return how long until the output holds what the key makes."""
    while terminal.read(0.0):
        pass
    terminal.output = b""
    pressed = terminal.press(key)
    return terminal.wait_for(seen, 5.0) - pressed


def key_times(terminal: Terminal, keys: list[tuple[bytes, bytes]]) -> list[float]:
    """Press keys in turn, each with the bytes that its effect prints, at odd moments between frames."""
    times = []
    for press in range(KEYS):
        key, shown = keys[press % len(keys)]
        times.append(painted_after(terminal, key, lambda output, shown=shown: shown in output))
        terminal.watch(0.137)
    return times


def switch_times(terminal: Terminal, keys: list[tuple[bytes, bytes]]) -> list[float]:
    """Switch pages; the first visit of each does not count."""
    times = []
    for press in range(SWITCHES + len(keys)):
        key, shown = keys[press % len(keys)]
        took = painted_after(terminal, key, lambda output, shown=shown: shown in output)
        if press >= len(keys):
            times.append(took)
        terminal.watch(0.317)
    return times


def composite() -> dict[str, list[float]]:
    terminal = Terminal([sys.executable, str(HERE / "composite.py")])
    terminal.wait_for(lambda output: b"pressed" in output)
    terminal.watch(2.0)
    cpu, rate = load(terminal, SECONDS)
    numbers: list[float] = []
    for press in range(KEYS):
        shown = f"{press + 1:06d}".encode()
        numbers.append(painted_after(terminal, b"x", lambda output, shown=shown: shown in output))
        terminal.watch(0.137)
    terminal.kill()
    return {"cpu": [cpu], "rate": [rate], "key": numbers}


def app(port: str) -> dict[str, list[float]]:
    settle(port)
    terminal = Terminal([str(BIN / "birdcage-tui")])
    terminal.wait_for(lambda output: b"IDLE" in output)
    terminal.watch(8.0)  # the survey is over then
    idle_cpu, idle_rate = load(terminal, SECONDS)
    pages = switch_times(terminal, [(b"2", b"Cable"), (b"1", b"Signal")])
    for letter in (b"g", b"2", b"0", b"0", b" ", b"4", b"0", b"\r"):
        terminal.press(letter)
        terminal.watch(0.1)
    terminal.wait_for(lambda output: b"SLEWING" in output, 5.0)
    terminal.watch(1.0)
    cpu, rate = load(terminal, SECONDS)
    keys = key_times(terminal, [(b"+", b"2\xc2\xb0."), (b"-", b"1\xc2\xb0.")])
    terminal.kill()
    return {"cpu": [cpu], "rate": [rate], "key": keys, "idle cpu": [idle_cpu], "idle rate": [idle_rate], "page": pages}


def signal_composite() -> dict[str, list[float]]:
    terminal = Terminal([sys.executable, str(HERE / "composite.py"), "signal"])
    terminal.wait_for(lambda output: b"pressed" in output)
    terminal.watch(FILLS_S)
    cpu, rate = load(terminal, SECONDS)
    terminal.kill()
    return {"cpu": [cpu], "rate": [rate]}


def signal_page(port: str) -> dict[str, list[float]]:
    settle(port)
    terminal = Terminal([str(BIN / "birdcage-tui")])
    terminal.wait_for(lambda output: b"IDLE" in output)
    terminal.watch(8.0)
    terminal.press(b"3")
    terminal.wait_for(lambda output: b"To the peak" in output, 5.0)
    terminal.watch(FILLS_S)
    cpu, rate = load(terminal, SECONDS)
    terminal.kill()
    return {"cpu": [cpu], "rate": [rate]}


def main() -> None:
    command = [str(BIN / "birdcage"), "sim", "--firmware", "g2", "--json", "-o", "az_speed=2", "-o", "el_speed=2",
               "-o", "latency_min=0.001", "-o", "latency_max=0.004"]  # fmt: skip
    rows: dict[str, dict[str, list[float]]] = {"composite": {}, "birdcage-tui": {}, "F3 composite": {}, "F3": {}}
    for _round in range(ROUNDS):
        simulator = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
        assert simulator.stdout is not None
        try:
            port = json.loads(simulator.stdout.readline())["port"]
            for name, measure in (
                ("composite", composite), ("birdcage-tui", partial(app, port)),
                ("F3 composite", signal_composite), ("F3", partial(signal_page, port)),
            ):  # fmt: skip
                measured = measure()
                for what, values in measured.items():
                    rows[name].setdefault(what, []).extend(values)
        finally:
            simulator.terminate()
            simulator.wait(5)
    report = {name: figures(values) for name, values in rows.items()}
    peer, ours = report["composite"], report["birdcage-tui"]
    print(f"{'':14}{'CPU':>8}{'kB/s':>8}{'key p95':>10}{'page':>8}{'idle CPU':>10}")
    for name, row in report.items():
        page = f"{row['page_s'] * 1e3:5.0f} ms" if "page_s" in row else "-"
        idle = f"{row['idle_cpu']:.1%}" if "idle_cpu" in row else "-"
        key = f"{row['key_p95_s'] * 1e3:7.1f} ms" if "key_p95_s" in row else "-"
        print(f"{name:14}{row['cpu']:8.1%}{row['rate'] / 1e3:8.1f}{key:>10}{page:>8}{idle:>10}")
    on_page = {what: round(report["F3"][what] / report["F3 composite"][what], 2) for what in ("cpu", "rate")}
    ratios = {what: round(ours[what] / peer[what], 2) for what in ("cpu", "rate", "key_p95_s")}
    for name, found in (("composite", ratios), ("composite of F3", on_page)):
        print(f"ratios to the {name}:", ", ".join(f"{what} {value}" for what, value in found.items()))
    budget = {"cpu": 1.25, "rate": 1.25, "key_p95_s": 1.5, "page_s": 0.020, "idle_cpu": 0.02}
    told = {"bench": "tui_load", "rounds": ROUNDS, "budget": budget, "ratios": ratios, "ratios_f3": on_page}
    print(json.dumps({**told, **report}))


def figures(values: dict[str, list[float]]) -> dict[str, float]:
    """Return the median of each, and the 95th percentile of what a person waits for."""
    found = {
        "cpu": round(statistics.median(values["cpu"]), 4),
        "rate": round(statistics.median(values["rate"])),
    }
    if "key" in values:
        found |= {
            "key_s": round(statistics.median(values["key"]), 4),
            "key_p95_s": round(percentile(values["key"], 0.95), 4),
        }
    if "page" in values:
        found |= {
            "page_s": round(statistics.median(values["page"]), 4),
            "page_p95_s": round(percentile(values["page"], 0.95), 4),
            "idle_cpu": round(statistics.median(values["idle cpu"]), 4),
            "idle_rate": round(statistics.median(values["idle rate"])),
        }
    return found


if __name__ == "__main__":
    main()
