"""Signals are heard on a thread of their own, and end a program whose main thread is stuck: last work first."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import threading

import pytest
from birdcage.base.signals import SignalListener, interrupt_quits

BOUND_S = 20.0


@pytest.fixture
def ends():
    """How the process would have ended, and a flag for it."""

    class Ends(list):
        came = threading.Event()

        def __call__(self, status):
            self.append(status)
            self.came.set()

    return Ends()


@pytest.fixture
def listener(ends):
    """One whose patience is at an end at once."""
    listener = SignalListener(patience_s=0.0, end=ends)
    listener.start()
    yield listener
    listener.close()


def test_what_is_heard_is_heard_beside_a_main_thread_that_waits(listener, ends):
    heard, came = [], threading.Event()

    def hear(number):
        heard.append((number, threading.current_thread() is threading.main_thread()))
        came.set()

    listener.tell(hear, lambda: None)
    listener.leave(BOUND_S)
    os.kill(os.getpid(), signal.SIGTERM)
    assert came.wait(BOUND_S)
    assert heard == [(signal.SIGTERM, False)]
    assert listener.number == signal.SIGTERM
    assert listener.status(0) == 143
    assert ends == []


def test_the_last_work_is_done_before_a_stuck_program_ends(listener, ends):
    done = []
    listener.tell(lambda _number: None, lambda: done.append(list(ends)))
    os.kill(os.getpid(), signal.SIGTERM)
    assert ends.came.wait(BOUND_S)
    assert ends == [143]
    assert done == [[]], "before the end, and once"


def test_last_work_that_never_ends_does_not_keep_it_alive(listener, ends, monkeypatch):
    monkeypatch.setattr("birdcage.base.signals.LAST_S", 0.0)
    stuck = threading.Event()
    listener.tell(lambda _number: None, stuck.wait)
    os.kill(os.getpid(), signal.SIGTERM)
    assert ends.came.wait(BOUND_S)
    stuck.set()


def test_hearing_that_never_ends_does_not_keep_it_alive(listener, ends):
    stuck = threading.Event()
    listener.tell(lambda _number: stuck.wait(BOUND_S), lambda: None)
    os.kill(os.getpid(), signal.SIGTERM)
    assert ends.came.wait(BOUND_S)
    stuck.set()


def test_a_main_thread_on_its_way_out_does_the_last_work_itself(listener, ends):
    done = []
    listener.tell(lambda _number: None, lambda: done.append(1))
    listener.leave(0.0)
    listener.take(signal.SIGHUP)
    assert ends.came.wait(BOUND_S)
    assert (ends, done) == ([129], [])


def test_before_there_is_anything_to_stop_the_main_thread_leaves_by_itself(ends):
    listener = SignalListener(end=ends)
    listener.start()
    with pytest.raises(SystemExit) as ended:
        os.kill(os.getpid(), signal.SIGTERM)
    listener.close()
    assert ended.value.code == 143
    assert ends == []


def test_a_signal_that_came_before_is_told(ends):
    listener = SignalListener(end=ends)
    heard = []
    listener.take(signal.SIGTERM)
    listener.take(signal.SIGINT)
    listener.tell(heard.append, lambda: None)
    listener.close()
    assert heard == [signal.SIGTERM]
    assert listener.status(0) == 143, "the first one counts"


def test_handlers_are_given_back_and_what_was_ignored_stays_ignored(ends):
    names = ("SIGINT", "SIGTERM", "SIGHUP", "SIGQUIT")
    before = [signal.getsignal(getattr(signal, name)) for name in names]
    hup = signal.signal(signal.SIGHUP, signal.SIG_IGN)
    try:
        listener = SignalListener(end=ends)
        listener.start()
        assert signal.getsignal(signal.SIGHUP) is signal.SIG_IGN
        listener.close()
    finally:
        signal.signal(signal.SIGHUP, hup)
    assert [signal.getsignal(getattr(signal, name)) for name in names] == before


def test_ctrl_c_in_the_middle_of_imports_quits_in_silence():
    code = (
        "import os, signal\n"
        "signal.signal(signal.SIGINT, signal.default_int_handler)\n"
        "from birdcage.base.signals import interrupt_quits\n"
        "with interrupt_quits(): os.kill(os.getpid(), signal.SIGINT)\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, timeout=60, check=False)
    assert (done.returncode, done.stdout, done.stderr) == (130, b"", b"")


def test_an_interrupt_handler_of_somebody_else_is_left_alone():
    mine = signal.signal(signal.SIGINT, lambda *_: None)
    try:
        handler = signal.getsignal(signal.SIGINT)
        with interrupt_quits():
            assert signal.getsignal(signal.SIGINT) is handler
    finally:
        signal.signal(signal.SIGINT, mine)
