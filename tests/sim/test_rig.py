"""The simulated receiver: what it hears through the dish's own beam, and how it talks."""

from __future__ import annotations

import json
import math
import statistics

import pytest
from birdcage.base.beam import beam_of
from birdcage.base.clock import VirtualClock
from birdcage.base.config import STOCK_FEED
from birdcage.base.geometry import beside
from birdcage.sim.beacons import read_beacons
from birdcage.sim.beam import COMPRESSION, gain, power_toward
from birdcage.sim.port import open_device, open_port
from birdcage.sim.rig import RigSettings, SimReceiver
from birdcage.station.known import list_models

SENT_HZ = 11.7e9


class Bench:
    """A dish at azimuth 180, elevation 45, and a receiver beside it; a beacon goes through the beam's centre."""

    def __init__(self, folder, **options):
        self.clock = VirtualClock()
        self.begin_s = self.clock.utc().timestamp()
        self.dish = open_device("g2?az=-180&el=45", clock=self.clock)
        self.file = folder / "beacons.json"
        self.rig = SimReceiver(
            RigSettings(beacons=str(self.file), noise_db=0.0, **options), self.clock, lambda: self.dish
        )  # fmt: skip

    def lay(self, *rows):
        rows = [[self.begin_s + second, *more] for second, *more in rows]
        beacon = {"name": "DEMO", "frequency_hz": SENT_HZ, "rows": rows}
        self.file.write_text(json.dumps({"beacons": [beacon]}))

    def cross(self):
        """20 degrees of azimuth in 100 s, the middle of the beam after 50; 1 kHz lower every 10 s."""
        self.lay(*((s, 170.0 + 0.2 * s, 45.0, -40.0, -100.0 * s) for s in range(0, 101, 10)))

    def hear(self, after_s, shift_hz=None):
        self.clock.advance(self.begin_s + after_s - self.clock.utc().timestamp())
        assert self.rig.answer(f"F {SENT_HZ + (-100.0 * after_s if shift_hz is None else shift_hz):.0f}") == "RPRT 0\n"
        return float(self.rig.answer("l STRENGTH"))


@pytest.fixture
def bench(tmp_path):
    return lambda **options: Bench(tmp_path, **options)


def test_a_beacon_rises_as_it_crosses_the_beam_and_falls_again(bench):
    there = bench()
    there.cross()
    heard = [there.hear(second) for second in (1, 25, 35, 45, 50, 55, 65, 75, 99)]
    assert heard[4] == max(heard) == pytest.approx(-40.0, abs=0.1)
    assert heard[:5] == sorted(heard[:5])
    assert heard[4:] == sorted(heard[4:], reverse=True)
    assert heard[0] < -49.0


def test_half_a_beam_beside_it_half_of_the_power_is_left(bench):
    there = bench()
    there.cross()
    assert there.hear(50 + 2.77 / 0.707 / 0.2) == pytest.approx(-43.0, abs=0.7)


def test_it_hears_where_the_dish_truly_looks_whatever_its_console_says(tmp_path):
    there = Bench(tmp_path)
    there.dish = open_device("g2?az=-180&el=45&heading=30", clock=there.clock)
    there.cross()
    assert there.hear(50) == pytest.approx(-60.0, abs=0.01)


def test_it_hears_only_what_it_is_tuned_to(bench):
    there = bench()
    there.cross()
    assert there.hear(50, -5000.0) == pytest.approx(-40.0, abs=0.1)
    assert there.hear(50, -5000.0 + 9900.0) > -41.0
    assert there.hear(50, -5000.0 - 10100.0) == -60.0
    assert there.hear(50, 145e6 - SENT_HZ) == -60.0


def test_behind_a_converter_it_is_tuned_lower(bench):
    there = bench(lo_hz=9.75e9)
    there.cross()
    assert there.hear(50, -5000.0) == -60.0
    assert there.hear(50, -5000.0 - 9.75e9) == pytest.approx(-40.0, abs=0.1)


def test_below_the_horizon_and_between_two_passes_there_is_nothing(bench):
    there = bench()
    there.lay((0, 180, 45, -40), (10, 180, 45, -40), (500, 180, 45, -40), (510, 180, 45, -40))
    assert there.hear(5, 0.0) > -41
    assert there.hear(250, 0.0) == -60
    assert there.hear(505, 0.0) > -41
    assert there.hear(600, 0.0) == -60


def test_the_file_may_come_later_and_change(bench):
    there = bench()
    assert there.hear(1) == -60
    there.lay((0, 180, 45, -40), (30, 180, 45, -40))
    assert there.hear(2, 0.0) > -41
    there.lay((0, 180, 45, -30), (30, 180, 45, -30), (31, 180, 45, -30))
    assert there.hear(3, 0.0) > -31
    there.file.write_text("{")
    assert there.rig.answer("l STRENGTH") == "RPRT -6\n"


