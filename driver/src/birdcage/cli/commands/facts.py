"""`birdcage facts`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from birdcage.base.reason import Reason
from birdcage.cli import exits
from birdcage.cli.options import flags, global_options, wanted

if TYPE_CHECKING:
    from birdcage.rotator.listed_facts import ListedFact
    from birdcage.rotator.own import OwnFact


@click.command("facts", epilog=exits.EPILOG)
@click.option("--forget", is_flag=True, help="Forget what was learnt: another dish is at this adapter.")
@global_options()
def command(forget: bool) -> None:
    """List what is known of this dish, with units and sources.

    documented: papers, logs or working programs have it. measured: somebody measured it at such a dish. inferred: an
    assumption. learnt: birdcage saw it at this dish. user: you say so, in [dish.facts] of birdcage.toml or with
    `birdcage gear`. Yours go before what was learnt, and that before all else.

    Sends nothing, and opens no port. A birdcage that runs takes what you change at its next start.
    """
    from birdcage.base.errors import ConfigError, LinkError
    from birdcage.cli.say import say, tell, tell_json
    from birdcage.rotator.listed_facts import listed
    from birdcage.rotator.own import OwnFacts
    from birdcage.station.facts_file import FactsFile
    from birdcage.station.known import list_firmwares, model_of, wrong_facts

    dish = wanted()
    file = FactsFile.of(dish.paths.state, dish.port, dish.firmware if dish.firmware_given else None)
    if forget:
        if file is None:
            raise LinkError(
                f"No adapter at {dish.port}. birdcage files what it learns of a dish under its adapter. "
                "`birdcage ports` lists them.",
                reason=Reason.MISSING,
            )
        file.forget()
    firmware = dish.firmware if dish.firmware_given else None if file is None else file.firmware
    if firmware is None:
        raise ConfigError("Name the firmware with --firmware. `birdcage detect` tells which it is.")
    model = model_of(firmware, dish.settings)
    if model is None:
        raise ConfigError(f"Firmware {firmware} is unknown to this version. It speaks {', '.join(list_firmwares())}.")
    own = OwnFacts() if file is None else file.read()
    facts = tuple(listed(own.on(model)))
    if flags().json:
        told = {fact.name: _values(fact, own.facts.get(fact.name)) for fact in facts}
        tell_json({"port": dish.port, "firmware": firmware, "facts": told})
    else:
        for fact in facts:
            tell(f"{fact.name:36} {_shown(fact.value):20} {fact.unit:8} {_origin(fact, own.facts.get(fact.name))}")
    for sentence in wrong_facts(firmware, dish.settings):
        say(sentence)


def _values(fact: ListedFact, own: OwnFact | None) -> dict[str, Any]:
    values: dict[str, Any] = {
        "value": fact.value, "unit": fact.unit or None, "origin": None if fact.origin is None else fact.origin.value,
    }  # fmt: skip
    if _counts(fact, own):
        assert own is not None
        values |= {"since": own.utc.isoformat(timespec="seconds"), "readings": own.readings}
    return values


def _origin(fact: ListedFact, own: OwnFact | None) -> str:
    if fact.origin is None:
        return "-"
    if not _counts(fact, own):
        return fact.origin.value
    assert own is not None
    readings = f"{own.readings} reading{'s' if own.readings > 1 else ''}, " if own.readings else ""
    return f"{fact.origin.value} ({readings}{own.utc:%Y-%m-%d})"


def _counts(fact: ListedFact, own: OwnFact | None) -> bool:
    """Whether it is the kept one that counts, and not what `birdcage.toml` says."""
    return own is not None and fact.origin is own.origin and fact.value == own.value


def _shown(value: str | float | bool | None) -> str:
    if value is None:
        return "-"
    if isinstance(value, bool):
        return "yes" if value else "no"
    return f"{value:.6g}" if isinstance(value, float) else str(value)
