"""Which class each page is. A page is loaded and composed on its first visit: nothing of it delays the first paint."""

from __future__ import annotations

from importlib import import_module

from birdcage_tui.pages.plain import PlainPage
from birdcage_tui.widgets.page import Page

MADE = {
    "setup": ("birdcage_tui.pages.setup", "SetupPage"),
    "dashboard": ("birdcage_tui.pages.dashboard", "DashboardPage"),
    "control": ("birdcage_tui.pages.control", "ControlPage"),
    "signal": ("birdcage_tui.pages.signal", "SignalPage"),
    "system": ("birdcage_tui.pages.system", "SystemPage"),
    "passes": ("birdcage_tui.pages.passes", "PassesPage"),
    "calibrate": ("birdcage_tui.pages.calibrate", "CalibratePage"),
}


def make_page(name: str) -> Page:
    """Return the page of that name, not yet mounted; an honest one where it is not built yet."""
    if name not in MADE:
        return PlainPage(name)
    module, kind = MADE[name]
    page: Page = getattr(import_module(module), kind)(id=f"page-{name}")
    return page
