"""Every place in which a person may be when the dish has to stop: how to get there, and what takes keys there."""

from __future__ import annotations

import asyncio
import sys
from dataclasses import dataclass, field, replace

import calibrate_stand_in
import health_stand_in
import horizon_stand_in
import lessons_stand_in
import map_stand_in
import settings_stand_in
import setup_stand_in
import sky_stand_in
import stand_in
import track_stand_in
from birdcage.base.errors import ConfirmationNeeded
from birdcage.base.presets import Preset, add_preset
from birdcage.easycomm.facts import RP2040_FACTS
from birdcage.protocol.g2.model import CARRYOUT_G2
from birdcage.protocol.hal.model import TRAVLER
from birdcage.rotator.facts import Facts
from birdcage.rotator.feature import FeaturePage
from birdcage.skymap.map_file import read_map
from birdcage.station.requests import Sync
from birdcage_tui.commands import PAGES
from birdcage_tui.shell.birdcage_app import BirdcageApp
from birdcage_tui.shown.map_book import MapRead
from birdcage_tui.shown.system_sheet import FeatureChange, sheet_rows

from tests.signal.test_recording import recorded, row

KEYS = {" ": "space", "?": "question_mark", ":": "colon", ";": "semicolon", "/": "slash"}
LINE = [KEYS.get(letter, letter) for letter in "a 0 200"]


@dataclass(frozen=True)
class Place:
    """The keys that lead there, what can have the focus there (`Owner/Kind`), and who put the dialog there, if any."""

    name: str
    keys: tuple[str, ...]
    holds: frozenset[str] = frozenset()
    dialog: str = ""
    asked_by: str = ""
    size: tuple[int, int] = (80, 24)
    engine: str = "home"
    state: dict[str, object] = field(default_factory=dict)
    track: str = "craft-idle"
    calibrate: str = "five"


def _page(name: str, *keys: str, holds: str = "", **more: object) -> Place:
    return Place(name, keys, frozenset(holds.split()), **more)


def _dialog(name: str, asked_by: str, *keys: str, dialog: str = "QuestionScreen",
            holds: str = "QuestionScreen/VerticalScroll", **more: object) -> Place:  # fmt: skip
    return Place(name, keys, frozenset(holds.split()), dialog, asked_by, **more)


def _down_to(page: FeaturePage, feature: str, dish: Facts = CARRYOUT_G2) -> tuple[str, ...]:
    """Return the keys to the first row of a tab of F4, and from there to that of a feature."""
    rows = sheet_rows(dish, page)
    return ("pageup",) * 4 + ("down",) * next(number for number, row in enumerate(rows) if row.cells[0].id == feature)


HANDS = "ControlPage/RosePane ControlPage/DigitsPane"
LIST = "PresetsBox/PresetsPane"
STEPS = "SetupBody/can_focus"
FORM = f"{STEPS} AnswerForm/ChoiceButton AnswerForm/Input"
BUTTONS = f"{STEPS} AnswerForm/ChoiceButton"
LOG, TYPED, FOUND = (f"ConsoleOverlay/{kind}" for kind in ("LogView", "ConsoleInput", "FindInput"))
FIELDS = {"dialog": "FieldsScreen", "holds": "FieldsScreen/HintedInput FieldsScreen/CancelButton"}
UNTOLD = {
    "dish": replace(CARRYOUT_G2, homing_s=None, never_homes=True, zero_at_power_up=(CARRYOUT_G2.azimuth.name,)),
    "homed": False,
}
"""A rotator that a person has to sync."""
FORMS = {"feed": FORM, "place": FORM, "north": FORM, "level": f"{STEPS} AnswerForm/Input",
         "busy": STEPS, "dish": STEPS, "search": STEPS}  # fmt: skip
"""What the form of a step holds, where that is not buttons alone."""
POCKET = (40, 12)
AIM = "CalibratePage/AimPane"
CALIBRATE = f"{AIM} CalibratePage/ObjectsPane CalibratePage/PeaksPane CalibratePage/SetsPane"

