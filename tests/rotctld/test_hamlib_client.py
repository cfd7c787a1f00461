"""Hamlib's own `rotctl -m 2` and its Python binding against the server, on threads and a real clock."""

from __future__ import annotations

import json
import shutil
import subprocess

import pytest
from birdcage.base.config import RotctldSettings
from birdcage.rotctld.listening import listen
from birdcage.rotctld.options import RotctldOptions
from birdcage.rotctld.server import RotctldService
from birdcage.station.requests import Goto
from birdcage.station.state import Activity

from .real_dish import RealDish

pytestmark = pytest.mark.skipif(shutil.which("rotctl") is None, reason="Hamlib's rotctl is not installed")

SYSTEM_PYTHON = "/usr/bin/python3"
"""Hamlib's binding belongs to the system's Python, not to ours."""
BINDING = """
import json, sys
import Hamlib

Hamlib.rig_set_debug(Hamlib.RIG_DEBUG_NONE)
rot = Hamlib.Rot(Hamlib.ROT_MODEL_NETROTCTL)
rot.set_conf("rot_pathname", sys.argv[1])

def did(value=None):
    print(json.dumps([value, rot.error_status]), flush=True)

did(rot.open())
for line in sys.stdin:
    match line.split():
        case ["read"]: did(rot.get_position())
        case ["set", az, el]: did(rot.set_position(float(az), float(el)))
        case ["name"]: did(rot.get_info())
        case ["stop"]: did(rot.stop())
        case ["park"]: did(rot.park())
did(rot.close())
"""


class Served(RealDish):
    """A simulated G2 behind a server."""

    def __init__(self):
        super().__init__()
        self.service = RotctldService(
            self.session.station, listen("127.0.0.1", 0), RotctldSettings(), RotctldOptions(park=(180.0, 40.0))
        )
        self.service.start()
        self.wait_for(lambda state: state.position is not None)

    def rotctl(self, *words, typed=None):
        """Run one command, or what is typed at its prompt; return what it prints."""
        command = ["rotctl", "-m", "2", "-r", f"127.0.0.1:{self.service.address[1]}", *words]
        return subprocess.run(command, capture_output=True, text=True, timeout=30, check=False, input=typed).stdout

    def prompt(self):
        """Start one whose prompt stays open."""
        command = ["rotctl", "-m", "2", "-r", f"127.0.0.1:{self.service.address[1]}"]
        return subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)


@pytest.fixture
def served():
    served = Served()
    yield served
    served.service.shutdown()
    served.session.close()


def test_it_points_the_dish_and_reads_where_it_is(served):
    assert served.rotctl("P", "20", "45") == ""
    served.wait_at(20.0, 45.0)
    assert [float(each) for each in served.rotctl("p").split()] == pytest.approx([20.0, 45.0], abs=0.1)
    assert served.rotctl("_").strip() == "Carryout G2"


def test_it_parks_drives_and_stops(served):
    assert served.rotctl("K") == ""
    served.wait_at(180.0, 40.0)
    served.wait_for(lambda state: state.holder is None)  # the one that parked it has left
    with served.prompt() as rotctl:
        rotctl.stdin.write("M 8 50\n")  # left: counter-clockwise
        rotctl.stdin.flush()
        served.wait_for(lambda state: state.position.az_deg < 179.0)
        said, _ = rotctl.communicate("q\n", timeout=30)
    assert "error" not in said
    served.wait_for(lambda state: state.holder is None)
    interactive = served.rotctl(typed="P 300 40\nS\nq\n")
    assert "error" not in interactive
    served.wait_for(lambda state: state.activity is Activity.IDLE)
    assert not 290.0 < served.state.position.az_deg < 310.0
    assert served.state.held is None


def test_its_own_stop_does_not_end_what_somebody_else_moves(served):
    future = served.session.station.submit(Goto(120.0, 40.0, "you"))
    served.wait_for(lambda state: state.motion is not None)
    assert served.rotctl("S") == ""
    assert future.result(30.0).az_deg == pytest.approx(120.0, abs=0.1)


def test_an_interactive_session_of_many_commands(served):
    said = served.rotctl(typed="P 30 50\np\n_\nS\nR 1\nq\n")
    assert "Azimuth: " in said
    assert "Info: Carryout G2" in said
    assert said.count("error") == 1  # R 1: no program in the network restarts or homes a dish


@pytest.fixture
def binding(served):
    """Open the server with Hamlib's binding in the system's Python; return what it does, and ends, line by line."""
    known = subprocess.run([SYSTEM_PYTHON, "-c", "import Hamlib"], capture_output=True, check=False)
    if known.returncode:
        pytest.skip("Hamlib's Python binding is not installed (python3-hamlib)")
    program = subprocess.Popen(
        [SYSTEM_PYTHON, "-E", "-c", BINDING, f"127.0.0.1:{served.service.address[1]}"],
        stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True,
    )  # fmt: skip
    assert json.loads(program.stdout.readline()) == [None, 0]

    def did(what):
        program.stdin.write(f"{what}\n")
        program.stdin.flush()
        return json.loads(program.stdout.readline())

    yield did
    last, _ = program.communicate(timeout=10)
    assert json.loads(last) == [None, 0]
    assert program.returncode == 0


def test_its_python_binding_opens_reads_sets_and_closes(served, binding):
    assert binding("set 200 45") == [None, 0]
    served.wait_at(200.0, 45.0)
    where, status = binding("read")
    assert (where, status) == (pytest.approx([200.0, 45.0], abs=0.1), 0)
    assert binding("name") == ["Carryout G2\n", 0]
    assert binding("set 300 45") == [None, 0]
    served.wait_for(lambda state: state.motion is not None)
    assert binding("stop") == [None, 0]
    served.wait_for(lambda state: state.activity is Activity.IDLE)
    assert not 290.0 < served.state.position.az_deg < 310.0


def test_an_error_reaches_a_program_with_the_binding(served, binding):
    served.service.shutdown()
    assert binding("read")[1] < 0
