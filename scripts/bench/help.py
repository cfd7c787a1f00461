"""CPU time of `birdcage --help`, against the help of a click program that does nothing, in turn, in one run."""

from __future__ import annotations

import json
import resource
import statistics
import subprocess
import sys
from pathlib import Path

RUNS = 11
BARE = "import click\n\n@click.command()\ndef main():\n    pass\n\nmain(['--help'])\n"


def cpu_s(command: list[str]) -> float:
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(command, stdout=subprocess.DEVNULL, check=True, timeout=60)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def main() -> None:
    script = str(Path(sys.executable).with_name("birdcage"))
    commands = {
        "bare click program": [sys.executable, "-c", BARE],
        "birdcage --help": [script, "--help"],
        "birdcage move --help": [script, "move", "--help"],
        "birdcage config show --help": [script, "config", "show", "--help"],
    }
    times: dict[str, list[float]] = {name: [] for name in commands}
    for run in range(RUNS + 1):
        for name, command in commands.items():
            spent_s = cpu_s(command)
            if run:
                times[name].append(spent_s)
    floor_s = statistics.median(times["bare click program"])
    report = {}
    for name, spent in times.items():
        median_s = statistics.median(spent)
        report[name] = {"cpu_s": round(median_s, 4), "ratio": round(median_s / floor_s, 2)}
        print(f"{name:30}{median_s * 1000:8.1f} ms{median_s / floor_s:8.2f}")
    print(json.dumps(report))


if __name__ == "__main__":
    main()
