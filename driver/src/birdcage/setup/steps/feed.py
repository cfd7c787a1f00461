"""Step 5: what hangs in the focus."""

from __future__ import annotations

from collections.abc import Mapping

from birdcage.base.config import STOCK_FEED, FeedProfile
from birdcage.base.config.edit import Value
from birdcage.setup.step import Choice, Field, NoSuchChoice
from birdcage.setup.steps.base import Plan, Step
from birdcage.setup.typed import frequency_hz, optional_number, yes

STOCK = "stock-ku"
MOST_FEEDS = 8


class FeedStep(Step):
    """The built-in stock feed, one that is in the file, or a new one."""

    name = "feed"
    title = "Feed"

    def words(self) -> tuple[str, ...]:
        """Say what depends on it."""
        return (
            "What hangs in the focus? Beam, frequencies and offsets come from it, and whether the dish may fold flat.",
            "Stow folds the dish onto the feed: allow it only for a feed that fits under it.",
        )

    def choices(self) -> tuple[Choice, ...]:
        """Name the feeds that there are, and a new one."""
        feeds = self.bench.settings.feeds
        own = [name for name in feeds if name != STOCK][:MOST_FEEDS]
        stock = feeds[STOCK]
        return (
            Choice("stock", "enter", f"Stock Ku LNB, beam {stock.beam_deg:g}°"),
            *(Choice(f"feed-{key}", str(key), name) for key, name in enumerate(own, 1)),
            Choice("other", "n", "Another feed", fields=(
                Field("name", "name", hint="L-band helix"),
                Field("beam_deg", "beam", "deg", "width at half power"),
                Field("lo_hz", "LO", "Hz", "9750 MHz; empty for none"),
                Field("az_offset_deg", "az offset", "deg", "beam clockwise of the dish's axis", "0"),
                Field("el_offset_deg", "el offset", "deg", "beam above the dish's axis", "0"),
                Field("stow", "stow allowed", "", "y or n", "n"),
            )),
        )  # fmt: skip

    def take(self, choice: str, values: Mapping[str, str]) -> None:
        """Write the feed and make it the active one."""
        if choice == "stock":
            self._mount(STOCK, {})
        elif choice == "other":
            name = values.get("name", "").strip()
            if not name or "." in name or name in (STOCK, "active"):
                raise NoSuchChoice("Give the feed a name of its own, without a full stop.")
            beam_deg = optional_number(values, "beam_deg", "beam", 0.01, 180.0)
            keys: dict[str, Value] = {
                f"feed.{name}.beam_deg": beam_deg,
                f"feed.{name}.lo_hz": frequency_hz(values, "lo_hz", "LO"),
                f"feed.{name}.az_offset_deg": optional_number(values, "az_offset_deg", "az offset", -45, 45) or 0.0,
                f"feed.{name}.el_offset_deg": optional_number(values, "el_offset_deg", "el offset", -45, 45) or 0.0,
                f"feed.{name}.stow_allowed": yes(values, "stow", "stow allowed"),
            }
            self._mount(name, keys)
        else:
            own = [name for name in self.bench.settings.feeds if name != STOCK]
            self._mount(own[int(choice.removeprefix("feed-")) - 1], {})

    def _mount(self, name: str, keys: dict[str, Value]) -> None:
        self.bench.write({**keys, "feed.active": name})
        self.begin(self._apply(name), "telling the station")

    def _apply(self, name: str) -> Plan:
        yield self.bench.apply()
        self.bench.done(self.name, _described(name, self.bench.settings.feeds.get(name, STOCK_FEED))
                        + self.bench.overridden("feed.active"))  # fmt: skip


def _described(name: str, feed: FeedProfile) -> str:
    parts = ["stock Ku LNB" if name == STOCK else name]
    if feed.beam_deg is not None:
        parts.append(f"beam {feed.beam_deg:g} deg")
    if feed.lo_hz:
        parts.append(f"LO {feed.lo_hz / 1e6:g} MHz")
    if feed.az_offset_deg or feed.el_offset_deg:
        parts.append(f"offset {feed.az_offset_deg:+.2f}/{feed.el_offset_deg:+.2f} deg")
    parts.append("stow allowed" if feed.stow_allowed else "stow locked")
    return ", ".join(parts)
