"""The BCM4515 as far as the console shows it: what it is tuned to, what it hears, and what feeds the LNB.

That there are 32 transponders 14.58 MHz apart, odd ones vertical at 13 V and even ones horizontal at 18 V, is the plan
of DISH with an LO of 11.25 GHz: number 15 comes to the 1178 MHz that the notes name (docs/reference/g2-signal.md,
*Tuner*). The plan and the network ids are assumed.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

from birdcage.sim.chance import seeded

if TYPE_CHECKING:
    from birdcage.sim.g2.board import G2Board

TRANSPONDERS = 32
FIRST_KHZ, SPACING_KHZ = 974_000, 14_580
SYMBOL_RATE_KSPS = 20_000
"""Inside the blind scan's 18000 to 24000 (docs/reference/g2.md, *Power-up*)."""
PULL_IN_KHZ = 3_000
"""So far off it still locks (assumed)."""
HORIZONTAL_V, VERTICAL_V = 18.0, 13.0
NO_NETWORK = 0xFFFF
NETWORKS = {
    -61.5: 0x1003,
    -72.7: 0x1008,
    -77.0: 0x1006,
    -91.0: 0x0100,
    -110.0: 0x1002,
    -119.0: 0x1001,
    -129.0: 0x1004,
}
"""Slot in degrees east to the network that it carries; the slots of `sky.SLOTS` left out send none (assumed)."""


@dataclass(frozen=True, slots=True)
class TunerReading:
    """One look of the tuner."""

    rssi: int
    """Counts, with the noise of one reading."""
    locked: bool
    snr_db: float
    """0 without lock."""
    network: int = NO_NETWORK
    """The network id that it reads; FFFF for none."""


@dataclass(frozen=True, slots=True)
class TunerChannel:
    """What the tuner is set to."""

    frequency_khz: int
    """Behind the LNB."""
    symbol_rate_ksps: int
    polarity: str
    """`H` or `V`."""

    @property
    def volts(self) -> float:
        """The LNB voltage that selects its polarity."""
        return VERTICAL_V if self.polarity == "V" else HORIZONTAL_V


def plan(transponder: int) -> TunerChannel:
    """Return the channel of a transponder, 1 to 32."""
    frequency = FIRST_KHZ + (transponder - 1) * SPACING_KHZ
    return TunerChannel(frequency, SYMBOL_RATE_KSPS, "V" if transponder % 2 else "H")


@dataclass(slots=True)
class TunerCounts:
    """What the tuner counts from power-on or `def` on."""

    reads: int = 0
    no_signal: int = 0
    glitches: int = 0
    """Locks that were lost from one read to the next."""
    locked: bool = False
    lowest: int = 0
    highest: int = 0
    networks: dict[int, int] = field(default_factory=dict)

    def count(self, heard: TunerReading) -> None:
        """Take one look into account."""
        self.lowest = min(self.lowest, heard.rssi) if self.reads else heard.rssi
        self.highest = max(self.highest, heard.rssi)
        self.reads += 1
        self.no_signal += not heard.locked
        self.glitches += self.locked and not heard.locked
        self.locked = heard.locked
        if heard.network != NO_NETWORK:
            self.networks[heard.network] = self.networks.get(heard.network, 0) + 1


class SimTuner:
    """Hears what the dish points at. All times are seconds of dish time."""

    def __init__(self, board: G2Board) -> None:
        self._board = board
        self._rng = seeded("rssi", board.settings.seed)
        self.power_on()

    def power_on(self) -> None:
        """Forget what it was told: 18 V, the receiver on, the channels of the factory."""
        self.lnb_volts = HORIZONTAL_V
        self.on = True
        self.switch_port = self._board.settings.switch_port
        """Of the DiSEqC switch on the cable; 0 for no switch."""
        self.restore()

    def restore(self) -> None:
        """Put the channels back to the factory's and begin to count anew."""
        self.channels = {number: plan(number) for number in range(1, TRANSPONDERS + 1)}
        self.order = list(self.channels)
        """The transponders as the table goes through them."""
        self.transponder = min(max(self._board.settings.transponder, 1), TRANSPONDERS)
        self.tally = TunerCounts()

    @property
    def channel(self) -> TunerChannel:
        """What it is tuned to."""
        return self.channels[self.transponder]

    def select(self, transponder: int) -> None:
        """Tune to a transponder; the LNB keeps its voltage.

        Raises:
            ValueError: there is no such transponder.

        """
        if transponder not in self.channels:
            raise ValueError(transponder)
        self.transponder = transponder

    def edit(self, **changes: int | str) -> None:
        """Change fields of the channel that it is tuned to, until the next power-on or `def`."""
        self.channels[self.transponder] = replace(self.channel, **changes)  # type: ignore[arg-type]

    def level(self, dish_s: float) -> tuple[float, float]:
        """Return the counts without noise, and how many of them are above the empty sky."""
        board = self._board
        if not self.on:
            return 0.0, 0.0
        az, el = board.dish.shafts(dish_s)
        level = board.level(dish_s, az, el)
        offset = board.settings.lnb_13v_counts if self.lnb_volts == VERTICAL_V else 0.0
        return level + offset, level - board.sky.floor(board.stance.beam(az, el)[1])

    def read(self, dish_s: float) -> TunerReading:
        """Look once."""
        settings = self._board.settings
        level, above = self.level(dish_s)
        noise = self._rng.gauss(0.0, settings.rssi_noise)
        heeds = above >= settings.lock_counts and self._tuned()
        network = self._network_in_view(dish_s) if heeds else None
        locked = network is not None
        rssi = max(round(level + noise), 0) if self.on else 0
        snr = max(above + noise, 0.0) / settings.snr_counts if locked else 0.0
        heard = TunerReading(rssi, locked, snr, (network or NO_NETWORK) if locked else NO_NETWORK)
        self.tally.count(heard)
        return heard

    def survey(self, transponder: int, dish_s: float) -> TunerReading:
        """Look at a transponder with the LNB at its voltage, then go back to what was set."""
        before = self.transponder, self.lnb_volts
        self.select(transponder)
        self.lnb_volts = self.channel.volts
        heard = self.read(dish_s)
        self.transponder, self.lnb_volts = before
        return heard

    def _network_in_view(self, dish_s: float) -> int | None:
        """Return the network of the strongest satellite in the beam, 0 if that sends none; None without a satellite."""
        board = self._board
        az, el = board.dish.shafts(dish_s)
        slot = board.sky.strongest(*board.stance.beam(az, el))
        return None if slot is None else NETWORKS.get(slot, 0)

    def _tuned(self) -> bool:
        """Whether channel and LNB fit a transponder that is sent."""
        channel = self.channel
        number = min(max(round((channel.frequency_khz - FIRST_KHZ) / SPACING_KHZ) + 1, 1), TRANSPONDERS)
        sent = plan(number)
        return (
            abs(channel.frequency_khz - sent.frequency_khz) <= PULL_IN_KHZ
            and channel.symbol_rate_ksps == sent.symbol_rate_ksps
            and (not self._board.settings.lock_polarity or self.lnb_volts == sent.volts)
        )
