"""The command line, in this process or in one of its own, and a simulated dish on a real pty."""

from __future__ import annotations

import contextlib
import json
import re
import socket
import subprocess
import sys
import threading

import pytest
from birdcage.base.clock import RealClock
from birdcage.base.config import load
from birdcage.base.paths import Paths
from birdcage.cli.app import cli
from birdcage.signal.signal_tasks import signal_tasks
from birdcage.station.build import open_session
from birdcage.station.control_client import find_owners, owner_file, owners_folder
from birdcage.station.control_server import ControlServer
from birdcage.station.state import LinkPhase
from click.testing import CliRunner
from pty_dish import PtyDish

# A server that systemd starts has its listening socket as descriptor 3, and its own number in the environment.
AS_SYSTEMD = """
import os, sys
os.dup2(int(sys.argv[1]), 3)
os.environ.update(LISTEN_FDS="1", LISTEN_PID=str(os.getpid()))
os.execv(sys.executable, [sys.executable, *sys.argv[2:]])
"""

# A test may itself run in the background of a shell, which then ignores SIGINT for all its children.
FRESH = """
import signal
for name in ("SIGTERM", "SIGHUP", "SIGQUIT"):
    signal.signal(getattr(signal, name), signal.SIG_DFL)
signal.signal(signal.SIGINT, signal.default_int_handler)
from birdcage.cli import main
main()
"""


@pytest.fixture
def pty_dish(request):
    """A dish on a pty; `parametrize` it indirectly with options of the simulator."""
    dish = PtyDish(getattr(request, "param", "seed=1"))
    yield dish
    dish.close()


@pytest.fixture
def pty_travler(request):
    """The same with a Trav'ler; or with how much faster it is than a real one, and options."""
    speed, options = getattr(request, "param", (1.0, "seed=1"))
    dish = PtyDish(options, "hal205", speed)
    yield dish
    dish.close()


@pytest.fixture
def run():
    """Run `birdcage` in this process, on a G2 unless told otherwise."""

    def run(*words, port="sim:g2", firmware="g2", env=None, **more):
        before = threading.enumerate()
        env = {"BIRDCAGE_PORT": port, "BIRDCAGE_FIRMWARE": firmware, **(env or {})}
        result = CliRunner().invoke(cli, [str(word) for word in words], env=env, prog_name="birdcage", **more)
        # The end of a process closes its port; here a station may still be leaving the dish's menu.
        for thread in threading.enumerate():
            if thread.name == "station" and thread not in before:
                thread.join(5)
        return result

    return run


@pytest.fixture
def start():
    """Start `birdcage` in a process of its own; with a socket as systemd passes it, if one is given."""
    started = []

    def start(*words, passed=None):
        fds = () if passed is None else (passed.fileno(),)
        systemd = () if passed is None else ("-c", AS_SYSTEMD, str(passed.fileno()))
        process = subprocess.Popen(
            [sys.executable, *systemd, "-c", FRESH, *map(str, words)], pass_fds=fds,
            stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
        )  # fmt: skip
        started.append(process)
        return process

    yield start
    for process in started:
        if process.poll() is None:
            process.kill()
        process.communicate()


@pytest.fixture
def serve(start, pty_dish):
    """Start `birdcage serve` at the dish on a port that the system chooses; return the process and that port."""

    def serve(*words):
        process = start("serve", "--port", pty_dish.path, "--firmware", "g2", "--listen-port", 0, *words)
        while not (found := re.search(r"Listening on \S+ port (\d+)", process.stderr.readline())):
            assert process.poll() is None
        return process, int(found[1])

    return serve


@pytest.fixture
def as_json():
    return lambda result: json.loads(result.stdout)


@pytest.fixture
def owner(pty_dish):
    """A program that has the port, as the app is one."""
    with owning(pty_dish, "g2") as session:
        yield session


@contextlib.contextmanager
def owning(dish, firmware):
    """Have the port in this process, as the app has it."""
    paths = Paths.default()
    session = open_session(
        port=dish.path,
        firmware=firmware,
        baud=None,
        settings=load(None),
        paths=paths,
        clock=RealClock(),
        survey=False,
        tasks=signal_tasks(),
    )
    control_server = ControlServer(session.station, owners_folder(paths))
    session.control_server = control_server
    session.start()
    # Other programs find it once it is announced, a little after the link is up.
    dish.wait_for(lambda _truth: session.station.state.link.state is LinkPhase.UP and find_owners(owners_folder(paths)))
    yield session
    session.close()
    control_server.close()


@pytest.fixture
def older_owner(tmp_path):
    """The port of a program that takes every line for one that it does not know, as an older birdcage does."""
    port = tmp_path / "older"
    port.touch()
    folder = owners_folder(Paths.default())
    folder.mkdir(parents=True, exist_ok=True)
    with socket.create_server(("127.0.0.1", 0)) as older:
        told = {"pid": 1, "tcp_port": older.getsockname()[1], "token": "t", "port": str(port), "asked": str(port)}
        owner_file(folder, str(port)).write_text(json.dumps(told))

        def answer() -> None:
            with contextlib.suppress(OSError):
                while True:
                    caller, _ = older.accept()
                    with caller:
                        caller.recv(4096)
                        caller.sendall(b'{"ok": false, "error": "cannot do None"}\n')

        threading.Thread(target=answer, daemon=True).start()
        yield str(port)
        older.shutdown(socket.SHUT_RDWR)
