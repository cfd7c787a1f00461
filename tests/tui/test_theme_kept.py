"""The theme that a person picks is there again at the next start; a demo keeps it in its own folder."""

from __future__ import annotations

from contextlib import ExitStack

from birdcage.base.config import load
from birdcage.base.errors import ConfigError
from birdcage.base.paths import Paths
from birdcage_tui.main import parser
from birdcage_tui.run import _app_settings, _paths
from stage import run
from stand_in import text_of


def pick(keep):
    async def body(app, pilot):
        await pilot.press("T")
        await pilot.pause()
        return app.theme, text_of(app)

    return run(body, keep_theme=keep)


def test_a_picked_theme_is_there_at_the_next_start(tmp_path):
    paths = Paths.in_folder(tmp_path)
    paths.config_file.parent.mkdir(parents=True, exist_ok=True)
    paths.config_file.write_text("# mine\n[motion]\nmin_elevation_deg = 20.0\n")
    settings = _app_settings(load(paths.config_file, environ={}), paths, demo=False)
    assert pick(settings.keep_theme)[0] == "daylight"
    assert _app_settings(load(paths.config_file, environ={}), paths, demo=False).theme == "daylight"
    assert "# mine\n[motion]\nmin_elevation_deg = 20.0\n" in paths.config_file.read_text()


def test_a_theme_that_cannot_be_kept_says_so_and_is_shown():
    def keep(_):
        raise ConfigError("birdcage.toml can't be written.")

    theme, text = pick(keep)
    assert theme == "daylight"
    assert "The theme was not saved. birdcage.toml can't be written." in text


def test_a_demo_keeps_it_in_its_own_folder():
    with ExitStack() as stack:
        paths = _paths(parser().parse_args(["--demo"]), stack)
        _app_settings(load(paths.config_file, environ={}), paths, demo=True).keep_theme("night")
        assert 'theme = "night"' in paths.config_file.read_text()
        kept = paths.config_file
    assert not kept.exists()
    assert kept != Paths.default().config_file
