"""What receivers do that no code behind RPRT tells, in words for a person.

SDR++'s module rigctl_server takes the next program only when the one before it has hung up, advertises STRENGTH in
`dump_state` and answers `RPRT 1` to `l STRENGTH`, and answers `RPRT 0` to AOS and LOS with its recording switched off,
too (docs/decisions/0015).
"""

from __future__ import annotations

from birdcage.radio.now import RadioNow

UNKNOWN_TO_SDRPP = 1
SILENT = (
    "SDR++ serves one program at a time: is another one connected to it, Gpredict or a second birdcage? "
    "rigctld must run without --vfo."
)
NOT_PROVEN = "SDR++ takes AOS with Recording switched off, too: check that it records."


def no_level(code: int) -> str:
    """Return what is to be said where `l STRENGTH` was refused."""
    if code == UNKNOWN_TO_SDRPP:
        return "No level: SDR++ advertises one and answers RPRT 1."
    return f"No level: it answers RPRT {code} to `l STRENGTH`."


def remark(now: RadioNow) -> str:
    """Return what is to be said of a receiver that is tuned and may be SDR++; nothing where it gives a level."""
    may_be_sdrpp = now.strength_db is None and now.strength_refused in (None, UNKNOWN_TO_SDRPP)
    return NOT_PROVEN if now.recording and may_be_sdrpp else ""
