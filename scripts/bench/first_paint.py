"""First paint and quit of the terminal app, against a minimal Textual app, in turn, in one run.

First paint: from exec of the installed script to the first frame that holds frames and dashes, warm. Quit: from the
bytes of Ctrl+Q to the end of the process, with a dish that answers and with a port that is silent.
"""

from __future__ import annotations

import json
import os
import pty
import statistics
import sys
import time
import tty
from pathlib import Path

from terminal import Terminal, settle

BIN = Path(sys.executable).parent
RUNS = 7


def painted(output: bytes) -> bool:
    text = output.decode(errors="replace")
    return "╭" in text and "--.--" in text


def measure(command: list[str], *, settle_s: float) -> tuple[float, float]:
    terminal = Terminal(command)
    paint_s = terminal.wait_for(painted) - terminal.started
    terminal.watch(settle_s)
    pressed = terminal.press(b"\x11")
    quit_s = terminal.wait_for_end() - pressed
    os.close(terminal.fd)
    return paint_s, quit_s


def main() -> None:
    master, slave = pty.openpty()
    tty.setraw(slave)
    settle(os.ttyname(slave))
    app = str(BIN / "birdcage-tui")
    commands = {
        "minimal Textual app": ([sys.executable, str(Path(__file__).with_name("minimal_app.py"))], 0.5),
        "birdcage-tui --demo": ([app, "--demo"], 2.0),
        "birdcage-tui, silent port": ([app], 1.0),
    }
    results: dict[str, list[tuple[float, float]]] = {name: [] for name in commands}
    for run in range(RUNS + 1):
        for name, (command, settle_s) in commands.items():
            result = measure(command, settle_s=settle_s)
            if run:
                results[name].append(result)
            time.sleep(0.2)
    os.close(master)
    floor_paint = statistics.median(paint for paint, _ in results["minimal Textual app"])
    floor_quit = statistics.median(quit_s for _, quit_s in results["minimal Textual app"])
    print(f"{'':28}{'first paint':>12}{'ratio':>8}{'quit':>10}{'more':>10}")
    report = {}
    for name, values in results.items():
        paint = statistics.median(paint for paint, _ in values)
        quit_s = statistics.median(quit_s for _, quit_s in values)
        print(f"{name:28}{paint * 1e3:9.0f} ms{paint / floor_paint:8.2f}{quit_s * 1e3:7.0f} ms"
              f"{(quit_s - floor_quit) * 1e3:+7.0f} ms")  # fmt: skip
        report[name] = {
            "first_paint_s": round(paint, 4), "ratio": round(paint / floor_paint, 3),
            "quit_s": round(quit_s, 4), "quit_more_s": round(quit_s - floor_quit, 4),
        }  # fmt: skip
    print(json.dumps({"bench": "first_paint", "runs": RUNS, "budget": {"ratio": 2.0, "quit_more_s": 0.1}, **report}))


if __name__ == "__main__":
    main()
