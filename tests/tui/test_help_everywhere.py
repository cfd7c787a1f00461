"""`?` lists what holds where the focus is, each row can be chosen, and no command is left without a mouse target."""

import pytest
from birdcage_tui.commands import COMMANDS, PAGES, in_force
from birdcage_tui.widgets.footer import KeyBar
from birdcage_tui.widgets.help import HelpScreen
from places import Place, at, settle
from textual.widgets import Input, OptionList

POCKET = (40, 12)
SCOPES = {
    **{(f"f{number}",): (name,) for number, (name, _, _) in enumerate(PAGES, 1)},
    ("f4",): ("system-health", "system"),
    ("f4", "b"): ("system-sheet", "system"),
    ("f4", "n"): ("system-settings", "system"),
    ("f2", "n"): ("digits", "control"),
    ("f2", "p"): ("presets", "control"),
    ("f2", "c"): ("craft",),
    ("f2", "N"): ("network",),
    ("f8", "C"): ("calibrate",),
    ("f8", "C", "o"): ("calibrate-objects", "calibrate"),
    ("f8", "C", "p"): ("calibrate-peaks", "calibrate"),
    ("f8", "C", "s"): ("calibrate-sets", "calibrate"),
    ("f5", "i"): ("console-input", "console"),
    ("f5", "slash"): ("console-find", "console"),
    ("f2", "f5"): ("console",),
    ("f3", "i"): ("map", "signal"),
}
"""The keys that lead to each set of scopes, and these, from the focus outward."""
POCKET_SCOPES = {(): ("pocket",), ("f",): ("pocket-passes", "pocket")}
MAP_OFFER = ("map-offer", "signal")
"""A horizon that a map proposes: its keys are pressed in `test_map_teach`."""
TWO_DISHES = ("dashboard", "dishes")
"""An app with a second dish: its help is read in `test_two_dishes`."""
OFFER_SCOPES = tuple((f"offer-{deed}", "craft") for deed in ("follow", "aim", "autotrack"))
"""What letters offer to do, which takes a target that was found: its help is read in `test_follow_from_passes`."""


async def open_help(app, pilot):
    """Open it by its key; while one types, by a click in the footer."""
    if isinstance(app.focused, Input):
        bar = app.query_one(KeyBar)
        spot = next(region for region, command in bar.hot if command == "help")
        await pilot.click(bar, offset=(spot.x + 1, 0))
    else:
        await pilot.press("question_mark")
    await settle(app, pilot)
    assert isinstance(app.screen, HelpScreen)
    return app.screen.query_one(OptionList)


async def chosen_in(app, pilot, rows):
    """Choose every row with the arrows and Enter, and return what was told to be done."""
    chosen = []
    app.screen.dismiss = chosen.append
    count = sum(not rows.get_option_at_index(index).disabled for index in range(rows.option_count))
    rows.action_first()
    for _ in range(count):
        rows.action_select()
        rows.action_cursor_down()
    await settle(app, pilot)
    return chosen


@pytest.mark.parametrize(
    ("keys", "scopes", "size"),
    [(keys, scopes, (80, 24)) for keys, scopes in SCOPES.items()]
    + [(keys, scopes, POCKET) for keys, scopes in POCKET_SCOPES.items()],
    ids=str,
)
def test_help_shows_what_holds_and_does_each_and_the_footer_begins_with_stop(keys, scopes, size, tmp_path):
    async def read(app, pilot, _):
        assert app.view().scopes == scopes
        holds = [command.name for command in in_force(scopes)]
        if size != POCKET:
            typing = isinstance(app.focused, Input)
            bar = app.query_one(KeyBar)
            text = "".join(segment.text for segment in bar._strips[0])
            assert text.startswith("  Ctrl+C STOP" if typing else "  Space STOP"), "the footer begins with STOP"
            assert bar.hot[0][1] == "stop"
        rows = await open_help(app, pilot)
        shown = [rows.get_option_at_index(index).id for index in range(rows.option_count)]
        assert [name for name in shown if name is not None] == holds
        assert await chosen_in(app, pilot, rows) == holds
        del app.screen.dismiss
        await pilot.press("home", "enter")
        await settle(app, pilot)
        assert app.station.stops == ["you"], "the first row is STOP"
        assert app.view().scopes == scopes, "the focus is where it was"

    at(Place("", keys), tmp_path, read, state="idle", size=size)


def test_every_command_is_in_some_help_and_so_has_a_mouse_target():
    listed = {
        command
        for scopes in (*SCOPES.values(), *POCKET_SCOPES.values(), *OFFER_SCOPES, MAP_OFFER, TWO_DISHES)
        for command in in_force(scopes)
    }
    assert listed == set(COMMANDS)
