from __future__ import annotations

import math
import tomllib

import pytest
from birdcage.base.config import NoGoSector, Settings, load, rows


@pytest.fixture
def read(tmp_path):
    def read_text(text, environ=None, flags=None):
        path = tmp_path / "birdcage.toml"
        data = text if isinstance(text, bytes) else text.encode()
        path.write_bytes(data)
        settings = load(path, environ or {}, flags)
        assert path.read_bytes() == data
        return settings

    return read_text


def the_problem(settings):
    (problem,) = settings.problems
    return problem


def test_no_file_is_no_problem(tmp_path):
    settings = load(tmp_path / "absent.toml", {})
    assert settings == Settings()
    assert settings.problems == ()
    assert settings.motion_problem is None
    assert settings.link.delay_s == 2.0
    assert settings.dish.port is None


def test_every_section_is_read(read):
    settings = read("""
[dish]
port = "/dev/ttyUSB3"
firmware = "g2"
baud = 115200
[link]
delay_s = 3
transcript = false
usb_identity = "0403:6001:A5"
[motion]
min_elevation_deg = 20
no_go_sectors = [[170, 190, 40.5], [350, 10, 30]]
stop_releases_motors = true
[alignment]
az_offset_deg = -1.5
[place]
latitude_deg = 52.0
longitude_deg = 5.0
[feed]
active = "hline"
[feed.hline]
freq_min_hz = 1.4e9
freq_max_hz = 1.43e9
polarization = "linear"
[app]
theme = "night"
""")
    assert settings.problems == ()
    assert settings.dish.baud == 115200
    assert settings.link.delay_s == 3.0
    assert isinstance(settings.link.delay_s, float)
    assert not settings.link.transcript
    assert settings.motion.min_elevation_deg == 20.0
    assert settings.motion.no_go_sectors == (NoGoSector(170, 190, 40.5), NoGoSector(350, 10, 30))
    assert settings.alignment.az_offset_deg == -1.5
    assert settings.active_feed.freq_min_hz == 1.4e9
    assert settings.active_feed.stow_allowed is False
    assert settings.app.theme == "night"
    assert settings.sources["dish.baud"] == "file"
    assert "app.glyphs" not in settings.sources


def test_the_stock_feed_is_built_in_and_may_stow(read):
    settings = read("")
    assert settings.feed.active == "stock-ku"
    feed = settings.active_feed
    assert (feed.freq_min_hz, feed.freq_max_hz, feed.lo_hz, feed.polarization) == (12.2e9, 12.7e9, 11.25e9, "circular")
    assert feed.beam_deg is None, "its beam is the dish's"
    assert settings.active_feed.stow_allowed
    changed = read('[feed."stock-ku"]\nlo_hz = 9.75e9\n').active_feed
    assert (changed.lo_hz, changed.freq_min_hz) == (9.75e9, 12.2e9)


def test_an_unknown_key_is_refused_with_the_nearest(read):
    settings = read("[app]\ntheme = 'night'\n\n[motion]\nmin_elevaton_deg = 30\nstop_releases_motors = true\n")
    problem = the_problem(settings)
    assert problem.line == 5
    assert problem.key == "motion.min_elevaton_deg"
    assert problem.sentence == "motion.min_elevaton_deg is no setting; did you mean min_elevation_deg?"
    assert problem.text.startswith(f"{problem.file}:5: ")
    assert settings.motion.stop_releases_motors is True
    assert settings.app.theme == "night"
    assert "nothing moves" in settings.motion_problem
    assert ":5:" in settings.motion_problem


def test_an_unknown_key_elsewhere_does_not_refuse_motion(read):
    settings = read("[app]\nthem = 'night'\n")
    assert the_problem(settings).sentence == "app.them is no setting; did you mean theme?"
    assert settings.motion_problem is None


