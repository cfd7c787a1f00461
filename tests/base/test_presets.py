"""Presets: kept as they were, whatever the file holds; a damaged file is shown and never written."""

import contextlib
from dataclasses import replace

import pytest
from birdcage.base.errors import ConfigError
from birdcage.base.presets import Preset, add_preset, checked, delete_preset, load_presets, replace_preset

WALL = Preset("Wall", 10.0, 20.5, "never below 20")
ASTRA = Preset("Astra 28.2E", 151.3, 27.2)
PARK = Preset("Park ☾", 0.0, 60.0)


@pytest.fixture
def path(tmp_path):
    return tmp_path / "deeper" / "presets.toml"


def filled(path):
    for preset in (WALL, ASTRA, PARK):
        add_preset(path, preset)
    return path


def test_what_was_kept_is_read_again(path):
    assert load_presets(filled(path)).entries == (WALL, ASTRA, PARK)
    assert load_presets(path).problems == ()
    assert "[[preset]]" in path.read_text()


def test_no_file_is_an_empty_list(path):
    assert load_presets(path).entries == ()
    assert load_presets(path).problems == ()


def test_a_deleted_one_comes_back_where_it_was(path):
    filled(path)
    assert delete_preset(path, "Astra 28.2E").entries == (WALL, PARK)
    assert add_preset(path, ASTRA, 1).entries == (WALL, ASTRA, PARK)


def test_the_file_does_not_grow_by_changes_that_are_undone(path):
    filled(path)
    before = path.read_text()
    for _ in range(3):
        delete_preset(path, "Astra 28.2E")
        add_preset(path, ASTRA, 1)
    assert path.read_text() == before
    assert "\n\n\n" not in before


def test_the_last_one_may_go_too(path):
    add_preset(path, WALL)
    assert delete_preset(path, "wall").entries == ()
    assert add_preset(path, PARK).entries == (PARK,)


def test_one_is_changed_in_its_place_and_may_be_renamed(path):
    filled(path)
    new = Preset("Astra 19.2E", 160.0, 30.0, "moved")
    assert replace_preset(path, "Astra 28.2E", new).entries == (WALL, new, PARK)


def test_what_others_wrote_stays(path):
    filled(path)
    text = path.read_text().replace('name = "Park', '# mine\ncolour = 7\nname = "Park')
    path.write_text("# on top\n" + text)
    delete_preset(path, "Wall")
    replace_preset(path, "Park ☾", Preset("Park ☾", 1.0, 61.0))
    after = path.read_text()
    for kept in ("# on top", "# mine", "colour = 7"):
        assert kept in after


@pytest.mark.parametrize("name", ["Wall", "wall", "  WALL "])
def test_names_are_unique_whatever_their_capitals(path, name):
    filled(path)
    before = path.read_bytes()
    with pytest.raises(ConfigError, match="already"):
        add_preset(path, Preset(name, 1.0, 2.0))
    with pytest.raises(ConfigError, match="already"):
        replace_preset(path, "Astra 28.2E", Preset(name, 1.0, 2.0))
    assert path.read_bytes() == before


def test_one_that_is_gone_cannot_be_changed(path):
    filled(path)
    with pytest.raises(ConfigError, match='no preset "Roof"'):
        delete_preset(path, "Roof")


