"""Has a server move the dish, as a client would, and sees it through."""

from __future__ import annotations

import socket
import time
from collections.abc import Callable

from birdcage.rotctld.self_test import PATIENCE_S, SelfTestResult, SelfTestVerdict

WAY_DEG = 5.0
NEAR_DEG = 0.5
ARRIVES_S = 60.0
"""How long the way may take: earlier moves may have to end first, and some dishes queue them."""
AGAIN_S = 1.0
"""How often the wish is sent again, as Gpredict does: the first may be ignored while an earlier client's move ends."""


def motion_test(address: tuple[str, int], each_time: Callable[[], object]) -> SelfTestResult:
    """Send the dish 5 degrees on in azimuth, and wait until `p` tells that it is there. `S` ends it in any case.

    `each_time` is called between two questions, and waits a little; what it raises ends the test.
    """
    began = time.monotonic()
    with socket.create_connection(address, PATIENCE_S) as line:
        here = _ask(line, b"p\n")
        if not _is_position(here):
            return SelfTestResult("motion", b"p\n", here, SelfTestVerdict.WRONG, time.monotonic() - began)
        az_deg, el_deg = map(float, here.split())
        to_deg = (az_deg + WAY_DEG) % 360.0
        wish = f"P {to_deg:.2f} {el_deg:.2f}\n".encode()
        try:
            if (taken := _ask(line, wish)) != b"RPRT 0\n":
                return SelfTestResult("motion", wish, taken, SelfTestVerdict.WRONG, time.monotonic() - began)
            sent_at = time.monotonic()
            while True:
                came = _ask(line, b"p\n")
                if _is_position(came):
                    az_now, el_now = map(float, came.split())
                    off_deg = max(abs((az_now - to_deg + 180.0) % 360.0 - 180.0), abs(el_now - el_deg))
                    if off_deg < NEAR_DEG:
                        return SelfTestResult("motion", wish, came, SelfTestVerdict.GOOD, time.monotonic() - began)
                if time.monotonic() > began + ARRIVES_S:
                    return SelfTestResult("motion", wish, came, SelfTestVerdict.WRONG, time.monotonic() - began)
                if time.monotonic() > sent_at + AGAIN_S:
                    _ask(line, wish)
                    sent_at = time.monotonic()
                each_time()
        finally:
            _ask(line, b"S\n")


def _is_position(came: bytes) -> bool:
    return came.count(b"\n") == 2 and not came.startswith(b"RPRT")


def _ask(line: socket.socket, command: bytes) -> bytes:
    """Return the answer; the part that came where it is not whole in time."""
    line.sendall(command)
    line.settimeout(PATIENCE_S)
    came = b""
    try:
        while came.count(b"\n") < (2 if command == b"p\n" else 1) and not came.startswith(b"RPRT"):
            piece = line.recv(128)
            if not piece:
                break
            came += piece
    except TimeoutError:
        pass  # what came until then is judged
    return came
