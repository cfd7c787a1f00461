"""`birdcage init`."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

import click

from birdcage.base.held import HeldReason
from birdcage.cli.exits import EPILOG
from birdcage.cli.options import flags, global_options, wanted

if TYPE_CHECKING:
    from birdcage.cli.dish import DishSession
    from birdcage.station.events import Event
    from birdcage.station.known import Facts

HOLDER = "birdcage init"
PATIENCE_S = 180.0
"""How long a dish is waited for of which not even the model is known."""
LEAST_S = 10.0
"""The same of one that has no boot to wait for: it has to be met."""

DISABLE = (
    "This saves {setting} as {off} in the dish, after a backup of its whole table. "
    "It takes effect when the dish is next switched off and on. Then the dish no longer searches for TV "
    "satellites, nor homes by itself: run `birdcage home` after each power-up. `birdcage init --restore-search` "
    "undoes that."
)
RESTORE = (
    "This saves {setting} as {on} in the dish, after a backup of its whole table. "
    "From the next power-up the dish homes and searches for TV satellites: it moves by itself."
)

REST_S = 6.0
"""How long a dish is watched that was on its way when its search was ended."""

SEARCHES = {
    "off until power-up": "Its TV search is ended until the next power-up. Run this again then.",
    "running": "Its TV search runs and moves the dish.",
    "off": "Its TV search is off.",
    "unknown": "The state of its TV search is unknown.",
}
"""What is said of a search that can only be ended while it runs."""


@click.command("init", epilog=EPILOG)
@click.option(
    "--disable-search",
    "switch",
    flag_value="disable",
    help="Switch the TV search off: for good where a setting of the dish does that, else until power-up (done anyway).",
)
@click.option("--restore-search", "switch", flag_value="restore", help="Undo that: let the dish search again.")
@click.option("--yes", is_flag=True, help="Write the dish's settings without asking.")
@click.option(
    "--timeout",
    "timeout_s",
    type=click.FloatRange(1.0, 3600.0),
    help="Seconds to wait for the dish.  [default: as long as its boot may take]",
)
@global_options()
def command(switch: str | None, yes: bool, timeout_s: float | None) -> None:
    """Wait until the dish answers, then print its state and what its TV search does.

    A dish that has been up for long answers at once; the boot of one just switched on is shown as it goes. Where no
    setting of the dish switches its TV search off, the search is ended until the next power-up. Any other search is
    left alone unless asked for.
    Nothing is moved. Ctrl+C ends it.
    """
    from birdcage.cli.dish import open_dish
    from birdcage.cli.say import say, tell_json
    from birdcage.cli.which import with_firmware
    from birdcage.station.report import status_report
    from birdcage.station.state import Activity

    dish_wanted = with_firmware(wanted(), patience_s=PATIENCE_S if timeout_s is None else timeout_s)
    at_once = _ends_at_once(dish_wanted.model)
    if switch is not None and (why := _no_switch(dish_wanted.model)):
        raise click.UsageError(why)
    if switch == "restore" and at_once:
        raise click.UsageError("This dish's TV search can't be switched off for good: it starts at each power-up.")
    if switch is not None and not at_once:
        _confirm(_consequence(dish_wanted.model, disabled=switch == "disable"), yes)
    if timeout_s is None:
        timeout_s = PATIENCE_S if dish_wanted.model is None else max(dish_wanted.model.boot_s, LEAST_S)
    with open_dish(dish_wanted) as dish:
        follower = BootFollower(dish)
        dish.come_up(timeout_s, patient=True, hear=follower.hear, each_time=follower.show)
        dish.survey()
        dish.progress.clear()
        if at_once:
            _end_search(dish, booted=follower.booted)
        _describe(dish)
        if switch is not None and not at_once:
            _switch(dish, disabled=switch == "disable", booted=follower.booted)
        report = status_report(dish.state, dish.now)
        ready = dish.state.homed is not False and dish.state.activity is not Activity.MOVING_UNASKED
    if flags().json:
        tell_json(report)
    elif ready:
        say("Ready.")


class BootFollower:
    """Tells the boot as it goes, with the time since the beginning."""

    def __init__(self, dish: DishSession) -> None:
        self._dish, self._since = dish, dish.now
        self.booted = False
        """Whether boot text was seen."""

    @property
    def elapsed_s(self) -> float:
        """Seconds since the beginning."""
        return self._dish.now - self._since

    def hear(self, event: Event) -> None:
        """Tell what the dish prints by itself."""
        from birdcage.cli.say import say
        from birdcage.station.events import TranscriptLine

        if isinstance(event, TranscriptLine) and event.direction == "<" and event.text.strip():
            self.booted = True
            if event.is_prompt:
                return  # what was sent while it booted is answered now, each line with a prompt
            self._dish.progress.clear()
            say(f"{self.elapsed_s:5.1f} s  {event.text.strip()}")

    def show(self) -> None:
        """Show that it is still waiting, and for what."""
        if self.elapsed_s >= 1.0:
            self._dish.progress.show(f"{self.elapsed_s:5.0f} s  waiting: {self._dish.state.link.detail}")


def _describe(dish: DishSession) -> None:
    from birdcage.cli.dish import how_to_home, why_unknown
    from birdcage.cli.say import say
    from birdcage.station.state import Activity, TvSearch

    state = dish.state
    assert state.dish is not None, "a station knows its dish from the start"
    version = f"firmware {state.firmware_version}" if state.firmware_version else f"speaks {state.dish.firmware}"
    say(f"{state.dish.name}, {version}, answers at {state.port}.")
    if state.activity is Activity.MOVING_UNASKED:
        say("The dish moves by itself: its TV search, or homing after power-up. Keep clear of it.")
    elif state.homed is False:
        say(why_unknown(state))
    elif state.position_text:
        say(f"{state.position_text} {how_to_home(state)}")
    elif state.position is not None and state.position_lost is None:
        at = state.position
        skew = "" if at.skew_deg is None else f" SK {at.skew_deg:.2f}°"
        say(f"It points at AZ {at.az_text} EL {at.el_deg:.2f}°{skew}.")
    if state.search is TvSearch.NONE:
        return
    if _ends_at_once(state.dish):
        say(SEARCHES[state.search.value])
        return
    setting = state.dish.search_setting
    told = None if setting is None else state.readings.get(setting.id)
    if setting is None or told is None:
        say("The state of its TV search is unknown.")
    elif told.value == setting.off:
        row = f"{setting.label} is {setting.off}"
        say(f"Its TV search is off ({row}), so it does not home by itself: run `birdcage home` at power-up.")
    else:
        say(
            f"{setting.label} is {setting.on}: at power-up this dish homes, then searches for TV satellites: it "
            "moves by itself. `birdcage init --disable-search` switches that off."
        )


def _ends_at_once(model: Facts | None) -> bool:
    """Return whether the TV search is ended while it runs, and by no setting."""
    from birdcage.station.known import SearchSwitch

    return model is not None and model.search_switch is SearchSwitch.UNTIL_POWER_UP


def _no_switch(model: Facts | None) -> str:
    """Return why the TV search can't be switched off or on; empty if it can, or that is not known."""
    from birdcage.station.known import SearchSwitch

    words = {
        SearchSwitch.NOT_KNOWN: "No command is known that switches this dish's TV search off or on.",
        SearchSwitch.NEVER_SEARCHES: "This dish has no TV search.",
    }
    return "" if model is None else words.get(model.search_switch, "")


