"""A simulated receiver through a whole pass: opened by its address, tuned, heard through the beam of the dish."""

from __future__ import annotations

import json

import pytest
from birdcage.base.clock import VirtualClock
from birdcage.base.config.tracking_sections import RadioSettings
from birdcage.base.wake import Wake
from birdcage.link.opening import is_registered
from birdcage.radio.errors import RadioLost
from birdcage.radio.now import RadioState
from birdcage.radio.opening import caller
from birdcage.radio.probe import ask_receiver
from birdcage.radio.runner import ReceiverRunner
from birdcage.radio.tuning import Tuning
from birdcage.sim.port import open_device

SENT_HZ, LO_HZ = 11.7e9, 9.75e9


def shift_hz(second):
    """Of a low pass in Ku band: 250 kHz from end to end."""
    return 125e3 - 2500.0 * second


@pytest.fixture
def address(tmp_path):
    """Return the address of a receiver beside a dish that waits where a beacon comes through, 50 s from now."""
    begin_s = VirtualClock().utc().timestamp()
    rows = [[begin_s + s, 160.0 + 0.4 * s, 45.0, -40.0, shift_hz(s)] for s in range(0, 101, 5)]
    file = tmp_path / "beacons.json"
    file.write_text(json.dumps({"beacons": [{"name": "DEMO", "frequency_hz": SENT_HZ, "rows": rows}]}))
    return f"sim:rig?dish={tmp_path.name}&beacons={file}&lo_hz={LO_HZ}&noise_db=0", tmp_path.name


def through(address, dish, *, wrong_hz=0.0):
    """Follow the pass with a dish that stands still; return what was shown, by its second."""
    clock = VirtualClock()
    if dish:
        open_device(f"g2?az=-180&el=45&id={dish}", clock=clock)
    shown = []
    begin_s = clock.utc().timestamp()
    runner = ReceiverRunner(RadioSettings(rigctld=address, strength=True), clock, shown.append)
    shift = lambda at_s: shift_hz(at_s - begin_s) + wrong_hz  # noqa: E731
    runner.follow(Tuning("DEMO", SENT_HZ, shift, begin_s, begin_s + 100.0, LO_HZ))
    while clock.utc().timestamp() < begin_s + 99.0:
        clock.wait(None, runner.step())
    heard = {round(now.strength_at.timestamp() - begin_s): now.strength_db for now in shown if now.strength_at}
    recording = runner.now.recording
    assert runner.close()
    return shown, heard, recording


def test_the_carrier_rises_as_it_enters_the_beam_and_goes(address):
    shown, heard, recording = through(*address)
    assert shown[-2].state is RadioState.TUNED
    assert shown[-2].address == "sim:rig"
    assert recording
    assert heard[50] == pytest.approx(-40.0, abs=0.1)
    assert heard[30] < heard[40] < heard[46] < heard[50] > heard[54] > heard[60] > heard[70]
    assert {strength for second, strength in heard.items() if abs(second - 50) > 42} == {-60.0}
    assert len(heard) >= 90


def test_with_doppler_wrong_by_more_than_the_passband_nothing_is_heard(address):
    _, heard, _ = through(*address, wrong_hz=15e3)
    assert set(heard.values()) == {-60.0}


def test_pass_services_no_dish_it_hears_its_own_noise(address):
    _, heard, _ = through(address[0].replace(f"dish={address[1]}", "dish=nobody"), "")
    assert set(heard.values()) == {-60.0}


def test_what_is_a_kind_of_port_and_what_an_address():
    assert is_registered("sim:rig")
    assert not any(is_registered(text) for text in ("localhost:4532", "radio.lan:7356", "socket://a:1", "/dev/ttyUSB0"))
    assert ask_receiver("sim:rig").frequency_hz == 145e6


def test_an_option_that_it_does_not_have_is_told():
    where, call = caller("sim:rig?beacon=x", VirtualClock())
    assert where == "sim:rig"
    with pytest.raises(RadioLost, match="did you mean beacons"):
        call(1.0)


def test_a_program_that_ends_waits_for_it_shortly():
    clock, hurry = VirtualClock(), Wake()
    wire = caller("sim:rig", clock, hurry)[1](1.0)
    began = clock.monotonic()
    assert wire.receive(5.0) == b""
    assert clock.monotonic() == pytest.approx(began + 5.0)
    hurry.set()
    assert wire.receive(5.0) == b""
    assert clock.monotonic() == pytest.approx(began + 5.2)
    wire.close()
    with pytest.raises(RadioLost):
        wire.send(b"f\n")
