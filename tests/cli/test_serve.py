"""`birdcage serve`: a process of its own, real clients of Hamlib, and how it ends."""

from __future__ import annotations

import json
import re
import shutil
import signal
import socket
import subprocess

import pytest


@pytest.fixture
def rotctl():
    """Run Hamlib's own client for one command."""
    if shutil.which("rotctl") is None:
        pytest.skip("Hamlib's rotctl is not installed")

    def rotctl(port, *words):
        command = ["rotctl", "-m", "2", "-r", f"127.0.0.1:{port}", *map(str, words)]
        return subprocess.run(command, capture_output=True, text=True, timeout=20, check=False).stdout

    return rotctl


def position(rotctl, port):
    """Return what it prints; None where that is an error."""
    said = rotctl(port, "p").split()
    return None if "error" in said else tuple(map(float, said))


def await_position(client):
    """Ask until the dish is there."""
    client.sendall(b"p\n")
    while client.recv(100).startswith(b"RPRT"):
        client.sendall(b"p\n")


def test_hamlibs_client_drives_the_dish(serve, rotctl, pty_dish):
    process, port = serve()
    pty_dish.wait_for(lambda _truth: position(rotctl, port))
    assert rotctl(port, "_").strip() == "Carryout G2"
    rotctl(port, "P", 180, 45)
    pty_dish.wait_for(lambda truth: not truth.moving and abs(truth.az_deg - 180.0) < 0.1)
    pty_dish.wait_for(lambda _truth: position(rotctl, port) == pytest.approx((180.0, 45.0), abs=0.1))
    process.send_signal(signal.SIGTERM)
    _out, err = process.communicate(timeout=30)
    assert process.returncode == 128 + signal.SIGTERM
    assert "Hamlib (rotctld" in err
    assert "Traceback" not in err


@pytest.mark.parametrize("name", ["SIGINT", "SIGTERM", "SIGHUP"])
def test_what_a_client_moves_is_stopped_before_it_ends(serve, pty_dish, name):
    process, port = serve("--json")
    with socket.create_connection(("127.0.0.1", port), timeout=10) as client:
        await_position(client)
        client.sendall(b"P 200 45\n")
        assert client.recv(100) == b"RPRT 0\n"
        pty_dish.wait_for_motion()
        process.send_signal(getattr(signal, name))
        out, err = process.communicate(timeout=30)
        assert client.recv(100) == b""
    assert process.returncode == 128 + getattr(signal, name)
    assert not pty_dish.device.truth().moving
    assert "The dish was last seen at" in err.splitlines()[-1]
    told = [json.loads(line) for line in out.splitlines()]
    kinds = [each["type"] for each in told]
    assert kinds[0] == "Listening"
    assert {"ClientCame", "LinkChanged", "MoveStarted", "StopConfirmed", "MoveEnded", "ClientLeft"} <= set(kinds)


def test_what_clients_say_is_kept(serve, pty_dish, tmp_path):
    kept = tmp_path / "session.txt"
    process, port = serve("--record", kept)
    with socket.create_connection(("127.0.0.1", port), timeout=10) as client:
        await_position(client)
        client.sendall(b"_\n")
        assert client.recv(100) == b"Carryout G2\n"
    process.send_signal(signal.SIGTERM)
    process.communicate(timeout=30)
    said = kept.read_text("ascii")
    assert re.search(r"Z 1 > _\\n\n.*Z 1 < Carryout G2\\n\n", said)
    assert said.endswith((" 1 # gone: quit\n", " 1 # gone: closing\n"))


def test_a_record_that_cannot_be_written_is_refused(run, tmp_path):
    result = run("serve", "--listen-port", 0, "--record", tmp_path)
    assert result.exit_code == 2
    assert "Name another --record." in result.stderr


def test_a_port_that_is_taken_says_by_whom(run):
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        result = run("serve", "--listen-port", port)
    assert result.exit_code == 2
    assert f"already listens on port {port}. End it, or choose another port with --listen-port." in result.stderr
    assert "link" not in result.stderr


def test_a_mistyped_network_lets_no_client_in(run):
    result = run("serve", "--listen-port", 0, "--allow", "192.168.l.0/24")
    assert result.exit_code == 2
    assert "Listening" not in result.stderr
    assert "192.168.l.0/24" in result.stderr


