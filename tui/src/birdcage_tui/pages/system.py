"""F4: what the dish says of itself, what needs attention first. The tab that is seen reads, and no other."""

from __future__ import annotations

from birdcage.rotator.feature import Feature, FeatureKind, FeaturePage
from textual.app import ComposeResult
from textual.containers import Container, Horizontal, Vertical
from textual.widget import Widget

from birdcage_tui.shown.system_sheet import features_on
from birdcage_tui.shown.view import View
from birdcage_tui.system.cursor_pane import CursorPane
from birdcage_tui.system.detail_pane import DetailPane
from birdcage_tui.system.findings_pane import FindingsPane
from birdcage_tui.system.health_figures import DaysPane, LinkFiguresPane, MotorFiguresPane
from birdcage_tui.system.health_hands import HealthHands
from birdcage_tui.system.own_settings_pane import OwnSettingsPane, SettingsBox
from birdcage_tui.system.settings_hands import SettingsHands
from birdcage_tui.system.sheet_hands import SheetHands
from birdcage_tui.system.sheet_pane import SheetPane
from birdcage_tui.system.tab_row import TABS, SystemTabs
from birdcage_tui.widgets.filter_box import FilterBox
from birdcage_tui.widgets.page import Page
from birdcage_tui.widgets.pane import Pane

BESIDE = 110
"""From this width on what there is to say of a row stands beside the list, else below."""
ROOMY = 28
"""From this height on the days stand one beside the other."""
STEADY_S = 600.0
"""What its machine is asked for as seldom as this does not change: it is not watched."""
SHEETS = {"hardware": FeaturePage.HARDWARE, "motors": FeaturePage.MOTORS, "receiver": FeaturePage.RECEIVER}
TITLES = {
    "health": "Needs you", "hardware": "Hardware", "motors": "Motors and limits", "receiver": "DVB receiver",
    "settings": "NVS: the dish's own settings",
}  # fmt: skip