PLACES = (
    *(_page(name, f"f{number}") for number, (name, _, _) in enumerate(PAGES, 1)
      if name not in ("control", "console", "setup", "passes", "system")),
    _page("system", "f4", holds="SystemPage/FindingsPane"),
    _page("system, hardware", "f4", "b", holds="SystemPage/SheetPane"),
    _page("system, motors", "f4", "m", holds="SystemPage/SheetPane"),
    _page("system, nvs", "f4", "n", holds="SettingsBox/OwnSettingsPane"),
    _page("system, nvs filter", "f4", "n", "slash", holds="SettingsBox/OwnSettingsPane FilterBox/EscField"),
    _page("system, receiver", "f4", "d", holds="SystemPage/SheetPane"),
    _page("passes", "f7", holds="PassesPage/PassList"),
    _page("passes, roomy", "f7", holds="PassesPage/PassList", size=(120, 36)),
    _page("passes, elevation", "f7", "v", holds="PassesPage/PassList"),
    _page("passes, world", "f7", "w", holds="PassesPage/PassWorld"),
    _page("passes, filter", "f7", "slash", holds="PassesPage/PassList PassesPage/EscField"),
    _page("go to, over passes", "f7", "g", holds="PassesPage/PassList GotoLine/EscField GotoLine/CancelButton"),
    _page("control", "f2", holds=HANDS),
    _page("control, roomy", "f2", holds=f"{HANDS} {LIST}", size=(120, 36)),
    _page("control, presets tab", "f2", "P", holds=LIST),
    _page("control, network", "f2", "N"),
    _page("craft", "f2", "c"),
    _page("craft, roomy", "f2", "c", size=(120, 36)),
    _page("craft, pass picked on F7", "f7", "f", holds="CraftTab/OfferLine"),
    _page("craft, autotrack offered", "f2", "c", "A", holds="CraftTab/OfferLine"),
    _page("craft, passes", "f2", "c", "v", track="craft-following"),
    _page("craft, search", "f2", "c", "slash", holds="NamedField/EscField"),
    _page("craft, following", "f2", "c", track="craft-following"),
    _page("control, presets", "f2", "p", holds=f"ControlPage/RosePane {LIST}"),
    _page("control, filter", "f2", "slash", holds=f"ControlPage/RosePane FilterBox/EscField {LIST}"),
    _page("go to", "g", holds="GotoLine/EscField GotoLine/CancelButton"),
    _page("go to, skew", "S", holds="GotoLine/EscField GotoLine/CancelButton", state={"dish": TRAVLER}),
    _page("control of a dish with a skew", "f2", holds=HANDS, state={"dish": TRAVLER}),
    _page("go to, over control", "f2", "g", holds=f"{HANDS} GotoLine/EscField GotoLine/CancelButton"),
    _page("console", "f5", holds=f"{LOG} {TYPED}"),
    _page("console, find", "f5", "slash", holds=f"{LOG} {FOUND}"),
    _page("console, recall", "f5", "i", "ctrl+r", holds=f"{LOG} {FOUND}"),
    _page("console, over control", "f2", "f5", holds=f"{HANDS} {LOG} {TYPED}"),
    _page("console, over setup", "f8", "f5", holds=f"{BUTTONS} {LOG} {TYPED}"),
    *(_page(f"setup, {name}", "f8", holds=FORMS.get(name, BUTTONS), engine=name)
      for name in setup_stand_in.ENGINES),
    _page("calibrate", "f8", "C", holds=f"{AIM} CalibratePage/ObjectsPane"),
    _page("calibrate, first", "f8", "C", holds=f"{AIM} CalibratePage/ObjectsPane", calibrate="first"),
    _page("calibrate, peaks", "f8", "C", "p", holds=f"{AIM} CalibratePage/PeaksPane"),
    _page("calibrate, sets", "f8", "C", "s", holds=f"{AIM} CalibratePage/SetsPane"),
    _page("calibrate, roomy", "f8", "C", holds=CALIBRATE, size=(120, 36)),
    _page("calibrate, on the sky", "f8", "C", "v", holds=f"{AIM} CalibratePage/ObjectsPane"),
    _page("setup, roomy form", "f8", holds=FORM, engine="place", size=(120, 36)),
    _page("setup, wiring", "f8", "w"),
    _page("pocket", size=POCKET),
    _page("pocket, map", "m", size=POCKET),
    _page("pocket, passes", "f", holds="PocketPasses/NextList", size=POCKET),
    _page("pocket, pass picked", "f", "enter", holds="PocketPasses/NextList PocketPasses/PocketOffer", size=POCKET),
    _page("pocket, go to", "g", holds="GotoLine/EscField GotoLine/CancelButton", size=POCKET),
    _dialog("home", "Questions._confirm", "H"),
    _dialog("add elements", "Questions.elements", "I", dialog="FieldsScreen",
            holds="FieldsScreen/PasteInput FieldsScreen/CancelButton"),
    _dialog("set the location", "Questions.place", "L", **FIELDS),
    _dialog("sync", "SyncQuestion.ask", "Y", **FIELDS, state=UNTOLD),
    _dialog("sync, believed otherwise", "SyncQuestion._confirm", "Y", "2", "enter", state=UNTOLD),
    _dialog("end the search", "Questions._confirm", "K", state={"dish": TRAVLER}),
    _dialog("own limits", "Questions._confirm", "enter", state={"motion_refused_because": "line 7: not a number."}),
    _dialog("engage", "ControlPage._question", "f2", "E"),
    _dialog("release", "ControlPage._question", "f2", "R"),
    _dialog("stow", "ControlPage._question", "f2", "W", state={"stow_allowed": True}),
    _dialog("speeds", "ControlPage._ask_speeds", "f2", "v", **FIELDS),
    _dialog("horizon point", "HorizonHands._type", "f2", "t", **FIELDS),
    _dialog("draw the horizon", "HorizonHands._draw", "f2", "D", dialog="SketchScreen",
            holds="SketchScreen/SketchPane"),
    _dialog("clear the horizon", "HorizonHands._clear", "f2", "Z"),
    _dialog("explain a finding", "HealthHands._open", "f4", "enter", dialog="LinesScreen",
            holds="LinesScreen/VerticalScroll"),
    _dialog("all of a value", "SheetHands._open", "f4", "b", "enter", dialog="LinesScreen",
            holds="LinesScreen/VerticalScroll"),
    _dialog("new value", "SheetHands._set", "f4", "m", *_down_to(FeaturePage.MOTORS, "speed.azimuth"), "e", **FIELDS),
    _dialog("set a value", "SheetHands._ask", "f4", "d", *_down_to(FeaturePage.RECEIVER, "enable_lna"), "e"),
    _dialog("test the motors", "SheetHands._test", "f4", "m", "t"),
    _dialog("run a motor while held", "SheetHands._run", "f4", "m",
            *_down_to(FeaturePage.MOTORS, "duty.azimuth", RP2040_FACTS), "plus", state={"dish": RP2040_FACTS}),
    _dialog("put a value back", "SheetHands._undo", "f4", "m", "u"),
    _dialog("read what switches something", "SheetHands.ask_to_read", "f4", "d",
            *_down_to(FeaturePage.RECEIVER, "even_level"), "enter"),
    _dialog("all of a setting", "SettingsHands._open", "f4", "n", "enter", dialog="LinesScreen",
            holds="LinesScreen/VerticalScroll"),
    _dialog("edit a setting", "SettingsHands._edit", "f4", "n", "e", **FIELDS),
    _dialog("write settings", "SettingsHands._write", "f4", "n", "w"),
    _dialog("save settings", "SettingsHands._save", "f4", "n", "s"),
    _dialog("restore settings", "SettingsHands._choose", "f4", "n", "R", dialog="ChoiceScreen",
            holds="ChoiceScreen/OptionList"),
    _dialog("compare settings", "SettingsHands._compare", "f4", "n", "c", "enter", dialog="LinesScreen",
            holds="LinesScreen/VerticalScroll"),
    _dialog("jump to a time", "PassesPage._ask_time", "f7", "t", **FIELDS),
    _dialog("source of the signal", "SignalPage.do", "f3", "s", dialog="ChoiceScreen",
            holds="ChoiceScreen/OptionList"),
    _dialog("sweep", "SignalPage.do", "f3", "w", **FIELDS),
    _page("map of the sky", "f3", "i", holds="SignalPage/MapPane"),
    _page("map of the sky, roomy", "f3", "i", holds="SignalPage/MapPane", size=(120, 36)),
    _dialog("map the sky", "MapHands.do", "f3", "m", **FIELDS),
    _dialog("maps of the sky", "MapHands._choose", "f3", "M", dialog="ChoiceScreen", holds="ChoiceScreen/OptionList"),
    _dialog("resume the map", "MapHands._ask_again", "f3", "u"),
    _dialog("what the map teaches", "MapTeach.ask", "f3", "y", dialog="ChoiceScreen", holds="ChoiceScreen/OptionList"),
    _dialog("north by the map", "MapTeach._offer_north", "f3", "y", "down", "enter"),
    _dialog("beam by the map", "MapTeach._offer_beam", "f3", "y", "down", "down", "enter"),
    _dialog("by the signal", "SignalPage.do", "f3", "f", dialog="ChoiceScreen", holds="ChoiceScreen/OptionList"),
    _dialog("step-track", "SignalPage._find", "f3", "f", "down", "enter", **FIELDS),
    _dialog("on-off", "SignalPage._find", "f3", "f", "down", "down", "enter", **FIELDS),
    _dialog("transponder", "SignalPage.do", "f3", "n", **FIELDS),
    _dialog("both polarisations", "SignalPage.do", "f3", "b"),
    _dialog("13 V for the LNB", "SignalPage.do", "f3", "V"),
    _dialog("recordings", "ReplayDesk._choose", "f3", "R", dialog="ChoiceScreen", holds="ChoiceScreen/OptionList"),
    _dialog("replay", "ReplayDesk._play", "f3", "R", "enter", dialog="ReplayScreen", holds=""),
    _dialog("replay, to a time", "ReplayScreen.action_ask_time", "f3", "R", "enter", "g", **FIELDS),
    _dialog("frequency", "CraftTab._ask_frequency", "f2", "c", "F", track="craft-following", **FIELDS),
    _dialog("find a peak", "CalibratePage._ask_find", "f8", "C", "f"),
    _dialog("forget all peaks", "CalibratePage._ask_begin", "f8", "C", "X"),
    _dialog("name of a fit", "CalibratePage._ask_name", "f8", "C", "a", **FIELDS),
    _dialog("new preset", "ControlPage._add", "f2", "a", **FIELDS),
    _dialog("edit preset", "ControlPage._edit", "f2", "p", "e", **FIELDS),
    _dialog("area clear", "SetupPage._when_clear", "f8", "enter"),
    _dialog("hazard", "ConsoleOverlay._ask", "f5", "i", *LINE, "enter", state={"holder": "console", "menu": "mot"}),
    _dialog("take over", "ConsoleOverlay._ask", "f5", "i", "a", "enter", state={"holder": "Gpredict", "menu": "mot"}),
    _dialog("help", "Deeds._show_help", "question_mark", dialog="HelpScreen", holds="HelpScreen/OptionList"),
    _dialog("jump", "Deeds._show_jump", "semicolon", dialog="JumpScreen", holds=""),
    _dialog("palette", "Deeds._show_palette", "colon", dialog="Palette", holds="Palette/CommandInput"),
    _dialog("home, pocket", "Questions._confirm", "H", size=POCKET),
    _dialog("help, pocket", "Deeds._show_help", "question_mark", dialog="HelpScreen",
            holds="HelpScreen/OptionList", size=POCKET),
    _dialog("palette, pocket", "Deeds._show_palette", "colon", dialog="Palette", holds="Palette/CommandInput",
            size=POCKET),
)  # fmt: skip
BY_NAME = {place.name: place for place in PLACES}


