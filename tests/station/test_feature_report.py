"""Errors as another program gets them: of the same kind, with the numbers and values that they carry."""

from __future__ import annotations

import json

import pytest
from birdcage.base.errors import BelowFloor, CommandRefused, MotionRefused, NoReply
from birdcage.base.reason import Reason
from birdcage.base.trouble import MotorTrouble
from birdcage.station.feature_report import error_of, error_values

TROUBLE = MotorTrouble("azimuth", homing=True, said="ERR 3")


@pytest.mark.parametrize("error", [
    BelowFloor("Elevation 10.00\u00b0 is below.", limit_deg=18.0, by_deg=8.0),
    MotionRefused("No number applies.", reason=Reason.UNHOMED),
    CommandRefused("It said no.", trouble=TROUBLE),
    CommandRefused("It said no."),
    NoReply("Nothing came."),
])  # fmt: skip
def test_an_error_comes_as_it_went(error):
    came = error_of(json.loads(json.dumps(error_values(error))))
    assert type(came) is type(error)
    assert (str(came), came.reason) == (str(error), error.reason)
    assert vars(came) | {"reason": came.reason} == vars(error) | {"reason": error.reason}


@pytest.mark.parametrize(("field", "told"), [
    ("limit_deg", "18"), ("by_deg", True), ("limit_deg", [1.0]), ("trouble", "stall"), ("trouble", {"axis": 1}),
])  # fmt: skip
def test_what_has_another_form_is_left_out(field, told):
    kind = "CommandRefused" if field == "trouble" else "MotionRefused"
    came = error_of({"kind": kind, "reason": "limit", "sentence": "So.", field: told})
    assert getattr(came, field) is None
