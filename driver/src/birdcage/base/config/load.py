"""Reads `birdcage.toml`, the variables over it and the flags over both. The file is never written."""

from __future__ import annotations

import dataclasses
import os
from collections.abc import Iterable, Mapping
from pathlib import Path
from types import MappingProxyType
from typing import Any, TypeVar

from birdcage.base.config.document import Document, read_document
from birdcage.base.config.fact_sections import FACT_PARTS, FACT_SECTIONS, OwnFactSettings
from birdcage.base.config.feeds import BUILT_IN, FeedProfile, FeedSettings
from birdcage.base.config.field import Section
from birdcage.base.config.schema import NAMED, SECTIONS, KeyRow, rows_of
from birdcage.base.config.sections import DishSettings
from birdcage.base.config.settings import Problem, Settings, Source
from birdcage.base.config.signals import OWN_TUNER, PRESETS, RECEIVER, SignalProfile
from birdcage.base.config.value import BadValue, did_you_mean, from_text, from_toml, nearest
from birdcage.base.machine_port import machine_at
from birdcage.base.text import clean, clean_all

S = TypeVar("S", bound=Section)

PLAIN_SECTIONS = tuple(
    each for each in SECTIONS if each not in (DishSettings, *FACT_SECTIONS, FeedSettings, *NAMED.values())
)
"""Sections that hold nothing but their keys. Each is the field of `Settings` that has its name."""


def load(
    path: Path | None,
    environ: Mapping[str, str] | None = None,
    flags: Mapping[str, object] | None = None,
) -> Settings:
    """Return the settings, whatever state the file is in; `Settings.problems` says what could not be read.

    `path` None, or a file that is not there, gives the defaults. `environ` is by default the process's own.
    `flags` are values by dotted key (`{"dish.port": "COM4"}`); None among them means that the flag was not given.
    """
    reader = _Reader(
        read_document(path),
        os.environ if environ is None else environ,
        {key: clean_all(value) for key, value in (flags or {}).items() if value is not None},
    )
    return reader.settings()


