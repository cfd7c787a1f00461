"""What sources tell of the rows of a G2's settings (docs/reference/g2-settings.md)."""

from __future__ import annotations

from collections.abc import Mapping

from birdcage.protocol.nvs import MAX_ELEVATION, MIN_ELEVATION
from birdcage.rotator.feature import FeatureKind, Range
from birdcage.rotator.own_settings import SettingKnown

_LOG = "A wrong log or debug port can take the console away, and no command brings it back then."
_SEARCH = "It shapes the TV search, which pointing does not use."
_SPEED = "A motor that is told to go faster than it can loses steps or stalls, and every angle is wrong then."
_STEPS = "A wrong number makes every angle wrong: the dish may run into its end stops, and not find its reference."
_LIMIT = "Beyond the factory's 18 to 65° the dish may run into its end stops, or a feed may hit."
_GAIN = "Wrong gains make a motor swing or stall. Which of 128 to 133 is which gain is not documented."
_DIP = "It replaces the DIP switches, which choose the satellites of the TV search."
_ANGLE = Range(0.0, 90.0)

_ROWS = (
    *(SettingKnown(index, danger=_LOG) for index in range(5)),
    *(SettingKnown(index, note=_SEARCH) for index in (21, 22, 23, 24, 25, 26, 28, 32, 33, 36, 37)),
    SettingKnown(
        20, kind=FeatureKind.SWITCH,
        danger="TRUE switches the TV search off, and homing at power-up with it: home the dish by command then. FALSE "
        "lets it home and search by itself at every power-up.",
    ),
    SettingKnown(27, "rpm", note=_SEARCH),
    SettingKnown(38, "s", danger="What the console does when the dish sleeps is unknown: a long pause may end a map."),
    SettingKnown(41, "deg/s", note=_SEARCH),
    SettingKnown(80, "deg/s", danger=_SPEED),
    SettingKnown(81, "deg/s²", danger=_SPEED),
    SettingKnown(83, "steps/turn", danger=_STEPS),
    SettingKnown(85, "deg/s", danger=_SPEED),
    SettingKnown(88, "steps/turn", danger=_STEPS),
    SettingKnown(
        MIN_ELEVATION, "deg", range=_ANGLE, danger=_LIMIT,
        note="The mechanics end at about 20°.",
    ),
    SettingKnown(
        MAX_ELEVATION, "deg", range=_ANGLE, danger=_LIMIT, note="90° is reached only by cutting the base.",
    ),
    SettingKnown(
        103, "deg", range=_ANGLE,
        danger="The angle that the dish takes its reference for: a wrong one makes every elevation wrong.",
    ),
    SettingKnown(112, kind=FeatureKind.SWITCH, danger=_DIP),
    SettingKnown(113, danger=_DIP, note="The dish goes by it only with row 112 TRUE."),
    *(SettingKnown(index, danger=_GAIN) for index in range(128, 134)),
)  # fmt: skip
KNOWN: Mapping[int, SettingKnown] = {each.index: each for each in sorted(_ROWS, key=lambda each: each.index)}
