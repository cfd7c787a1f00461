"""The command that goes on with what was interrupted."""

from __future__ import annotations

from birdcage_tui.commands.table import Command
from birdcage_tui.shown.allowed import RESUME_KEY, can_resume

RESUME = (
    Command(
        "resume",
        (RESUME_KEY,),
        RESUME_KEY,
        "Resume",
        "Follow again what STOP, a step by hand or the end of the program has interrupted, with autotrack if that was "
        "on. It releases HELD, and row 2 says where the dish goes.",
        "Motion",
        can_resume,
    ),
)