@pytest.mark.parametrize(
    ("text", "line", "sentence", "refused"),
    [
        ("[motoin]\nmin_elevation_deg = 3\n", 1, "motoin is no section; did you mean motion?", True),
        ("[aap]\ntheme = 'dusk'\n", 1, "aap is no section; did you mean app?", False),
        ("min_elevation_deg = 20\n", 1, "min_elevation_deg stands outside every section.", True),
        ("motion = 3\n", 1, "motion is a value, where a section [motion] belongs.", True),
        ("[motion]\nmin_elevation_deg = '20'\n", 2, "motion.min_elevation_deg is '20', not a number.", True),
        ("[motion]\nmin_elevation_deg = nan\n", 2, "motion.min_elevation_deg is nan, not a finite number.", True),
        ("[motion]\nmin_elevation_deg = inf\n", 2, "motion.min_elevation_deg is inf, not a finite number.", True),
        ("[motion]\nmin_elevation_deg = 200\n", 2, "motion.min_elevation_deg is 200, more than 180 deg.", True),
        ("[motion]\nstop_releases_motors = 1\n", 2, "motion.stop_releases_motors is 1, not true or false.", True),
        ("[motion]\nmin_elevation_deg = true\n", 2, "motion.min_elevation_deg is true, not a number.", True),
        ("[dish]\nbaud = 9600.5\n", 2, "dish.baud is 9600.5, not a whole number.", False),
        ("[dish]\nport = ''\n", 2, "dish.port is empty; leave the line out to leave it unset.", False),
        (
            "[app]\ntheme = 'nihgt'\n",
            2,
            "app.theme is 'nihgt', not one of daylight, dusk, night; did you mean night?",
            False,
        ),
        ("app.update_hz = 99\n", 1, "app.update_hz is 99, more than 30 Hz.", False),
        (
            "[motion]\nno_go_sectors = [\n  [1, 2],\n]\n",
            2,
            "motion.no_go_sectors has [1, 2], where three numbers [az_from, az_to, el_below] belong.",
            True,
        ),
        (
            "[motion]\nmax_elevation_deg = 30\nmin_elevation_deg = 40\n",
            3,
            "motion.min_elevation_deg is 40, which is not below max_elevation_deg (30).",
            True,
        ),
        (
            "[place]\nlatitude_deg = 50\n",
            1,
            "place.longitude_deg is missing: a place needs both latitude_deg and longitude_deg.",
            False,
        ),
        (
            "[feed]\nactive = 'stok-ku'\n",
            2,
            "feed.active is 'stok-ku', and there is no [feed.stok-ku]; did you mean stock-ku?",
            True,
        ),
        ("[feed.spare]\nbeam_dg = 3\n", 2, "feed.spare.beam_dg is no setting; did you mean beam_deg?", False),
        ("[feed.stock-ku]\nbeam_dg = 3\n", 2, "feed.stock-ku.beam_dg is no setting; did you mean beam_deg?", True),
    ],
)
def test_each_mistake_is_named_with_its_line(read, text, line, sentence, refused):
    settings = read(text)
    problem = the_problem(settings)
    assert (problem.sentence, problem.line) == (sentence, line)
    assert problem.limits_motion is refused
    assert (settings.motion_problem is not None) is refused
    assert settings.motion == Settings().motion
    assert settings.dish == Settings().dish


def test_contradicting_limits_both_go_back(read):
    settings = read("[motion]\nmax_elevation_deg = 30\nmin_elevation_deg = 40\n")
    assert settings.motion.max_elevation_deg is None
    assert settings.sources == {}


@pytest.mark.parametrize(
    ("data", "line"),
    [
        (b"[dish]\nport = 'a'\nfirmware = \n", 3),
        (b"[dish]\nport = 'a\n", 2),
        (b"[dish]\n# caf\xe9\n", 2),
        (b"[dish\n", 1),
        (b"[dish]\n[dish]\n", 2),
    ],
)
def test_a_damaged_file_keeps_the_defaults_and_refuses_motion(read, data, line):
    settings = read(data)
    problem = the_problem(settings)
    assert problem.line == line
    assert problem.limits_motion
    assert settings.dish == Settings().dish
    assert settings.motion_problem is not None
    assert settings.active_feed.stow_allowed is False


def test_a_folder_in_its_place_is_named(tmp_path):
    settings = load(tmp_path, {})
    assert "cannot be read" in the_problem(settings).sentence
    assert settings.motion_problem


def test_variables_override_the_file_and_flags_override_both(read):
    text = "[dish]\nport = '/dev/a'\nfirmware = 'hal205'\nbaud = 9600\n"
    settings = read(
        text,
        {
            "BIRDCAGE_PORT": "/dev/b",
            "BIRDCAGE_FIRMWARE": "g2",
            "BIRDCAGE_BAUD": "19200",
            "BIRDCAGE_LINK_TRANSCRIPT": "no",
        },
        {"dish.port": "/dev/c", "dish.baud": None},
    )
    assert settings.problems == ()
    assert (settings.dish.port, settings.dish.firmware, settings.dish.baud) == ("/dev/c", "g2", 19200)
    assert settings.link.transcript is False
    assert settings.sources["dish.port"] == "flag"
    assert settings.sources["dish.firmware"] == "environment"


