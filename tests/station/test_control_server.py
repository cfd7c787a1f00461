"""The control server of the process that owns a port, and its callers."""

from __future__ import annotations

import contextlib
import json
import os
import re
import socket
import threading
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import replace

import pytest
from birdcage.base.errors import CommandRefused, NoReply
from birdcage.rotator.own_settings import SettingRow, SettingsTable, SettingsWritten
from birdcage.station import control_caller
from birdcage.station.control_client import OwnerGone, call_owner, find_owner, find_owners, owner_file
from birdcage.station.control_messages import LONGEST_LINE, ControlCall, TellStatus, as_line, call_to_json
from birdcage.station.control_server import ControlServer
from birdcage.station.requests import Goto, Read, ReadSettings, SaveSettings, Set, Stop, Watch, WriteSettings
from birdcage.station.state import LinkPhase

from .owner_stand_in import OwnerStandIn


@pytest.fixture
def folder(tmp_path):
    return tmp_path / "owners"


@pytest.fixture
def owner(tmp_path, folder):
    port = tmp_path / "port"
    port.touch()
    owner = OwnerStandIn(str(port))
    owner.server = ControlServer(owner, folder)
    yield owner
    owner.server.close()


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
    told = call_owner(find_owner(folder, owner.state.port), Stop("birdcage stop"), "birdcage stop")
    assert owner.stops == ["birdcage stop"]
    assert told == {"by": "birdcage stop", "means": "retarget", "confirmed": True, "sentence": "Stands still."}


def test_status_is_the_report(owner, folder) -> None:
    owner.link(LinkPhase.UP)
    assert call_owner(find_owner(folder, owner.state.port), TellStatus(), "x")["connected"] is True