def test_wider_than_this_machine_is_warned_of_and_shown(serve, run, as_json, pty_dish):
    process, _port = serve("--host", "0.0.0.0")
    words = "All computers on the network can move the dish"
    assert words in process.stderr.readline()
    pty_dish.wait_for(lambda _truth: "up" in process.stderr.readline())
    status: dict = {}

    def shown(_truth):
        status.update(as_json(run("status", "--json", port=pty_dish.path)))
        return status["network"]

    pty_dish.wait_for(shown)
    assert status["network"]["address"].startswith("0.0.0.0:")
    assert words in " ".join(status["warnings"])


def test_without_a_named_firmware_it_says_what_is_tried(start, tmp_path):
    process = start("serve", "--port", tmp_path / "none", "--listen-port", 0)
    said = [process.stderr.readline() for _ in range(2)]
    assert said[0] == "Firmware unknown, so hal205 is tried. Name it with --firmware if the dish comes later.\n"
    assert said[1].startswith("Listening on 127.0.0.1 port")
    process.send_signal(signal.SIGTERM)
    process.communicate(timeout=30)
    assert process.returncode == 128 + signal.SIGTERM


def test_status_names_the_clients(serve, run, as_json, pty_dish):
    _process, port = serve()
    with socket.create_connection(("127.0.0.1", port), timeout=10) as client:
        await_position(client)
        client.sendall(b"\\dump_state\nP 180 45\n")
        seen = []

        def shown(_truth):
            seen.append(as_json(run("status", "--json", port=pty_dish.path)))
            clients = (seen[-1]["network"] or {}).get("clients", ())
            return clients and clients[0]["role"] == "control"

        pty_dish.wait_for(shown)
        client_seen = seen[-1]["network"]["clients"][0]
        assert (client_seen["program"], client_seen["wants_azimuth_deg"]) == ("Hamlib", 180.0)
        said = run("status", port=pty_dish.path).stdout
        line = next(line for line in said.splitlines() if line.startswith("network "))
        assert f"listens on 127.0.0.1:{port}; Hamlib (rotctld 1) 127.0.0.1:" in line
        assert line.endswith("has control")


def client_shown(owner):
    """The only client as the program that has the port shows it; None as long as it shows none."""
    network = owner.station.state.network
    return network.clients[0] if network is not None and network.clients else None


def test_where_another_program_has_the_port_clients_go_through_that(serve, pty_dish, owner):
    process, port = serve("--json")
    with socket.create_connection(("127.0.0.1", port), timeout=10) as client:
        await_position(client)
        client.sendall(b"P 200 45\n")
        assert client.recv(100) == b"RPRT 0\n"
        pty_dish.wait_for_motion()
        assert owner.station.state.holder is not None
        pty_dish.wait_for(lambda _truth: (client := client_shown(owner)) and client.wants_az_deg == 200.0)
        assert owner.station.state.network.port == port
        assert owner.station.state.network.by.startswith("birdcage serve, ")
        assert client_shown(owner).name == owner.station.state.holder
        process.send_signal(signal.SIGTERM)
        out, err = process.communicate(timeout=30)
    assert process.returncode == 128 + signal.SIGTERM
    assert "Traceback" not in err
    assert '"type": "MoveStarted"' in out
    pty_dish.wait_for(lambda truth: not truth.moving, 3.0)
    assert abs(pty_dish.device.truth().az_deg - 200.0) > 5.0
    pty_dish.wait_for(lambda _truth: owner.station.state.holder is None)
    assert owner.station.state.held is None
    pty_dish.wait_for(lambda _truth: owner.station.state.network is None)


def test_it_serves_on_the_socket_that_systemd_passes_and_early_clients_wait(start, pty_dish):
    with socket.create_server(("127.0.0.1", 0)) as listener, socket.create_connection(listener.getsockname()) as early:
        early.settimeout(20)
        early.sendall(b"_\n")
        words = ("--port", pty_dish.path, "--firmware", "g2", "--listen-port", 1)
        process = start("serve", *words, passed=listener)
        assert early.recv(100) == b"Carryout G2\n"
        assert f"Listening on 127.0.0.1 port {listener.getsockname()[1]}." in process.stderr.readline()
        process.send_signal(signal.SIGTERM)
        process.communicate(timeout=30)
    assert process.returncode == 128 + signal.SIGTERM


def test_a_passed_socket_that_is_none_of_tcp_is_refused(start, pty_dish):
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as datagrams:
        process = start("serve", "--port", pty_dish.path, "--firmware", "g2", passed=datagrams)
        _out, err = process.communicate(timeout=30)
    assert process.returncode == 2
    assert "ListenStream=127.0.0.1:4533" in err
