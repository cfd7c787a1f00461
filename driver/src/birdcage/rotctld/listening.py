"""The socket that listens: who may connect, and who has the port where it can't be had."""

from __future__ import annotations

import errno
import socket
from collections.abc import Sequence
from ipaddress import IPv4Network, IPv6Address, IPv6Network, ip_address, ip_network
from pathlib import Path

from birdcage.base.errors import ConfigError

BACKLOG = 64
UNREAD_BYTES = 65_536
LISTENING = "0A"
"""The state of a listening socket in Linux's `/proc/net/tcp`."""

Network = IPv4Network | IPv6Network


def networks_of(texts: Sequence[str]) -> tuple[Network, ...]:
    """Return the networks that are written so: `192.168.1.0/24`, `fd00::/8`, `192.168.1.7`. ConfigError for no such."""
    networks = []
    for text in texts:
        try:
            networks.append(ip_network(text.strip(), strict=False))
        except ValueError:
            raise ConfigError(
                f"{text} is no network. Write an address, or a network with its length: 192.168.1.0/24 or fd00::/8."
            ) from None
    return tuple(networks)


def is_allowed(address: str, networks: Sequence[Network]) -> bool:
    """Return whether a client at this address may connect: from this machine always, from elsewhere by `networks`.

    Without networks everybody may who reaches the port.
    """
    host = ip_address(address.partition("%")[0])
    if isinstance(host, IPv6Address) and host.ipv4_mapped is not None:
        host = host.ipv4_mapped
    return not networks or host.is_loopback or any(host in network for network in networks)


def is_loopback(host: str) -> bool:
    """Return whether only programs of this machine reach a server that listens there."""
    try:
        return ip_address(host).is_loopback
    except ValueError:
        return host == "localhost"


def wide_warning(host: str, port: int, networks: Sequence[Network], *, read_only: bool) -> str:
    """Return what a person should know of a server that other machines reach; empty for one that they don't."""
    if is_loopback(host):
        return ""
    which = "Computers in " + ", ".join(map(str, networks)) if networks else "All computers on the network"
    if read_only:
        return f"{which} can read the dish's position on port {port}: this protocol has no password."
    advice = "" if networks else " Limit it: --allow 192.168.1.0/24, or --read-only."
    return f"{which} can move the dish through port {port}: this protocol has no password.{advice}"


def listen(host: str, port: int) -> socket.socket:
    """Return a listening socket, not blocking. ConfigError says why there is none, and what to do."""
    try:
        found = socket.getaddrinfo(host or None, port, type=socket.SOCK_STREAM, flags=socket.AI_PASSIVE)
        family, _, _, _, address = found[0]
        both = host == "::" and socket.has_dualstack_ipv6()
        listener = socket.create_server(address[:2], family=family, backlog=BACKLOG, dualstack_ipv6=both)
    except OSError as error:
        raise ConfigError(_why_not(host, port, error)) from error
    return as_listener(listener)


def as_listener(listener: socket.socket) -> socket.socket:
    """Return a socket that listens already, as the server needs it."""
    listener.setblocking(False)
    # Its clients inherit it: what one of them leaves unread is bounded in the system, too.
    listener.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, UNREAD_BYTES)
    return listener


def _why_not(host: str, port: int, error: OSError) -> str:
    if error.errno == errno.EADDRINUSE:
        owner = who_listens(port)
        by = f"{owner} already listens on port {port}" if owner else f"Another program already listens on port {port}"
        return f"{by}. End it, or choose another port with --listen-port."
    if error.errno == errno.EACCES:
        return f"Port {port} is reserved for the system. Choose one above 1023 with --listen-port."
    if error.errno == errno.EADDRNOTAVAIL:
        return f"This machine has no address {host}. Use 127.0.0.1, 0.0.0.0 or one of its own."
    return (
        f"{host} port {port} can't be listened on: {error.strerror or error}. Choose others with --host, --listen-port."
    )


def who_listens(port: int, proc: Path = Path("/proc")) -> str:
    """Return which process listens on a TCP port, `rotctld (process 123)`; empty where that can't be known.

    Only on Linux, and of other users' processes only for root.
    """
    inodes = {inode for table in ("tcp", "tcp6") for inode in _listeners(proc / "net" / table, port)}
    wanted = {f"socket:[{inode}]" for inode in inodes}
    for process in proc.glob("[0-9]*") if wanted else ():
        try:
            if any(str(link.readlink()) in wanted for link in (process / "fd").iterdir()):
                name = (process / "comm").read_text(encoding="utf-8", errors="replace").strip()
                return f"{name} (process {process.name})"
        except OSError:
            continue  # it is another user's, or has ended
    return ""


def _listeners(table: Path, port: int) -> list[str]:
    """Return the inodes of the sockets that listen on a port, by one of Linux's tables."""
    try:
        rows = [line.split() for line in table.read_text(encoding="ascii").splitlines()[1:]]
    except (OSError, ValueError):
        return []
    return [row[9] for row in rows if row[3] == LISTENING and int(row[1].rpartition(":")[2], 16) == port]
