"""The global options, accepted before and after the subcommand, and what they come to with variables and the file."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, TypeVar

import click

if TYPE_CHECKING:
    from birdcage.base.beam import Beam
    from birdcage.base.config import Settings
    from birdcage.base.paths import Paths
    from birdcage.station.known import Facts

DEFAULT_PORT = "/dev/ttyUSB0"
DEFAULT_FIRMWARE = "hal205"
"""What is tried first without a named firmware, if nothing answers (`docs/decisions/0021-which-firmware.md`)."""
DEMO_FIRMWARE = "g2"
"""What is simulated unless something else is named: the dish that is known best."""
ASKED = "as set, else the port is asked"
NO_DISH = "as set, else none: no limits of a dish"

AnyCallable = TypeVar("AnyCallable", bound=Callable[..., Any])


@dataclass
class Flags:
    """The global options as given; None is *not given*. The one after the subcommand counts."""

    values: dict[str, Any] = field(default_factory=dict)

    def get(self, name: str) -> Any:  # noqa: ANN401 - as varied as options are
        """Return what was given for an option."""
        return self.values.get(name)

    @property
    def json(self) -> bool:
        """Whether data is wanted as JSON."""
        return bool(self.values.get("json"))


@dataclass(frozen=True, slots=True)
class Wanted:
    """Which dish, reached how: flags over variables over the file over defaults."""

    port: str
    port_given: bool
    """Whether anybody named the port; else it is the default."""
    firmware: str
    firmware_given: bool
    """Whether anybody named the firmware, or the port told it; else it is the default."""
    baud: int | None
    settings: Settings
    paths: Paths
    flags: Mapping[str, object] = field(default_factory=dict)
    """What lies over the file in `settings`, by dotted key."""
    environ: Mapping[str, str] | None = None
    """The variables that lie over it; None: those of this process."""

    def load(self) -> Settings:
        """Read the settings again, with the same flags over them. Any thread."""
        from birdcage.base.config import load

        return load(self.paths.config_file, environ=self.environ, flags=self.flags)

    @property
    def model(self) -> Facts | None:
        """What that firmware drives, as its owner says that it is; None for one that this version does not speak."""
        from birdcage.station.known import model_of

        return model_of(self.firmware, self.settings)

    @property
    def named_model(self) -> Facts | None:
        """The same where somebody named the firmware: what is computed without a dish guesses none."""
        return self.model if self.firmware_given else None

    @property
    def beam(self) -> Beam | None:
        """The beam of the dish that was named, with the active feed; None if it is not known."""
        from birdcage.base.beam import beam_of

        model = self.named_model
        return beam_of(self.settings.active_feed, None if model is None else model.reflector)


def flags() -> Flags:
    """Return the flags of the command under way."""
    return click.get_current_context().ensure_object(Flags)


def _keep(context: click.Context, parameter: click.Parameter, value: Any) -> None:  # noqa: ANN401 - click's signature
    given = context.find_root().ensure_object(Flags)
    if value not in (None, False, 0) and parameter.name is not None:
        given.values[parameter.name] = value
        if parameter.name in ("verbose", "log"):
            _log(context, given)


def _log(context: click.Context, given: Flags) -> None:
    from pathlib import Path

    from birdcage.base.errors import ConfigError
    from birdcage.base.log_output import LogOutput
    from birdcage.cli.say import say

    root = context.find_root()
    output = root.meta.get("log")
    if output is None:
        output = root.meta["log"] = LogOutput()
        root.call_on_close(lambda: say(problem) if (problem := output.close()) else None)
    file = given.get("log")
    try:
        output.set(verbosity=given.get("verbose") or 0, file=None if file is None else Path(file))
    except ConfigError as wrong:
        raise click.UsageError(str(wrong), context) from wrong


_OPTIONS: dict[str, tuple[tuple[str, ...], dict[str, Any]]] = {
    "verbose": (
        ("-v", "--verbose"),
        {"count": True, "help": "Show decisions and changes on stderr; -vv shows every exchange too."},
    ),
    "log": (
        ("--log",),
        {"metavar": "FILE", "help": "Write all of that to FILE; four older files are kept."},
    ),
    "port": (
        ("--port",),
        {"metavar": "PORT", "help": f"Serial port or URL, or BIRDCAGE_PORT.  [default: as set, or {DEFAULT_PORT}]"},
    ),
    "firmware": (
        ("--firmware",),
        {"metavar": "NAME", "help": "Firmware, or BIRDCAGE_FIRMWARE.  [default: {default}]"},
    ),
    "baud": (
        ("--baud",),
        {"type": click.IntRange(50, 4_000_000), "help": "Speed of the port.  [default: as set, or the firmware's]"},
    ),
    "json": (("--json",), {"is_flag": True, "help": "Print data as JSON."}),
    "config": (("--config",), {"type": click.Path(), "help": "Another birdcage.toml."}),
}


def global_options(*names: str, firmware: str = ASKED) -> Callable[[AnyCallable], AnyCallable]:
    """Add the global options, or those named, to a command. `flags` and `wanted` return what they hold.

    `firmware`: what the help of this command says of the firmware that counts when none is named.
    """

    def decorate(function: AnyCallable) -> AnyCallable:
        listed = [each for name in names for each in ((name, "log") if name == "verbose" else (name,))]
        for name in reversed(listed or tuple(_OPTIONS)):
            declarations, attributes = _OPTIONS[name]
            told = {**attributes, "help": attributes["help"].replace("{default}", firmware)}
            function = click.option(*declarations, name, callback=_keep, expose_value=False, **told)(function)
        return function

    return decorate


def find_paths() -> Paths:
    """Return where files live; ConfigError for a `--config` that names no file."""
    from pathlib import Path

    from birdcage.base.errors import ConfigError
    from birdcage.base.paths import Paths

    paths, chosen = Paths.default(), flags().get("config")
    if chosen is None:
        return paths
    if not Path(chosen).is_file():
        raise ConfigError(f"{chosen} (--config) is not a file.")
    return paths.with_config(Path(chosen))


def load_settings(paths: Paths, own: Mapping[str, object] | None = None) -> Settings:
    """Return the settings with the flags of this command over them; `own` are those that no other command has."""
    from birdcage.base.config import load

    return load(paths.config_file, flags=_flags_over(own))


def _flags_over(own: Mapping[str, object] | None) -> dict[str, object]:
    given = flags()
    over = {"dish.port": given.get("port"), "dish.firmware": given.get("firmware"), "dish.baud": given.get("baud")}
    return {**over, **(own or {})}


def wanted(own: Mapping[str, object] | None = None) -> Wanted:
    """Return which dish is meant, and say what in the settings could not be read.

    `own`: settings by dotted key that this command has flags for; None among them was not given.
    """
    from birdcage.cli.say import say

    paths = find_paths()
    settings = load_settings(paths, own)
    for problem in settings.problems:
        say(problem.text)
    dish = settings.dish
    return Wanted(
        port=dish.port or DEFAULT_PORT,
        port_given=dish.port is not None,
        firmware=dish.firmware or DEFAULT_FIRMWARE,
        firmware_given=dish.firmware is not None,
        baud=dish.baud,
        settings=settings,
        paths=paths,
        flags=_flags_over(own),
    )