def test_its_noise_is_its_own_and_repeats(tmp_path):
    def told(seed):
        rig = SimReceiver(RigSettings(noise_db=0.5, seed=seed), VirtualClock(), lambda: None)
        return [float(rig.answer("l STRENGTH")) for _ in range(300)]

    assert told(1) == told(1) != told(2)
    assert statistics.mean(told(1)) == pytest.approx(-60.0, abs=0.1)
    assert statistics.stdev(told(1)) == pytest.approx(0.5, abs=0.1)


@pytest.mark.parametrize(
    "text",
    [
        "[]", "{}", '{"beacons": [1]}', '{"beacons": [{"rows": []}]}',
        '{"beacons": [{"frequency_hz": 1, "rows": [[1, 2, 3]]}]}',
        '{"beacons": [{"frequency_hz": 1, "rows": [[1, 2, 3, "x"]]}]}',
        '{"beacons": [{"frequency_hz": 1, "rows": [[2, 2, 3, 4], [1, 2, 3, 4]]}]}',
    ],
)  # fmt: skip
def test_what_is_no_list_of_beacons_is_told(tmp_path, text):
    file = tmp_path / "beacons.json"
    file.write_text(text)
    with pytest.raises(ValueError, match=r"beacons\.json"):
        read_beacons(file)


def test_near_the_zenith_the_direction_goes_through_it_and_not_around(bench):
    there = bench()
    there.lay((0, 0, 89, -40), (10, 180, 89, -40))
    (beacon,) = read_beacons(there.file)
    assert beacon.at(there.begin_s + 5).el_deg == pytest.approx(90.0)
    assert beacon.at(there.begin_s + 2.5).az_deg == pytest.approx(0.0)


def test_the_beam_is_as_wide_everywhere_in_the_sky():
    def heard(*directions):
        return power_toward(*directions, (12.0, 12.0)) ** (1.0 / COMPRESSION)

    assert heard(10.0, 30.0, 10.0, 30.0) == 1.0
    assert heard(12.0, 0.0, 10.0, 0.0) == pytest.approx(gain(2.0, 0.0))
    assert heard(10.0, 32.0, 10.0, 30.0) == pytest.approx(gain(0.0, 2.0))
    # 2 degrees over the zenith, and 60 degrees of azimuth beside it that are 1 on the sky.
    assert heard(190.0, 89.0, 10.0, 89.0) == pytest.approx(gain(0.0, 2.0))
    assert heard(70.0, 89.0, 10.0, 89.0) == pytest.approx(gain(0.866, 0.5), abs=0.01)
    assert heard(190.0, 30.0, 10.0, 30.0) == 0.0


def test_how_it_talks(bench):
    rig = bench().rig
    assert [rig.answer(line) for line in ("F 137912500", "f", "\\get_freq", "F 0", "F x", "F", "F 1e12", "f")] == [
        "RPRT 0\n", "137912500\n", "137912500\n", *["RPRT -1\n"] * 4, "137912500\n",
    ]  # fmt: skip
    assert (rig.answer("AOS"), rig.recording, rig.answer("LOS"), rig.recording) == ("RPRT 0\n", True, "RPRT 0\n", False)
    assert rig.answer("l RAWSTR") == rig.answer("dance") == "RPRT -11\n"
    assert rig.answer("l ?") == "STRENGTH\n"
    assert rig.answer("") == ""


def test_in_memory_bytes_go_in_pieces_and_leave_takes_it_away():
    port = open_port("rig?floor_db=-55&noise_db=0", clock=VirtualClock())
    assert not port.pending()
    port.write(b"F 1000")
    port.write(b"00000\nl STREN")
    assert port.read() == b"RPRT 0\n"
    port.write(b"GTH\nq\n")
    assert port.read() == b"-55.0\nRPRT 0\n"
    with pytest.raises(ConnectionError):
        port.read()
    with pytest.raises(ConnectionError):
        port.write(b"f\n")


def test_what_it_has_no_option_for_is_told():
    with pytest.raises(ValueError, match="did you mean beacons"):
        open_port("rig?beacon=x", clock=VirtualClock())


@pytest.mark.parametrize("firmware", ["g2", "hal205"])
def test_each_dish_hears_with_the_beam_that_its_reflector_makes(firmware):
    """The driver's theory beside the simulator's own beam: twins that know nothing of each other."""
    dish = open_device(f"{firmware}?az=0&el=45", clock=VirtualClock())
    model = next(each for each in list_models() if each.firmware == firmware)
    beam = beam_of(STOCK_FEED, model.reflector)

    def lost_db(right_deg, up_deg):
        source = beside(0.0, 45.0, -right_deg, -up_deg)
        return -10.0 * math.log10(power_toward(0.0, 45.0, *source, dish.settings.reflector_in))

    for side in (-1.0, 1.0):
        assert lost_db(side * beam.az_deg / 2.0, 0.0) == pytest.approx(3.0, abs=0.7)
        assert lost_db(0.0, side * beam.el_deg / 2.0) == pytest.approx(3.0, abs=0.7)
        across, up = side * 0.2 * beam.az_deg, 0.25 * beam.el_deg
        assert lost_db(across, up) == pytest.approx(beam.loss_db(across, up), abs=0.7)