def at(place, folder, test, *, state="slewing", size=None, **settings):
    """Go there, in an app around a stand-in dish (which moves, unless told otherwise); await `test(app, pilot, ask)`.

    `ask` is who put the dialog there.
    """
    presets = folder / "presets.toml"
    add_preset(presets, Preset("Hot Bird", 164.2, 38.1, "13°E"))

    async def body():
        asked = []
        app = stand_in.app_in(
            state, setup=setup_stand_in.ENGINES[place.engine], presets_file=presets, history_file=folder / "history",
            sky=sky_stand_in.make(), horizon=horizon_stand_in.File(), keep_place=lambda *_place: None,
            calibrate=calibrate_stand_in.make(place.calibrate),
            recordings_file=recordings_in(folder) if "R" in place.keys else None,
            lessons=lessons_stand_in.Lessons(), backups_folder=backups_in(folder), **settings,
        )  # fmt: skip
        if {("f3", "i"), ("f3", "u"), ("f3", "M"), ("f3", "y"), ("m",)} & {place.keys[:2]}:
            open_map(app, folder)
        app.track._make = track_stand_in.Source(track_stand_in.desk_in(place.track, app.session.clock))
        app.station.state = replace(app.station.state, **place.state)

        def push_screen(*args, **options):
            asked.append(sys._getframe(1).f_code.co_qualname)
            return BirdcageApp.push_screen(app, *args, **options)

        app.push_screen = push_screen
        if place.asked_by == "SyncQuestion._confirm":
            doubt_sync(app.station)
        async with app.run_test(size=size or place.size) as pilot:
            await settle(app, pilot)
            if place.keys[:1] == ("f4",):
                fill_system(app)
            await press(app, pilot, *place.keys)
            return await test(app, pilot, asked[-1] if asked else "")

    return asyncio.run(body())


