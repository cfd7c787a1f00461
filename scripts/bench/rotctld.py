"""Commands a second and latency of `birdcage serve`, beside Hamlib's `rotctld` in the same run.

Three tables. At full speed each client asks `p` again as soon as it has its answer; at the pace of people's programs
ten times a second. Hamlib drives its dummy rotator (model 1), birdcage a simulated G2 in another process. With a slow
dish, at the same pace, an answer of the dish takes 100 ms: Hamlib drives a stand-in that speaks EasyComm II (model
202), birdcage the simulated G2. The limit of commands a second is lifted: its default is 5000 for each client.
"""

from __future__ import annotations

import json
import os
import pty
import selectors
import signal
import socket
import statistics
import subprocess
import sys
import tempfile
import time
import tty
from pathlib import Path

BIN = Path(sys.executable).parent
SECONDS = 3.0
SLOW_S = 0.1
PACE_S = 0.1
CLIENTS = (1, 10, 100)
EASYCOMM = """
import os, sys, time, tty
fd = int(sys.argv[1])
half = b""
while data := os.read(fd, 100):
    *lines, half = (half + data).split(b"\\n")
    for line in lines:
        if line.startswith(b"AZ EL"):
            time.sleep(float(sys.argv[2]))
            os.write(fd, b"AZ180.0 EL45.0\\n")
"""


def free_port() -> int:
    with socket.create_server(("127.0.0.1", 0)) as server:
        return int(server.getsockname()[1])


class Peers:
    """The servers and dishes of one table, ended together."""

    def __init__(self) -> None:
        self._processes: list[subprocess.Popen[str]] = []
        self._home = tempfile.TemporaryDirectory()

    def __enter__(self) -> Peers:
        return self

    def __exit__(self, *_: object) -> None:
        for process in reversed(self._processes):
            process.send_signal(signal.SIGTERM)
            process.wait(30)
        self._home.cleanup()

    def start(self, *words: str, **more: object) -> subprocess.Popen[str]:
        home = {"HOME": self._home.name, "XDG_CONFIG_HOME": self._home.name, "BIRDCAGE_ROTCTLD_COMMANDS_PER_S": "1e6"}
        process = subprocess.Popen(words, text=True, stderr=subprocess.DEVNULL, env=os.environ | home, **more)  # type: ignore[call-overload]
        self._processes.append(process)
        return process

    def hamlib(self, model: str, *more: str) -> int:
        port = free_port()
        self.start("rotctld", "-m", model, "-T", "127.0.0.1", "-t", str(port), *more)
        return port

    def hamlib_slow(self) -> int:
        master, slave = pty.openpty()
        tty.setraw(slave)
        self.start(sys.executable, "-c", EASYCOMM, str(master), str(SLOW_S), pass_fds=(master,))
        return self.hamlib("202", "-r", os.ttyname(slave), "-C", "timeout=2000")

    def birdcage(self, *options: str) -> int:
        words = [word for option in options for word in ("-o", option)]
        sim = self.start(str(BIN / "birdcage"), "sim", "--json", "--firmware", "g2", *words, stdout=subprocess.PIPE)
        assert sim.stdout is not None
        dish = json.loads(sim.stdout.readline())["port"]
        port = free_port()
        self.start(
            str(BIN / "birdcage"), "serve", "--port", dish, "--firmware", "g2", "--listen-port", str(port),
            "--skip-init", stdout=subprocess.DEVNULL,
        )  # fmt: skip
        return port


def await_position(port: int) -> None:
    """Wait until the server tells where its rotator is."""
    end = time.monotonic() + 30.0
    while time.monotonic() < end:
        try:
            with socket.create_connection(("127.0.0.1", port), timeout=5.0) as line:
                line.sendall(b"p\n")
                if not line.recv(100).startswith(b"RPRT"):
                    return
        except OSError:
            pass
        time.sleep(0.1)
    raise SystemExit(f"The server on port {port} does not answer.")


def measure(port: int, clients: int, pace_s: float) -> tuple[float, list[float]]:
    """Return commands a second and every latency in ms, of clients that ask each `pace_s`; 0: at once again."""
    selector, took, lines = selectors.DefaultSelector(), [], []
    asked: dict[socket.socket, float] = {}
    got: dict[socket.socket, bytes] = {}
    for _ in range(clients):
        line = socket.create_connection(("127.0.0.1", port), timeout=10.0)
        line.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        lines.append(line)
        got[line] = b""
        selector.register(line, selectors.EVENT_READ)
    start = time.perf_counter()
    due = [(start + pace_s * number / clients, line) for number, line in enumerate(lines)]
    while (now := time.perf_counter()) < start + SECONDS:
        while due and due[0][0] <= now:
            _, line = due.pop(0)
            asked[line] = time.perf_counter()
            line.sendall(b"p\n")
        wait_s = max(0.0, due[0][0] - now) if due else start + SECONDS - now
        for key, _ in selector.select(min(wait_s, 0.2)):
            line = key.fileobj
            got[line] += line.recv(1000)
            if got[line].count(b"\n") == 2:
                got[line] = b""
                ended = time.perf_counter()
                took.append((ended - asked[line]) * 1000.0)
                due.append((max(ended, asked[line] + pace_s), line))
        due.sort(key=lambda each: each[0])
    for line in lines:
        line.close()
    return len(took) / SECONDS, took


def table(title: str, servers: dict[str, int], pace_s: float) -> None:
    print(f"\n{title}\n\n| clients | server | commands/s | median ms | p99 ms |\n|---|---|---|---|---|")
    for clients in CLIENTS:
        medians = {}
        for name, port in servers.items():
            rate, took = measure(port, clients, pace_s)
            if not took:
                print(f"| {clients} | {name} | 0 | no answer | no answer |")
                continue
            p99 = statistics.quantiles(took, n=100)[98] if len(took) > 100 else max(took)
            medians[name] = statistics.median(took)
            print(f"| {clients} | {name} | {rate:.0f} | {medians[name]:.2f} | {p99:.2f} |", flush=True)
        if len(medians) == 2:
            ours, theirs = medians.values()
            print(f"| {clients} | ratio of medians | | {ours / theirs:.2f} | |")


def main() -> None:
    with Peers() as peers:
        servers = {"birdcage": peers.birdcage(), "rotctld -m 1": peers.hamlib("1")}
        for port in servers.values():
            await_position(port)
        table("As fast as they can", servers, 0.0)
        table("Each client ten times a second", servers, PACE_S)
    slow = f"latency_min={SLOW_S}", f"latency_max={SLOW_S}"
    with Peers() as peers:
        servers = {"birdcage": peers.birdcage(*slow), "rotctld -m 202": peers.hamlib_slow()}
        for port in servers.values():
            await_position(port)
        table("A dish that takes 100 ms, each client ten times a second", servers, PACE_S)


if __name__ == "__main__":
    main()
