"""`birdcage elements`, as a person types it. Only `update` reaches a network, and here that is this machine."""

from __future__ import annotations

import json
import socket
import threading
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer

import pytest
from birdcage.cli import exits

ISS = (
    "ISS (ZARYA)\n"
    "1 25544U 98067A   08264.51782528 -.00002182  00000-0 -11606-4 0  2927\n"
    "2 25544  51.6416 247.4627 0006703 130.5360 325.0288 15.72125391563537\n"
)
BROKEN = ISS.replace("ZARYA", "BROKEN").replace("15.72125391563537", "15.72125391563530")


def omm(name, norad_id, epoch="2026-07-01T12:00:00.000000"):
    return {
        "OBJECT_NAME": name, "OBJECT_ID": "2017-073A", "EPOCH": epoch, "MEAN_MOTION": 14.19553,
        "ECCENTRICITY": 0.0001234, "INCLINATION": 98.7, "RA_OF_ASC_NODE": 123.4, "ARG_OF_PERICENTER": 12.5,
        "MEAN_ANOMALY": 350.25, "EPHEMERIS_TYPE": 0, "CLASSIFICATION_TYPE": "U", "NORAD_CAT_ID": norad_id,
        "ELEMENT_SET_NO": 999, "REV_AT_EPOCH": 41234, "BSTAR": 1.5e-5, "MEAN_MOTION_DOT": 2e-7, "MEAN_MOTION_DDOT": 0,
    }  # fmt: skip


BODY = json.dumps([omm("NOAA 20", 43013), omm("NOAA 21", 54234), omm("NEWEST", 123456789)]).encode()


@pytest.fixture
def no_sockets(monkeypatch):
    """Forbid every way onto a network, and count who tries."""
    tried = []

    def refuse(*args, **_more):
        tried.append(args)
        raise OSError("no network in this test")

    for name in ("connect", "connect_ex", "bind", "sendto"):
        monkeypatch.setattr(socket.socket, name, refuse)
    for name in ("getaddrinfo", "gethostbyname", "create_connection"):
        monkeypatch.setattr(socket, name, refuse)
    return tried


@pytest.fixture
def tle(tmp_path):
    path = tmp_path / "iss.tle"
    path.write_text(ISS + BROKEN)
    return path


@pytest.fixture
def server():
    """A mirror on this machine; `bodies` by path, and the paths that were asked for."""

    class Handler(BaseHTTPRequestHandler):
        def do_GET(self) -> None:
            server.asked.append(self.path)
            status, body = server.bodies.get(self.path, (404, b""))
            self.send_response(status)
            self.send_header("Content-Length", str(len(body)))
            self.end_headers()
            self.wfile.write(body)

        def log_message(self, *_args) -> None:
            pass

    server = ThreadingHTTPServer(("127.0.0.1", 0), Handler)
    server.asked, server.bodies = [], {}
    server.mirror = f"http://127.0.0.1:{server.server_address[1]}/{{group}}.json"
    thread = threading.Thread(target=server.serve_forever, args=(0.01,), daemon=True)
    thread.start()
    yield server
    server.shutdown()
    server.server_close()
    thread.join(5)


@pytest.fixture
def elements(run):
    return lambda *words, **more: run("elements", *words, **more)


def test_nothing_but_update_goes_onto_a_network(elements, tle, no_sockets):
    assert elements("add", tle).exit_code == exits.NOT_DONE
    for words in (
        ("add", "-"), ("list",), ("list", "--all"), ("list", "--groups"), ("list", "--favourites"), ("check",),
        ("check", tle), ("search", "iss"), ("favourite", "iss"), ("offset", "iss", "2"), ("remove", "iss"), ("--help",),
    ):  # fmt: skip
        result = elements(*words, input=ISS)
        assert result.exit_code in (0, exits.NOT_DONE), (words, result.output)
        assert result.exception is None or isinstance(result.exception, SystemExit), words
    assert no_sockets == []


def test_update_without_a_network_is_a_sentence_and_keeps_what_is_there(elements, no_sockets):
    elements("add", "-", input=ISS)
    result = elements("update", "weather", "geo")
    assert result.exit_code == exits.NOT_DONE
    assert "Are you online?" in result.stdout
    assert len([each for each in no_sockets if "celestrak.org" in each]) == 1, (
        "a server that is not there is tried once"
    )
    assert "ISS (ZARYA)" in elements("list", "--all").stdout


