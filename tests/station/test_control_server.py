"""The control server of the process that owns a port, and its callers."""

from __future__ import annotations

import contextlib
import json
import os
import re
import socket
from concurrent.futures import Future
from dataclasses import replace

import pytest
from birdcage.base.clock import VirtualClock
from birdcage.base.errors import CommandRefused
from birdcage.station import control_server
from birdcage.station.control_client import OwnerGone, call_owner, find_owner, find_owners, owner_file
from birdcage.station.control_server import ControlServer
from birdcage.station.events import LinkChanged, StopConfirmed
from birdcage.station.state import LinkPhase, LinkState, StationState, StopReport
from birdcage.station.state_store import StateStore


class Owner:
    """A station as far as a control server sees one: it confirms each STOP at once."""

    def __init__(self, port: str, asked: str | None = None) -> None:
        self.clock = VirtualClock()
        self.board = StateStore(self.clock, StationState(port=port))
        self.asked_port = asked or port
        self.stops: list[str] = []
        self.subscribe, self.warn = self.board.subscribe, self.board.warn

    @property
    def state(self) -> StationState:
        return self.board.state

    def stop(self, by: str) -> None:
        self.stops.append(by)
        report = StopReport(by, self.clock.monotonic(), "retarget", True, "Stands still.")
        self.board.change(last_stop=report)
        self.board.tell(StopConfirmed(*self.board.stamp(), report))

    def link(self, state: LinkPhase, **fields) -> None:
        self.board.change(link=LinkState(state), **fields)
        self.board.tell(LinkChanged(*self.board.stamp(), self.state.link))


@pytest.fixture
def folder(tmp_path):
    return tmp_path / "owners"


@pytest.fixture
def owner(tmp_path, folder):
    port = tmp_path / "port"
    port.touch()
    owner = Owner(str(port))
    owner.bell = ControlServer(owner, folder)
    yield owner
    owner.bell.close()


def test_it_is_announced_once_the_port_is_really_ours(owner, folder) -> None:
    owner.link(LinkPhase.OPENING)
    owner.link(LinkPhase.LOST)
    assert find_owners(folder) == []
    owner.link(LinkPhase.UP)
    found = find_owner(folder, owner.state.port)
    assert found.pid == os.getpid()
    assert found.file.stat().st_mode & 0o777 == 0o600
    assert [path.name for path in folder.iterdir()] == [found.file.name]


def test_stop_reaches_the_station_and_says_what_came_of_it(owner, folder) -> None:
    owner.link(LinkPhase.SILENT)
    told = call_owner(find_owner(folder, owner.state.port), "stop", "birdcage stop")
    assert owner.stops == ["birdcage stop"]
    assert told == {"by": "birdcage stop", "means": "retarget", "confirmed": True, "sentence": "Stands still."}


def test_status_is_the_report(owner, folder) -> None:
    owner.link(LinkPhase.UP)
    assert call_owner(find_owner(folder, owner.state.port), "status", "x")["connected"] is True


@pytest.mark.parametrize("line", [
    b"", b"stop\n", b"[]\n", b'{"do": "stop"}\n', b'{"do": "stop", "token": "wrong"}\n', b"x" * 10000,
])  # fmt: skip
def test_without_the_token_nothing_happens(owner, folder, line) -> None:
    owner.link(LinkPhase.UP)
    found = find_owner(folder, owner.state.port)
    reply = b""
    # Who says too much is cut off: whether that is seen while sending, shutting down or reading is the system's affair.
    with socket.create_connection(("127.0.0.1", found.tcp_port), 2) as caller, contextlib.suppress(OSError):
        caller.sendall(line)
        caller.shutdown(socket.SHUT_WR)
        reply = caller.recv(1000)
    assert reply == b"" or json.loads(reply)["ok"] is False
    assert owner.stops == []


def test_a_caller_that_says_nothing_does_not_keep_a_stop_waiting(owner, folder) -> None:
    owner.link(LinkPhase.UP)
    found = find_owner(folder, owner.state.port)
    with socket.create_connection(("127.0.0.1", found.tcp_port), 2):
        call_owner(found, "stop", "you")
    assert owner.stops == ["you"]


@pytest.mark.parametrize(("asked", "said"), [
    ({"do": "sing"}, "can't do that: cannot do 'sing'"),
    ({"do": "set", "value": None}, "can't do that: no value: None"),
    ({"do": "get", "ids": ["x" * 5000]}, "ask for less"),
])  # fmt: skip
def test_what_a_living_owner_does_not_take_leaves_it_reachable_for_stop(owner, folder, asked, said) -> None:
    owner.link(LinkPhase.UP)
    with pytest.raises(CommandRefused, match=re.escape(said)):
        call_owner(find_owner(folder, owner.state.port), **{"by": "you", **asked})
    call_owner(find_owner(folder, owner.state.port), "stop", "you")
    assert owner.stops == ["you"]


