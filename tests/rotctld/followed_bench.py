"""A shared dish under a catalogue, and programs that follow one of its satellites, each in its own way."""

from __future__ import annotations

from datetime import timedelta

from birdcage.base.config import Settings
from birdcage.base.config.sections import PlaceSettings
from birdcage.base.geometry import separation
from birdcage.base.paths import Paths
from birdcage.rotctld.options import RotctldOptions
from birdcage.rotctld.recogniser import Recogniser
from birdcage.rotctld.shared_dish import SharedDish
from birdcage.sky.catalogue import Catalogue
from birdcage.sky.demo_orbits import demo_orbits
from birdcage.sky.observer import Observer
from birdcage.sky.propagate import track

from tests.station.conftest import Bench

HERE = Observer(50.0, 10.0, 300.0, "here")
SOON = timedelta(seconds=180.0)
PLACE = PlaceSettings(latitude_deg=HERE.latitude_deg, longitude_deg=HERE.longitude_deg, height_m=HERE.height_m)


class FollowedBench(Bench):
    """The server's side of a dish, without sockets; one thread, a virtual clock."""

    def __init__(self, folder, settings=None, catalogue=None, *, on=True, station=None, soon=SOON, **options):
        super().__init__("g2?seed=1", station or {})
        self.paths, self.settings = Paths.in_folder(folder), settings or Settings(place=PLACE)
        self.orbits = demo_orbits(self.clock.utc() + soon, HERE)  # of which the first one rises, and crosses north
        kept = self.orbits if catalogue is None else catalogue
        if kept:
            with Catalogue(self.paths.catalogue) as sets:
                sets.add(kept)
        self.recogniser = Recogniser(self.clock, self.paths, lambda: self.settings, on=on, threads=False)
        self.shared = SharedDish(self.station, RotctldOptions(**options), self.recogniser)
        self.client = self.shared.client("rotctld 1")
        self.connect(3.0)
        self.run(2.0)

    def run(self, seconds):
        """Let time pass, with the turns of the server and of the recogniser in between."""
        for _ in range(max(1, round(seconds / 0.1))):
            self.step(0.1)
            self.recogniser.step()
            self.shared.tick()

    def look(self, elements, ahead_s=0.0):
        """Return where a satellite stands."""
        seen = track(elements, HERE, [self.clock.utc().timestamp() + ahead_s])
        return float(seen.az_deg[0]), float(seen.el_deg[0])

    def off(self, elements):
        """Return how far from a satellite the dish truly points."""
        truth = self.device.truth()
        return separation(truth.az_deg % 360.0, truth.el_deg, *self.look(elements))

    def to_pass(self, elements, el_deg=25.0):
        """Let time pass until a satellite rises above an elevation."""
        while self.look(elements)[1] >= el_deg:
            self.run(30.0)
        while self.look(elements)[1] < el_deg:
            self.run(1.0)

    @property
    def view(self):
        return next(view for view in self.shared.views() if view.name == "rotctld 1")

    def gpredict(self, elements, seconds, threshold_deg=5.0):
        """Have Gpredict follow for so long: beyond its threshold it wishes for where that will be reached again."""
        end = self.clock.monotonic() + seconds
        wishes = 0
        while self.clock.monotonic() < end:
            az, el = self.look(elements)
            told = self.client.position()
            if max(abs(az - told[0]), abs(el - told[1])) > threshold_deg:
                self.client.set_position(*self._ahead(elements, threshold_deg))
                wishes += 1
            self.run(0.9)
        return wishes

    def _ahead(self, elements, threshold_deg):
        az, el = self.look(elements)
        span_s = step_s = 120.0
        found = az, el
        while step_s > 0.25:
            found = self.look(elements, span_s)
            off = max(abs(az - found[0]), abs(el - found[1])) > threshold_deg or found[1] < 0.0
            step_s /= 2.0
            span_s += -step_s if off else step_s
        return round(found[0], 2), max(round(found[1], 2), 0.0)

    def now(self, elements, seconds, threshold_deg=0.0, every_s=1.0):
        """Have a program follow that wishes for where it is now, beyond its threshold."""
        end = self.clock.monotonic() + seconds
        while self.clock.monotonic() < end:
            az, el = self.look(elements)
            told = self.client.position()
            if max(abs(az - told[0]), abs(el - told[1])) > threshold_deg:
                self.client.set_position(round(az, 2), round(el, 2))
            self.run(every_s)
