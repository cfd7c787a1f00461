"""Step 5: which feed is fitted."""

from __future__ import annotations

import re
from collections.abc import Mapping

from birdcage.base.beam import Beam, beam_of
from birdcage.base.config import STOCK_FEED, FeedProfile, feed_label
from birdcage.base.config.edit import Value
from birdcage.setup.step import Choice, Field, NoSuchChoice
from birdcage.setup.steps.base import Plan, Step
from birdcage.setup.typed import band_hz, frequency_hz, optional_number, yes

STOCK = "stock-ku"
MOST_FEEDS = 8


class FeedStep(Step):
    """The built-in stock feed, one that is in the file, or a new one."""

    name = "feed"
    title = "Feed"

    def words(self) -> tuple[str, ...]:
        """Say what depends on it, and how wide the stock feed's beam is."""
        beam = self._beam(self.bench.settings.feeds[STOCK])
        told = "Its band and the dish's reflector make the beam." if beam is None else f"Stock beam: {beam.words}."
        dish = self.bench.state.dish
        return (
            "Which feed is fitted? Frequencies and offsets come from it, and whether the dish may fold flat.",
            told,
            "Stow folds the dish onto the feed: allow it only for a feed that fits under it.",
            *((dish.handling.coax,) if dish is not None and dish.handling.coax else ()),
        )

    def choices(self) -> tuple[Choice, ...]:
        """Name the feeds that there are, and a new one."""
        feeds = self.bench.settings.feeds
        own = [name for name in feeds if name != STOCK][:MOST_FEEDS]
        return (
            Choice("stock", "enter", f"Stock LNB{self._told(feeds[STOCK])}"),
            *(Choice(f"feed-{key}", str(key), f"{name}{self._told(feeds[name])}") for key, name in enumerate(own, 1)),
            Choice("other", "n", "Another feed", fields=(
                Field("name", "name", hint="L-band helix"),
                Field("band", "band", "", "1670 to 1710 MHz"),
                Field("beam_deg", "beam", "deg", "2.0 x 2.9; empty: theory"),
                Field("lo_hz", "LO", "MHz", "9750; empty for none"),
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
                raise NoSuchChoice("Give the feed its own name, without a full stop.")
            low_hz, high_hz = band_hz(values, "band", "band")
            beam_deg, beam_az_deg, beam_el_deg = _widths(values)
            keys: dict[str, Value] = {
                f"feed.{name}.freq_min_hz": low_hz,
                f"feed.{name}.freq_max_hz": high_hz,
                f"feed.{name}.beam_deg": beam_deg,
                f"feed.{name}.beam_az_deg": beam_az_deg,
                f"feed.{name}.beam_el_deg": beam_el_deg,
                f"feed.{name}.lo_hz": frequency_hz(values, "lo_hz", "LO"),
                f"feed.{name}.az_offset_deg": optional_number(values, "az_offset_deg", "az offset", -45, 45) or 0.0,
                f"feed.{name}.el_offset_deg": optional_number(values, "el_offset_deg", "el offset", -45, 45) or 0.0,
                f"feed.{name}.stow_allowed": yes(values, "stow", "stow allowed"),
            }
            self._mount(name, keys)
        else:
            own = [name for name in self.bench.settings.feeds if name != STOCK]
            self._mount(own[int(choice.removeprefix("feed-")) - 1], {})

    def _beam(self, feed: FeedProfile) -> Beam | None:
        """Return the beam of this dish with a feed; None if it is not known, as before the dish is."""
        dish = self.bench.state.dish
        return beam_of(feed, None if dish is None else dish.reflector)

    def _told(self, feed: FeedProfile) -> str:
        """Return a feed's band and beam, after its name."""
        beam, band = self._beam(feed), ""
        if feed.freq_min_hz is not None and feed.freq_max_hz is not None:
            band = f", {feed.freq_min_hz / 1e9:g} to {feed.freq_max_hz / 1e9:g} GHz"
        return band + ("" if beam is None else f", beam {beam.size} {beam.origin.brief}")

    def _mount(self, name: str, keys: dict[str, Value]) -> None:
        self.bench.write({**keys, "feed.active": name})
        self.begin(self._apply(name), "telling the station")

    def _apply(self, name: str) -> Plan:
        yield self.bench.apply()
        feed = self.bench.settings.feeds.get(name, STOCK_FEED)
        self.bench.done(self.name, _described(name, feed, self._beam(feed))
                        + self.bench.overridden("feed.active"))  # fmt: skip


def _widths(values: Mapping[str, str]) -> tuple[float | None, float | None, float | None]:
    """Return the width that was typed: of a round beam, or in azimuth and elevation: `2.0 x 2.9`."""
    parts = re.split(r"\s*[x×]\s*", values.get("beam_deg", "").strip())
    if len(parts) > 2:
        raise NoSuchChoice("beam: type one width, or two: 2.0 x 2.9.")
    widths = [optional_number({"beam_deg": part}, "beam_deg", "beam", 0.01, 180.0) for part in parts]
    if len(parts) == 1:
        return widths[0], None, None
    if None in widths:
        raise NoSuchChoice("beam: type one width, or two: 2.0 x 2.9.")
    return None, widths[0], widths[1]


def _described(name: str, feed: FeedProfile, beam: Beam | None) -> str:
    parts = [feed_label(name)]
    if beam is not None:
        parts.append(f"beam {beam.words}")
    if feed.lo_hz:
        parts.append(f"LO {feed.lo_hz / 1e6:g} MHz")
    if feed.az_offset_deg or feed.el_offset_deg:
        parts.append(f"offset {feed.az_offset_deg:+.2f}/{feed.el_offset_deg:+.2f} deg")
    parts.append("stow allowed" if feed.stow_allowed else "stow locked")
    return ", ".join(parts)