def test_damaged_lines_are_named_with_file_and_line_and_good_ones_are_taken(elements, tle):
    result = elements("add", tle, "--group", "mine")
    assert result.exit_code == exits.NOT_DONE
    assert f"{tle}:6: checksum" in result.stderr
    assert "1 new" in result.stdout
    listed = elements("list", "mine")
    assert "25544  ISS (ZARYA)  2008-09-20 12:25" in listed.stdout
    assert "BROKEN" not in listed.stdout


def test_check_tells_epoch_age_and_damage_and_takes_nothing_in(elements, tle, as_json):
    result = elements("check", tle)
    assert result.exit_code == exits.NOT_DONE
    assert f"{tle}:6: checksum" in result.stderr
    assert "ISS (ZARYA)  2008-09-20 12:25:40" in result.stdout
    told = as_json(elements("check", tle, "--json"))
    (satellite,) = told["satellites"]
    assert satellite["epoch"] == "2008-09-20T12:25:40.104Z"
    assert satellite["age_s"] > 5e8
    (complaint,) = told["complaints"]
    assert (complaint["source"], complaint["line"]) == (str(tle), 6)
    assert as_json(elements("list", "--all", "--json")) == []
    empty = elements("check")
    assert empty.exit_code == 0
    assert "The catalogue is empty" in empty.stderr


def test_pasted_text_and_a_folder(elements, tle, tmp_path, as_json):
    tle.write_text(ISS)
    (tmp_path / "two.json").write_bytes(BODY)
    added = as_json(elements("add", tmp_path, "--json"))
    assert (added["new"], added["complaints"]) == (4, [])
    assert as_json(elements("add", "-", "--json", input=ISS))["kept"] == 1
    nothing = elements("add", "-", input="hello\n")
    assert nothing.exit_code == exits.NOT_DONE
    missing = elements("add", tmp_path / "nowhere")
    assert missing.exit_code == exits.NOT_DONE
    assert "nowhere: cannot be read" in missing.stderr


def test_update_from_the_users_own_mirror(elements, server, as_json):
    server.bodies["/weather.json"] = (200, BODY)
    env = {"BIRDCAGE_ELEMENTS_MIRROR_URL": server.mirror, "BIRDCAGE_ELEMENTS_GROUPS": "weather, my-birds"}
    result = elements("update", env=env)
    assert result.exit_code == exits.NOT_DONE
    assert server.asked == ["/weather.json", "/my-birds.json"]
    assert "weather        updated    3 satellites: 3 new" in result.stdout
    assert "my-birds       failed" in result.stdout
    assert "answers 404" in result.stdout
    (group, failed) = sorted(as_json(elements("list", "--json")), key=lambda each: -each["satellites"])
    assert (group["group"], group["satellites"], group["problem"]) == ("weather", 3, None)
    assert 0 <= group["age_s"] < 600
    assert group["median_epoch"] == "2026-07-01T12:00:00.000Z"
    assert "404" in failed["problem"]
    (again,) = as_json(elements("update", "weather", "--json", env=env))
    assert (again["status"], again["added"]) == ("updated", {"new": 0, "newer": 0, "kept": 3})
    assert "NOAA 21" in elements("search", "noaa").stdout


def test_a_pause_that_a_server_asked_for_outlives_the_program_and_force(elements, server):
    env = {"BIRDCAGE_ELEMENTS_MIRROR_URL": server.mirror}
    server.bodies["/geo.json"] = (429, b"")
    assert "Not asked again before" in elements("update", "geo", env=env).stdout
    assert "Not asked before" in elements("update", "geo", "--force", env=env).stdout
    assert server.asked == ["/geo.json"]
    assert "paused until" in elements("list").stdout


def test_a_group_that_is_none_is_refused_before_anything_is_asked(elements, no_sockets):
    result = elements("update", "weather", "wether")
    assert result.exit_code == exits.USAGE
    assert "did you mean weather?" in result.stderr
    assert no_sockets == []


