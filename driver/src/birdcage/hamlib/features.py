"""What a rotctld tells besides the position (`docs/reference/rotctl.md`, *Features*)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from birdcage.base.text import clean
from birdcage.hamlib.replies import NUMBER, CodeReply, ExtendedReply, WordReply, number
from birdcage.rotator.feature import Cost, Feature, FeatureKind, FeaturePage, Range, Value, Writer
from birdcage.rotator.feature_table import FeatureRow, FeatureTable

if TYPE_CHECKING:
    from birdcage.hamlib.rotator import HamlibRotator

INFO, STATUS, SPEED = "info", "status_flags", "speed_level"
GET_STATUS, GET_SPEED, SPEED_RANGE = "+s", "v SPEED", Range(1.0, 100.0)
NO_FLAGS = "none"
_SOMETIMES = Cost()


def _info(server: HamlibRotator) -> dict[str, Value]:
    return {INFO: clean(server.ask_if_known(WordReply("_")).lines[0]).strip()}


def _status(server: HamlibRotator) -> dict[str, Value]:
    told = server.ask_if_known(ExtendedReply(GET_STATUS)).value("Status flags")
    # Hamlib 4.5 writes them twice.
    return {} if told is None else {STATUS: " ".join(dict.fromkeys(clean(told).split())) or NO_FLAGS}


def _speed(server: HamlibRotator) -> dict[str, Value]:
    told = server.ask_if_known(WordReply(GET_SPEED)).lines[0].strip()
    return {SPEED: number(told)} if NUMBER.fullmatch(told) else {}


def _set_speed(server: HamlibRotator, value: Value) -> dict[str, Value]:
    server.ask_if_known(CodeReply(f"V SPEED {round(float(value))}"))
    return _speed(server)


FEATURES = FeatureTable(
    FeatureRow(
        Feature(
            INFO, "Name from the server", kind=FeatureKind.TEXT, cost=_SOMETIMES,
            page=FeaturePage.HARDWARE, group="Server", asked="_",
        ),
        _info,
    ),
    FeatureRow(
        Feature(
            STATUS, "Status flags", kind=FeatureKind.TEXT, cost=_SOMETIMES, page=FeaturePage.MOTORS, group="Motors",
            asked=GET_STATUS, note="Not every rotator reports them.",
        ),
        _status,
    ),
    FeatureRow(
        Feature(
            SPEED, "Speed level", "", FeatureKind.NUMBER, SPEED_RANGE, Writer.UNTIL_RESTART, cost=_SOMETIMES,
            page=FeaturePage.MOTORS, group="Motors", asked=GET_SPEED,
            note="1 is the slowest, 100 the fastest. The rotator decides how many degrees a second that is.",
        ),
        _speed, _set_speed,
    ),
)  # fmt: skip