@pytest.mark.parametrize("line", [
    b"", b"stop\n", b"[]\n", b'{"do": "stop"}\n', b'{"do": "stop", "token": "wrong"}\n', b"x" * 40_000,
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
        call_owner(found, Stop("you"), "you")
    assert owner.stops == ["you"]


@pytest.mark.parametrize(("request_", "said"), [
    (Goto(180.0, 45.0, "you"), 'can\'t do that: "Goto" is no request here. There are Stop, HoldDish, Release,'),
    (Watch("you", frozenset({"rssi"})), "can't do that: A watch lasts as long as its caller listens."),
    (Read(("x" * LONGEST_LINE,)), "ask for less"),
])  # fmt: skip
def test_what_a_living_owner_does_not_take_leaves_it_reachable_for_stop(owner, folder, request_, said) -> None:
    owner.link(LinkPhase.UP)
    with pytest.raises(CommandRefused, match=re.escape(said)):
        call_owner(find_owner(folder, owner.state.port), request_, "you")
    call_owner(find_owner(folder, owner.state.port), Stop("you"), "you")
    assert owner.stops == ["you"]


def say(found, told) -> dict[str, object]:
    with socket.create_connection(("127.0.0.1", found.tcp_port), 2) as caller, caller.makefile("rb") as lines:
        caller.sendall(told if isinstance(told, bytes) else as_line(told))
        return json.loads(lines.readline())


@pytest.mark.parametrize(("change", "said"), [
    ({"v": 2}, "The line is in version 2, and this birdcage reads version 1."),
    ({"v": None}, 'The line says no version. Give "v": 1.'),
    ({"then": 1}, 'The line has no field "then". It has v, token, by, request, events.'),
    ({"request": None}, "The request is null. Give an object."),
    ({"request": {"v": 1, "type": "Read"}}, "Read lacks features."),
    ({"events": 1}, '"events" is true or false.'),
    ({"by": ["you"]}, '"by" is who asks, as text;'),
])  # fmt: skip
def test_a_line_that_is_wrong_is_told_what_belongs_there(owner, folder, change, said) -> None:
    owner.link(LinkPhase.UP)
    found = find_owner(folder, owner.state.port)
    answer = say(found, call_to_json(found.token, ControlCall(Stop("you"), "you")) | change)
    assert (answer["v"], answer["ok"], answer["error"]["kind"]) == (1, False, "BadMessage")
    assert said in answer["error"]["sentence"]
    assert owner.stops == []


@pytest.mark.parametrize("token", ["wrong", "", None, 5, ["x"], "\u00fc\ud800", "x" * 2000])
def test_a_wrong_token_of_any_kind_is_refused(owner, folder, token) -> None:
    owner.link(LinkPhase.UP)
    found = find_owner(folder, owner.state.port)
    answer = say(found, call_to_json(found.token, ControlCall(Stop("you"), "you")) | {"token": token})
    assert answer["error"]["reason"] == "wrong_token"
    assert owner.stops == []


def test_a_line_of_a_megabyte_is_told_that_it_is_too_long(owner, folder) -> None:
    owner.link(LinkPhase.UP)
    answer = say(find_owner(folder, owner.state.port), b"x" * 2**20 + b"\n")
    assert answer["error"]["sentence"] == f"The line is longer than {LONGEST_LINE} bytes. Ask for less."


def test_an_older_birdcage_reads_why_not(owner, folder) -> None:
    owner.link(LinkPhase.UP)
    found = find_owner(folder, owner.state.port)
    answer = say(found, {"token": found.token, "do": "stop", "by": "birdcage stop"})
    assert answer["ok"] is False
    assert answer["error"] == 'The line says no version. Give "v": 1.'


def test_an_older_owner_is_named_as_that(folder, tmp_path) -> None:
    with socket.create_server(("127.0.0.1", 0)) as older:
        told = {"pid": 1, "tcp_port": older.getsockname()[1], "token": "t", "port": "/dev/x", "asked": "/dev/x"}
        folder.mkdir()
        owner_file(folder, "/dev/x").write_text(json.dumps(told))
        found = find_owner(folder, "/dev/x")

        def answer() -> None:
            caller, _ = older.accept()
            with caller:
                caller.recv(4096)
                caller.sendall(b'{"ok": false, "error": "cannot do None"}\n')

        thread = threading.Thread(target=answer)
        thread.start()
        with pytest.raises(CommandRefused, match=r"can't do that: cannot do None\. Nothing was sent\. Is it an older"):
            call_owner(found, Stop("you"), "you")
        thread.join()
    assert found.file.exists()


def test_fifty_callers_at_once_all_have_their_answer(owner, folder) -> None:
    owner.link(LinkPhase.UP)
    found = find_owner(folder, owner.state.port)
    with ThreadPoolExecutor(50) as callers:
        told = list(callers.map(lambda number: call_owner(found, Stop(f"{number}"), "you")["confirmed"], range(50)))
    assert told == [True] * 50
    assert sorted(map(int, owner.stops)) == list(range(50))


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
    monkeypatch.setattr(control_caller, "REQUEST_S", 0.01)
    owner.link(LinkPhase.UP)
    with pytest.raises(NoReply, match=re.escape(said) + "$"):
        call_owner(find_owner(folder, owner.state.port), Set("lamp", 5.0, "you"), "you")
    assert asked[0].cancelled() is not begun


ROWS = {index: SettingRow(index, "x" * 24, "y" * 24, None, None) for index in range(150)}
TABLE = SettingsTable((), ROWS)


@pytest.mark.parametrize(
    ("request_", "answer"),
    [
        (ReadSettings(), TABLE),
        (WriteSettings({1: "2"}, "you", agreed=True), SettingsWritten(None, TABLE)),
        (SaveSettings("you", agreed=True, shown=TABLE.to_save), TABLE),
    ],
    ids=lambda value: type(value).__name__,
)
def test_what_keeps_the_dish_longer_with_its_own_settings_is_waited_for(
    owner, folder, monkeypatch, request_, answer
) -> None:
    asked, answered = [], Future()

    def submit(request):
        asked.append(request)
        threading.Timer(0.1, answered.set_result, (answer,)).start()
        return answered

    owner.submit = submit
    monkeypatch.setattr(control_caller, "REQUEST_S", 0.01)
    owner.link(LinkPhase.UP)
    assert call_owner(find_owner(folder, owner.state.port), request_, "you") == answer
    assert asked == [request_], "one that names all rows of a dish fits into its line"


def test_only_this_machine_is_listened_to(owner, folder) -> None:
    assert owner.server._listener.getsockname()[0] == "127.0.0.1"


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
    owner.server.close()
    assert not found.file.exists()
    found.file.write_text(json.dumps({
        "pid": 1, "tcp_port": found.tcp_port, "token": found.token, "port": found.port, "asked": found.port,
    }))  # fmt: skip
    with pytest.raises(OwnerGone):
        call_owner(find_owner(folder, found.port), Stop("you"), "you")
    assert not found.file.exists()


def test_another_program_on_the_old_tcp_port_is_no_owner(owner, folder) -> None:
    owner.link(LinkPhase.UP)
    found = find_owner(folder, owner.state.port)
    stale = replace(found, token="of an earlier owner")
    with pytest.raises(OwnerGone):
        call_owner(stale, Stop("you"), "you")
    assert found.file.exists(), "the living owner's file is not the stale one's"
    assert owner.stops == []


def test_a_damaged_file_is_ignored(folder) -> None:
    folder.mkdir()
    for text in ("", "[]", "{}", '{"pid": "x"}', "\x00"):
        owner_file(folder, "/dev/ttyUSB0").write_text(text)
        assert find_owner(folder, "/dev/ttyUSB0") is None


def test_a_folder_that_cannot_be_written_is_told_in_the_app_until_it_can(tmp_path) -> None:
    (tmp_path / "file").write_text("")
    owner = OwnerStandIn("/dev/ttyUSB0")
    server = ControlServer(owner, tmp_path / "file" / "owners")
    owner.link(LinkPhase.UP)
    assert "`birdcage stop` does not reach this program" in owner.state.warnings["outside"]
    (tmp_path / "file").unlink()
    owner.link(LinkPhase.UP)
    assert dict(owner.state.warnings) == {}
    server.close()


def test_closing_leaves_the_file_of_a_later_owner(owner, folder) -> None:
    owner.link(LinkPhase.UP)
    later = ControlServer(owner, folder)
    owner.link(LinkPhase.UP)
    assert len(find_owners(folder)) == 1
    first, second = owner.server, later
    text = find_owners(folder)[0].token
    assert text == second._token
    first.close()
    assert find_owners(folder)[0].token == text
    second.close()
    assert find_owners(folder) == []