def _end_search(dish: DishSession, *, booted: bool) -> None:
    from birdcage.station.requests import SetSearch
    from birdcage.station.state import Activity

    if booted:
        _release(dish)
    dish.ask(SetSearch(HOLDER, disabled=True), 60.0)
    # What the search last moved comes to rest before anything is said of it.
    until = dish.now + REST_S
    while dish.state.activity is Activity.MOVING_UNASKED and dish.now < until:
        dish.look()


def _release(dish: DishSession) -> None:
    """Let go of what a restart has latched: here it was waited for. Held where somebody stopped the dish."""
    from birdcage.base.errors import Held
    from birdcage.station.requests import AcknowledgeFault, Release

    held = dish.state.held
    if held is not None and (held.earlier or held.reason is HeldReason.STOP):
        raise Held(f"{held.sentence} Nothing was sent: `birdcage release` lets it move again.")
    dish.ask(AcknowledgeFault(HOLDER), 5.0)
    dish.ask(Release(HOLDER), 5.0)


def _switch(dish: DishSession, *, disabled: bool, booted: bool) -> None:
    from birdcage.cli.say import say
    from birdcage.station.requests import SetSearch

    if booted:
        _release(dish)
    backup = dish.ask(SetSearch(HOLDER, disabled), 60.0)
    say(f"Backup of the dish's settings: {backup}.")
    model = dish.state.dish
    setting = None if model is None else model.search_setting
    saved = (
        "The setting is saved"
        if setting is None
        else f"{setting.label} is saved as {setting.off if disabled else setting.on}"
    )
    say(f"{saved}. Now switch the dish off and on.")


def _consequence(model: Facts | None, *, disabled: bool) -> str:
    """Return what writing the setting of the TV search does, for a person who is to agree."""
    setting = None if model is None else model.search_setting
    words = {"setting": "the setting of its TV search", "off": "off", "on": "on"}
    if setting is not None:
        words = {"setting": f"{setting.label} ({setting.name})", "off": setting.off, "on": setting.on}
    return (DISABLE if disabled else RESTORE).format_map(words)


def _confirm(consequence: str, yes: bool) -> None:
    click.echo(consequence, err=True)
    if yes:
        return
    if not sys.stdin.isatty():
        raise click.UsageError("Give --yes to do it.")
    click.confirm("Write it?", abort=True, err=True)
