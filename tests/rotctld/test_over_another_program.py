"""The same server over the station of another program, attached through the control channel."""

from __future__ import annotations

import socket
import time

from birdcage.base.clock import RealClock
from birdcage.base.config import RotctldSettings, load
from birdcage.base.paths import Paths
from birdcage.rotctld.listening import listen
from birdcage.rotctld.options import RotctldOptions
from birdcage.rotctld.server import RotctldService
from birdcage.station.attached import AttachedStation
from birdcage.station.build import open_session
from birdcage.station.control_client import find_owners, owners_folder
from birdcage.station.control_server import ControlServer
from pty_dish import PtyDish


def wait_for(good, within_s=30.0):
    end = time.monotonic() + within_s
    while not good():
        assert time.monotonic() < end
        time.sleep(0.02)


def test_clients_drive_the_dish_of_another_program():
    paths, dish = Paths.default(), PtyDish()
    session = open_session(
        port=dish.path, firmware="g2", baud=None, settings=load(None), paths=paths, clock=RealClock(), survey=False
    )
    control = ControlServer(session.station, owners_folder(paths))
    session.start()
    wait_for(lambda: find_owners(owners_folder(paths)))
    attached = AttachedStation(paths, dish.path, by="birdcage serve")
    assert attached.wait_attached(10.0)
    service = RotctldService(attached, listen("127.0.0.1", 0), RotctldSettings(), RotctldOptions())
    service.start()
    try:
        with socket.create_connection(service.address, timeout=10.0) as client:

            def ask(command):
                client.sendall(command)
                return client.recv(100)

            wait_for(lambda: not ask(b"p\n").startswith(b"RPRT"))
            assert ask(b"P 20 45\n") == b"RPRT 0\n"
            wait_for(lambda: float(ask(b"p\n").split()[0]) > 15.0)
            assert abs(dish.device.truth().az_deg - 20.0) < 10.0
            assert ask(b"S\n") == b"RPRT 0\n"
    finally:
        service.shutdown()
        attached.close()
        session.close()
        control.close()
        dish.close()
