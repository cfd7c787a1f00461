"""What the system itself says of its clock: chrony, or systemd. Other systems do not tell without rights."""

from __future__ import annotations

import math
import shutil
import subprocess
from collections.abc import Callable, Sequence
from datetime import datetime
from typing import Final

from birdcage.gps.verdict import DOUBTFUL_S, ClockVerdict

ASK_S: Final = 2.0
"""How long such a program may take to answer."""
LOCAL_REFERENCE = "7F7F0101"
"""chrony's name for *my own clock*: it serves others without being set itself."""

RunTool = Callable[[Sequence[str]], str | None]
"""Runs a program; returns what it printed, None when it is absent, failed or did not end in time."""


def run_tool(words: Sequence[str]) -> str | None:
    """Run a program of the system with a deadline."""
    program = shutil.which(words[0])
    if program is None:
        return None
    try:
        done = subprocess.run(  # noqa: S603 - the words are constants of this file
            [program, *words[1:]], capture_output=True, text=True, timeout=ASK_S, check=False, stdin=subprocess.DEVNULL
        )
    except (OSError, subprocess.TimeoutExpired, UnicodeDecodeError):
        return None
    return done.stdout if done.returncode == 0 else None


def by_system(now: datetime, run: RunTool = run_tool) -> ClockVerdict:
    """Judge by the programs that set the clock from the network; *unknown* where none of them tells."""
    return _chrony(now, run) or _systemd(now, run) or ClockVerdict(
        "unknown", "none", now,
        doubt="This system does not tell whether its clock is right. Compare it with GPS or a watch.",
    )  # fmt: skip


def _chrony(now: datetime, run: RunTool) -> ClockVerdict | None:
    """`chronyc -c tracking`: reference, name, stratum, time, correction, ..., 10 delay, 11 dispersion, 13 leap."""
    answer = run(("chronyc", "-c", "tracking"))
    fields = (answer or "").strip().split(",")
    if len(fields) < 14:
        return None
    source = "network time (chrony)"
    try:
        correction_s, delay_s, dispersion_s = (float(fields[index]) for index in (4, 10, 11))
    except ValueError:
        return None
    error_s = abs(correction_s) + delay_s / 2 + dispersion_s
    if fields[13].strip() == "Not synchronised" or fields[0] in (LOCAL_REFERENCE, "00000000"):
        return ClockVerdict("network", source, now, doubt="chrony has no time source.")
    if not math.isfinite(error_s) or error_s > DOUBTFUL_S:
        doubt = f"chrony has not reached its time source for long: the clock may be {error_s:.1f} s off."
        return ClockVerdict("network", source, now, None, error_s, doubt)
    return ClockVerdict("network", source, now, None, error_s)


def _systemd(now: datetime, run: RunTool) -> ClockVerdict | None:
    """`timedatectl show`: NTPSynchronized is the kernel's own word, which it takes back some hours after the last."""
    answer = run(("timedatectl", "show", "--property=NTPSynchronized", "--property=NTP"))
    pairs = dict(line.split("=", 1) for line in (answer or "").splitlines() if "=" in line)
    if pairs.get("NTPSynchronized") not in ("yes", "no"):
        return None
    source = "network time (systemd)"
    if pairs["NTPSynchronized"] == "yes":
        return ClockVerdict("network", source, now)
    switched_off = " and network time is switched off" if pairs.get("NTP") == "no" else ""
    return ClockVerdict("network", source, now, doubt=f"The clock is not set by the network{switched_off}.")
