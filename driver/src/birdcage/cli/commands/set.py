"""`birdcage set`."""

from __future__ import annotations

from typing import Any

import click

from birdcage.base.reason import Reason
from birdcage.cli import exits
from birdcage.cli.options import flags, global_options, wanted
from birdcage.cli.sky_options import NEGATIVE_NUMBERS, no_options_among

ON, OFF = ("on", "yes", "true", "1"), ("off", "no", "false", "0")


@click.command("set", epilog=exits.EPILOG, context_settings=NEGATIVE_NUMBERS)
@click.argument("name")
@click.argument("value", required=False)
@click.option("--yes", is_flag=True, help="Agree to what it does in advance.")
@global_options()
def command(name: str, value: str | None, yes: bool) -> None:
    """Set a feature of the dish, and print what was read back; `birdcage features` lists names and ranges.

    VALUE is a number, or on and off; what is done and over (`at once`) takes none. A message in hex is one argument:
    "E0 10 38 F4". Where the dish tells it, you also see what it was before, and how to put that back.

    What needs your consent is asked for first. Nothing is set while the dish moves. If another birdcage program has the
    port, that one sets it.
    """
    from birdcage.base.errors import CommandRefused
    from birdcage.cli.commands.get import confirm, lines_of
    from birdcage.cli.dish_features import list_features, set_feature
    from birdcage.cli.say import say, tell, tell_json
    from birdcage.rotator.feature import DISEQC
    from birdcage.station.feature_report import only_held

    no_options_among([name] if value is None else [name, value])
    dish = wanted()
    rows = {row["id"]: row for row in list_features(dish)["features"]}
    row = rows.get(name)
    if row is None or row["writer"] == "read only":
        raise CommandRefused(
            f"This dish has no feature {name} that can be set. Nothing was sent. `birdcage features` lists what it "
            "has.",
            reason=Reason.UNSUPPORTED,
        )
    if row["kind"] == "held":
        raise CommandRefused(only_held(name, row["label"]), reason=Reason.UNSUPPORTED)
    meant = _value(row, value)
    if name == DISEQC:
        say(_message(str(meant)))
    if row["hazard"]:
        confirm(row["hazard"], yes, "Set it?")
    told = set_feature(dish, name, meant, look_first=row["told"] and not row["read_hazard"])
    if flags().json:
        tell_json(told)
        return
    if row["kind"] == "momentary":
        tell(f"{name:24} done")
        return
    for line in lines_of(name, told["readings"][name]):
        only_taken = not row["told"] and row["writer"] != "at once"
        tell(f"{line}: the dish took it, and can't be asked for it" if only_taken else line)
    if undo := _undo(name, told):
        say(undo)


def _undo(name: str, told: dict[str, Any]) -> str:
    """Return what it was, and how to put it back; empty where that is not known, or it is the same."""
    from birdcage.cli.commands.get import value_text

    before, now = told.get("before"), told["readings"][name]
    if before is None or now is None or before["value"] == now["value"]:
        return ""
    value = before["value"]
    typed = f"{value:.10g}" if isinstance(value, float) else value_text(value)
    return (
        f"It was {value_text(value)}{' ' + before['unit'] if before['unit'] else ''}. Undo: birdcage set {name} {typed}"
    )


def _message(typed: str) -> str:
    """Return what a message to the coax means; UsageError for what is none."""
    from birdcage.coax.messages import read_message, typed_message

    try:
        return str(read_message(typed_message(typed)))
    except ValueError as wrong:
        raise click.UsageError(f"{wrong} Nothing was sent.") from None


def _value(row: dict[str, Any], text: str | None) -> bool | float | str:
    """Return what was typed as what this feature takes; UsageError for anything else."""
    kind = row["kind"]
    if kind == "momentary":
        if text is not None:
            raise click.UsageError(f"{row['id']} takes no value.")
        return True
    if text is None:
        raise click.UsageError(f"Give a value for {row['id']}.")
    if kind == "switch":
        if text.lower() not in (*ON, *OFF):
            raise click.UsageError(f"{row['id']} is {text!r}. Give on or off.")
        return text.lower() in ON
    if kind != "number":
        return text
    try:
        return float(text)
    except ValueError:
        raise click.UsageError(f"{row['id']} is {text!r}. Give a number, in {row['unit'] or 'no unit'}.") from None
