"""A station as attached programs see one, and an attached program that says what a test wants."""

from __future__ import annotations

import contextlib
import json
import socket
import threading
import time
from collections.abc import Callable, Iterator

from birdcage.base.paths import Paths
from birdcage.station.attach_messages import Attach
from birdcage.station.control_client import find_owner, owners_folder
from birdcage.station.control_messages import ControlCall, as_line, call_to_json
from birdcage.station.control_server import ControlServer
from birdcage.station.events import TranscriptLine
from birdcage.station.json_form import to_json
from birdcage.station.json_lines import LineReader
from birdcage.station.services import Services
from birdcage.station.state import LinkPhase

from .owner_stand_in import OwnerStandIn


@contextlib.contextmanager
def served(tmp_path) -> Iterator[OwnerStandIn]:
    """A station whose program announces its port."""
    port = tmp_path / "port"
    port.touch()
    owner = OwnerStandIn(str(port))
    folder = owners_folder(Paths.default())
    owner.services = Services()
    owner.server = ControlServer(owner, folder, on_wire=owner.transcript.listen, services=owner.services)
    owner.link(LinkPhase.UP)
    owner.found = find_owner(folder, str(port))

    def serve_again() -> None:
        """Let another program have the port, after this one's server was closed."""
        owner.services = Services()
        owner.server = ControlServer(owner, folder, on_wire=owner.transcript.listen, services=owner.services)
        owner.link(LinkPhase.UP)

    owner.serve_again = serve_again
    yield owner
    owner.thawed.set()
    owner.server.close()


class Caller:
    """An attached program that says what the test wants it to say."""

    def __init__(self, owner, name="anna") -> None:
        self.line = socket.create_connection(("127.0.0.1", owner.found.tcp_port), 5)
        self.lines = LineReader(self.line)
        self.say(call_to_json(owner.found.token, ControlCall(Attach(name), "test")))
        self.welcome = self.hear()
        assert self.welcome["ok"] is True, self.welcome

    def say(self, told) -> None:
        self.line.sendall(told if isinstance(told, bytes) else as_line(told))

    def ask(self, number, request) -> None:
        self.say({"v": 1, "id": number, "request": to_json(request)})

    def hear(self, within_s=10.0):
        line = self.lines.read(4_000_000, within_s)
        return json.loads(line) if line else None

    def hear_all(self):
        with contextlib.suppress(OSError):
            while (told := self.hear()) is not None:
                yield told

    def until(self, **fields):
        for told in self.hear_all():
            if fields.items() <= told.items():
                return told
        raise AssertionError(f"never heard {fields}")

    def close(self) -> None:
        self.line.close()


@contextlib.contextmanager
def callers(owner) -> Iterator[Callable[..., Caller]]:
    """What attaches programs, which are gone afterwards."""
    with contextlib.ExitStack() as stack:
        yield lambda *given: stack.enter_context(contextlib.closing(Caller(owner, *given)))


def until(seen, within_s=10.0) -> None:
    end = time.monotonic() + within_s
    while not seen():
        assert time.monotonic() < end, "not seen in time"
        threading.Event().wait(0.01)


def is_alone(owner) -> bool:
    """Whether the station tells its own server alone."""
    return not owner.board._watchers and [each for each, _ in owner.board._listeners] == [owner.server._hear]


def tell(owner, text: str) -> TranscriptLine:
    line = TranscriptLine(*owner.board.stamp(), "<", text)
    owner.board.tell(line)
    return line
