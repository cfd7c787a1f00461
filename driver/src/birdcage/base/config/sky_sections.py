"""The sections of `birdcage.toml` that are about the sky."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar
from urllib.parse import urlsplit

from birdcage.base.config.field import Complaint, Section, setting


@dataclass(frozen=True, slots=True)
class ElementsSettings(Section):
    """Where orbital elements come from. Nothing is ever fetched but by `birdcage elements update`."""

    section: ClassVar[str] = "elements"

    groups: str | None = setting(
        None, "Which groups `birdcage elements update` fetches, with spaces between; not set: a few."
    )
    mirror_url: str | None = setting(
        None, "Your own server instead of CelesTrak and SatNOGS DB: an address in which {group} stands for the group."
    )
    deadline_s: float = setting(
        60.0, "How long the answer of a server may take as a whole.", minimum=1.0, maximum=600.0
    )
    craft_url: str | None = setting(
        None,
        "A prediction server, if you have one (`birdcage craft`); not set: none is asked.",
        env="BIRDCAGE_CRAFT_URL",
    )

    @property
    def group_names(self) -> tuple[str, ...]:
        """The groups that are named, in order; empty for the default."""
        return tuple((self.groups or "").replace(",", " ").split())

    def complaints(self) -> Iterator[Complaint]:
        """Yield addresses that are none, and a mirror without a place for the group."""
        for key, url in (("mirror_url", self.mirror_url), ("craft_url", self.craft_url)):
            if url is not None and not _is_address(url):
                yield key, f"is {url!r}, which is not an http or https address"
        if self.mirror_url is not None and "{group}" not in self.mirror_url:
            yield "mirror_url", f"is {self.mirror_url!r}, where {{group}} is missing: http://nas.local/{{group}}.json"


def _is_address(url: str) -> bool:
    try:
        parts = urlsplit(url)
        return parts.scheme in ("http", "https") and bool(parts.hostname)
    except ValueError:
        return False
