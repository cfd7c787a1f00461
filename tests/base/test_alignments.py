"""Alignments with names: kept, put into force, and never out of the range that birdcage.toml allows."""

from __future__ import annotations

import pytest
from birdcage.base.alignments import (
    AlignmentSet,
    alignment_settings,
    is_in_force,
    keep_set,
    load_sets,
    remove_set,
)
from birdcage.base.config import edit, load
from birdcage.base.errors import ConfigError
from birdcage.station.settings import rules_from

ROOF = AlignmentSet("Roof", 25.0, -0.4, 0.3, 1.2, 0.7, 0.05, 7, "2026-03-20T20:30Z")
PLAIN = AlignmentSet("Plain", -10.0, 0.5)


@pytest.fixture
def path(tmp_path):
    return tmp_path / "alignments.toml"


def test_what_was_kept_is_read_again(path):
    keep_set(path, ROOF)
    assert keep_set(path, PLAIN).entries == (ROOF, PLAIN)
    assert load_sets(path).named("roof") == ROOF
    newer = AlignmentSet("roof", 26.0, -0.3)
    assert keep_set(path, newer).entries == (newer, PLAIN)
    assert remove_set(path, "ROOF").entries == (PLAIN,)
    with pytest.raises(ConfigError, match='no alignment "Roof"'):
        remove_set(path, "Roof")


def test_one_in_force_is_what_the_station_points_by(path, tmp_path):
    file = tmp_path / "birdcage.toml"
    edit(file, alignment_settings(ROOF))
    settings = load(file, {})
    assert settings.problems == ()
    assert is_in_force(ROOF, settings.alignment)
    assert not is_in_force(PLAIN, settings.alignment)
    alignment = rules_from(settings).alignment
    assert (alignment.ca_deg, alignment.an_deg, alignment.aw_deg) == (0.3, 1.2, 0.7)
    assert (alignment.az_offset_deg, alignment.el_offset_deg) == (25.0, -0.4)
    edit(file, {"alignment.az_offset_deg": 30.0})
    assert not is_in_force(ROOF, load(file, {}).alignment)  # changed since


@pytest.mark.parametrize(
    ("entry", "says"),
    [(AlignmentSet("x", 25.0, 0.0, ca_deg=11.0), "ca_deg lies from -10 to 10"),
     (AlignmentSet("x", float("nan"), 0.0), "az_offset_deg lies"), (AlignmentSet("  ", 1.0, 0.0), "a name has")],
)  # fmt: skip
def test_what_can_not_be_kept_is_said(path, entry, says):
    with pytest.raises(ConfigError, match=says):
        keep_set(path, entry)
    assert not path.exists()


@pytest.mark.parametrize(
    ("row", "says"),
    [('name = 1', "an alignment has a name"), ('name = "x"\nan_deg = 90', "an_deg lies"),
     ('name = "x"\npeaks = 1.5', "peaks is a whole number"), ('name = "x"\nca_deg = "a"', "ca_deg must be a number")],
)  # fmt: skip
def test_what_is_wrong_in_the_file_is_said(path, row, says):
    path.write_text(f"[[alignment]]\n{row}\n")
    found = load_sets(path)
    assert found.entries == ()
    assert says in found.problems[0]
    with pytest.raises(ConfigError, match="Fix that file"):
        keep_set(path, ROOF)