class SystemPage(Page):
    """A row of tabs over the one that is seen."""

    HELP = (
        "The dish from inside. h: what needs attention. b: hardware. m: motors. n: its own settings (NVS). "
        "d: its receiver. Only the tab that you see asks the dish, and only while it rests."
    )
    DEFAULT_CSS = """
    SystemPage { layout: vertical; }
    SystemPage SystemTabs { height: 1; }
    SystemPage #system-body { height: 1fr; layout: vertical; }
    SystemPage.-beside #system-body { layout: horizontal; }
    SystemPage #system-health-box { height: 1fr; width: 1fr; }
    SystemPage #system-figures { height: 8; }
    SystemPage #system-days { height: 8; display: none; }
    SystemPage.-roomy #system-days { display: block; }
    SystemPage #system-days, SystemPage #system-figures Pane { border: round $line; border-title-color: $dim;
        border-title-style: none; }
    SystemPage #system-figures Pane { height: 1fr; width: 1fr; }
    SystemPage #system-figures LinkFiguresPane { width: 1.25fr; }
    SystemPage FilterBox { height: 1fr; width: 1fr; }
    SystemPage FilterBox Input, SystemPage FilterBox Input:focus { height: 1; border: none; padding: 0 1;
        background: $panel; }
    SystemPage CursorPane { height: 1fr; width: 1fr; border: round $line; border-title-color: $dim;
        border-title-style: none; border-subtitle-color: $dim; }
    SystemPage CursorPane:focus { border: round $focus; }
    SystemPage DetailPane { height: 7; border: round $line; border-title-color: $dim; border-title-style: none; }
    SystemPage.-beside DetailPane { height: 1fr; width: 38%; }
    """
    RATE_HZ = 1.0
    FIRST_FOCUS = f"#system-{TABS[0]}"

    def __init__(self, *, id: str | None = None) -> None:  # noqa: A002
        super().__init__(id=id)
        self.tab = TABS[0]
        self._watched: frozenset[str] = frozenset()
        self._sheets, self._settings, self._health = SheetHands(self), SettingsHands(self), HealthHands(self)

    def compose(self) -> ComposeResult:
        """The tabs, their lists, and what there is to say of a row."""
        yield SystemTabs()
        with Container(id="system-body"):
            with Vertical(id="system-health-box"):
                yield FindingsPane(id="system-health")
                yield DaysPane(id="system-days")
                with Horizontal(id="system-figures"):
                    yield MotorFiguresPane(id="system-motor-figures")
                    yield LinkFiguresPane(id="system-link-figures")
            for name, page in SHEETS.items():
                yield SheetPane(page, id=f"system-{name}")
            yield SettingsBox()
            yield DetailPane(id="system-detail")

    @property
    def list(self) -> CursorPane:
        """The list of the tab that is seen."""
        return self.query_one(f"#system-{self.tab}", CursorPane)

    @property
    def part(self) -> Widget:
        """The list of the tab that is seen."""
        return self.list

    @property
    def watches(self) -> frozenset[str]:
        """What changes by itself on this tab, once it was read there."""
        return self._watches(self.host.view())

    def _watches(self, view: View) -> frozenset[str]:
        dish, page = view.state.dish, SHEETS.get(self.tab)
        if dish is None or page is None or not self.host.system.sheets.is_settled:
            return frozenset({"position"})
        changing = {
            each.id for each in features_on(dish, page) if each.id in view.state.readings and _changes(each)
        }  # fmt: skip
        return frozenset({"position", *changing})

    def show(self, view: View) -> None:
        """Have the tab that is seen read, and draw."""
        self.host.system.own_settings.notice()  # also where another tab is seen: Health goes by the table
        self.host.system.sheets.look(SHEETS.get(self.tab))
        if self.tab == "settings":
            self.host.system.own_settings.look()
        row, detail = self.query_one(SystemTabs), self.query_one(DetailPane)
        row.shown, detail.list = self.tab, self.list
        watched = self._watches(view)
        if watched != self._watched:
            self._watched = watched
            self.host.watch_page()
        if self.tab in ("health", "motors"):  # what the motors were measured at stands in the journal, too
            self.host.system.health.look()
        for part in (row, *self.query_one("#system-body").walk_children(Pane)):
            if part.region:
                part.show(view)

    def on_mount(self) -> None:
        """Name the lists, and show the first tab."""
        for name in TABS:
            self.query_one(f"#system-{name}").border_title = TITLES[name]
        self._show_parts()

    def on_resize(self) -> None:
        """Put the words beside the list where there is room."""
        self.set_class(self.size.width >= BESIDE, "-beside")
        self.set_class(self.size.height >= ROOMY, "-roomy")

    def do(self, command: str) -> bool:
        """Carry out a command of the page."""
        scope, _, name = command.partition("-")
        owner = {"settings": "settings", "health": "health"}.get(scope)
        if command in ("sheet-test", "sheet-run", "sheet-run-back"):
            owner = "motors"
        if owner not in (None, self.tab):  # chosen by its name, from another tab
            self._show_tab(str(owner))
        now = self.list
        if scope == "system" and name in TABS:
            self._show_tab(name)
        elif command == "system-read":
            feature = now.chosen(self.host.view()) if isinstance(now, SheetPane) else None
            if feature is not None and feature.read_hazard:
                self._sheets.ask_to_read(feature)
            elif isinstance(now, OwnSettingsPane):
                self.host.system.own_settings.read()
            elif isinstance(now, FindingsPane):
                self.host.system.health.read()
            else:
                self.host.system.sheets.read_again()
            self.host.paint()
        elif command == "settings-filter":
            self.query_one(FilterBox).open_filter()
        elif scope == "sheet":
            if isinstance(now, SheetPane):
                return self._sheets.do(name, now)
            self.host.say("Select a value first: b hardware, m motors, d DVB.")
        elif scope == "health" and isinstance(now, FindingsPane):
            return self._health.do(name, now)
        elif scope == "settings" and isinstance(now, OwnSettingsPane):
            return self._settings.do(name, now)
        else:
            return False
        return True

    def _show_parts(self) -> None:
        """Show what belongs to the tab."""
        body = self.query_one("#system-body")
        here = self.list
        for part in body.children:
            part.display = part is here or here in part.walk_children() or part.id == "system-detail"

    def _show_tab(self, name: str) -> None:
        self.tab = name
        self._show_parts()
        self.FIRST_FOCUS = f"#system-{name}"
        self.screen.set_focus(self.list)
        self.host.watch_page()
        self.call_after_refresh(self.host.paint)


def _changes(feature: Feature) -> bool:
    """Return whether it may change by itself while somebody looks."""
    lasting = feature.kind is FeatureKind.LINES or feature.read_hazard or not feature.is_readable
    return not lasting and 0.0 < feature.cost.min_interval_s < STEADY_S
