"""`birdcage serve --easycomm` as a process: a serial port of a fixed name, and nothing on the network."""

from __future__ import annotations

import json
import os
import signal

import pytest

pytest.importorskip("termios", reason="a pseudo terminal is needed")


def ask(link, said):
    port = os.open(link, os.O_RDWR | os.O_NOCTTY)
    try:
        os.write(port, said)
        return os.read(port, 100)
    finally:
        os.close(port)


def test_it_serves_at_its_link_until_it_is_ended(start, pty_dish, tmp_path):
    link = tmp_path / "rotator"
    process = start(
        "serve", "--port", pty_dish.path, "--firmware", "g2", "--easycomm", "--link", link, "--skip-init", "--json"
    )
    told = json.loads(process.stdout.readline())
    while told.get("type") != "Serving":
        told = json.loads(process.stdout.readline())
    assert told["link"] == str(link)
    assert os.path.realpath(link) == told["port"]
    while json.loads(process.stdout.readline()).get("type") != "PositionRead":
        pass
    assert ask(link, b"AZ EL\n").startswith(b"AZ0.0 EL45.")
    assert ask(link, b"AZ20.0 EL45.0\nGS\n")[:2] == b"GS"
    pty_dish.wait_for_motion()
    process.send_signal(signal.SIGINT)
    process.communicate(timeout=20)
    assert not link.is_symlink()
    pty_dish.wait_for(lambda truth: not truth.moving)
    assert pty_dish.device.truth().az_deg < 19.0, "STOP went out first"


@pytest.mark.parametrize("words", [
    ("--listen-port", 0), ("--host", "0.0.0.0"), ("--strict",), ("--record", "x"), ("--selftest",),
    ("--allow", "10.0.0.0/8"),
])  # fmt: skip
def test_what_is_of_the_network_does_not_go_with_it(run, words):
    said = run("serve", "--easycomm", *words)
    assert said.exit_code == 2
    assert f"{words[0]} is for the network" in said.stderr


def test_a_link_goes_with_it_alone(run, tmp_path):
    said = run("serve", "--link", tmp_path / "rotator")
    assert said.exit_code == 2
    assert "--link goes with --easycomm." in said.stderr
