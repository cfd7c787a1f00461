"""Global options: before and after the command; flag over variable over file over default."""

from __future__ import annotations

import json
import re
from pathlib import Path

import click
import pytest
from birdcage.cli.app import cli
from birdcage.station.known import list_firmwares


def seen(as_json, result) -> tuple[object, object, object]:
    values = as_json(result)
    return tuple(values[f"dish.{key}"]["value"] for key in ("port", "firmware", "baud"))


@pytest.mark.parametrize("words", [
    ("--port", "a", "--firmware", "g2", "--baud", 9600, "--json", "config", "show"),
    ("config", "show", "--port", "a", "--firmware", "g2", "--baud", 9600, "--json"),
    ("--port", "other", "--json", "config", "show", "--port", "a", "--firmware", "g2", "--baud", 9600),
])  # fmt: skip
def test_before_and_after_the_command(run, as_json, words) -> None:
    assert seen(as_json, run(*words, port="variable", firmware="hal000")) == ("a", "g2", 9600)


def test_flag_over_variable_over_file(run, as_json, tmp_path) -> None:
    file = tmp_path / "birdcage.toml"
    file.write_text('[dish]\nport = "file"\nfirmware = "hal000"\nbaud = 1\n'.replace("= 1\n", "= 2400\n"))
    result = run("--config", file, "config", "show", "--json", "--port", "flag")
    assert seen(as_json, result) == ("flag", "g2", 2400)
    assert [as_json(result)[f"dish.{key}"]["source"] for key in ("port", "firmware", "baud")] == [
        "flag", "environment", "file",
    ]  # fmt: skip


def test_the_beam_of_each_feed_is_shown_with_where_it_comes_from(run, as_json, tmp_path) -> None:
    file = tmp_path / "birdcage.toml"
    file.write_text("[feed.helix]\nfreq_min_hz = 1.67e9\nfreq_max_hz = 1.71e9\n[feed.old]\nbeam_deg = 6.3\n")

    def shown(firmware):
        lines = run("--config", file, "config", "show", firmware=firmware).stdout.splitlines()
        return {line.split()[0]: " ".join(line.split()[1:]) for line in lines if line.split()[0].endswith(".beam")}

    assert shown("hal205") == {
        "feed.stock-ku.beam": "2.0° x 2.9° from reflector and frequency",
        "feed.helix.beam": "14.8° x 21.3° from reflector and frequency",
        "feed.old.beam": "6.3° x 6.3° entered by hand",
    }
    assert shown("g2")["feed.stock-ku.beam"].endswith("; 6.4° x 6.3° measured in counts: upper bound")
    assert shown("")["feed.stock-ku.beam"].startswith("- (needs dish.firmware")
    value = as_json(run("--config", file, "config", "show", "--json", firmware="hal205"))["feed.old.beam"]["value"]
    assert (value["az_deg"], value["el_deg"], value["origin"]) == (6.3, 6.3, "entered")


def test_the_default_port_is_that_of_the_document_and_no_firmware_is_claimed(run) -> None:
    result = run("status", "--json", port="", firmware="")
    assert result.exit_code == 3
    assert json.loads(result.stdout)["firmware"] is None
    assert "/dev/ttyUSB0" in result.stderr


def test_a_firmware_that_is_not_spoken_is_one_sentence(run) -> None:
    result = run("pos", firmware="nosuch")
    assert result.exit_code == 2
    assert result.stderr == (
        f"This version does not speak nosuch. It speaks {', '.join(list_firmwares())}. "
        "Without --firmware, BIRDCAGE_FIRMWARE and dish.firmware the port is asked.\n"
    )


def test_a_damaged_file_is_named_with_its_line_and_refuses_motion_only(run, tmp_path) -> None:
    file = tmp_path / "birdcage.toml"
    text = "[motion]\nmin_elevaton_deg = 30\n"
    file.write_text(text)
    shown = run("--config", file, "pos")
    assert shown.exit_code == 0
    assert f"{file}:2: motion.min_elevaton_deg" in shown.stderr
    moved = run("--config", file, "move", "--az", 10, "--el", 40)
    assert moved.exit_code == 4
    assert "nothing moves" in moved.stderr
    checked = run("config", "check", "--config", file)
    assert (checked.exit_code, file.read_text()) == (2, text)


def test_a_config_that_is_not_there_is_refused(run, tmp_path) -> None:
    result = run("--config", tmp_path / "no.toml", "pos")
    assert result.exit_code == 2
    assert "no.toml (--config) is not a file" in result.stderr


def test_check_of_no_file_is_in_order(run) -> None:
    assert run("config", "check").exit_code == 0


def test_paths_lie_in_the_home(run, as_json) -> None:
    places = as_json(run("paths", "--json"))
    assert set(places) >= {"config", "state", "transcripts", "backups", "logs", "cache"}
    assert all(Path(place).is_relative_to(Path.home()) for place in places.values())
    assert run("config", "path").stdout.strip() == places["config"]


def test_ports_as_json_is_a_list(run, as_json) -> None:
    assert isinstance(as_json(run("ports", "--json")), list)


def commands_with(option: str) -> list[tuple[str, click.Option]]:
    """Return every option of a name, with its command."""
    found, waiting = [], [("birdcage", cli)]
    for name, command in waiting:
        found += [(name, each) for each in command.params if isinstance(each, click.Option) and option in each.opts]
        if isinstance(command, click.Group):
            context = click.Context(command)
            waiting += [
                (f"{name} {each}", sub)
                for each in command.list_commands(context)
                if (sub := command.get_command(context, each)) is not None
            ]
    return found


def test_the_time_to_look_at_has_one_name() -> None:
    assert len(commands_with("--at")) == 6
    # A map begins at its `--start`: that is no time to look at.
    assert [name for name, each in commands_with("--start") if not each.hidden] == ["birdcage scan"]
    assert {each.type.name for _name, each in commands_with("--at")} == {"TIME"}


def test_a_frequency_has_one_unit() -> None:
    options = [each for name in ("--freq", "--rf", "--if", "--lo") for each in commands_with(name)]
    assert len(options) == 5
    assert {(each.type.name, each.type.convert("137.1", each, None)) for _name, each in options} == {("FREQ", 137.1e6)}
    assert all("a bare number is in MHz" in (each.help or "") for _name, each in commands_with("--freq"))


def test_the_old_name_of_the_time_goes_on_to_work(run, as_json) -> None:
    words = ("passes", "iss", "--lat", 51.5, "--lon", 0, "--hours", 24, "--json")
    at, start = (as_json(run(*words, option, "2026-11-21")) for option in ("--at", "--start"))
    assert at == start


def test_help_names_no_firmware_that_does_not_exist() -> None:
    told = " ".join(each.help or "" for _name, each in commands_with("--firmware"))
    assert set(re.findall(r"\b(?:g\d\w*|hal\d+|trav\w*)\b", told)) <= set(list_firmwares())