def test_a_mirror_without_a_place_for_the_group_is_named(elements, server):
    result = elements("update", "geo", env={"BIRDCAGE_ELEMENTS_MIRROR_URL": server.mirror.replace("{group}", "x")})
    assert "{group} is missing" in result.stderr
    assert result.exit_code == exits.USAGE
    assert server.asked == []


def test_favourites_priorities_tags_and_offset(elements, as_json):
    elements("add", "-", input=ISS)
    elements("favourite", "zarya", "--priority", "3", "--tag", "SSTV", "--tag", "APRS")
    elements("offset", "25544", "-1.5")
    (entry,) = as_json(elements("favourite", "25544", "--untag", "APRS", "--json"))
    assert (entry["favourite"], entry["priority"], entry["tags"]) == (True, 3, ["SSTV"])
    assert entry["time_offset_s"] == -1.5
    assert entry["time_offset_set"].endswith("Z")
    assert "1.5 s earlier than computed" in elements("offset", "iss").stdout
    assert "no time offset" in elements("offset", "iss", "none").stdout
    elements("favourite", "iss", "--off")
    assert "No favourites yet" in elements("favourite").stderr
    for words in (
        ("offset", "iss", "soon"),
        ("offset", "iss", "1e9"),
        ("offset", "iss", "nan"),
        ("favourite", "--off"),
    ):
        assert elements(*words).exit_code == exits.USAGE, words
    unknown = elements("favourite", "noaa 99")
    assert unknown.exit_code == exits.NOT_DONE
    assert "noaa 99" in unknown.stderr


def test_remove_by_name_or_age(elements):
    elements("add", "-", input=ISS)
    elements("add", "-", input=BODY.decode())
    assert "1 removed" in elements("remove", "NOAA 20").stdout
    assert "1 removed" in elements("remove", "--older-than", "3000").stdout
    assert elements("remove").exit_code == exits.USAGE
    left = elements("list", "--all").stdout
    assert "NOAA 21" in left
    assert "ISS" not in left


def test_search_that_finds_nothing_says_so(elements):
    elements("add", "-", input=ISS)
    result = elements("search", "noaa")
    assert (result.exit_code, result.stdout) == (exits.NOT_DONE, "")
    assert "noaa" in result.stderr


def test_ctrl_c_keeps_the_groups_that_had_come(elements, server, monkeypatch):
    from birdcage.sky.update.refresh import _Refresh

    def fetch_one(self, host):
        if self._source.name == "second":
            raise KeyboardInterrupt
        return fetch(self, host)

    fetch = _Refresh._fetch
    monkeypatch.setattr(_Refresh, "_fetch", fetch_one)
    server.bodies["/first.json"] = (200, BODY)
    result = elements("update", "first", "second", env={"BIRDCAGE_ELEMENTS_MIRROR_URL": server.mirror})
    assert result.exit_code == 130
    assert "What arrived is saved" in result.stderr
    assert "NOAA 20" in elements("list", "first").stdout


def test_lists_are_sorted_for_people(elements):
    elements("add", "-", input=json.dumps([omm("B", 9), omm("a", 1000), omm("C", 20)]))
    lines = elements("list", "--all").stdout.splitlines()[1:]
    assert [line.split()[1] for line in lines] == ["a", "B", "C"]
    elements("favourite", "20", "--priority", "2")
    assert elements("list", "--all").stdout.splitlines()[1].split()[:3] == ["*", "20", "C"]


def test_elements_dated_in_years_to_come_are_told_and_give_way(elements):
    def body(epoch):
        return json.dumps([omm("NOAA 20", 43013, epoch)])

    first = elements("add", "-", input=body("2055-01-01T00:00:00"))
    assert "NOAA 20 is dated 2055-01-01, more than 7 days ahead of this computer's clock" in first.stderr
    assert "`birdcage clock`" in first.stderr
    assert "2055-01-01" in elements("list").stderr
    assert "2055-01-01" in elements("check").stderr
    second = elements("add", "-", input=body("2026-07-01T12:00:00"))
    assert second.stdout.startswith("0 new, 1 with newer elements")
    assert "ahead" not in elements("list").stderr
    assert "0 new, 0 with newer elements" in elements("add", "-", input=body("2055-01-01T00:00:00")).stdout
    assert "2026-07-01 12:00" in elements("list", "--all").stdout
