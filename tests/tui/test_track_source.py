"""The app's end of the pursuit desk: what it is told anew when place, horizon or feed have changed."""

from birdcage.base.config import Settings
from birdcage.base.config.sections import PlaceSettings
from birdcage.sky.horizon import HorizonMask
from birdcage_tui.feeds.track_source import DeskSource
from birdcage_tui.shown.options import SitePlace

HERE = SitePlace(50.0, 10.0, "here")
TREES = HorizonMask([(10, 4), (20, 5)])


class Desk:
    def __init__(self):
        self.applied = []

    def ask(self, order):
        order.carry_out(self)

    def apply(self, settings, observer):
        self.applied.append((settings, observer))

    def start(self):
        """A desk without a thread."""


def test_another_horizon_reaches_the_desk_at_once_and_only_then():
    desk, settings = Desk(), Settings(place=PlaceSettings(latitude_deg=50.0, longitude_deg=10.0))
    source = DeskSource(lambda: desk, lambda: settings, threads=False)
    source.start()
    for horizon in (TREES, TREES, TREES.insert(200.0, 30.0), TREES.insert(200.0, 30.0)):
        source.keep(HERE, horizon)
    ((told, observer),) = desk.applied
    assert told is settings
    assert (observer.latitude_deg, observer.longitude_deg) == (50.0, 10.0)


def test_another_feed_reaches_the_desk_at_once_and_only_then():
    """Its LO counts for the receiver, its band for the beam."""
    desk, settings = Desk(), Settings(place=PlaceSettings(latitude_deg=50.0, longitude_deg=10.0))
    source = DeskSource(lambda: desk, lambda: settings, threads=False)
    source.start()
    for feed in ("", "stock-ku", "stock-ku", "helix", "helix"):
        source.keep(HERE, TREES, feed)
    ((told, _observer),) = desk.applied
    assert told is settings