def doubt_sync(station):
    """Have the station believe that the dish points elsewhere than it is told."""
    submit = station.submit

    def doubted(request):
        future = submit(request)
        if isinstance(request, Sync) and not request.agreed:
            future.set_exception(ConfirmationNeeded("It points elsewhere by its own word. Change it?"))
        return future

    station.submit = doubted


def fill_system(app):
    """Give the System page something to show and to undo, once it has met the dish of this state."""
    feeds = app.system
    feeds.sheets.look(None)
    feeds.sheets._changes = [FeatureChange(CARRYOUT_G2.features["speed.azimuth"], 65.0, 20.0)]
    feeds.own_settings.look()
    settings_stand_in.fill(app, staged={38: "600"})
    feeds.health.look()
    feeds.health.now = health_stand_in.NOW


def backups_in(folder):
    """Return a folder with one backup of a dish's own settings."""
    backups = folder / "backups"
    backups.mkdir(exist_ok=True)
    row = " 20) Disable Tracker Proc?             FALSE       FALSE       FALSE\n"
    (backups / "nvs-g2-20260314T120000Z.txt").write_text(row)
    return backups


def open_map(app, folder):
    """Have a map in the file that is begun and open; what reads the file does so at once."""
    app.maps.beside = lambda work: work()
    path = app.maps._path = folder / "maps.sqlite"
    if not path.exists():
        map_stand_in.keep(path, map_stand_in.made(heard=20))
    app.maps.book.chosen = map_stand_in.KEY
    app.maps.book.read(map_stand_in.KEY, MapRead.of(read_map(path, 1)))


def recordings_in(folder):
    """Record a minute, and return the file."""
    path = folder / "signal.sqlite"
    if not path.exists():
        recorded(path, [row(second) for second in range(60)])
    return path


async def press(app, pilot, *keys):
    """Press keys, each once what the one before has brought is drawn."""
    for key in keys:
        await pilot.press(key)
        for _ in range(4 if "R" in keys else 0):  # the disk is read by workers
            await app.workers.wait_for_complete()
            await pilot.pause()
        await settle(app, pilot)


async def settle(app, pilot):
    """Draw one frame, and wait until the layout has followed it."""
    app.paint()
    await pilot.pause()
    await pilot.pause()
