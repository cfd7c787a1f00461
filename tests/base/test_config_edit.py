"""Writing single keys: what is asked for changes, everything else stays as its owner wrote it."""

from __future__ import annotations

import errno
import tomllib

import pytest
from birdcage.base.config import HorizonPoint, edit, load
from birdcage.base.errors import ConfigError

OWN = """\
# my dish, on the shed
[dish]
port = "/dev/ttyUSB3"   # the grey adapter

[weather]  # another program's
wind = [1, 2,
        3]

[feed.helix]
beam_deg = 12
"""


@pytest.fixture
def file(tmp_path):
    path = tmp_path / "folder" / "birdcage.toml"
    path.parent.mkdir()
    path.write_text(OWN)
    return path


def test_changes_a_key_and_nothing_else(file):
    edit(file, {"dish.port": "/dev/ttyUSB0"})
    assert file.read_text() == OWN.replace("ttyUSB3", "ttyUSB0")


def test_adds_keys_and_sections_and_keeps_comments(file):
    edit(
        file,
        {
            "dish.baud": 115200,
            "motion.min_elevation_deg": 20.5,
            "feed.active": "helix",
            "feed.new one.stow_allowed": False,
        },
    )
    text = file.read_text()
    for kept in ("# my dish, on the shed", "# the grey adapter", "[weather]  # another program's", "wind = [1, 2,\n"):
        assert kept in text
    settings = load(file, {})
    assert (settings.dish.port, settings.dish.baud) == ("/dev/ttyUSB3", 115200)
    assert settings.motion.min_elevation_deg == 20.5
    assert settings.feed.active == "helix"
    assert settings.feeds["helix"].beam_deg == 12
    assert settings.feeds["new one"].stow_allowed is False


def test_makes_the_file_and_its_folder(tmp_path):
    path = tmp_path / "deep" / "birdcage.toml"
    edit(path, {"place.latitude_deg": 52.0, "place.longitude_deg": 5.0})
    assert tomllib.loads(path.read_text()) == {"place": {"latitude_deg": 52.0, "longitude_deg": 5.0}}
    assert [each.name for each in path.parent.iterdir()] == ["birdcage.toml"]


def test_takes_a_key_out(file):
    edit(file, {"dish.port": None, "dish.baud": None, "motion.cable_min_deg": None})
    assert load(file, {}).dish.port is None
    assert "[motion]" not in file.read_text()


def test_what_it_already_says_is_not_written_again(file):
    before = file.stat()
    edit(file, {"dish.port": "/dev/ttyUSB3", "dish.baud": None})
    assert (file.stat().st_ino, file.stat().st_mtime_ns) == (before.st_ino, before.st_mtime_ns)


@pytest.mark.parametrize(
    "damaged", [OWN + "[dish\n", OWN.encode() + b"\xff\xfe", "[dish]\nport = \n", "a = 1\na = 2\n"]
)
def test_a_damaged_file_is_left_alone(file, damaged):
    data = damaged if isinstance(damaged, bytes) else damaged.encode()
    file.write_bytes(data)
    with pytest.raises(ConfigError, match=r"Nothing was written.*Fix that file"):
        edit(file, {"dish.port": "COM4"})
    assert file.read_bytes() == data
    assert [each.name for each in file.parent.iterdir()] == ["birdcage.toml"]


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"dish.prot": "COM4"}, "no setting dish.prot; did you mean dish.port"),
        ({"motion.min_elevation_deg": 500.0}, "more than 180 deg"),
        ({"dish.baud": "fast"}, "not a whole number"),
        ({"link.usb_identity": " "}, "is empty"),
        ({"feed.helix.colour": "red"}, "no setting feed.helix.colour"),
        ({"dish.port": "COM4", "dish.baud": 3}, "less than 50"),
    ],
)
def test_what_may_not_be_set_is_refused_as_a_whole(file, changes, words):
    with pytest.raises(ConfigError, match=words):
        edit(file, changes)
    assert file.read_text() == OWN


def test_a_value_where_a_section_belongs_is_left_alone(file):
    file.write_text("dish = 3\n")
    with pytest.raises(ConfigError, match="where a section belongs"):
        edit(file, {"dish.port": "COM4"})
    assert file.read_text() == "dish = 3\n"


def test_a_folder_that_cannot_be_written_says_so(tmp_path):
    (tmp_path / "blocked").write_text("no folder")
    with pytest.raises(ConfigError, match=r"can't be written|cannot be read"):
        edit(tmp_path / "blocked" / "birdcage.toml", {"dish.port": "COM4"})


