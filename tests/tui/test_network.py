"""The Network tab: who may move the dish, exact in each state, and no half of it blank."""

from __future__ import annotations

import re
from dataclasses import replace
from datetime import timedelta

import pytest
import sky_stand_in
import track_stage
from birdcage.base.clock import VirtualClock
from birdcage.station.network_state import NetworkClient, NetworkLine, NetworkProgram, NetworkRole, NetworkState
from birdcage.station.requests import AcquireLease, ReleaseLease
from stage import read, run

SIZES = [(80, 24), (100, 30), (120, 36), (160, 48), (240, 70)]


async def network(app, pilot):
    await pilot.press("N")
    for _ in range(3):
        await pilot.pause()
        app.paint()
    await pilot.pause()
    return await read(app, pilot)


def flat(text):
    return re.sub(r"[\s│]+", " ", text)


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_it_says_who_has_control_who_may_take_it_and_how_it_is_stopped_from_a_shell(size):
    text = flat(run(network, "slewing", size, key="f2", sky=sky_stand_in.make()))
    for words in ("Control", "You, at this terminal.", "Who may move it", "Tracker", "Console", "birdcage stop",
                  "birdcage hold", "birdcage release", "off. o serves Gpredict"):  # fmt: skip
        assert words in text, words


@pytest.mark.parametrize("size", SIZES[1:], ids=str)
def test_no_half_of_the_page_is_blank(size):
    rows = run(network, "slewing", size, key="f2", sky=sky_stand_in.make()).splitlines()[4:-3]
    words = [row.replace("│", " ") for row in rows]
    assert sum(bool(row.strip()) for row in words) >= 0.7 * len(words), "\n".join(rows)
    for half in (slice(0, size[0] // 2), slice(size[0] // 2, None)):
        assert any(row[half].strip() for row in words)


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_held_it_says_what_enter_sets_in_motion(size):
    text = flat(run(network, "held", size, key="f2"))
    assert "Refused Gpredict 3 times. Enter releases it: Gpredict may move it to 231.4/44.0." in text


def test_while_a_pass_is_followed_it_names_it_with_its_error_and_what_comes_next():
    async def to_network(app, pilot, _desk):
        return await network(app, pilot)

    text = flat(track_stage.run(to_network, size=(120, 36)))
    assert re.search(r"Following METEOR-M2 4 error ±?\d\.\d\d°, for tracker\.", text), text
    assert "In reach" in text or "in 0" in text or "eiling" in text


NOW = VirtualClock().utc()
CLIENTS = (
    NetworkClient(
        1, "rotctld 1", NetworkProgram.GPREDICT, "127.0.0.1:45806", NOW, NetworkRole.CONTROL, 176.0, 40.0, "P 176 40",
        NOW - timedelta(seconds=0.8), 40, lines=(NetworkLine(NOW, "P 176.00 40.00", "RPRT 0"),),
    ),
    NetworkClient(
        2, "rotctld 2", NetworkProgram.SATDUMP, "192.168.1.9:51234", NOW, NetworkRole.IGNORED, 171.0, 41.0, "P 171 41",
        NOW - timedelta(seconds=1.0), 41, ignored=41, why="Gpredict has control.",
        lines=(NetworkLine(NOW, "P 171.00 41.00", "RPRT 0"),),
    ),
    NetworkClient(3, "rotctld 3", NetworkProgram.UNKNOWN, "172.17.0.2:40000", NOW),
)  # fmt: skip


class Server:
    """Stands in for the app's server: notes what is asked of it."""

    is_on = True

    def __init__(self):
        self.asked = []

    def switch(self):
        self.asked.append("switch")
        return "Switched."

    def hang_up(self, number):
        self.asked.append(number)

    def shut_out(self, number, *, on):
        self.asked.append((number, "ignore", on))

    def recognise(self, *, on):
        self.asked.append(("recognise", on))

    def close(self):
        self.asked.append("close")


def serving(*clients, **more):
    return {"network": NetworkState("127.0.0.1", 4533, clients=clients, **more)}


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_with_a_server_it_says_who_is_connected_what_each_wants_and_gets(size):
    text = flat(
        run(network, "slewing", size, key="f2", state=serving(*CLIENTS, turned_away=2) | {"holder": "rotctld 1"})
    )
    assert "Control Gpredict (rotctld 1)." in text
    assert "on at 127.0.0.1:4533, turned away 2. o stops it." in text
    assert re.search(r"▶ Gpredict .*176.0/40.0 P 0.8 s .*control", text)
    assert "ignored 41 times, told RPRT 0" in text
    assert re.search(r"rotctld 3 .*watches", text)
    assert "Lines of Gpredict" in text
    assert "P 176.00 40.00" in text


def test_with_room_it_says_how_to_connect():
    text = flat(run(network, "slewing", (120, 36), key="f2", state=serving()))
    assert "No program is connected yet." in text
    assert "rotctl -m 2 -r 127.0.0.1:4533" in text
    assert "SATNOGS_ROT_PORT=127.0.0.1:4533" in text


def test_strict_says_what_an_ignored_client_is_told():
    assert "told RPRT -9" in flat(run(network, "slewing", (120, 36), key="f2", state=serving(*CLIENTS, strict=True)))


def test_keys_choose_a_client_hang_up_and_switch_the_server():
    server = Server()

    async def press(app, pilot):
        await network(app, pilot)
        await pilot.press("down", "x")
        text = flat(await read(app, pilot))
        await pilot.press("o")
        await pilot.pause()
        return text

    text = run(press, "slewing", (120, 36), key="f2", state=serving(*CLIENTS), network=server)
    assert "▶ SatDump" in text
    assert "Lines of SatDump" in text
    assert server.asked == [2, "switch"]


FOLLOWS = replace(CLIENTS[0], follows="NOAA 20", follow_error_deg=0.031, steps_error_deg=2.97)


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_a_satellite_that_a_client_follows_stands_there_with_both_errors(size):
    text = flat(run(network, "slewing", size, key="f2", state=serving(FOLLOWS, *CLIENTS[1:], recognises=True)))
    assert "Gpredict follows NOAA 20: 0.03°; its own steps would leave 2.97°." in text
    assert "control, follows NOAA 20" in text


@pytest.mark.parametrize("size", SIZES, ids=str)
@pytest.mark.parametrize(
    ("told", "words"),
    [
        ({"recognises": True}, "recognised by what programs ask for. r goes by their own steps."),
        ({"recognises": True, "recognises_why_not": "no place is set"}, "not recognised: no place is set."),
        ({}, "not recognised: programs' own steps count. r changes that."),
    ],
    ids=["on", "no place", "off"],
)
def test_it_says_whether_satellites_are_recognised_and_why_not(size, told, words):
    assert f"Satellites {words}" in flat(run(network, "slewing", size, key="f2", state=serving(*CLIENTS, **told)))


def test_before_it_was_on_the_target_no_error_is_shown():
    client = replace(FOLLOWS, follow_error_deg=None)
    text = flat(run(network, "slewing", (120, 36), key="f2", state=serving(client, recognises=True)))
    assert "Gpredict follows NOAA 20; its own steps would leave 2.97°." in text


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_a_client_that_a_person_ignores_is_told_so(size):
    client = replace(CLIENTS[1], shut_out=True)
    text = flat(run(network, "slewing", size, key="f2", state=serving(CLIENTS[0], client)))
    assert "ignored by a person" in text


def test_keys_ignore_a_client_and_switch_recognition():
    server = Server()

    async def press(app, pilot):
        await network(app, pilot)
        await pilot.press("down", "i", "r")
        return flat(await read(app, pilot))

    text = run(press, "slewing", (120, 36), key="f2", state=serving(*CLIENTS, recognises=True), network=server)
    assert server.asked == [(2, "ignore", True), ("recognise", False)]
    assert "Programs' own steps count." in text
    server.asked.clear()
    client = replace(CLIENTS[1], shut_out=True)
    run(press, "slewing", (120, 36), key="f2", state=serving(CLIENTS[0], client), network=server)
    assert server.asked == [(2, "ignore", False), ("recognise", True)]


def test_only_the_program_that_runs_a_server_changes_it():
    server = Server()

    async def press(app, pilot):
        await network(app, pilot)
        await pilot.press("i", "r", "x")
        return flat(await read(app, pilot))

    text = run(press, "slewing", (120, 36), key="f2", network=server,
               state=serving(*CLIENTS, recognises=True, by="birdcage serve, anna (pts/3)"))  # fmt: skip
    assert server.asked == []
    assert "birdcage serve, anna (pts/3) runs that server. Only that program changes it." in text


def test_one_key_takes_control_for_a_quarter_of_an_hour_and_one_gives_it_back():
    async def press(app, pilot):
        await network(app, pilot)
        await pilot.press("t", "B")
        await pilot.pause()
        return app.station.asked

    asked = run(press, "idle", (120, 36), key="f2")
    assert [each for each in asked if isinstance(each, AcquireLease | ReleaseLease)] == [
        AcquireLease("you", take_over=True, for_s=900.0), ReleaseLease("you"),
    ]  # fmt: skip


def test_control_for_a_while_says_until_when():
    text = flat(run(network, "idle", (120, 36), key="f2", state={"holder": "you", "holder_until": NOW}))
    assert f"You, at this terminal, until {NOW:%H:%M:%S}Z." in text
