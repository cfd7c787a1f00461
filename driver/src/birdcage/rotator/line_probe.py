"""How a whole machine is known at a port: a question that moves nothing anywhere, and words that it alone prints."""

from __future__ import annotations

import re
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class LineProbe:
    """What detection may ask of a port where nothing else answers; the class of a machine has it as `probe`.

    It goes out last, to a port on which an Enter brought nothing and no log is heard.
    """

    ask: bytes
    """Ends what may stand there unfinished, asks, and ends its line. It must do nothing to any other machine."""
    answer: re.Pattern[str]
    """Matches a whole line that only this machine answers with."""
    said: str
    """What is asked, for a person: `VE`."""
    log_marks: tuple[str, ...] = ()
    """Words that only this machine prints unasked."""
