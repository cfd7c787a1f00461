"""What this machine holds against a port, from folders that stand in for /proc and /sys."""

from __future__ import annotations

import grp
import os
import types

import pytest
from birdcage.link.system import SystemFacts, look_at_system
from birdcage.link.trouble import other_program


@pytest.fixture
def proc(tmp_path):
    folder = tmp_path / "proc"
    for pid, name in ((1, "systemd"), (40, "bash")):
        run(folder, pid, name)
    return folder


def run(proc, pid, name, opened=None):
    (proc / str(pid) / "fd").mkdir(parents=True)
    (proc / str(pid) / "comm").write_text(f"{name}\n")
    if opened is not None:
        (proc / str(pid) / "fd" / "5").symlink_to(opened)


@pytest.fixture
def device(tmp_path):
    path = tmp_path / "ttyUSB0"
    path.touch()
    return path


def look(device, proc, tmp_path):
    return look_at_system(str(device), proc=proc, sys=tmp_path)


def names(facts):
    return [each.name for each in facts.hindrances]


def test_a_clean_machine(device, proc, tmp_path):
    facts = look(device, proc, tmp_path)
    assert (facts.modem_manager, facts.brltty, facts.other_program, facts.latency_ms) == (False, False, None, None)
    assert facts.may_open is True
    assert facts.hindrances == ()


@pytest.mark.parametrize(
    ("program", "name", "command"),
    [
        ("ModemManager", "modemmanager", "sudo systemctl stop ModemManager"),
        ("brltty", "brltty", "sudo apt remove brltty"),
    ],
)
def test_programs_that_meddle_are_seen(device, proc, tmp_path, program, name, command):
    run(proc, 700, program)
    (found,) = look(device, proc, tmp_path).hindrances
    assert (found.name, found.command) == (name, command)
    assert program in found.what


def test_a_program_that_only_sounds_alike_is_not(device, proc, tmp_path):
    run(proc, 700, "ModemManagerGui")
    run(proc, 701, "xbrltty")
    assert look(device, proc, tmp_path).hindrances == ()


def test_a_process_that_ended_meanwhile_is_passed_over(device, proc, tmp_path):
    (proc / "800").mkdir()
    (proc / "800" / "comm").symlink_to(proc / "gone")
    run(proc, 801, "brltty")
    assert look(device, proc, tmp_path).brltty is True


def test_no_proc_is_not_known_and_not_no(device, tmp_path):
    facts = look(device, tmp_path / "nothing", tmp_path)
    assert (facts.modem_manager, facts.brltty) == (None, None)
    assert facts.hindrances == ()


def test_another_program_with_the_port_is_named(device, proc, tmp_path):
    run(proc, 4711, "screen", opened=device)
    facts = look(device, proc, tmp_path)
    assert facts.other_program == "screen (process 4711)"
    (busy,) = facts.hindrances
    assert (busy.name, busy.command) == ("busy", "")
    assert "screen (process 4711)" in busy.what
    assert busy.then


def test_this_program_itself_is_no_other(device, proc, tmp_path):
    run(proc, os.getpid(), "birdcage", opened=device)
    assert other_program(str(device), proc) is None
    run(proc, 4711, "screen", opened=device)
    assert other_program(str(device), proc) == "screen (process 4711)"


def test_a_lock_names_its_owner(device, proc):
    node = device.stat()
    run(proc, 99, "minicom")
    (proc / "locks").write_text(
        f"1: FLOCK  ADVISORY  WRITE 99 {os.major(node.st_dev):02x}:{os.minor(node.st_dev):02x}:{node.st_ino} 0 EOF\n"
    )
    assert other_program(str(device), proc) == "minicom (process 99)"


def forbidden(monkeypatch, group, members):
    monkeypatch.setattr("birdcage.link.system.os.access", lambda path, mode: False)
    entry = types.SimpleNamespace(gr_name=group, gr_mem=members)
    monkeypatch.setattr(grp, "getgrgid", lambda gid: entry)
    user = types.SimpleNamespace(pw_name="ann", pw_gid=-1)
    monkeypatch.setattr("pwd.getpwuid", lambda uid: user)


@pytest.mark.parametrize("group", ["dialout", "uucp"])
def test_a_device_of_a_group_that_the_user_is_not_in(device, proc, tmp_path, monkeypatch, group):
    forbidden(monkeypatch, group, ["bob"])
    facts = look(device, proc, tmp_path)
    assert (facts.group, facts.may_open, facts.enrolled) == (group, False, False)
    (found,) = facts.hindrances
    assert (found.name, found.command) == ("group", f"sudo usermod -aG {group} $USER")
    assert "log out and in again" in found.then


def test_a_login_from_before_the_group(device, proc, tmp_path, monkeypatch):
    forbidden(monkeypatch, "dialout", ["ann"])
    (found,) = look(device, proc, tmp_path).hindrances
    assert (found.name, found.command) == ("login", "newgrp dialout")


def test_a_device_of_root_alone(device, proc, tmp_path, monkeypatch):
    forbidden(monkeypatch, "root", [])
    (found,) = look(device, proc, tmp_path).hindrances
    assert found.command == f"sudo chmod a+rw {device}"


def test_a_slow_adapter_is_told_last(device, proc, tmp_path):
    timer = tmp_path / "class" / "tty" / "ttyUSB0" / "device" / "latency_timer"
    timer.parent.mkdir(parents=True)
    timer.write_text("16\n")
    run(proc, 700, "ModemManager")
    facts = look(device, proc, tmp_path)
    assert facts.latency_ms == 16
    assert names(facts) == ["modemmanager", "latency"]
    assert facts.hindrances[-1].command.endswith("/sys/class/tty/ttyUSB0/device/latency_timer")
    timer.write_text("1\n")
    assert names(look(device, proc, tmp_path)) == ["modemmanager"]


def test_a_port_that_is_no_device(proc, tmp_path):
    facts = look_at_system("socket://host:2000", proc=proc, sys=tmp_path)
    assert (facts.group, facts.may_open, facts.latency_ms) == (None, None, None)
    assert facts.hindrances == ()


def test_elsewhere_nothing_is_known(device, proc, tmp_path, monkeypatch):
    run(proc, 700, "ModemManager")
    monkeypatch.setattr("birdcage.link.system.python.platform", "darwin")
    assert look(device, proc, tmp_path) == SystemFacts(str(device))
    assert SystemFacts(str(device)).hindrances == ()


def test_who_holds_a_pseudo_terminal_open_takes_nothing_away(proc, tmp_path):
    link = tmp_path / "dish"
    link.symlink_to("/dev/pts/7")
    run(proc, 900, "birdcage", opened="/dev/pts/7")
    assert other_program(str(link), proc) is None


@pytest.mark.parametrize("name", ["", "/"])
def test_an_empty_name_or_a_folder_has_no_remedy(name, proc, tmp_path, monkeypatch):
    monkeypatch.setattr("birdcage.link.system.os.access", lambda path, mode: False)
    facts = look_at_system(name, proc=proc, sys=tmp_path)
    assert (facts.group, facts.may_open, facts.enrolled) == (None, None, None)
    assert facts.hindrances == ()
