"""Where it listens, who may connect, and what is said where it can't."""

from __future__ import annotations

import os
import socket
from pathlib import Path

import pytest
from birdcage.base.config import RotctldSettings
from birdcage.base.errors import ConfigError
from birdcage.rotctld.listening import is_allowed, listen, who_listens, wide_warning
from birdcage.rotctld.passed_socket import passed_socket


def networks(text):
    return RotctldSettings(allow=text).networks


@pytest.mark.parametrize(("address", "allow", "let_in"), [
    ("10.0.0.1", None, True),
    ("192.168.1.7", "192.168.1.0/24", True),
    ("192.168.2.7", "192.168.1.0/24", False),
    ("192.168.2.7", "192.168.1.0/24, 192.168.2.7", True),
    ("127.0.0.1", "192.168.1.0/24", True),
    ("::1", "192.168.1.0/24", True),
    ("::ffff:192.168.1.7", "192.168.1.0/24", True),
    ("::ffff:192.168.2.7", "192.168.1.0/24", False),
    ("fd00::7", "fd00::/8", True),
    ("fe80::1%eth0", "fd00::/8", False),
    ("fd00::7", "192.168.1.0/24", False),
])  # fmt: skip
def test_who_may_connect(address, allow, let_in):
    assert is_allowed(address, networks(allow)) is let_in


@pytest.mark.parametrize(("host", "allow", "read_only", "words"), [
    ("127.0.0.1", None, False, None),
    ("localhost", None, False, None),
    ("::1", None, False, None),
    ("0.0.0.0", None, False, "All computers on the network can move the dish"),
    ("", None, False, "All computers on the network can move the dish"),
    ("192.168.1.7", "192.168.1.0/24", False, "Computers in 192.168.1.0/24 can move the dish"),
    ("::", None, True, "All computers on the network can read the dish's position"),
])  # fmt: skip
def test_a_warning_where_other_machines_reach_it(host, allow, read_only, words):
    said = wide_warning(host, 4533, networks(allow), read_only=read_only)
    assert (said == "") if words is None else said.startswith(words)
    assert words is None or "4533" in said


def test_a_port_that_is_taken_names_the_process_that_has_it():
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        with pytest.raises(ConfigError, match=f"already listens on port {port}. End it, or choose another") as error:
            listen("127.0.0.1", port)
    if Path("/proc/net/tcp").exists():
        assert f"(process {os.getpid()}) already" in str(error.value)


def test_who_listens_is_unknown_where_the_system_does_not_tell(tmp_path):
    assert who_listens(4533, tmp_path) == ""


@pytest.mark.parametrize(
    ("host", "words"), [("203.0.113.9", "no address 203.0.113.9"), ("no.such.host.invalid", "--host")]
)
def test_an_address_that_is_not_ours_says_what_to_use(host, words):
    with pytest.raises(ConfigError, match=words):
        listen(host, 0)


@pytest.mark.skipif(not socket.has_ipv6, reason="no IPv6 here")
def test_one_port_for_both_kinds_of_addresses():
    with listen("::", 0) as listener:
        port = listener.getsockname()[1]
        with socket.create_connection(("127.0.0.1", port), timeout=5):
            pass


@pytest.mark.parametrize("environ", [
    {}, {"LISTEN_PID": "1", "LISTEN_FDS": "1"}, {"LISTEN_FDS": "1"}, {"LISTEN_PID": str(os.getpid())},
    {"LISTEN_PID": str(os.getpid()), "LISTEN_FDS": "0"}, {"LISTEN_PID": str(os.getpid()), "LISTEN_FDS": "many"},
])  # fmt: skip
def test_a_socket_passed_to_another_process_is_not_taken(environ):
    assert passed_socket(environ) is None
    assert not any(name.startswith("LISTEN_") for name in environ)


def test_more_than_one_passed_socket_is_refused():
    with pytest.raises(ConfigError, match="2 sockets"):
        passed_socket({"LISTEN_PID": str(os.getpid()), "LISTEN_FDS": "2", "LISTEN_FDNAMES": "a:b"})
