"""`birdcage sync` at a rotator on a pty, one command after the other; each is a program of its own."""

from __future__ import annotations

import pytest
from installed_toys import installed

pytest.importorskip("termios", reason="a pseudo terminal is needed")


@pytest.fixture(scope="module")
def twins(tmp_path_factory):
    with installed(tmp_path_factory.mktemp("toys")):
        from birdcage_toys import starter_twin

        yield starter_twin


@pytest.fixture
def starter(twins):
    dish = twins.StarterOnPty()
    yield dish
    dish.close()


@pytest.fixture
def at(run, starter):
    return lambda *words: run(*words, port=starter.path, firmware="starter")


def test_what_was_told_holds_for_the_commands_that_follow(at, starter, as_json) -> None:
    unknown = at("pos")
    assert unknown.exit_code != 0
    assert "Sync it: `birdcage sync AZ EL` says where it points." in unknown.stderr
    assert at("move", "--az", 210, "--el", 30).exit_code != 0
    told = at("sync", 200, 30)
    assert (told.exit_code, told.stdout) == (0, "AZ: 200.0\nEL: 30.0\n"), told.stderr
    assert at("pos").stdout == "AZ: 200.0\nEL: 30.0\n"
    moved = at("move", "--az", 215, "--el", 30)
    assert moved.exit_code == 0, moved.stderr
    assert starter.twin.points_az_deg == pytest.approx(215.0)
    assert as_json(at("pos", "--json"))["azimuth_deg"] == pytest.approx(215.0)


def test_what_it_believes_otherwise_takes_a_yes(at) -> None:
    assert at("sync", 200).exit_code == 0
    asked = at("sync", 100, 30)
    assert asked.exit_code == 2
    assert "It is already synced: azimuth 200.00°, elevation 30.00°." in asked.stderr
    assert at("pos").stdout.startswith("AZ: 200.0")
    assert at("sync", 100, 30, "--yes").stdout.startswith("AZ: 100.0")


@pytest.mark.parametrize("words", [(400, 30), (-5, 30), (10, 95)])
def test_what_is_no_direction_is_not_told(at, words) -> None:
    said = at("sync", *words)
    assert said.exit_code != 0
    assert "Nothing was changed." in said.stderr
    assert at("pos").exit_code != 0


def test_init_says_that_a_person_has_to_tell_it(at) -> None:
    said = at("init")
    assert "not homed" not in said.stderr
    assert "It counts from where it was switched on. Sync it: `birdcage sync AZ EL`" in said.stderr


def test_home_says_what_to_do_instead(at) -> None:
    said = at("home", "--yes")
    assert said.exit_code != 0
    assert (
        "The Starter has no homing. It counts from where it was switched on. Sync it: `birdcage sync AZ EL`"
        in said.stderr
    )


def test_a_dish_that_knows_by_itself_says_so(run) -> None:
    said = run("sync", 180, 45)
    assert said.exit_code != 0
    assert "The Carryout G2 knows by itself where it points. Nothing was changed." in said.stderr
