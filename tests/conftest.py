"""What every test runs under: a home of its own, a plain terminal, and no skips where CI is set."""

from __future__ import annotations

import gc
import itertools
import os
import signal
import sys
import threading
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest


def _keep_bytecode() -> None:
    """Compile each module once and not once a process, beside the packages: no source tree gets a file of ours."""
    if sys.prefix != sys.base_prefix:
        sys.dont_write_bytecode, sys.pycache_prefix = False, str(Path(sys.prefix) / "pycache")
        os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
        os.environ["PYTHONPYCACHEPREFIX"] = sys.pycache_prefix  # programs that tests start


_keep_bytecode()

from hypothesis import settings  # noqa: E402

sys.path.insert(0, str(Path(__file__).parent / "shared"))  # importlib mode puts no folder on the path by itself

import night  # noqa: E402

IN_CI = os.environ.get("CI", "").lower() in {"1", "true", "yes"}

settings.register_profile("local", deadline=None)
settings.register_profile("ci", deadline=None, derandomize=True, print_blob=True)
settings.load_profile("ci" if IN_CI else "local")

FOREIGN_PREFIXES = ("BIRDCAGE_", "TEXTUAL", "XDG_")
FOREIGN_NAMES = ("NO_COLOR", "FORCE_COLOR", "CLICOLOR", "CLICOLOR_FORCE", "COLUMNS", "LINES", "ESCDELAY")


def _forget_the_developer() -> None:
    """Drop settings of the person at the keyboard, before anything of ours is imported and reads them."""
    for name in list(os.environ):
        if name.startswith(FOREIGN_PREFIXES) or name in FOREIGN_NAMES:
            del os.environ[name]
    os.environ.update(TERM="xterm-256color", COLORTERM="truecolor", LC_ALL="C.UTF-8")


_forget_the_developer()


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addini("cpu_limit_s", "processor time after which a test fails", default="60")


@pytest.hookimpl(wrapper=True)
def pytest_runtest_call(item: pytest.Item) -> Iterator[None]:
    """Fail a test that computes for ever. By processor time: on a loaded machine every test takes long."""
    limit_s = float(item.config.getini("cpu_limit_s"))
    if not hasattr(signal, "setitimer") or item.get_closest_marker("soak"):
        return (yield)

    def fail(*_) -> None:
        pytest.fail(f"It has taken more than {limit_s:g} s of processor time.")

    before = signal.signal(signal.SIGPROF, fail)
    signal.setitimer(signal.ITIMER_PROF, limit_s)
    try:
        return (yield)
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        signal.signal(signal.SIGPROF, before)


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Leave to the night what `tests/by_night.txt` names."""
    night.leave_to_the_night(items)


def pytest_collectstart() -> None:
    """Collect tests without collecting garbage: there is none yet."""
    gc.disable()


def pytest_collection_finish() -> None:
    """Keep what all tests share, all of it already made, out of the garbage collector's sight."""
    gc.freeze()
    gc.set_threshold(100_000, 3, 3)  # an app is 100,000 objects: by the time it is looked at, most have gone
    gc.enable()


@pytest.fixture(scope="session")
def _homes(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Path]:
    folder = tmp_path_factory.mktemp("homes")
    return (folder / str(number) for number in itertools.count())


@pytest.fixture(autouse=True)
def _own_home(_homes: Iterator[Path]) -> Iterator[None]:
    """Give each test an empty home: it meets neither a person's files nor those of another test."""
    home = next(_homes)
    home.mkdir()
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("HOME", str(home))
        patch.setenv("XDG_CONFIG_HOME", str(home / "config"))
        patch.setenv("XDG_DATA_HOME", str(home / "data"))
        patch.setenv("XDG_STATE_HOME", str(home / "state"))
        patch.setenv("XDG_CACHE_HOME", str(home / "cache"))
        patch.setenv("XDG_RUNTIME_DIR", str(home / "run"))
        yield


AT_IMPORT = """
import os, signal, sys

class Finder:
    def find_spec(self, name, path, target=None):
        if name == {module!r}:
            sys.meta_path.remove(self)
            {deed}

sys.meta_path.insert(0, Finder())
"""


@pytest.fixture
def at_import(tmp_path: Path) -> Callable[[str, str], dict[str, str]]:
    """Make a Python that is started do something as it is about to import a module: an exact moment, without a clock.

    Returns what its environment needs.
    """

    def at_import(module: str, deed: str) -> dict[str, str]:
        (tmp_path / "sitecustomize.py").write_text(AT_IMPORT.format(module=module, deed=deed))
        return {"PYTHONPATH": str(tmp_path)}

    return at_import


@pytest.fixture
def begin_slowly(
    monkeypatch: pytest.MonkeyPatch,
) -> Callable[[Callable[[], object], Callable[[], object]], list[BaseException]]:
    """Call `start`, whose thread takes a while to begin, and `close` on another thread meanwhile.

    Returns what went wrong there.
    """

    def begin_slowly(start: Callable[[], object], close: Callable[[], object]) -> list[BaseException]:
        begins, closed, wrong = threading.Event(), threading.Event(), list[BaseException]()
        really = threading.Thread.start

        def slowly(thread: threading.Thread) -> None:
            begins.set()
            closed.wait(0.2)  # as long as `close` waits for it, as it should
            really(thread)

        def close_meanwhile() -> None:
            begins.wait(5.0)
            try:
                close()
            except RuntimeError as error:
                wrong.append(error)
            closed.set()

        other = threading.Thread(target=close_meanwhile)
        other.start()
        with monkeypatch.context() as patch:
            patch.setattr(threading.Thread, "start", slowly)
            start()
        other.join(10.0)
        return wrong

    return begin_slowly


def _refuse_skip(report: pytest.TestReport | pytest.CollectReport) -> None:
    if IN_CI and report.skipped and not hasattr(report, "wasxfail"):
        report.outcome = "failed"
        report.longrepr = f"skipped, and CI is set, where nothing may be missing: {report.longrepr}"


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(item: pytest.Item, call: pytest.CallInfo[None]) -> Iterator[None]:
    """Make a skipped test a failed one in CI."""
    report = yield
    _refuse_skip(report)
    return report


@pytest.hookimpl(wrapper=True)
def pytest_make_collect_report(collector: pytest.Collector) -> Iterator[None]:
    """Make a file that skips itself while it is collected a failed one in CI."""
    report = yield
    _refuse_skip(report)
    return report
