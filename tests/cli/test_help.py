"""What `--help` loads and says."""

from __future__ import annotations

import subprocess
import sys

import pytest
from birdcage.cli.app import COMMANDS

HEAVY = {
    "serial", "sqlite3", "platformdirs", "logging", "subprocess", "birdcage.station.station", "birdcage.link.link",
    "birdcage.base.config", "birdcage.sim.port",
}  # fmt: skip


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


@pytest.mark.parametrize("name", list(COMMANDS))
def test_every_command_tells_its_exit_codes(run, name) -> None:
    result = run(name, "--help")
    assert result.exit_code == 0
    assert "130" in result.stdout


def test_the_version_is_that_of_the_distribution(run) -> None:
    from importlib.metadata import version

    assert run("--version").stdout.strip() == f"birdcage {version('winegard-birdcage')}"


@pytest.mark.parametrize(
    ("name", "default"),
    [
        ("pos", "as set, else the port is asked"),
        ("stop", "as set, else the port is asked"),
        ("sim", "g2"),
        ("passes", "as set, else none: no limits of a dish"),
        ("sky", "as set, else none: no limits of a dish"),
    ],
)
def test_help_tells_which_firmware_counts_when_none_is_named(run, name, default) -> None:
    assert f"[default: {default}]" in " ".join(run(name, "--help").stdout.split())
