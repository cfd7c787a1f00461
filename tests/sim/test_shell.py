"""The line shell: echo, line ends, one thing at a time, and what `q` does at the root."""

from __future__ import annotations

import pytest


def test_nothing_is_printed_on_connect(terminal):
    dish = terminal()
    assert dish.listen(60.0) == ""
    assert dish.ask("") == "\r\nTRK>"


@pytest.mark.parametrize("end", ["\r", "\n", "\r\n"])
def test_line_ends_that_are_taken(terminal, end):
    dish = terminal()
    dish.type("mot" + end)
    assert dish.listen(1.0) == "mot\r\nMOT>"


def test_lf_after_cr_may_be_a_line_of_its_own(terminal):
    dish = terminal("lf_after_cr=line")
    dish.type("mot\r\n")
    assert dish.listen(1.0) == "mot\r\nMOT>\r\nMOT>"


@pytest.mark.parametrize(("name", "end"), [("crlf", "\r\n"), ("lf", "\n"), ("cr", "\r")])
def test_line_ends_that_are_sent(terminal, name, end):
    assert terminal(f"line_end={name}").ask("mot") == f"mot{end}MOT>"


def test_echo_may_be_off(terminal):
    assert terminal("echo=0").ask("mot") == "MOT>"


def test_there_is_no_backspace(terminal):
    dish = terminal()
    dish.type("moo\x7ft\r")
    assert dish.listen(1.0) == "moo\x7ft\r\nInvalid command.\r\nTRK>"


def test_unknown_command_text_is_a_setting(terminal):
    assert terminal("unknown_command=What%3F").ask("xyz") == "xyz\r\nWhat?\r\nTRK>"


def test_a_word_that_no_menu_knows(terminal):
    dish = terminal()
    dish.ask("mot")
    assert dish.ask("azscanwxpq 0 10 100 3") == "azscanwxpq 0 10 100 3\r\nInvalid command.\r\nMOT>"


def test_homing_blocks_the_shell(terminal):
    dish = terminal("unhomed=1")
    dish.ask("mot", "MOT>")
    dish.type("h 1\r")
    assert dish.listen(0.3) == "h 1\r\n"
    dish.type("a\r")
    assert dish.listen(0.2) == ""  # not even an echo: input is read between commands only
    heard = dish.listen(3.0)
    assert heard == "MOT>a\r\nAngle[0] = 2147483647.00\r\nAngle[1] = 65.00\r\nMOT>"


@pytest.mark.parametrize(
    ("root_q", "heard"), [("error", "q\r\nInvalid command.\r\nTRK>"), ("ignore", "q\r\nTRK>"), ("kill", "q\r\n")]
)
def test_q_at_the_root(terminal, root_q, heard):
    dish = terminal(f"root_q={root_q}")
    assert dish.ask("q") == heard
    assert dish.port.dish.truth().shell_alive is (root_q != "kill")
    assert (dish.ask("") == "") is (root_q == "kill")


def test_only_power_brings_a_killed_shell_back(terminal):
    dish = terminal("root_q=kill")
    dish.ask("q")
    dish.type("reboot\r")
    assert dish.listen(30.0) == ""
    dish.device.power_cycle()
    assert dish.listen(30.0).endswith("TRK>")


def test_received_lines(terminal):
    dish = terminal()
    start = dish.now
    dish.ask("mot", "MOT>")
    dish.ask("a", "MOT>")
    assert [line for _, line in dish.port.received] == ["mot", "a"]
    assert dish.port.received[0][0] == start
