"""Whatever of the alignment is not zero is shown: a tilt as well as an offset."""

from functools import partial

import stage
from birdcage.antenna.alignment import Alignment
from stage import read

LEANS = {"alignment": Alignment(0.0, 0.0, 0.1, 0.3, -0.4)}

run = partial(stage.run, read, state=LEANS)


def test_the_dashboard_and_the_status_line_name_the_tilt():
    text = run(size=(160, 48), key="f1")
    assert "offset +0.00 +0.00 tilt" in text
    assert text.count("tilt 0.50° to 53°") >= 1


def test_digits_that_are_not_the_dishs_own_say_so():
    assert "azimuth true" in run(size=(120, 36), key="f2")
    assert "azimuth true" not in stage.run(read, size=(120, 36), key="f2")