DAMAGE = [
    (b"[[preset]\nname = 'x'", "not valid TOML"),
    (b"\xff\xfe\x00", "not UTF-8"),
    (b"[[preset]]\nname = 'x'\naz_deg = 'north'\nel_deg = 1", "line 1: az_deg must be a number"),
    (b"[[preset]]\nname = 'x'\naz_deg = true\nel_deg = 1", "az_deg must be a number"),
    (b"[[preset]]\nname = 'x'\naz_deg = nan\nel_deg = 1", "azimuth lies from"),
    (b"[[preset]]\nname = 'x'\naz_deg = 1\nel_deg = inf", "elevation lies from"),
    (b"[[preset]]\nname = 'x'\naz_deg = 1" + b"0" * 400 + b"\nel_deg = 1", "no number of degrees"),
    (b"[[preset]]\naz_deg = 1\nel_deg = 1", "has a name"),
    (b"[[preset]]\nname = ''\naz_deg = 1\nel_deg = 1", "1 to 40 characters"),
    (b'[[preset]]\nname = "\\u0007"\naz_deg = 1\nel_deg = 1', "can be seen"),
    (b"preset = 3", "must be tables"),
    (b"preset = [1, 2]", "a preset is a table"),
    (b"[preset]\nname = 'x'", "must be tables"),
    (b"a = " + b"[" * 100_000, "not valid TOML"),
    (b"a = 1" + b"0" * 5_000, "not valid TOML"),
    (b"#" * 1_000_001, "larger than"),
]


@pytest.mark.parametrize(("content", "says"), DAMAGE, ids=range(len(DAMAGE)))
def test_a_damaged_file_is_told_and_never_written(tmp_path, content, says):
    path = tmp_path / "presets.toml"
    path.write_bytes(content)
    found = load_presets(path)
    assert says in found.problems[0]
    assert str(path) in found.problems[0]
    for change in (lambda: add_preset(path, WALL), lambda: delete_preset(path, "x")):
        with pytest.raises(ConfigError, match="Nothing was written"):
            change()
    assert path.read_bytes() == content


def test_the_good_entries_of_a_damaged_file_are_shown(path):
    filled(path)
    path.write_text(path.read_text().replace("az_deg = 151.3", 'az_deg = "east"'))
    found = load_presets(path)
    assert found.entries == (WALL, PARK)
    assert "line 9: az_deg must be a number" in found.problems[0]


def test_twice_the_same_name_is_told(path):
    filled(path)
    path.write_text(path.read_text().replace("Astra 28.2E", "wall"))
    assert load_presets(path).entries == (WALL, PARK)
    assert 'there is a preset "wall" before it' in load_presets(path).problems[0]


def test_a_folder_in_its_place_is_told(tmp_path):
    assert "can't be read" in load_presets(tmp_path).problems[0]


def test_what_another_program_has_added_meanwhile_stays(path):
    filled(path)
    known = load_presets(path)
    add_preset(path, Preset("Roof", 3.0, 33.0))
    assert len(known.entries) == 3
    assert [p.name for p in delete_preset(path, "Wall").entries] == ["Astra 28.2E", "Park ☾", "Roof"]


def test_a_list_written_in_one_line_is_kept_or_refused_but_never_broken(tmp_path):
    path = tmp_path / "presets.toml"
    path.write_text('preset = [{name = "One", az_deg = 1, el_deg = 20}]\n')
    with contextlib.suppress(ConfigError):
        add_preset(path, WALL)
    assert Preset("One", 1.0, 20.0) in load_presets(path).entries


def test_angles_and_spaces_are_put_in_order():
    assert checked("  two   words ", -10.0, 45.0) == Preset("two words", 350.0, 45.0)
    with pytest.raises(ValueError, match="1 to 40"):
        checked("x" * 41, 1.0, 2.0)


def test_control_characters_of_a_name_are_lost_as_it_comes_in(tmp_path):
    path = tmp_path / "presets.toml"
    path.write_text('[[preset]]\nname = "a\\u001B[2J"\naz_deg = 1\nel_deg = 1\nnote = "\\u202Eb"\n')
    (preset,) = load_presets(path).entries
    assert (preset.name, preset.note) == ("a[2J", "b")
    assert add_preset(path, replace(preset, name="other")).problems == ()


def test_a_library_that_writes_another_number_writes_nothing(path, monkeypatch):
    import tomlkit

    before, dumps = filled(path).read_text(), tomlkit.dumps
    monkeypatch.setattr("tomlkit.dumps", lambda document: dumps(document).replace("151.3", "15.3"))
    with pytest.raises(ConfigError, match="Nothing was written"):
        add_preset(path, Preset("Tower", 20.0, 30.0))
    assert path.read_text() == before
