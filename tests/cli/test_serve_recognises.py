"""`birdcage serve` recognises the satellite that a client follows: the process itself, in real time."""

from __future__ import annotations

import socket
import threading
import time
from datetime import UTC, datetime, timedelta

import pytest
from birdcage.base.geometry import separation
from birdcage.base.paths import Paths
from birdcage.sky.catalogue import Catalogue
from birdcage.sky.demo_orbits import demo_orbits
from birdcage.sky.observer import Observer
from birdcage.sky.targets.model import Satellite

HERE = Observer(47.0, 8.0)
PLACE = '[place]\nname = "Bench"\nlatitude_deg = 47.0\nlongitude_deg = 8.0\n'
WITHIN_S = 60.0


@pytest.mark.parametrize("pty_dish", ["seed=1&az_speed=30"], indirect=True)
def test_it_follows_by_a_plan_what_a_client_asks_for_and_leaves_it_for_another_wish(
    serve, pty_dish, run, as_json
) -> None:
    paths = Paths.default()
    paths.config_file.parent.mkdir(parents=True, exist_ok=True)
    paths.config_file.write_text(PLACE)
    orbits = demo_orbits(datetime.now(UTC) + timedelta(seconds=60.0), HERE)  # the first one is high up, and fast
    with Catalogue(paths.catalogue) as catalogue:
        catalogue.add(orbits)
    _process, port = serve()
    satellite = Satellite(orbits[0])

    def told():
        network = as_json(run("status", "--json", port=pty_dish.path))["network"]
        return network["clients"][0] if network and network["clients"] else None

    with socket.create_connection(("127.0.0.1", port), timeout=10) as client:
        lines = client.makefile("r")

        def ask(words):
            client.sendall(f"{words}\n".encode())
            return lines.readline().strip()

        def wish():
            look = satellite.look(HERE, datetime.now(UTC))
            assert ask(f"P {look.az_deg:.2f} {look.el_deg:.2f}") == "RPRT 0"
            threading.Event().wait(0.5)

        while ask("p").startswith("RPRT"):
            threading.Event().wait(0.2)
        lines.readline()
        end, seen = time.monotonic() + WITHIN_S, None
        while not (seen and seen["follows"] == orbits[0].name and seen["follow_error_deg"] is not None):
            assert time.monotonic() < end, seen
            wish()
            seen = told() if time.monotonic() > end - WITHIN_S + 4.0 else None
        assert seen["role"] == "control"
        assert seen["steps_error_deg"] > 0.0
        wish()
        truth, look = pty_dish.device.truth(), satellite.look(HERE, datetime.now(UTC))
        assert separation(truth.az_deg % 360.0, truth.el_deg, look.az_deg, look.el_deg) < 3.0
        assert "follows DEMO LEO 1" in run("status", port=pty_dish.path).stdout
        assert ask("P 200 30") == "RPRT 0"
        pty_dish.wait_for(lambda truth: not truth.moving and abs(truth.az_deg % 360.0 - 200.0) < 0.3)
        assert told()["follows"] is None
