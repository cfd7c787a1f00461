"""First paint and quit of the terminal app, against a minimal Textual app, in turn, in one run.

First paint: from exec of the installed script to the first frame that holds frames and dashes, warm. Quit: from the
bytes of Ctrl+Q to the end of the process, with a dish that answers and with a port that is silent; and that once more
with a catalogue of 6,000 satellites, which must not hold up the first paint.
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

from made_up import fill
from terminal import Terminal, settle

BIN = Path(sys.executable).parent
RUNS = 7
SATELLITES = 6000
SILENT, FULL = "birdcage-tui, silent port", "the same, 6,000 satellites"


def painted(output: bytes) -> bool:
    text = output.decode(errors="replace")
    return "╭" in text and "--.--" in text


def measure(command: list[str], home: Path, *, settle_s: float) -> tuple[float, float]:
    os.environ["BIRDCAGE_HOME"] = str(home)
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
    home, full = settle(os.ttyname(slave)), settle(os.ttyname(slave))
    fill(full, SATELLITES)
    app = str(BIN / "birdcage-tui")
    commands = {
        "minimal Textual app": ([sys.executable, str(Path(__file__).with_name("minimal_app.py"))], home, 0.5),
        "birdcage-tui --demo": ([app, "--demo"], home, 2.0),
        SILENT: ([app], home, 1.0),
        FULL: ([app], full, 1.0),
    }
    results: dict[str, list[tuple[float, float]]] = {name: [] for name in commands}
    for run in range(RUNS + 1):
        for name, (command, where, settle_s) in commands.items():
            result = measure(command, where, settle_s=settle_s)
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
    catalogue_ratio = round(report[FULL]["first_paint_s"] / report[SILENT]["first_paint_s"], 3)
    print(f"with {SATELLITES:,} satellites to without: {catalogue_ratio}")
    budget = {"ratio": 2.0, "quit_more_s": 0.1, "catalogue_ratio": 1.1}
    print(json.dumps({"bench": "first_paint", "runs": RUNS, "budget": budget, "catalogue_ratio": catalogue_ratio,
                      **report}))  # fmt: skip


if __name__ == "__main__":
    main()
