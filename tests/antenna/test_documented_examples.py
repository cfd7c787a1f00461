"""The class that docs/commands.md shows drives a rotor as it stands."""

from __future__ import annotations

import re
import socketserver
import threading
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]


def example(page: str, words: str) -> str:
    blocks = re.findall(r"```python\n(.*?)```", (ROOT / page).read_text(encoding="utf-8"), re.DOTALL)
    [block] = [block for block in blocks if words in block]
    return block


class Rotor(socketserver.StreamRequestHandler):
    """A rotor that speaks EasyComm II, and is at once where it is sent."""

    def handle(self):
        at = {"AZ": 180.0, "EL": 45.0}
        for line in self.rfile:
            self.server.heard.append(line)
            if line == b"AZ EL \n":
                self.wfile.write(b"AZ%.1f EL%.1f\n" % (at["AZ"], at["EL"]))
            else:
                at[line[:2].decode()] = float(line[2:])


@pytest.fixture
def rotor():
    with socketserver.TCPServer(("127.0.0.1", 0), Rotor) as server:
        server.heard = []
        thread = threading.Thread(target=server.serve_forever, kwargs={"poll_interval": 0.01})
        thread.start()
        yield server
        server.shutdown()
        thread.join()


def test_a_rotor_with_a_port_of_its_own(rotor, capsys):
    code = example("docs/commands.md", "class EasyComm")
    assert "/dev/ttyUSB0" in code
    exec(code.replace("/dev/ttyUSB0", f"socket://127.0.0.1:{rotor.server_address[1]}"), {})
    assert capsys.readouterr().out == "Position(azimuth=181.0, elevation=46.0, skew=None)\n"
    assert rotor.heard == [b"AZ EL \n", b"AZ181.0\n", b"EL46.0\n", b"AZ EL \n"]
