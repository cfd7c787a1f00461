"""Exit codes of `birdcage`, and which error has which."""

from __future__ import annotations

from typing import TYPE_CHECKING

from birdcage.base.reason import Reason

if TYPE_CHECKING:
    from birdcage.base.errors import BirdcageError

OK = 0
NOT_DONE = 1
"""The dish did not do it: did not arrive, refused the command, was stopped, or did not confirm a STOP."""
USAGE = 2
"""The command line or the settings are wrong, among them `--firmware` where the console is another one's."""
LINK = 3
"""The port is missing, busy or forbidden, or nothing answers there."""
REFUSED = 4
"""HELD, a limit, or an unknown position forbids the motion: nothing was sent."""
CRASH = 70
"""A fault of birdcage itself."""
SIGNAL = 128
"""Plus the signal's number: 130 after Ctrl+C."""

SIGPIPE = 13
"""The number of that signal, on systems that have none, too: whoever read stdout is gone."""

EPILOG = """\b
Exit status:
  0    done
  1    the dish did not do it
  2    wrong command line, settings or firmware
  3    no link to the dish
  4    refused by HELD, a limit or an unknown position; nothing was sent
  70   a fault of birdcage
  130  Ctrl+C, after STOP; 128 + n: ended by signal n"""

DATA_EPILOG = """\b
Exit status:
  0    done
  1    not done, or not all of it
  2    wrong command line or settings
  130  Ctrl+C"""
"""Of commands that have nothing to do with a dish."""


class EndedBySignal(Exception):
    """A signal ended the command, after STOP."""

    def __init__(self, number: int) -> None:
        super().__init__(f"signal {number}")
        self.number = number


def code_of(error: BirdcageError) -> int:
    """Return the exit code for an error."""
    from birdcage.base.errors import ConfigError, Held, LinkError, MotionRefused, NoReply, OutOfRange

    if isinstance(error, ConfigError) or error.reason == Reason.WRONG_FIRMWARE:
        return USAGE
    if isinstance(error, LinkError | NoReply) or error.reason == Reason.LINK:
        return LINK
    refused = isinstance(error, MotionRefused | OutOfRange) or (isinstance(error, Held) and error.reason == Held.reason)
    return REFUSED if refused else NOT_DONE
