"""A port that names its machine, typed in the setup: the session begins anew and speaks to that."""

from birdcage.setup.steps.firmware import speak_another
from birdcage.station.state import LinkPhase

AT = "rotctl://shed:4533"


def test_its_machine_is_kept_with_the_port_and_spoken_to(build):
    house = build("hal205?seed=1", firmware="g2")
    house.until(lambda: house.state.link.state is LinkPhase.SILENT)
    house.choose("link", "other", port=AT)
    assert house.setup.begin_anew == "rotctl"
    kept = house.file().dish
    assert (kept.port, kept.firmware, kept.baud) == (AT, "rotctl", None)
    assert house.file().link.usb_identity is None
    assert all(port != AT for port, _baud in house.opened), "nobody spoke as to a G2 there"


def test_another_dish_afterwards_takes_the_port_along(build):
    house = build("hal205?seed=1", firmware="g2")
    house.until(lambda: house.state.link.state is LinkPhase.SILENT)
    house.choose("link", "other", port=AT)
    speak_another(house.setup._bench, "hal205")
    kept = house.file().dish
    assert (kept.port, kept.firmware) == ("/dev/ttyUSB0", "hal205")
