"""The whole contract in one class."""

from __future__ import annotations

from birdcage.testing.console import RawConsole
from birdcage.testing.features import Features
from birdcage.testing.golden import GoldenTranscripts
from birdcage.testing.meeting import Meeting
from birdcage.testing.motion import Motion
from birdcage.testing.passing import Passing
from birdcage.testing.stopping import Stopping
from birdcage.testing.wire import Wire


class Contract(Meeting, Motion, Stopping, Passing, RawConsole, Wire, Features, GoldenTranscripts):
    """All that a machine owes to whoever uses it. Inherit it in a class `Test…`, with a fixture `bench`."""
