"""What Gpredict and SatNOGS are told: the limits of this dish, and where the server listens."""

from __future__ import annotations

import configparser
import os

import pytest
from birdcage.cli.client_settings import ListeningPlace, gpredict_file, where_it_listens
from birdcage.sky.reach_limits import ReachLimits
from birdcage.station.network_state import NetworkState


@pytest.fixture
def gpredict(run):
    """Run `serve --print-gpredict` and return its keys, and what is said on stderr."""

    def gpredict(*words, **more):
        result = run("serve", "--print-gpredict", *words, **{"port": "/dev/not-there", **more})
        assert result.exit_code == 0, result.stderr
        return rotator(result.stdout), result.stderr

    return gpredict


def rotator(text):
    parser = configparser.ConfigParser()
    parser.optionxform = str
    parser.read_string(text)
    assert parser.sections() == ["Rotator"]
    return dict(parser["Rotator"])


@pytest.mark.parametrize(
    ("firmware", "low", "high"), [("g2", "18", "65"), ("hal205", "15", "90"), ("carryout", "22", "73")]
)
def test_gpredict_gets_the_limits_of_the_dish(gpredict, firmware, low, high):
    keys, said = gpredict(firmware=firmware)
    assert keys == {
        "Host": "localhost", "Port": "4533", "AzType": "0", "MinAz": "0", "MaxAz": "360", "MinEl": low, "MaxEl": high,
        "AzStopPos": "0", "Cycle": "1000", "Threshold": "1",
    }  # fmt: skip
    assert "Gpredict/hwconf/birdcage.rot" in said


def test_settings_narrow_them_and_name_the_port(gpredict, tmp_path):
    config = tmp_path / "own.toml"
    config.write_text("[motion]\nmin_elevation_deg = 30.456\nmax_elevation_deg = 60.0\n[rotctld]\nport = 4600\n")
    keys, _ = gpredict("--config", config)
    assert (keys["MinEl"], keys["MaxEl"], keys["Port"]) == ("30.46", "60", "4600")
    keys, _ = gpredict("--config", config, "--listen-port", 4700, "--host", "192.168.1.9")
    assert (keys["Host"], keys["Port"]) == ("192.168.1.9", "4700")


@pytest.mark.skipif(os.name != "posix", reason="a pty")
def test_a_running_station_is_asked_for_its_limits_and_its_server(gpredict, owner, pty_dish):
    owner.station.show_network(NetworkState("0.0.0.0", 4999))
    pty_dish.wait_for(lambda _truth: owner.station.state.el_min_deg is not None)
    keys, _ = gpredict(port=pty_dish.path, env={"BIRDCAGE_FIRMWARE": "hal205"})
    assert (keys["MinEl"], keys["MaxEl"]) == ("18", "65")
    assert (keys["Host"], keys["Port"]) == ("localhost", "4999")
    keys, _ = gpredict("--listen-port", 4700, port=pty_dish.path)
    assert keys["Port"] == "4700"


def test_nothing_is_invented_for_an_unknown_dish(run):
    result = run("serve", "--print-gpredict", port="/dev/not-there", firmware="")
    assert result.exit_code == 2
    assert result.stdout == ""
    assert "Name the firmware with --firmware." in result.stderr


def test_any_free_port_cannot_be_told(run):
    result = run("serve", "--print-satnogs", "--listen-port", 0)
    assert result.exit_code == 2
    assert "Name one with --listen-port." in result.stderr


@pytest.mark.parametrize(
    ("cable", "offset", "kind", "low", "high", "stop"),
    [
        ((-423.0, 23.0), 0.0, 0, 0.0, 360.0, 0),
        ((10.0, 350.004), 0.0, 0, 10.0, 350.0, 0),
        ((-100.0, 100.0), 0.0, 1, -100.0, 100.0, -180),
        ((-100.0, 100.0), 180.0, 0, 80.0, 280.0, 0),
        ((100.0, 440.0), 0.0, 0, 0.0, 360.0, 0),
        ((None, None), 0.0, 0, 0.0, 360.0, 0),
    ],
)
def test_less_than_a_turn_gets_the_kind_of_azimuth_in_which_it_is_one_piece(cable, offset, kind, low, high, stop):
    limits = ReachLimits(cable_min_deg=cable[0], cable_max_deg=cable[1], az_offset_deg=offset)
    keys = rotator(gpredict_file(ListeningPlace("localhost", 4533), limits))
    told = [float(keys[name]) for name in ("AzType", "MinAz", "MaxAz", "AzStopPos")]
    assert told == [kind, low, high, stop]


def test_satnogs_gets_its_variables_and_what_a_container_needs(run):
    result = run("serve", "--print-satnogs", "--host", "0.0.0.0", "--listen-port", 4600)
    assert result.exit_code == 0, result.stderr
    lines = result.stdout.splitlines()
    assert [line for line in lines if not line.startswith("#")] == [
        "SATNOGS_ROT_MODEL=ROT_MODEL_NETROTCTL", "SATNOGS_ROT_PORT=localhost:4600", "SATNOGS_ROT_THRESHOLD=1",
        "SATNOGS_ROT_FLIP=False",
    ]  # fmt: skip
    assert "#   SATNOGS_ROT_PORT=172.17.0.1:4600" in lines
    assert "#   birdcage serve --host 172.17.0.1 --listen-port 4600 --allow 172.17.0.0/16" in lines


@pytest.mark.parametrize(("host", "told"), [("::", "localhost"), ("::1", "::1"), ("192.168.1.9", "192.168.1.9")])
def test_an_address_that_is_no_address_of_a_machine_is_not_told(host, told):
    from birdcage.base.config import RotctldSettings

    assert where_it_listens(RotctldSettings(host=host), None, given=False) == ListeningPlace(told, 4533)


def test_one_at_a_time(run):
    result = run("serve", "--print-satnogs", "--print-gpredict")
    assert result.exit_code == 2
    assert "one at a time" in result.stderr
