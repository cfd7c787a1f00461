"""What `--help` costs and says."""

from __future__ import annotations

import resource
import subprocess
import sys
import sysconfig
from pathlib import Path

import pytest
from birdcage.cli.app import COMMANDS

SCRIPT = Path(sysconfig.get_path("scripts")) / "birdcage"
HEAVY = {
    "serial", "sqlite3", "platformdirs", "logging", "subprocess", "birdcage.station.station", "birdcage.link.link",
    "birdcage.base.config", "birdcage.sim.port",
}  # fmt: skip


def cpu_s(*command) -> float:
    """The least CPU time of five runs."""
    times = []
    for _ in range(5):
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        subprocess.run(command, stdout=subprocess.DEVNULL, check=True, timeout=60)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        times.append(after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime)
    return min(times)


@pytest.mark.parametrize("words", [[], ["move"], ["config", "show"]], ids=" ".join)
def test_help_takes_less_than_a_tenth_of_a_second_of_cpu(words) -> None:
    assert cpu_s(SCRIPT, *words, "--help") < 0.1


@pytest.mark.parametrize("words", [[], *([name] for name in COMMANDS)], ids=" ".join)
def test_help_loads_nothing_that_only_the_work_needs(words) -> None:
    code = (
        "import sys\n"
        f"sys.argv = ['birdcage', *{words!r}, '--help']\n"
        "from birdcage.cli import main\n"
        "try:\n    main()\n"
        "except SystemExit as end:\n    assert not end.code\n"
        "print('loaded:', *sys.modules)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60, check=True)
    assert sorted(HEAVY.intersection(done.stdout.rpartition("loaded:")[2].split())) == []


def test_help_of_all_names_the_commands_without_loading_them() -> None:
    code = (
        "import sys\nsys.argv = ['birdcage', '--help']\nfrom birdcage.cli import main\n"
        "try:\n    main()\nexcept SystemExit:\n    pass\n"
        "print([m for m in sys.modules if m.startswith('birdcage.cli.commands')])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60, check=True)
    assert done.stdout.splitlines()[-1] == "[]"
    for name in COMMANDS:
        assert f"\n  {name} " in done.stdout


def test_there_is_no_network_server(run) -> None:
    assert "serve" not in COMMANDS
    assert run("serve").exit_code == 2


@pytest.mark.parametrize("name", list(COMMANDS))
def test_every_command_tells_its_exit_codes(run, name) -> None:
    result = run(name, "--help")
    assert result.exit_code == 0
    assert "130" in result.stdout


def test_the_version_is_that_of_the_distribution(run) -> None:
    from importlib.metadata import version

    assert run("--version").stdout.strip() == f"birdcage {version('winegard-birdcage')}"
