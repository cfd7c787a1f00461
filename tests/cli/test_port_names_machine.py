"""`--port rotctl://…` alone, on Hamlib's own rotctld: no firmware is named anywhere."""

from __future__ import annotations

import json

import pytest
from hamlib_program import hamlib_program


@pytest.fixture(scope="module")
def port():
    with hamlib_program("rotctld") as number:
        yield f"rotctl://127.0.0.1:{number}"


def test_detect_names_it(run, port):
    said = run("detect", port=port, firmware="")
    assert said.exit_code == 0, said.stderr
    assert f"{port} is a rotctld rotator (rotctl)" in said.stdout
    assert "Dummy rotator" in said.stdout
    assert json.loads(run("detect", "--json", port=port, firmware="").stdout)["firmware"] == "rotctl"


def test_it_is_met_moved_read_and_stopped(run, port):
    for words in (("init",), ("move", "6", "4"), ("get", "info")):
        said = run(*words, port=port, firmware="")
        assert said.exit_code == 0, (words, said.stderr)
    assert run("pos", port=port, firmware="").stdout == "AZ: 6.0\nEL: 4.0\n"
    told = json.loads(run("status", "--json", port=port, firmware="").stdout)
    assert (told["firmware"], told["link"], told["port"]) == ("rotctl", "up", port)
    stopped = run("stop", port=port, firmware="")
    assert stopped.exit_code == 0, stopped.stderr
    assert "Stands still at 6.00°/4.00°" in stopped.stdout
    held = run("move", "8", "4", port=port, firmware="")
    assert held.exit_code == 4
    assert run("release", port=port, firmware="").exit_code == 0


def test_another_firmware_is_told_not_to_count(run, port):
    said = run("pos", port=port, firmware="g2")
    assert said.exit_code == 0
    assert f"dish.firmware is 'g2', and does not count: {port} is a port of 'rotctl'." in said.stderr


def test_an_address_without_a_server_is_one_sentence(run):
    said = run("detect", port="rotctl://127.0.0.1:1", firmware="")
    assert said.exit_code == 3
    assert "no connection (Connection refused)" in said.stdout
    assert "Traceback" not in said.stdout + said.stderr
