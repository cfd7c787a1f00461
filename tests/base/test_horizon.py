"""The horizon as it is kept: in `birdcage.toml`, and with the saved place that is in use."""

import pytest
from birdcage.base.config import load
from birdcage.base.errors import ConfigError
from birdcage.base.paths import throw_away_paths
from birdcage.base.places import Place, add_place, keep_horizon, load_places

POINTS = ((10.12345, 4.0), (231.0, 12.3))
TEXT = '# mine\n[place]\nname = "Field"\nlatitude_deg = 52.0\nlongitude_deg = 6.5\n'


@pytest.fixture
def paths():
    with throw_away_paths() as found:
        found.config_file.parent.mkdir(parents=True, exist_ok=True)
        found.config_file.write_text(TEXT)
        yield found


def place_of(paths):
    return load(paths.config_file, environ={}).place


def test_points_go_into_the_file_and_the_rest_stays(paths):
    assert keep_horizon(paths, place_of(paths), POINTS) == ""
    assert place_of(paths).horizon == ((10.123, 4.0), (231.0, 12.3))
    assert paths.config_file.read_text().startswith(TEXT)
    keep_horizon(paths, place_of(paths), ())
    assert "horizon" not in paths.config_file.read_text()


def test_the_saved_place_that_is_in_use_has_them_too(paths):
    add_place(paths.places_file, Place("Field", 52.0, 6.5))
    add_place(paths.places_file, Place("Roof", 52.1, 6.5))
    assert keep_horizon(paths, place_of(paths), POINTS) == "Field"
    field, roof = load_places(paths.places_file).entries
    assert field.horizon == ((10.123, 4.0), (231.0, 12.3))
    assert roof.horizon == ()


def test_a_damaged_file_is_not_written(paths):
    paths.config_file.write_text("[place\n")
    with pytest.raises(ConfigError, match="Nothing was written"):
        keep_horizon(paths, place_of(paths), POINTS)
    assert paths.config_file.read_text() == "[place\n"
