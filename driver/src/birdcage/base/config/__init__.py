"""`birdcage.toml`: the schema of every section as data, reading it, and writing single keys of it."""

from birdcage.base.config.edit import edit
from birdcage.base.config.feeds import STOCK_FEED, FeedProfile, FeedSettings, feed_label
from birdcage.base.config.load import load
from birdcage.base.config.network_sections import RotctldSettings
from birdcage.base.config.progress import KeptStep, SetupSettings
from birdcage.base.config.schema import KeyRow, rows
from birdcage.base.config.sections import (
    AlignmentSettings,
    AppSettings,
    DishSettings,
    HorizonPoint,
    LinkSettings,
    MotionSettings,
    PlaceSettings,
)
from birdcage.base.config.settings import Problem, Settings
from birdcage.base.config.sky_sections import ElementsSettings
from birdcage.base.config.tracking_sections import AutotrackSettings, HookSettings, RadioSettings, TrackingSettings
from birdcage.base.no_go import NoGoSector

__all__ = [
    "STOCK_FEED",
    "AlignmentSettings",
    "AppSettings",
    "AutotrackSettings",
    "DishSettings",
    "ElementsSettings",
    "FeedProfile",
    "FeedSettings",
    "HookSettings",
    "HorizonPoint",
    "KeptStep",
    "KeyRow",
    "LinkSettings",
    "MotionSettings",
    "NoGoSector",
    "PlaceSettings",
    "Problem",
    "RadioSettings",
    "RotctldSettings",
    "Settings",
    "SetupSettings",
    "TrackingSettings",
    "edit",
    "feed_label",
    "load",
    "rows",
]
