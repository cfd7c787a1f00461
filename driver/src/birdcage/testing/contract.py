"""The whole contract in one class."""

from __future__ import annotations

from birdcage.testing.console import RawConsoleContract
from birdcage.testing.features import FeatureContract
from birdcage.testing.golden import GoldenTranscriptContract
from birdcage.testing.meeting import MeetingContract
from birdcage.testing.motion import MotionContract
from birdcage.testing.own_settings import OwnSettingsContract
from birdcage.testing.passing import PassContract
from birdcage.testing.stopping import StoppingContract
from birdcage.testing.wire import WireContract


class Contract(
    MeetingContract,
    MotionContract,
    StoppingContract,
    PassContract,
    RawConsoleContract,
    WireContract,
    FeatureContract,
    OwnSettingsContract,
    GoldenTranscriptContract,
):
    """All that a machine owes to whoever uses it. Inherit it in a class `Test…`, with a fixture `bench`."""
