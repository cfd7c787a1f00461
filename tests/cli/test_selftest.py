"""`birdcage serve --selftest`: what it says of a dish that is fine, of one that is not there, and what it moves."""

from __future__ import annotations

import json
import socket
import time

import pytest
from birdcage.cli import self_test_run
from birdcage.rotctld.self_test import self_test


@pytest.fixture
def selftest(run):
    """Run it with JSON, on a port of its own unless told otherwise; return the result, and the checks."""

    def selftest(*words, **more):
        result = run("serve", "--selftest", "--json", *(words or ("--listen-port", 0)), **more)
        return result, [json.loads(line) for line in result.stdout.splitlines()]

    return selftest


def test_a_simulated_dish_passes_and_is_moved(selftest):
    result, checks = selftest()
    assert result.exit_code == 0, result.stdout + result.stderr
    assert {check["verdict"] for check in checks} == {"good"}
    programs = list(dict.fromkeys(check["program"] for check in checks))
    assert programs == ["server", "Hamlib", "Gpredict", "SatNOGS", "SatDump", "SDRangel", "Look4Sat", "motion"]
    assert checks[1]["sent"] == "\\dump_state"
    assert f"All {len(checks)} good." in result.stderr
    motion = checks[-1]
    wished, got = motion["sent"].split()[1:], motion["came"].split()
    assert float(got[0]) == pytest.approx(float(wished[0]), abs=0.5)


def test_a_real_dish_is_not_moved_unless_asked(selftest, pty_dish, monkeypatch):
    def slowly(address, name):
        for result in self_test(address, name):
            yield result
            # A wish comes before the next look at the dish: one that was carried out would be on the wire by then.
            if result.sent.startswith(b"P"):
                since = time.monotonic()
                pty_dish.wait_for(lambda _truth, since=since: pty_dish.lines(since))

    monkeypatch.setattr(self_test_run, "self_test", slowly)
    before = pty_dish.device.truth()
    result, checks = selftest(port=pty_dish.path)
    assert result.exit_code == 0, result.stdout + result.stderr
    assert pty_dish.moves() == []
    after = pty_dish.device.truth()
    assert (after.az_deg, after.el_deg, after.moving) == (before.az_deg, before.el_deg, False)
    assert checks[-1]["program"] == "Look4Sat"
    assert "Nothing was moved. --moves tries that, too" in result.stderr


def test_with_moves_it_is(selftest, pty_dish):
    before = pty_dish.device.truth().az_deg
    result, checks = selftest("--moves", "--listen-port", 0, port=pty_dish.path)
    assert result.exit_code == 0, result.stdout + result.stderr
    assert (checks[-1]["program"], checks[-1]["verdict"]) == ("motion", "good")
    assert abs(pty_dish.device.truth().az_deg - before) > 1.0


def test_it_goes_through_the_program_that_has_the_port(selftest, pty_dish, owner):
    result, checks = selftest(port=pty_dish.path)
    assert result.exit_code == 0, result.stdout + result.stderr
    assert f"Another birdcage program has {pty_dish.path}." in result.stderr
    assert len(checks) > 30
    assert owner.station.state.holder is None


def test_a_dish_that_is_not_there_fails_with_what_to_do(selftest):
    result, checks = selftest(port="/dev/not-there")
    assert result.exit_code == 1
    wrong = [check for check in checks if check["verdict"] != "good"]
    assert {check["came"] for check in wrong} <= {"RPRT -6", "RPRT -5"}
    assert {check["program"] for check in wrong} >= {"Hamlib", "Gpredict", "SatNOGS", "SatDump"}
    gpredict = next(check for check in wrong if check["program"] == "Gpredict")
    assert gpredict["advice"].startswith("Gpredict would disengage, or show an error.")
    assert "/dev/not-there" in gpredict["advice"]


def test_a_port_that_is_taken_is_said(run):
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        result = run("serve", "--selftest", "--listen-port", port)
    assert result.exit_code == 1
    first, advice = result.stdout.splitlines()[:2]
    assert first.split() == ["server", f"127.0.0.1:{port}", "wrong", "taken"]
    assert f"already listens on port {port}." in advice


def test_a_server_that_is_set_to_be_read_only_moves_nothing(selftest):
    result, checks = selftest("--read-only", "--listen-port", 0)
    assert result.exit_code == 0, result.stdout + result.stderr
    assert "Nothing was moved: clients may look only" in result.stderr
    assert checks[-1]["program"] == "Look4Sat"


def test_moves_alone_is_refused(run):
    result = run("serve", "--moves")
    assert result.exit_code == 2
    assert "--moves goes with --selftest." in result.stderr
