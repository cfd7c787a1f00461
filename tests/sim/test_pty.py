"""A pseudo terminal that is served outlives its clients, and what they leave."""

from __future__ import annotations

import fcntl
import os
import termios

from birdcage.sim.pty import PtyChannel


def test_what_a_killed_client_left_locked_is_freed():
    channel = PtyChannel()
    channel.open()
    assert channel.attend() is False
    client = os.open(channel.path, os.O_RDWR | os.O_NOCTTY)
    fcntl.flock(client, fcntl.LOCK_EX)
    fcntl.ioctl(client, termios.TIOCEXCL)
    assert channel.attend() is True, "it is in use: ask again soon"
    assert channel._is_exclusive()
    os.close(client)  # and no TIOCNXCL, as after kill -9
    assert channel._is_exclusive()
    assert channel.attend() is False
    assert not channel._is_exclusive()
    again = os.open(channel.path, os.O_RDWR | os.O_NOCTTY)
    fcntl.flock(again, fcntl.LOCK_EX | fcntl.LOCK_NB)
    os.close(again)
    channel.close()
    assert channel.attend() is False
