"""Refraction against figures by N cot(el) and by Bennett's formula, and without a jump anywhere."""

from __future__ import annotations

import numpy as np
import pytest
from birdcage.tracking.planning.refraction import lift_deg


@pytest.mark.parametrize(
    ("el", "optical", "radio"),
    [
        (15, 0.061, 0.068), (18, 0.050, 0.056), (22, 0.041, 0.045), (30, 0.029, 0.032), (45, 0.017, 0.018),
        (65, 0.008, 0.009),
    ],
)  # fmt: skip
def test_the_figures_of_the_reference(el, optical, radio):
    assert lift_deg(el, "radio") == pytest.approx(radio, abs=6e-4)
    assert lift_deg(el, "optical") == pytest.approx(optical, abs=1.1e-3)
    assert lift_deg(el, "none") == 0.0


@pytest.mark.parametrize("kind", ["radio", "optical"])
def test_it_is_continuous_and_never_turns_the_order_of_elevations_about(kind):
    el = np.arange(-90.0, 90.01, 0.01)
    lift = lift_deg(el, kind)
    assert np.abs(np.diff(lift)).max() < 0.004
    assert (np.diff(el + lift) > 0.0).all()
    assert (lift >= 0.0).all()
    assert 0.4 < lift_deg(0.0, kind) < 0.7
    assert lift_deg(90.0, kind) == pytest.approx(0.0, abs=1e-4)
