"""Places: kept with their horizons, put to use in birdcage.toml, and never lost to a damaged file."""

from __future__ import annotations

import pytest
from birdcage.base.config import HorizonPoint, edit, load
from birdcage.base.errors import ConfigError
from birdcage.base.places import (
    Place,
    add_place,
    checked_place,
    is_in_use,
    load_places,
    place_settings,
    remove_place,
    replace_place,
)

ROOF = Place("Roof", 51.9, 4.8, 12.0)
HILL = checked_place("Hill", -33.5, 151.25, 640.0, [(0.0, 5.0), (90.0, 12.5), (180.0, 3.0), (270.0, 0.0), (300, 1)])


@pytest.fixture
def path(tmp_path):
    return tmp_path / "places.toml"


def test_what_was_kept_is_read_again(path):
    add_place(path, ROOF)
    assert add_place(path, HILL).entries == (ROOF, HILL)
    assert load_places(path).named("hill").horizon[1] == HorizonPoint(90.0, 12.5)
    assert max(map(len, path.read_text().splitlines())) < 120


def test_a_new_horizon_replaces_the_old_and_leaves_the_rest(path):
    add_place(path, HILL)
    path.write_text(path.read_text().replace("latitude_deg", "# by map\nlatitude_deg"))
    replace_place(path, "Hill", checked_place("Hill", -33.5, 151.25, 640.0, [(10.0, 1.0)]))
    assert load_places(path).entries[0].horizon == ((10.0, 1.0),)
    assert "# by map" in path.read_text()
    replace_place(path, "Hill", checked_place("Hill", -33.5, 151.25, 640.0))
    assert "horizon =" not in path.read_text()


def test_removed(path):
    add_place(path, ROOF)
    add_place(path, HILL)
    assert remove_place(path, "roof").entries == (HILL,)
    with pytest.raises(ConfigError, match='no place "Roof"'):
        remove_place(path, "Roof")


@pytest.mark.parametrize(
    ("row", "says"),
    [
        ('name = "x"', "latitude_deg must be a number of degrees"),
        ('name = "x"\nlatitude_deg = 91\nlongitude_deg = 1', "latitude lies"),
        ('name = "x"\nlatitude_deg = 1\nlongitude_deg = 1\nheight_m = "low"', "height_m must be a number of metres"),
        ('name = "x"\nlatitude_deg = 1\nlongitude_deg = 1\nhorizon = [1, 2]', "a point of the horizon is"),
        ('name = "x"\nlatitude_deg = 1\nlongitude_deg = 1\nhorizon = [[1, 200]]', "a point of the horizon has"),
        ('name = "x"\nlatitude_deg = 1\nlongitude_deg = 1\nhorizon = 7', "a horizon is a list"),
    ],
)
def test_a_damaged_file_is_told_and_never_written(path, row, says):
    path.write_text(f'[[place]]\nname = "Roof"\nlatitude_deg = 1\nlongitude_deg = 2\n[[place]]\n{row}\n')
    found = load_places(path)
    assert [place.name for place in found.entries] == ["Roof"]
    assert f"{path} line 5: " in found.problems[0]
    assert says in found.problems[0]
    before = path.read_bytes()
    with pytest.raises(ConfigError, match="Nothing was written"):
        add_place(path, HILL)
    assert path.read_bytes() == before


def test_put_to_use_it_stands_in_birdcage_toml(tmp_path):
    file = tmp_path / "birdcage.toml"
    file.write_text("# mine\n[place]\nname = \"old\"\nlatitude_deg = 1.0 # old\nlongitude_deg = 2.0\n"
                    "declination_deg = 3.0\nhorizon = [[0, 1]]\n")  # fmt: skip
    edit(file, place_settings(HILL))
    place = load(file, {}).place
    assert (place.name, place.latitude_deg, place.height_m) == ("Hill", -33.5, 640.0)
    assert (place.horizon, place.declination_deg) == (HILL.horizon, None)
    assert is_in_use(HILL, place)
    assert not is_in_use(ROOF, place)
    assert file.read_text().startswith("# mine\n")
    edit(file, place_settings(ROOF))
    assert load(file, {}).place.horizon == ()