def test_a_bad_variable_is_named_and_the_file_counts(read):
    settings = read("[dish]\nbaud = 9600\n", {"BIRDCAGE_BAUD": "fast", "BIRDCAGE_MOTION_MIN_ELEVATION_DEG": "nan"})
    assert [problem.sentence for problem in settings.problems] == [
        "BIRDCAGE_BAUD is 'fast', not a whole number.",
        "BIRDCAGE_MOTION_MIN_ELEVATION_DEG is nan, not a finite number.",
    ]
    assert settings.dish.baud == 9600
    assert settings.motion_problem


def test_a_bad_flag_is_named(read):
    settings = read("", flags={"dish.baud": 3})
    assert the_problem(settings).sentence == "dish.baud is 3, less than 50."


def test_the_schema_documents_every_key():
    table = rows()
    assert {row.section for row in table} >= {
        "dish",
        "link",
        "motion",
        "alignment",
        "place",
        "feed",
        "feed.NAME",
        "app",
    }
    assert len({row.path for row in table}) == len(table)
    assert all(row.doc.endswith(".") for row in table)
    by_path = {row.path: row for row in table}
    floor = by_path["motion.min_elevation_deg"]
    assert (floor.unit, floor.optional, floor.limits_motion, floor.kind) == ("deg", True, True, "number")
    assert by_path["feed.NAME.beam_deg"].unit == "deg"
    assert by_path["app.theme"].choices == ("daylight", "dusk", "night")
    variables = [row.env for row in table if row.env]
    assert len(set(variables)) == len(variables)
    assert {"BIRDCAGE_PORT", "BIRDCAGE_FIRMWARE", "BIRDCAGE_BAUD"} <= set(variables)


def test_defaults_pass_their_own_checks(read):
    lines = []
    for section in ("dish", "link", "motion", "alignment", "place", "app"):
        lines.append(f"[{section}]")
        for row in rows():
            if row.section == section and row.default not in (None, ()):
                value = str(row.default).lower() if isinstance(row.default, bool) else repr(row.default)
                lines.append(f"{row.key} = {value}")
    text = "\n".join(lines)
    assert tomllib.loads(text)
    settings = read(text)
    assert settings.problems == ()
    assert math.isclose(settings.app.update_hz, Settings().app.update_hz)


def test_every_key_of_every_section_is_read_and_checked(read):
    keys = [row.path.replace("feed.NAME", "feed.mine") for row in rows()]
    settings = read("".join(f"{key} = [[]]\n" for key in keys))
    assert {problem.key for problem in settings.problems} == set(keys)


class TestSectorsAndHorizon:
    """Lists of lists: what stands in the way of the dish, and the line of trees."""

    def test_a_sector_may_say_what_stands_there(self, tmp_path):
        path = tmp_path / "birdcage.toml"
        path.write_text('[motion]\nno_go_sectors = [[170, 190, 40.5, "mast"], [350, 10, 30]]\n')
        assert load(path, {}).motion.no_go_sectors == (NoGoSector(170, 190, 40.5, "mast"), NoGoSector(350, 10, 30))
        assert load(path, {}).problems == ()

    def test_a_reason_that_is_no_text_is_refused(self, tmp_path):
        path = tmp_path / "birdcage.toml"
        path.write_text("[motion]\nno_go_sectors = [[170, 190, 40.5, 7]]\n")
        assert load(path, {}).motion_problem is not None

    def test_the_horizon_is_read(self, tmp_path):
        path = tmp_path / "birdcage.toml"
        path.write_text("[place]\nlatitude_deg = 1\nlongitude_deg = 2\nhorizon = [[0, 5], [90, 10.5]]\n")
        assert load(path, {}).place.horizon == ((0.0, 5.0), (90.0, 10.5))

    @pytest.mark.parametrize("point", ["[1]", '[1, "2"]', "[1, 91]", "[400, 2]", "[1, nan]", "[true, 2]", "3"])
    def test_a_wrong_point_costs_the_horizon_and_not_the_place(self, tmp_path, point):
        path = tmp_path / "birdcage.toml"
        path.write_text(f"[place]\nlatitude_deg = 1\nlongitude_deg = 2\nhorizon = [[0, 5], {point}]\n")
        settings = load(path, {})
        assert (settings.place.latitude_deg, settings.place.horizon) == (1.0, ())
        (problem,) = settings.problems
        assert (problem.line, problem.limits_motion) == (4, False)
        assert "[az, el] belongs" in problem.sentence
