"""A table of a dish's own settings for the app around a stand-in, as if it had just been read."""

from birdcage.rotator.own_settings import SettingRow, SettingsTable
from birdcage_tui.shown.own_settings import OwnSettingsNow

ROWS = {
    20: SettingRow(20, "Disable Tracker Proc?", "TRUE", "TRUE", "FALSE"),
    38: SettingRow(38, "Sleep Mode Timer Secs", "420", "420", "420"),
    101: SettingRow(101, "Minimum Elevation Angle", "20.00", "18.00", "18.00"),
    140: SettingRow(140, "Spare 7", "0x1F", None, None),
}
TABLE = SettingsTable(("as printed",), ROWS)


def fill(app, **more):
    """Have the tab show this table, as if it had just been read; `more` as `OwnSettingsNow`."""
    feed = app.system.own_settings
    feed.now, feed._due = OwnSettingsNow(TABLE, app.session.clock.monotonic(), **more), False
