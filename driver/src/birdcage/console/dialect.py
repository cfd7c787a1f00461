"""What a console looks like from outside, as data. Dialects declare it; the codec and the session read it."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property

from birdcage.base.errors import CommandRefused
from birdcage.base.reason import Reason
from birdcage.base.trouble import MotorTrouble
from birdcage.console.events import Reply

UNKNOWN_TOKEN = ""
"""Stands for a prompt that no source tells: it is learnt from the dish (decision 0010)."""


@dataclass(frozen=True)
class ConsoleDialect:
    """The grammar of one firmware's console."""

    prompts: Mapping[str, str]
    """Menu name to prompt token: `{"root": "TRK>", "mot": "MOT>"}`. Submenus are entered by their name.

    All tokens are known, and differ; or all are `UNKNOWN_TOKEN`: then they are learnt, and may be alike.
    """
    parents: Mapping[str, str] = field(default_factory=dict)
    """By menu, the one that it is entered in and left to, where that is not the root: `{"mot": "odu"}`.

    Where prompts are learnt, such a menu has `submenu_marks` that its parent does not list.
    """
    one_way: frozenset[str] = frozenset()
    """Menus that nothing is known to leave, but a power cycle: `leave` is as little sent there as at the root.

    Where prompts are learnt they have `submenu_marks`, which no other menu's help lists.
    """
    root: str = "root"
    leave: str = "q"
    """Leaves a submenu. At the root it may kill the shell until a power cycle: see `Console.leave`."""
    gap_s: float = 0.0
    """The least time from one line to the next, in seconds: what comes sooner may be lost. STOP does not wait for it.
    """
    gaps_s: Mapping[str, float] = field(default_factory=dict)
    """What it is instead after a line that stays in one of these menus."""
    line_end: bytes = b"\r"
    echo: bool = True
    refusals: tuple[tuple[re.Pattern[str], Reason], ...] = ()
    """Reply lines that mean that nothing was done, each with the `CommandRefused` reason it stands for."""
    live: re.Pattern[str] | None = None
    """What it prints by itself while its motors run: unasked, but no noise. None if it prints nothing then."""
    troubles: tuple[tuple[re.Pattern[str], bool], ...] = ()
    """Lines that tell of a motor in trouble: the group `axis` names it, and whether it failed to find its reference."""
    axis_names: Mapping[str, str] = field(default_factory=dict)
    """The names of axes by what `axis` then holds, in capitals."""
    root_marks: frozenset[str] = frozenset()
    """Commands that only the root's help of this firmware lists: they tell it from others, and from its submenus."""
    root_is_own: bool = True
    """Whether no other console is known to list all `root_marks`. Else they tell the root, and no firmware for certain.
    """
    root_hints: frozenset[str] = frozenset()
    """Further commands that no submenu's help lists: what lists one is no submenu, though it may be no root either."""
    submenu_marks: Mapping[str, frozenset[str]] = field(default_factory=dict)
    """Commands that the help of a submenu lists, by menu. Until the root was seen, nothing else counts as a submenu."""
    own_marks: frozenset[str] = frozenset()
    """Commands of submenus that no other firmware is known to list."""
    proofs: Mapping[str, tuple[str, re.Pattern[str]]] = field(default_factory=dict)
    """By submenu, a question that changes nothing, and what only this menu of this firmware answers."""
    stranger_marks: frozenset[str] = frozenset()
    """Commands in a menu's help that show, where no root mark stands beside them, that this is another firmware."""
    foreign_marks: frozenset[str] = frozenset()
    """Commands in a menu's help that show another firmware, whatever stands beside them."""
    stranger: str = ""
    """What to say to a person whose dish is another firmware; `{prompt}` is what it shows. Empty: nothing is said."""

    def trouble_in(self, text: str) -> MotorTrouble | None:
        """Return what a line says of a motor; None for any other line."""
        for pattern, homing in self.troubles:
            if found := pattern.search(text):
                return MotorTrouble(self.axis_names[found["axis"].upper()], homing, text.strip())
        return None

    def refusal_in(self, reply: Reply) -> CommandRefused | None:
        """Return what the firmware's error in a reply means; None when it holds none."""
        for line in reply.lines:
            for pattern, reason in self.refusals:
                if pattern.search(line):
                    return CommandRefused(
                        f"The dish refused `{reply.command}` in menu `{reply.menu}`: {line.strip()}",
                        reason=reason,
                        trouble=self.trouble_in(line),
                    )
        return None

    def __post_init__(self) -> None:
        """Raise ValueError where a menu has no way to the root."""
        for menu in self.parents:
            if not {menu, self.parents[menu]} <= set(self.prompts) or not self.path(menu):
                raise ValueError(f"menu {menu!r} does not lead to the root")

    def parent(self, menu: str) -> str:
        """Return the menu that a submenu is left to."""
        return self.parents.get(menu, self.root)

    def path(self, menu: str) -> tuple[str, ...]:
        """Return the menus to enter one after the other on the way from the root; empty for the root itself.

        Also where the menus go round in a circle.
        """
        path: tuple[str, ...] = ()
        while menu != self.root:
            if menu in path:
                return ()
            path, menu = (menu, *path), self.parent(menu)
        return path

    def way_out(self, menu: str) -> int:
        """Return how many menus are left on the way from one to the first that `leave` must not reach."""
        path = self.path(menu)
        return next((count for count, each in enumerate(reversed(path)) if each in self.ends), len(path))

    @property
    def depth(self) -> int:
        """How many menus lie in one another below the root, at most."""
        return max(len(self.path(menu)) for menu in (*self.prompts, ""))

    def may_hold_menus(self, menu: str) -> bool:
        """Return whether others may be entered in a menu, which may be one that goes by no name."""
        return menu == self.root or menu in self.parents.values() or (bool(self.parents) and menu not in self.prompts)

    @cached_property
    def ends(self) -> frozenset[str]:
        """The menus that `leave` must not reach: the root, and those that nothing is known to leave."""
        return self.one_way | {self.root}

    @cached_property
    def marks_of_ends(self) -> Mapping[str, frozenset[str]]:
        """What the help of each of these lists, and no other menu's."""
        return {self.root: self.root_marks, **{menu: self.submenu_marks[menu] for menu in sorted(self.one_way)}}

    def gap_after(self, line: str, menu: str | None) -> float:
        """Return the least time from a line to the next one, by the menu that it is sent in; None: not known."""
        if menu is None or self.leaving.search(line):
            return self.gap_s
        return self.gaps_s.get(menu, self.gap_s)

    @cached_property
    def learnt(self) -> bool:
        """Whether its prompts are learnt from the dish."""
        return UNKNOWN_TOKEN in self.prompts.values()

    @cached_property
    def leaving(self) -> re.Pattern[str]:
        """Found in each line that, whole or with bytes lost, could leave a menu: the letters of `leave`, in order."""
        return re.compile(".*".join(map(re.escape, self.leave)), re.IGNORECASE | re.DOTALL)
