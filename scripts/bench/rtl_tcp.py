"""What listening to an RTL-SDR costs: level and spectrum of 1.024 million samples a second, beside merely reading them.

The samples come from a process of their own, at their own pace. Aim: 20 % of a core.
"""

from __future__ import annotations

import multiprocessing
import os
import socket
import time
from multiprocessing.connection import Connection

from birdcage.base.clock import RealClock
from birdcage.signal.rtl_tcp_meter import HEADER, MAGIC, RtlTcpMeter, Tuned

RATE_HZ, SECONDS, BLOCK = 1_024_000.0, 10.0, 65_536
AIM = 0.20
TUNED = Tuned(1_420_400_000.0, RATE_HZ, 200_000.0, 28.0)


def serve(told: Connection) -> None:
    """Send samples to whoever connects, as fast as a receiver takes them."""
    block = os.urandom(BLOCK)
    with socket.create_server(("127.0.0.1", 0)) as server:
        told.send(server.getsockname()[1])
        while True:
            client, _ = server.accept()
            with client:
                begun, sent = time.monotonic(), 0
                try:
                    client.sendall(MAGIC.ljust(HEADER, b"\0"))
                    while True:
                        client.sendall(block)
                        sent += BLOCK
                        time.sleep(max(begun + sent / (2.0 * RATE_HZ) - time.monotonic(), 0.0))
                except OSError:
                    continue


def measured(port: int) -> tuple[float, int]:
    """Return the share of a core that levels and spectra take, and how many there were."""
    meter = RtlTcpMeter(f"127.0.0.1:{port}", TUNED, RealClock())
    meter.open()
    count, begun, cpu = 0, time.monotonic(), time.process_time()
    while time.monotonic() < begun + SECONDS:
        count += meter.read(0.2) is not None
    share = (time.process_time() - cpu) / (time.monotonic() - begun)
    meter.close()
    return share, count


def merely_read(port: int) -> float:
    """Return the share of a core that reading the same bytes takes."""
    with socket.create_connection(("127.0.0.1", port)) as connection:
        begun, cpu = time.monotonic(), time.process_time()
        while time.monotonic() < begun + SECONDS:
            connection.recv(BLOCK)
        return (time.process_time() - cpu) / (time.monotonic() - begun)


def main() -> None:
    """Print both, and their ratio."""
    ours, theirs = multiprocessing.Pipe()
    server = multiprocessing.Process(target=serve, args=(theirs,), daemon=True)
    server.start()
    port = ours.recv()
    share, count = measured(port)
    floor = merely_read(port)
    server.terminate()
    print(f"levels and spectra: {share:.1%} of a core, {count / SECONDS:.1f} a second (aim {AIM:.0%})")
    print(f"merely read:        {floor:.1%} of a core; ratio {share / floor:.1f}")


if __name__ == "__main__":
    main()
