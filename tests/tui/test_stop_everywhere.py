"""STOP with the focus on everything that can have it, in every dialog; and no place is left untried."""

import ast
import importlib
import pkgutil
import re
from pathlib import Path

import birdcage_tui
import pytest
import stand_in
import textual.containers
import textual.widgets
from birdcage.station.requests import Unwatch, Watch
from birdcage_tui.widgets.status import StopButton
from places import PLACES, at
from textual.screen import ModalScreen
from textual.widget import Widget
from textual.widgets import Input

SOURCES = Path(birdcage_tui.__file__).parent


def kinds_of(widget):
    """Every name under which a widget may stand in `holds`: its owner's class, or a base of it, and its own."""
    owner = next(
        each for each in widget.ancestors if type(each).__module__.startswith("birdcage_tui") and each is not widget
    )
    kinds = [kind.__name__ for kind in type(widget).__mro__ if getattr(kind, "can_focus", False)] or ["can_focus"]
    return {f"{base.__name__}/{kind}" for base in type(owner).__mro__ for kind in kinds}


def focusable(app):
    return [widget for widget in app.screen.query("*") if widget.focusable and widget.is_on_screen]


@pytest.mark.parametrize("place", PLACES, ids=lambda place: place.name)
def test_stop_with_the_focus_on_everything(place, tmp_path):
    async def everywhere(app, pilot, asked_by):
        assert (type(app.screen).__name__ if place.dialog else "") == place.dialog
        assert asked_by == place.asked_by
        widgets = focusable(app)
        assert all(kinds_of(widget) & place.holds for widget in widgets), [kinds_of(widget) for widget in widgets]
        assert all(any(kind in kinds_of(widget) for widget in widgets) for kind in place.holds), widgets
        stops, asked, screens = app.station.stops, len(app.station.asked), list(app.screen_stack)
        for widget in (None, *widgets):
            app.screen.set_focus(widget)
            for key in ("ctrl+c", "escape", "space"):  # Esc: it moves
                before, text = len(stops), getattr(widget, "value", None)
                await pilot.press(key)
                typed = key == "space" and isinstance(widget, Input)
                assert len(stops) == before + (not typed), (key, widget)
                assert widget is None or app.focused is widget, (key, widget)
                if isinstance(widget, Input):
                    assert widget.value.count(" ") == text.count(" ") + typed
        assert app.screen_stack == screens, "the keys were spent on STOP"
        assert [each for each in app.station.asked[asked:] if not isinstance(each, Watch | Unwatch)] == []
        before = len(stops)
        button = next(each for each in app.screen.query(StopButton) if each.is_on_screen and each.region.area)
        await pilot.mouse_down(button, offset=(button.region.width // 2, 0))
        await pilot.pause()
        assert len(stops) == before + 1, "the mouse's STOP"

    at(place, tmp_path, everywhere)


# No place is left untried: what the sources make, against what the places hold.


def classes():
    """Every class of the app, by its name."""
    for found in pkgutil.walk_packages([str(SOURCES)], "birdcage_tui."):
        importlib.import_module(found.name)
    todo, known = [Widget], {}
    while todo:
        kind = todo.pop()
        todo += kind.__subclasses__()
        if kind.__module__.startswith("birdcage_tui"):
            known[kind.__name__] = kind
    return known


def made(tree, takes_focus):
    """Yield `Owner/Kind` of each widget that may have the focus and is made inside a class."""
    for owner in (node for node in ast.walk(tree) if isinstance(node, ast.ClassDef)):
        for node in ast.walk(owner):
            if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id in takes_focus:
                never = any(word.arg == "can_focus" and word.value.value is False for word in node.keywords)
                if not never:
                    yield f"{owner.name}/{node.func.id}"
            if isinstance(node, ast.Assign) and isinstance(node.value, ast.Constant) and node.value.value is True:
                for target in node.targets:
                    if isinstance(target, ast.Attribute) and target.attr == "can_focus":
                        yield f"{owner.name}/can_focus"


def test_everything_that_can_have_the_focus_is_in_some_place():
    library = {name: getattr(textual.widgets, name) for name in textual.widgets.__all__} | vars(textual.containers)
    kinds = {name: kind for name, kind in (library | classes()).items() if isinstance(kind, type)}
    takes_focus = {name for name, kind in kinds.items() if issubclass(kind, Widget) and kind.can_focus}
    assert {"Input", "Switch", "OptionList", "VerticalScroll", "LogView", "RosePane"} <= takes_focus
    found = {pair for path in SOURCES.rglob("*.py") for pair in made(ast.parse(path.read_text()), takes_focus)}
    assert {"QuestionScreen/VerticalScroll", "SetupBody/can_focus", "ConsoleOverlay/FindInput"} <= found
    held = frozenset().union(*(place.holds for place in PLACES)) - {"Palette/CommandInput"}  # made by Textual
    assert found == held


def test_every_dialog_is_a_place():
    dialogs = {kind for kind in classes().values() if issubclass(kind, ModalScreen)}
    shown = {kind.__name__ for kind in dialogs if not dialogs & set(kind.__subclasses__())}
    assert len(shown) >= 5
    assert shown == {place.dialog for place in PLACES if place.dialog}


def asking(node, owner=""):
    """Yield the name of each function that puts a dialog on the screen."""
    for child in ast.iter_child_nodes(node):
        name = owner
        if isinstance(child, ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef):
            name = f"{owner}.{child.name}".lstrip(".")
        if isinstance(child, ast.Call) and isinstance(child.func, ast.Attribute) and child.func.attr == "push_screen":
            yield owner
        yield from asking(child, name)


def test_everything_that_asks_is_asked_in_some_place():
    found = {name for path in SOURCES.rglob("*.py") for name in asking(ast.parse(path.read_text()))}
    assert found == {place.asked_by for place in PLACES if place.dialog}


SAID_OF_ESC = re.compile(r"(at rest|rests),? Esc|Esc\s+(\S+ ?\S*)", re.IGNORECASE)


def said_of_esc(text):
    """Every pair of words after Esc, but for sentences that begin with `at rest`."""
    return [found[2] for found in SAID_OF_ESC.finditer(text) if found[2]]


@pytest.mark.parametrize("place", PLACES, ids=lambda place: place.name)
def test_what_is_said_of_esc_is_what_it_does(place, tmp_path):
    async def moving(app, pilot, _asked_by):
        layers = list(app.screen_stack)
        return said_of_esc(stand_in.text_of(app)), layers == app.screen_stack

    said, _ = at(place, tmp_path, moving)
    for words in said:
        assert words.startswith(("stop", "or Ctrl+C")), f"the dish moves, and the screen says: Esc {words}"


@pytest.mark.parametrize("place", [place for place in PLACES if place.dialog], ids=lambda place: place.name)
def test_at_rest_a_dialog_says_that_esc_closes_it_and_it_does(place, tmp_path):
    async def resting(app, pilot, _asked_by):
        if app.view().may_move:
            return None
        said, layers = said_of_esc(stand_in.text_of(app)), len(app.screen_stack)
        await pilot.press("escape")
        await pilot.pause()
        return said, len(app.screen_stack) < layers

    found = at(place, tmp_path, resting, state="idle")
    if found is not None:
        said, closed = found
        assert closed
        assert not [words for words in said if words.startswith("stop")], said
