"""Reads a meter as a source does, until it tells something."""

from __future__ import annotations

import contextlib
import time

from birdcage.signal.meter import MeterError


@contextlib.contextmanager
def opened(meter):
    try:
        meter.open()
        yield meter
    finally:
        meter.close()


def end_of(meter, reads=200):
    """What it says in the end."""
    try:
        with opened(meter):
            for _ in range(reads):
                meter.read(0.2)
    except MeterError as error:
        return str(error)
    raise AssertionError("it goes on")


def level(meter, within_s=4.0):
    end = time.monotonic() + within_s
    while time.monotonic() < end:
        told = meter.read(0.2)
        if told is not None:
            return told
    raise AssertionError("no level")


def wait_until(condition, within_s=8.0):
    end = time.monotonic() + within_s
    while not condition():
        assert time.monotonic() < end
        time.sleep(0.02)
