"""The units for systemd: this installation's paths, quoted as systemd reads them."""

from __future__ import annotations

import os
import shutil
import subprocess
from pathlib import Path

import pytest


def unit(run, *words, port="/dev/ttyUSB0", **env):
    result = run("station", "run", "--print-systemd", *words, port=port, env=env)
    assert result.exit_code == 0, result.stderr
    lines = [line for line in result.stdout.splitlines() if line and not line.startswith("#")]
    return result.stdout, dict(line.split("=", 1) for line in lines if "=" in line)


def test_it_starts_what_was_asked_for_here(run) -> None:
    text, keys = unit(run, "--baud", 9600, "--skip-init")
    program, *words = keys["ExecStart"].split(" ")
    assert os.access(program, os.X_OK)
    assert words == [
        "station", "run", "--port", "/dev/ttyUSB0", "--firmware", "g2", "--baud", "9600", "--skip-init"
    ]  # fmt: skip
    assert (keys["Type"], keys["SuccessExitStatus"], keys["RestartPreventExitStatus"]) == ("exec", "143", "2")
    assert "systemd/user/birdcage-station.service" in text


def test_it_finds_the_files_that_are_found_here(run, tmp_path) -> None:
    (tmp_path / "birdcage.toml").write_text("")
    text, keys = unit(run, BIRDCAGE_HOME=str(tmp_path))
    assert f"--config {tmp_path}/birdcage.toml" in keys["ExecStart"]
    assert f"Environment=BIRDCAGE_HOME={tmp_path}" in text


def test_odd_names_are_quoted(run) -> None:
    _, keys = unit(run, port="/dev/serial/by-id/odd 50% $x")
    assert '"/dev/serial/by-id/odd 50%% $$x"' in keys["ExecStart"]


@pytest.mark.skipif(shutil.which("systemd-analyze") is None and "CI" not in os.environ, reason="no systemd here")
def test_systemd_itself_takes_it(run, tmp_path) -> None:
    if shutil.which("systemd-analyze") is None:
        return
    text, _ = unit(run)
    file = tmp_path / "birdcage-station.service"
    file.write_text(text)
    done = subprocess.run(["systemd-analyze", "verify", "--user", file], capture_output=True, text=True, timeout=60)
    assert "birdcage-station" not in done.stderr, done.stderr


def test_the_server_has_a_unit_with_its_own_options(run) -> None:
    result = run(
        "serve", "--print-systemd", "service", "--allow", "10.0.0.0/8", "--allow", "fd00::/8", "--read-only",
        "--record", "said.txt", port="/dev/ttyUSB0",
    )  # fmt: skip
    assert result.exit_code == 0, result.stderr
    (command,) = [line for line in result.stdout.splitlines() if line.startswith("ExecStart=")]
    assert command.split(" ")[1:] == [
        "serve", "--port", "/dev/ttyUSB0", "--firmware", "g2", "--allow", "10.0.0.0/8", "--allow", "fd00::/8",
        "--read-only", "--record", str(Path("said.txt").absolute()),
    ]  # fmt: skip


@pytest.mark.parametrize(("words", "address"), [
    ((), "127.0.0.1:4533"),
    (("--host", "localhost", "--listen-port", 4600), "127.0.0.1:4600"),
    (("--host", "::1"), "[::1]:4533"),
])  # fmt: skip
def test_the_socket_has_a_unit(run, tmp_path, words, address) -> None:
    text = run("serve", "--print-systemd", "socket", *words).stdout
    assert f"\nListenStream={address}\n" in text
    if shutil.which("systemd-analyze") is not None:
        for kind, printed in (("socket", text), ("service", run("serve", "--print-systemd", "service").stdout)):
            (tmp_path / f"birdcage-rotctld.{kind}").write_text(printed)
        files = [tmp_path / "birdcage-rotctld.socket", tmp_path / "birdcage-rotctld.service"]
        done = subprocess.run(
            ["systemd-analyze", "verify", "--user", *files], capture_output=True, text=True, timeout=60, check=False
        )
        assert "birdcage-rotctld" not in done.stderr, done.stderr
