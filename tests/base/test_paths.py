from __future__ import annotations

import errno
import os
from pathlib import Path

import pytest
from birdcage.base.paths import Paths, throw_away_paths, write_aside_and_rename


def test_the_platform_says_where(monkeypatch):
    monkeypatch.setattr("sys.platform", "linux")
    paths = Paths.default()
    assert paths.config_file == Path(os.environ["XDG_CONFIG_HOME"]) / "birdcage" / "birdcage.toml"
    assert paths.journal == Path(os.environ["XDG_STATE_HOME"]) / "birdcage" / "journal.sqlite"
    assert Path(os.environ["XDG_CACHE_HOME"]) in paths.cache.parents


def test_one_folder_for_all(tmp_path):
    paths = Paths.default({"BIRDCAGE_HOME": str(tmp_path)})
    assert paths == Paths.in_folder(tmp_path)
    everything = [paths.config_file, paths.presets_file, paths.cache, paths.logs, paths.transcripts, paths.backups]
    assert all(tmp_path in path.parents for path in [*everything, paths.state, paths.history])


def test_another_config_file(tmp_path):
    paths = Paths.default({"BIRDCAGE_HOME": str(tmp_path), "BIRDCAGE_CONFIG": "/etc/dish.toml"})
    assert paths.config_file == Path("/etc/dish.toml")
    assert paths.state == tmp_path / "state"


def test_throw_away_paths_leave_nothing():
    with throw_away_paths() as paths:
        write_aside_and_rename(paths.config_file, b"x")
        assert paths.config_file.exists()
    assert not paths.config_file.parent.exists()


def test_a_file_is_replaced_whole(tmp_path):
    path = tmp_path / "deep" / "file"
    write_aside_and_rename(path, b"one")
    path.chmod(0o640)
    write_aside_and_rename(path, b"two")
    assert path.read_bytes() == b"two"
    assert path.stat().st_mode & 0o777 == 0o640
    assert [each.name for each in path.parent.iterdir()] == ["file"]


def test_a_full_disk_keeps_the_old_file(tmp_path, monkeypatch):
    path = tmp_path / "file"
    path.write_bytes(b"old")

    def full(descriptor):
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr("birdcage.base.paths.os.fsync", full)
    with pytest.raises(OSError, match="No space"):
        write_aside_and_rename(path, b"new")
    assert path.read_bytes() == b"old"
    assert [each.name for each in tmp_path.iterdir()] == ["file"]


def test_a_symbolic_link_stays_one(tmp_path):
    (tmp_path / "real").write_bytes(b"old")
    (tmp_path / "link").symlink_to(tmp_path / "real")
    write_aside_and_rename(tmp_path / "link", b"new")
    assert (tmp_path / "link").is_symlink()
    assert (tmp_path / "real").read_bytes() == b"new"