@pytest.mark.parametrize(
    ("begun", "said"), [(False, "Nothing was sent."), (True, "Whether lamp was set is not known.")]
)
def test_who_waits_no_longer_is_told_whether_it_may_still_be_set(owner, folder, monkeypatch, begun, said) -> None:
    asked = []

    def submit(request):
        asked.append(Future())
        assert not begun or asked[-1].set_running_or_notify_cancel()
        return asked[-1]

    owner.submit = submit
    monkeypatch.setattr(control_server, "FEATURE_S", 0.01)
    owner.link(LinkPhase.UP)
    told = call_owner(find_owner(folder, owner.state.port), "set", "you", id="lamp", value=5.0)
    assert told["error"]["sentence"].endswith(said)
    assert asked[0].cancelled() is not begun


def test_only_this_machine_is_listened_to(owner, folder) -> None:
    assert owner.bell._listener.getsockname()[0] == "127.0.0.1"


def test_all_names_of_a_port_lead_to_its_owner(owner, folder, tmp_path) -> None:
    owner.link(LinkPhase.UP)
    (tmp_path / "by-id").symlink_to(owner.state.port)
    assert find_owner(folder, str(tmp_path / "by-id")).port == owner.state.port
    assert find_owner(folder, str(tmp_path / "other")) is None


def test_a_port_that_came_back_elsewhere_is_found_under_both_names(owner, folder, tmp_path) -> None:
    owner.link(LinkPhase.UP)
    (tmp_path / "port").unlink()
    owner.link(LinkPhase.LOST)
    assert find_owner(folder, str(tmp_path / "port")) is not None
    (tmp_path / "port1").touch()
    owner.link(LinkPhase.UP, port=str(tmp_path / "port1"))
    assert len(find_owners(folder)) == 1
    assert find_owner(folder, str(tmp_path / "port1")).pid == os.getpid()
    assert find_owner(folder, str(tmp_path / "port")).port == str(tmp_path / "port1")


def test_a_simulated_dish_is_never_announced(owner, folder) -> None:
    owner.link(LinkPhase.UP, demo=True)
    assert find_owners(folder) == []


def test_what_a_dead_process_left_is_ignored_and_removed(owner, folder, tmp_path) -> None:
    owner.link(LinkPhase.UP)
    found = find_owner(folder, owner.state.port)
    owner.bell.close()
    assert not found.file.exists()
    found.file.write_text(json.dumps({
        "pid": 1, "tcp_port": found.tcp_port, "token": found.token, "port": found.port, "asked": found.port,
    }))  # fmt: skip
    with pytest.raises(OwnerGone):
        call_owner(find_owner(folder, found.port), "stop", "you")
    assert not found.file.exists()


def test_another_program_on_the_old_tcp_port_is_no_owner(owner, folder) -> None:
    owner.link(LinkPhase.UP)
    found = find_owner(folder, owner.state.port)
    stale = replace(found, token="of an earlier owner")
    with pytest.raises(OwnerGone):
        call_owner(stale, "stop", "you")
    assert found.file.exists(), "the living owner's file is not the stale one's"
    assert owner.stops == []


def test_a_damaged_file_is_ignored(folder) -> None:
    folder.mkdir()
    for text in ("", "[]", "{}", '{"pid": "x"}', "\x00"):
        owner_file(folder, "/dev/ttyUSB0").write_text(text)
        assert find_owner(folder, "/dev/ttyUSB0") is None


def test_a_folder_that_cannot_be_written_is_told_in_the_app_until_it_can(tmp_path) -> None:
    (tmp_path / "file").write_text("")
    owner = Owner("/dev/ttyUSB0")
    bell = ControlServer(owner, tmp_path / "file" / "owners")
    owner.link(LinkPhase.UP)
    assert "`birdcage stop` does not reach this program" in owner.state.warnings["outside"]
    (tmp_path / "file").unlink()
    owner.link(LinkPhase.UP)
    assert dict(owner.state.warnings) == {}
    bell.close()


def test_closing_leaves_the_file_of_a_later_owner(owner, folder) -> None:
    owner.link(LinkPhase.UP)
    later = ControlServer(owner, folder)
    owner.link(LinkPhase.UP)
    assert len(find_owners(folder)) == 1
    first, second = owner.bell, later
    text = find_owners(folder)[0].token
    assert text == second._token
    first.close()
    assert find_owners(folder)[0].token == text
    second.close()
    assert find_owners(folder) == []