class _Reader:
    """Collects sections and what is wrong with them."""

    def __init__(self, document: Document, environ: Mapping[str, str], flags: Mapping[str, object]) -> None:
        self._document = document
        self._environ = environ
        self._flags = flags
        self._problems = list(document.problems)
        self._sources: dict[str, Source] = {}

    def settings(self) -> Settings:
        """Read every section."""
        self._check_sections()
        signals = self._signals()
        feed, feeds = self._feeds(signals)
        dish, facts = self._dish()
        plain: dict[str, Any] = {section.section: self._plain(section) for section in PLAIN_SECTIONS}
        return Settings(
            dish=dish,
            facts=facts,
            feed=feed,
            feeds=feeds,
            signals=signals,
            **plain,
            problems=tuple(self._problems),
            sources=MappingProxyType(self._sources),
        )

    def _check_sections(self) -> None:
        known = {section.section: section for section in SECTIONS if "." not in section.section}
        known["signal"] = SignalProfile
        for name, value in self._document.data.items():
            if name in known:
                continue
            near = nearest(name, known)
            what = "is no section" if isinstance(value, dict) else "stands outside every section"
            # What was meant to limit motion and doesn't is worse than a refusal too many.
            limits = near is None or known[near].limits_motion or not isinstance(value, dict)
            self._complain((name,), what + did_you_mean(name, known), limits_motion=limits)

    def _table(self, section: type[Section]) -> dict[str, object]:
        value = self._document.data.get(section.section, {})
        if isinstance(value, dict):
            return value
        what = f"is a value, where a section [{section.section}] belongs"
        self._complain((section.section,), what, limits_motion=section.limits_motion)
        return {}

    def _plain(self, section: type[S]) -> S:
        return self._section(section(), self._table(section), (section.section,), section.limits_motion)

    def _dish(self) -> tuple[DishSettings, Mapping[str, Section]]:
        table = dict(self._table(DishSettings))
        facts = self._part_of(table, ("dish", "facts"))
        # A table here is a mistyped [dish.facts], which may hold a limit.
        limits = any(isinstance(value, dict) for value in table.values())
        dish = self._section(DishSettings(), table, ("dish",), limits, also=("facts",))
        dish = self._with_named_machine(dish)
        names = [section.section.rpartition(".")[2] for section in FACT_PARTS]
        parts = {name: self._part_of(facts, ("dish", "facts", name)) for name in names}
        read: dict[str, Section] = {}
        for section in FACT_SECTIONS:
            path = tuple(section.section.split("."))
            of_machine = section is OwnFactSettings
            own = facts if of_machine else parts[path[-1]]
            also = names if of_machine else ()
            read[section.section] = self._section(section(), own, path, limits_motion=True, also=also)
        return dish, MappingProxyType(read)

    def _with_named_machine(self, dish: DishSettings) -> DishSettings:
        """Return the dish as its port names it, where that has a machine's own scheme: no other answers there."""
        named = machine_at(dish.port)
        if named is None or dish.firmware == named:
            return dish
        if dish.firmware is not None:
            what = f"is {dish.firmware!r}, and does not count: {dish.port} is a port of {named!r}"
            self._complain(("dish", "firmware"), what, limits_motion=False)
        self._sources["dish.firmware"] = "port"
        return dataclasses.replace(dish, firmware=named)

    def _part_of(self, table: dict[str, object], path: tuple[str, ...]) -> dict[str, object]:
        """Take a table out of the one that it stands in; empty if it is not there, or is none."""
        value = table.pop(path[-1], {})
        if isinstance(value, dict):
            return dict(value)
        self._complain(path, f"is a value, where a section [{'.'.join(path)}] belongs", limits_motion=True)
        return {}

    def _signals(self) -> Mapping[str, SignalProfile]:
        table = self._document.data.get("signal", {})
        signals = dict(PRESETS)
        for name, values in (table if isinstance(table, dict) else {"": table}).items():
            if not isinstance(values, dict):
                path = ("signal", name) if name else ("signal",)
                self._complain(path, "is a value, where a section [signal.NAME] belongs", limits_motion=False)
            elif name in (OWN_TUNER, RECEIVER):
                self._complain(("signal", name), "is a name that is taken. Choose another", limits_motion=False)
            else:
                base = PRESETS.get(name, SignalProfile())
                signals[name] = self._section(base, values, ("signal", name), limits_motion=False)
        return MappingProxyType(signals)

    def _with_known_signal(self, name: str, feed: FeedProfile, signals: Mapping[str, SignalProfile]) -> FeedProfile:
        """Return a feed that reads a signal which there is."""
        if feed.signal in (OWN_TUNER, RECEIVER) or feed.signal in signals:
            return feed
        known = (OWN_TUNER, RECEIVER, *signals)
        what = f"is {feed.signal!r}, and there is no [signal.{feed.signal}]{did_you_mean(feed.signal, known)}"
        self._complain(("feed", name, "signal"), what, limits_motion=False)
        return dataclasses.replace(feed, signal=OWN_TUNER)

    def _feeds(self, signals: Mapping[str, SignalProfile]) -> tuple[FeedSettings, Mapping[str, FeedProfile]]:
        table = self._table(FeedSettings)
        tables = {key: value for key, value in table.items() if isinstance(value, dict)}
        rest = {key: value for key, value in table.items() if key not in tables}
        feed = self._section(FeedSettings(), rest, ("feed",), limits_motion=True)
        feeds = dict(BUILT_IN)
        for name, values in tables.items():
            # A mistake in a feed that hangs on the wall keeps no dish from moving.
            limits = name == feed.active
            read = self._section(BUILT_IN.get(name, FeedProfile()), values, ("feed", name), limits)
            feeds[name] = self._with_known_signal(name, read, signals)
        if feed.active not in feeds:
            what = f"is {feed.active!r}, and there is no [feed.{feed.active}]{did_you_mean(feed.active, feeds)}"
            self._complain(("feed", "active"), what, limits_motion=True)
            feed = FeedSettings()
        return feed, MappingProxyType(feeds)

    def _section(
        self, base: S, table: dict[str, object], path: tuple[str, ...], limits_motion: bool, also: Iterable[str] = ()
    ) -> S:
        """Read one section: the file's table over `base`, then variables and flags over it.

        `also`: what else may stand there, for whoever mistypes it.
        """
        known = rows_of(type(base))
        values: dict[str, object] = {}
        for key, value in table.items():
            if key not in known:
                self._complain(
                    (*path, key), f"is no setting{did_you_mean(key, (*known, *also))}", limits_motion=limits_motion
                )
                continue
            try:
                values[key] = from_toml(known[key], value)
                self._sources[".".join((*path, key))] = "file"
            except BadValue as error:
                self._complain((*path, key), str(error), limits_motion=limits_motion)
        for row in known.values():
            self._override(row, ".".join((*path, row.key)), values, limits_motion)
        read: S = dataclasses.replace(base, **values)  # type: ignore[type-var]
        complaints = list(read.complaints())
        for key, what in complaints:
            self._complain((*path, key), what, limits_motion=limits_motion)
        if complaints:
            # Keys that contradict each other: which is wrong is unknown, so the section keeps its defaults.
            for key in values:
                self._sources.pop(".".join((*path, key)), None)
            return base
        return read

    def _override(self, row: KeyRow, dotted: str, values: dict[str, object], limits_motion: bool) -> None:
        text = clean(self._environ.get(row.env, "")) if row.env else None
        culprit = row.env
        try:
            if text:
                values[row.key] = from_text(row, text)
                self._sources[dotted] = "environment"
            culprit = dotted
            if dotted in self._flags:
                values[row.key] = from_toml(row, self._flags[dotted])
                self._sources[dotted] = "flag"
        except BadValue as error:
            self._problems.append(Problem(None, None, culprit, f"{culprit} {error}.", limits_motion))

    def _complain(self, path: tuple[str, ...], what: str, *, limits_motion: bool) -> None:
        key = ".".join(path)
        sentence = f"{key} {what}" if what.endswith("?") else f"{key} {what}."
        if self._sources.get(key, "file") == "file":
            self._problems.append(Problem(self._document.path, self._document.line(path), key, sentence, limits_motion))
        else:
            self._problems.append(Problem(None, None, key, sentence, limits_motion))