@pytest.mark.parametrize(
    "text",
    [
        'dish.port = "a"\n',
        'dish = {port = "a"}\n',
        '[dish]\nport = "a"\n[motion]\n[feed]\nactive = "x"\n[feed.x]\n',
        '\ufeff[dish]\r\nport = "a"\r\n',
        '[feed.x]\nbeam_deg = 3.0\n[dish]\nport = "a"\n[feed]\nactive = "x"\n',
    ],
)
def test_every_way_of_writing_toml(tmp_path, text):
    path = tmp_path / "birdcage.toml"
    path.write_bytes(text.encode())
    edit(path, {"dish.port": "b", "dish.firmware": "g2", "feed.x.beam_deg": 4.0, "feed.active": "x"})
    settings = load(path, {})
    assert settings.problems == ()
    assert (settings.dish.port, settings.dish.firmware, settings.feed.active) == ("b", "g2", "x")
    assert settings.feeds["x"].beam_deg == 4.0


@pytest.mark.parametrize("call", ["os.fsync", "Path.replace"])
@pytest.mark.parametrize("end", [OSError(errno.ENOSPC, "No space left on device"), SystemExit()], ids=["full", "ended"])
def test_what_ends_in_the_middle_of_writing_leaves_the_old_file_whole(file, monkeypatch, call, end):
    seen = []

    def fail(*_):
        seen.append(file.read_text())
        raise end

    monkeypatch.setattr(f"birdcage.base.paths.{call}", fail)
    with pytest.raises((ConfigError, SystemExit)) as error:
        edit(file, {"dish.port": "/dev/ttyUSB0"})
    monkeypatch.undo()
    assert isinstance(error.value, SystemExit) or "can't be written (No space left on device)" in str(error.value)
    assert seen == [OWN]
    assert file.read_text() == OWN
    assert [each.name for each in file.parent.iterdir()] == ["birdcage.toml"]


def test_a_library_that_writes_more_than_was_asked_for_writes_nothing(file, monkeypatch):
    monkeypatch.setattr("tomlkit.dumps", lambda _document: OWN.replace("ttyUSB3", "ttyUSB0").replace("= 12", "= 13"))
    with pytest.raises(ConfigError, match="nothing was written"):
        edit(file, {"dish.port": "/dev/ttyUSB0"})
    assert file.read_text() == OWN


def test_a_link_stays_a_link(tmp_path):
    real = tmp_path / "real.toml"
    real.write_text("")
    path = tmp_path / "birdcage.toml"
    path.symlink_to(real)
    edit(path, {"dish.port": "COM4"})
    assert path.is_symlink()
    assert load(real, {}).dish.port == "COM4"


class TestSetupLines:
    def test_are_read_back(self, tmp_path):
        path = tmp_path / "birdcage.toml"
        edit(path, {"setup.link": "done 2026-03-20T12:00Z: ttyUSB0: fine", "setup.level": "skipped 2026-03-20T12:01Z"})
        setup = load(path, {}).setup
        assert setup.begun
        assert setup.kept("link") == ("done", "2026-03-20T12:00Z", "ttyUSB0: fine")
        assert setup.kept("level") == ("skipped", "2026-03-20T12:01Z", "")
        assert setup.kept("north") is None
        assert setup.kept("link").text == setup.link

    @pytest.mark.parametrize(
        ("text", "offset_s"),
        [("compared 2026-03-20T12:00Z: -2 s", -2.0), ("trusted 2026-03-20T12:00Z", 0.0), (None, None)],
    )
    def test_the_clock(self, tmp_path, text, offset_s):
        path = tmp_path / "birdcage.toml"
        edit(path, {"setup.clock": text})
        assert load(path, {}).setup.clock_offset_s == offset_s

    @pytest.mark.parametrize("line", ['link = "yes"', 'clock = "right"', 'home = "done"'])
    def test_others_are_complained_about_and_keep_no_dish_from_moving(self, tmp_path, line):
        path = tmp_path / "birdcage.toml"
        path.write_text(f"[setup]\n{line}\n")
        settings = load(path, {})
        assert "which the setup did not write" in settings.problems[0].sentence
        assert settings.motion_problem is None
        assert not settings.setup.begun


@pytest.mark.parametrize("count", [1, 12])
def test_a_horizon_is_written_and_comments_survive(tmp_path, count):
    path = tmp_path / "birdcage.toml"
    path.write_text("# mine\n[place]\nlatitude_deg = 1.0 # roof\nlongitude_deg = 2.0\n")
    horizon = [HorizonPoint(30.0 * number, 5.5) for number in range(count)]
    edit(path, {"place.horizon": horizon})
    assert load(path, {}).place.horizon == tuple(horizon)
    text = path.read_text()
    assert text.startswith("# mine\n")
    assert "# roof" in text
    assert max(map(len, text.splitlines())) < 80
    edit(path, {"place.horizon": None})
    assert load(path, {}).place.horizon == ()


def test_a_wrong_point_is_not_written(tmp_path):
    path = tmp_path / "birdcage.toml"
    with pytest.raises(ConfigError, match="belongs"):
        edit(path, {"place.horizon": [(0.0, 95.0)]})
    assert not path.exists()
