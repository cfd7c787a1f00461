"""Which tab of the control page is seen. Craft and Network are loaded and made on their first visit."""

from __future__ import annotations

from typing import Protocol, cast

from textual.widget import Widget

from birdcage_tui.commands.control import PAGE as CONTROL
from birdcage_tui.shown.view import View
from birdcage_tui.widgets.page import Page
from birdcage_tui.widgets.tab_row import TabRow

TABS = ("manual", "presets", "craft", "network")
FOCUS = {"manual": "#rose", "presets": "#presets"}
LATER = ("craft", "network")
"""Tabs that are made on their first visit. They have commands of their own: the arrows step the dish by hand only."""


class TabView(Protocol):
    """What draws itself from a view."""

    def show(self, view: View) -> None:
        """Draw it."""


class Tabbed(Page):
    """A page with a row of tabs over it."""

    DEFAULT_CSS = """
    Tabbed TabRow { height: 1; }
    Tabbed.-tab-craft #control-top, Tabbed.-tab-craft CablePane, Tabbed.-tab-craft LastLine,
    Tabbed.-tab-network #control-top, Tabbed.-tab-network CablePane, Tabbed.-tab-network LastLine { display: none; }
    Tabbed.-tab-presets RosePane, Tabbed.-tab-presets #control-upper, Tabbed.-tab-presets CablePane,
    Tabbed.-tab-presets LogPane { display: none; }
    Tabbed.-tab-presets #control-lower { display: block; }
    Tabbed #craft, Tabbed #network { display: none; height: 1fr; }
    Tabbed.-tab-craft #craft, Tabbed.-tab-network #network { display: block; }
    """
    FIRST_FOCUS: str | None = FOCUS["manual"]
    tab = TABS[0]

    @property
    def body(self) -> Widget | None:
        """What a tab that was made later consists of; None while it is not mounted, and for the others."""
        found = self.query_one_optional(f"#{self.tab}") if self.tab in LATER else None
        return found if found is not None and found.is_mounted else None

    @property
    def part(self) -> Widget:
        """The tab that was made later, where that is seen."""
        return self.body or self

    def show_tab(self, name: str) -> None:
        """Show another tab, and give the focus to what it wants it on."""
        self.tab, self.scope = name, name if name in LATER else CONTROL
        for each in TABS:
            self.set_class(each == name, f"-tab-{each}")
        row = self.query_one(TabRow)
        row.shown = name
        row.redraw()
        if name in LATER and self.query_one_optional(f"#{name}") is None:
            self.mount(self._make(name))
        self.FIRST_FOCUS = FOCUS.get(name)
        self.screen.set_focus(None if self.FIRST_FOCUS is None else self.query_one(self.FIRST_FOCUS))
        self.call_after_refresh(self._seen)

    @staticmethod
    def _make(name: str) -> Widget:
        if name == "network":
            from birdcage_tui.control.network import NetworkPane

            return NetworkPane(id="network")
        from birdcage_tui.track.craft import CraftTab

        return CraftTab(id="craft")

    def _seen(self) -> None:
        self.on_resize()
        self.host.paint()

    def on_resize(self) -> None:
        """Choose the layout."""

    def do_on_craft(self, command: str) -> bool:
        """Carry out a command of the tab Craft; once that is mounted, if it is not. Return False for an unknown one."""
        if self.body is None:
            return self.call_after_refresh(self._do_in_body, command)
        return self._do_in_body(command)

    def _do_in_body(self, command: str) -> bool:
        from birdcage_tui.track.craft import CraftTab

        body = self.body
        return isinstance(body, CraftTab) and body.do(command)

    def do_on_network(self, command: str) -> bool:
        """Carry out a command of the tab Network; once that is mounted, if it is not."""
        from birdcage_tui.control.network import NetworkPane

        body = self.body
        if body is None:
            return self.call_after_refresh(self.do_on_network, command)
        return isinstance(body, NetworkPane) and body.do(command)

    def show_body(self, view: View) -> bool:
        """Draw the tabs, and a tab that was made later; return whether that is the one that is seen."""
        self.query_one(TabRow).show(view)
        if self.tab not in LATER:
            return False
        body = self.body
        if body is not None:
            cast(TabView, body).show(view)
        return True
