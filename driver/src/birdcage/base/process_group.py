"""A child with all that it starts: begun apart from us, asked to end, made to end."""

from __future__ import annotations

import contextlib
import os
import signal
import subprocess
import sys
from collections.abc import Mapping, Sequence


class ProcessGroup:
    """A child in a group of its own, so that neither a Ctrl+C for us reaches it nor its own children stay behind.

    What it starts and puts into another session (`setsid`, a service) is no longer part of it.
    """

    def __init__(self, words: Sequence[str], environment: Mapping[str, str], *, errors_apart: bool = False) -> None:
        """Start it. OSError where that cannot be done; the sentence is the system's.

        `errors_apart`: standard error has a pipe of its own; else it comes with the output.
        """
        self._leash: subprocess.Popen[bytes] | None = None
        new_group = 0
        if sys.platform == "win32":
            new_group = subprocess.CREATE_NEW_PROCESS_GROUP
        self.child = subprocess.Popen(  # noqa: S603 - a command line that its own user has set
            list(words), stdin=subprocess.PIPE, stdout=subprocess.PIPE,
            stderr=subprocess.PIPE if errors_apart else subprocess.STDOUT, env=dict(environment),
            start_new_session=True, creationflags=new_group,
        )  # fmt: skip

    def leash(self) -> None:
        """Have it ended should this program die without a word, as by `kill -9`. Not on Windows.

        A shell waits for that at the other end of a pipe: it reads a line from `unleash`, or the end of the pipe.
        """
        if sys.platform == "win32":
            return
        group = f"-- -{self.child.pid}"
        words = ["/bin/sh", "-c", f"read -r _ || {{ kill -s TERM {group}; sleep 1; kill -s KILL {group}; }}"]
        self._leash = subprocess.Popen(  # noqa: S603 - no word of anybody's
            words, stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True,
        )  # fmt: skip

    def unleash(self) -> None:
        """Let go of it: it has ended, or may go on."""
        leash, self._leash = self._leash, None
        if leash is not None:
            with contextlib.suppress(OSError):
                leash.communicate(b"\n", timeout=1.0)

    def alive(self) -> bool:
        """Whether any of it still runs."""
        if self.child.poll() is None:
            return True
        return False if sys.platform == "win32" else self._signal(0)

    def ask(self) -> None:
        """Ask all of it to end: TERM, or Ctrl+Break on Windows."""
        if sys.platform == "win32":
            if self.child.poll() is None:
                self.child.send_signal(signal.CTRL_BREAK_EVENT)
        else:
            self._signal(signal.SIGTERM)

    def kill(self) -> None:
        """End all of it."""
        if sys.platform == "win32":
            ending = ["taskkill", "/T", "/F", "/PID", str(self.child.pid)]
            subprocess.run(ending, capture_output=True, timeout=5.0, check=False)  # noqa: S603 - no word of anybody's
        else:
            self._signal(signal.SIGKILL)

    def kill_later(self, seconds: float) -> None:
        """Leave somebody behind who ends all of it after so long; on Windows it is ended at once."""
        if sys.platform == "win32":
            self.kill()
            return
        words = ["/bin/sh", "-c", f"sleep {seconds:g}; kill -s KILL -- -{self.child.pid}"]
        subprocess.Popen(  # noqa: S603 - no word of anybody's
            words, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
            start_new_session=True,
        )  # fmt: skip

    def _signal(self, number: int) -> bool:
        """Whether there was somebody to send it to."""
        if sys.platform == "win32":
            return False
        try:
            os.killpg(self.child.pid, number)
        except ProcessLookupError:
            return False
        except PermissionError:
            return True  # somebody is there who has become another user
        return True
