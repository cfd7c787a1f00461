"""`birdcage.toml`: the schema of every section as data, and reading it without ever touching it."""

from birdcage.base.config.feeds import STOCK_FEED, FeedProfile, FeedSettings
from birdcage.base.config.load import load
from birdcage.base.config.schema import Row, rows
from birdcage.base.config.sections import (
    AlignmentSettings,
    AppSettings,
    DishSettings,
    LinkSettings,
    MotionSettings,
    NoGoSector,
    PlaceSettings,
)
from birdcage.base.config.settings import Problem, Settings

__all__ = [
    "STOCK_FEED",
    "AlignmentSettings",
    "AppSettings",
    "DishSettings",
    "FeedProfile",
    "FeedSettings",
    "LinkSettings",
    "MotionSettings",
    "NoGoSector",
    "PlaceSettings",
    "Problem",
    "Row",
    "Settings",
    "load",
    "rows",
]
