"""The section of `birdcage.toml` about the network: Hamlib's rotator protocol over TCP."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar, Literal

from birdcage.base.config.field import Complaint, Section, setting

if TYPE_CHECKING:
    from ipaddress import IPv4Network, IPv6Network


@dataclass(frozen=True, slots=True)
class RotctldSettings(Section):
    """`[rotctld]`: the dish for Gpredict, SatNOGS, SatDump and Hamlib's own tools."""

    section: ClassVar[str] = "rotctld"

    in_app: bool = setting(False, "Serve from the start of the app on; `o` on the tab Network does it by hand.")
    host: str = setting(
        "127.0.0.1", "Address to listen at; any but 127.0.0.1 lets other computers move the dish.",
        env="BIRDCAGE_LISTEN_HOST",
    )  # fmt: skip
    port: int = setting(
        4533, "TCP port to listen at; 0: any that is free.", minimum=0, maximum=65_535, env="BIRDCAGE_LISTEN_PORT"
    )
    allow: str | None = setting(
        None, "Networks whose programs may connect, with commas: 192.168.1.0/24, fd00::/8; not set: all."
    )
    read_only: bool = setting(False, "Clients may look, and move nothing.")
    strict: bool = setting(
        False, "Answer a wish that is not carried out with an error (-9); Gpredict disengages after six of them."
    )
    gap: Literal["hold", "error"] = setting(
        "hold", "While the link is lost: hold repeats the last position, and the newest wish is sent when the dish is "
        "back. error: clients get errors.",
    )  # fmt: skip
    gap_s: float = setting(20.0, "The longest loss of the link that is held over.", minimum=1.0, maximum=120.0)
    drive_s: float = setting(2.0, "How long `M` moves the dish unless it is sent again.", minimum=0.2, maximum=30.0)
    idle_s: float = setting(
        120.0, "Park after so long without a wish, once the client that moved the dish has left; 0: never.",
        minimum=0.0, maximum=86_400.0,
    )  # fmt: skip
    smoother: Literal["off", "on", "auto"] = setting(
        "auto", "Follow the target of a stream of wishes, ahead by the latency. auto: of even streams; on: of uneven "
        "ones too; off: go from wish to wish.",
    )  # fmt: skip
    recognise: bool = setting(
        True, "Tell from its wishes which satellite a client follows, and follow that by a plan of birdcage's own."
    )
    most_clients: int = setting(600, "How many may be connected at once.", minimum=1, maximum=700)
    commands_per_s: float = setting(
        5000.0, "How many commands of one client are answered in a second; more of them wait.",
        minimum=1.0, maximum=1_000_000.0,
    )  # fmt: skip
    unread_s: float = setting(
        15.0, "How long a client may leave its answers unread, once its connection is full.", minimum=1.0,
        maximum=3600.0,
    )  # fmt: skip
    silent_s: float = setting(
        0.0, "Hang up on a client that has sent nothing for so long; 0: never.", minimum=0.0, maximum=86_400.0
    )

    @property
    def networks(self) -> tuple[IPv4Network | IPv6Network, ...]:
        """Whose programs may connect; empty: all. ValueError where `allow` is no list of networks."""
        import ipaddress  # where a server is to listen: a face paints without it

        names = [] if self.allow is None else [name.strip() for name in self.allow.split(",")]
        return tuple(ipaddress.ip_network(name, strict=False) for name in names)

    def complaints(self) -> Iterator[Complaint]:
        """Yield networks that are none."""
        try:
            self.networks  # noqa: B018 - it is read to see whether it can be
        except ValueError as error:
            yield "allow", f"is no list of networks: {error}"
