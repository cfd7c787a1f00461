"""The listening socket that systemd passes to a server it has started: sd_listen_fds(3), in a few lines."""

from __future__ import annotations

import os
import socket
from collections.abc import MutableMapping

from birdcage.base.errors import ConfigError
from birdcage.rotctld.listening import as_listener

FIRST = 3
"""The descriptor of the first socket that is passed (SD_LISTEN_FDS_START)."""
VARIABLES = ("LISTEN_PID", "LISTEN_FDS", "LISTEN_FDNAMES")


def passed_socket(environ: MutableMapping[str, str] = os.environ) -> socket.socket | None:
    """Return the socket that this process was given, ready for the server; None if it was given none.

    The variables are taken out of `environ`: a program that is started from here was given nothing. ConfigError for
    more than one socket, and for one that is no listening TCP socket.
    """
    mine = environ.get("LISTEN_PID") == str(os.getpid())
    count = environ.get("LISTEN_FDS", "")
    for name in VARIABLES:
        environ.pop(name, None)
    if not mine or not count.isdecimal() or count == "0":
        return None
    if count != "1":
        raise ConfigError(f"systemd passes {count} sockets, and birdcage serves one. Keep one ListenStream= line.")
    os.set_inheritable(FIRST, False)
    listener = socket.socket(fileno=FIRST)
    is_tcp = listener.family in (socket.AF_INET, socket.AF_INET6) and listener.type == socket.SOCK_STREAM
    if not is_tcp or not listener.getsockopt(socket.SOL_SOCKET, socket.SO_ACCEPTCONN):
        listener.close()
        raise ConfigError("systemd passes a socket that takes no TCP connections. Write ListenStream=127.0.0.1:4533.")
    return as_listener(listener)
