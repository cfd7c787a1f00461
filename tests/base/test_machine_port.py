"""A port of a machine's own scheme names that machine: no firmware has to be said, and no other counts."""

import pytest
from birdcage.base.config import edit, load
from birdcage.base.machine_port import machine_at, port_of
from birdcage.link.opening import has_speed, keeps_order
from birdcage.rotator.machines import class_of

AT = "rotctl://shed:4533"


@pytest.mark.parametrize(
    "port", [None, "", "/dev/ttyUSB0", "COM4", "socket://shed:4533", "sim:rotctl", "g2://shed", "rotctl"]
)
def test_other_ports_name_none(port):
    assert machine_at(port) is None


@pytest.mark.parametrize("port", [AT, "rotctl://shed", "ROTCTL://shed", "rotctl://[::1]:4533"])
def test_its_scheme_names_it(port):
    assert class_of(machine_at(port)).facts.firmware == "rotctl"


@pytest.mark.parametrize("source", ["flag", "variable", "file"])
def test_the_settings_have_its_firmware(tmp_path, source):
    file = tmp_path / "birdcage.toml"
    if source == "file":
        edit(file, {"dish.port": AT})
    settings = load(
        file, {"BIRDCAGE_PORT": AT} if source == "variable" else {}, {"dish.port": AT} if source == "flag" else {}
    )
    assert settings.dish.firmware == "rotctl"
    assert settings.sources["dish.firmware"] == "port"
    assert settings.problems == ()


def test_another_firmware_does_not_count_and_that_is_said(tmp_path):
    file = tmp_path / "birdcage.toml"
    edit(file, {"dish.firmware": "g2"})
    settings = load(file, {}, {"dish.port": AT})
    assert settings.dish.firmware == "rotctl"
    (problem,) = settings.problems
    assert problem.text.endswith(f"dish.firmware is 'g2', and does not count: {AT} is a port of 'rotctl'.")
    assert settings.motion_problem is None
    assert load(file, {}, {"dish.port": "/dev/ttyUSB0"}).dish.firmware == "g2"


@pytest.mark.parametrize(
    ("firmware", "given", "kept", "port"),
    [
        ("g2", "/dev/ttyUSB0", None, "/dev/ttyUSB0"),
        ("g2", "/dev/ttyUSB0", "/dev/ttyUSB1", "/dev/ttyUSB0"),
        ("rotctl", "/dev/ttyUSB0", AT, AT),
        ("rotctl", None, AT, AT),
        ("g2", AT, "/dev/ttyUSB0", "/dev/ttyUSB0"),
        ("rotctl", AT, None, AT),
    ],
)
def test_where_a_machine_is_that_was_chosen_instead(firmware, given, kept, port):
    assert port_of(firmware, given, kept) == port


def test_its_line_has_no_rate_of_ours():
    assert not has_speed(AT)
    assert not keeps_order(AT)
    assert has_speed("sim:g2")
    assert has_speed("rfc2217://shed:2217")
    assert keeps_order("sim:g2")
    assert not keeps_order("rfc2217://shed:2217")
