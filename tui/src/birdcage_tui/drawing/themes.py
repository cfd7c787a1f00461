"""Three looks: `dusk` (ground nearly black), `daylight` (for the sun) and `night` (red only, for dark-adapted eyes)."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from rich.style import Style
from textual.theme import Theme


def _luminance(colour: str) -> float:
    channels = [int(colour[index : index + 2], 16) / 255 for index in (1, 3, 5)]
    red, green, blue = (c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in channels)
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue


def contrast(one: str, other: str) -> float:
    """Return the contrast of two colours, `#rrggbb`, from 1 to 21 (WCAG 2.1, section 1.4.3)."""
    high, low = sorted((_luminance(one), _luminance(other)), reverse=True)
    return (high + 0.05) / (low + 0.05)


@dataclass(frozen=True)
class ThemeColours:
    """The colours of one theme, as `#rrggbb`. A state always has a glyph and a word besides its colour."""

    name: str
    ground: str
    raised: str
    """Ground of rows and keys that stand out a little."""
    text: str
    dim: str
    faint: str
    """Hatching: fainter than a line, and never the only sign of anything."""
    line: str
    """Frames and grids."""
    focus: str
    """The frame of the pane that has the focus."""
    accent: str
    """The dish, and what you command."""
    target: str
    """What you are pointing at."""
    good: str
    warn: str
    fault: str
    dark: bool = True
    row: str = ""
    """Ground of rows that must be seen, with `fault` as their ink; empty: the state's own colour, inked in `ground`."""

    @cached_property
    def inks(self) -> dict[str, Style]:
        """Styles by name. Every one carries its ground: line-API widgets get none by themselves."""
        plain = ("text", "dim", "faint", "line", "accent", "target", "good", "warn", "fault")
        inks = {ink: Style(color=getattr(self, ink), bgcolor=self.ground) for ink in plain}
        inks["strong"] = Style(color=self.text, bgcolor=self.ground, bold=True)
        inks["big"] = Style(color=self.accent, bgcolor=self.ground, bold=True)
        for ink in ("accent", "target", "good", "warn", "fault"):
            inks[f"{ink}-strong"] = Style(color=getattr(self, ink), bgcolor=self.ground, bold=True)
            colour, back = (self.fault, self.row) if self.row else (self.ground, getattr(self, ink))
            inks[f"{ink}-row"] = Style(color=colour, bgcolor=back, bold=True)
        inks["key"] = Style(color=self.text, bgcolor=self.raised, bold=True)
        inks["bar"] = Style(color=self.text, bgcolor=self.raised)
        inks["bar-warn"] = Style(color=self.warn, bgcolor=self.raised, bold=True)
        inks["bar-dim"] = Style(color=self.dim, bgcolor=self.raised)
        return inks

    def theme(self) -> Theme:
        """Return it as Textual wants it."""
        return Theme(
            name=self.name,
            primary=self.accent,
            secondary=self.target,
            accent=self.accent,
            warning=self.warn,
            error=self.fault,
            success=self.good,
            foreground=self.text,
            background=self.ground,
            surface=self.ground,
            panel=self.raised,
            boost=self.raised,
            dark=self.dark,
            text_alpha=1.0,
            variables={
                "line": self.line,
                "focus": self.focus,
                "dim": self.dim,
                "block-cursor-foreground": self.ground,
                "block-cursor-background": self.accent,
                "input-cursor-background": self.text,
                "input-cursor-foreground": self.ground,
                "border": self.focus,
                "border-blurred": self.line,
            },
        )


LOOKS = {
    look.name: look
    for look in (
        ThemeColours(
            name="dusk",
            ground="#0b0e12",
            raised="#171d25",
            text="#dde3ea",
            dim="#8e99a6",
            faint="#2b3540",
            line="#3d4854",
            focus="#7f95ad",
            accent="#63c7f2",
            target="#f3d264",
            good="#b5d6c3",
            warn="#ff9438",
            fault="#ff6b7d",
        ),
        ThemeColours(
            name="daylight",
            ground="#ffffff",
            raised="#e9edf1",
            text="#0c1116",
            dim="#4a545f",
            faint="#c8cfd6",
            line="#a4aeb8",
            focus="#3f5366",
            accent="#00459a",
            target="#846800",
            good="#24503a",
            warn="#8a2a00",
            fault="#c2004a",
            dark=False,
        ),
        ThemeColours(
            name="night",
            ground="#000000",
            raised="#1c0000",
            text="#ff2a1a",
            dim="#c82014",
            faint="#5e0d07",
            line="#6a0f08",
            focus="#cc2115",
            accent="#ff3a2a",
            target="#ff2a1a",
            good="#ff2a1a",
            warn="#ff2a1a",
            fault="#ff4a3a",
            row="#4a0000",
        ),
    )
}
DEFAULT = "dusk"
