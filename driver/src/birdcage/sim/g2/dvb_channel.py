"""The part of `DVB>` that tunes, lists and searches transponders (docs/reference/g2-commands.md, *DVB>*).

No source quotes what these print: every line is assumed, and named so that a person understands it.
"""

from __future__ import annotations

from collections.abc import Iterator

from birdcage.sim.chance import seeded
from birdcage.sim.g2.eeprom import whole
from birdcage.sim.g2.menu import G2Menu
from birdcage.sim.g2.tracker import Tracker
from birdcage.sim.g2.tuner import TRANSPONDERS, TunerReading
from birdcage.sim.shell import Pause, Script
from birdcage.sim.trk.menu import Command

FREQUENCIES_KHZ = 950_000, 2_150_000
SYMBOL_RATES_KSPS = 1_000, 45_000
LONGEST_MS = 60_000
POLARITIES = {"0": "H", "1": "V", "h": "H", "v": "V"}


class DvbChannel:
    """Channel parameters, tables and search."""

    def __init__(self, menu: G2Menu) -> None:
        self._menu = menu
        self._board = menu.board
        self._rng = seeded("shuffle", menu.board.settings.seed)
        self._tracker = Tracker(menu.board)
        self.commands: dict[str, Command] = {
            "dis": self._display,
            "e": self._edit,
            "freqs": self._frequencies,
            "shuf": self._shuffle,
            "srch": self._search,
            "srch_mode": self._mode,
            "t": self._select,
            "table": self._table,
            "tablex": self._extended_table,
            "tabto": self._table_timeout,
            "to": self._timeout,
        }
        self.restore()
        menu.board.at_power_on += [self.restore, self._tracker.stop]

    def restore(self) -> None:
        """Put mode and timeouts back to the factory's."""
        settings = self._board.settings
        self._search_mode = 0
        self._table_ms, self._to_ms = settings.table_timeout_ms, settings.tuner_timeout_ms

    def _rows(self) -> tuple[str, ...]:
        channel = self._board.tuner.channel
        return (
            f"  0) Frequency: {channel.frequency_khz} kHz\n",
            f"  1) Symbol Rate: {channel.symbol_rate_ksps} ksps\n",
            f"  2) LNB Polarity: {channel.polarity} ({channel.volts:.0f}V)\n",
        )

    def _display(self, args: list[str]) -> Script:  # noqa: ARG002
        yield f"Transponder: {self._board.tuner.transponder}\n" + "".join(self._rows())

    def _edit(self, args: list[str]) -> Script:
        row = args[0] if args else ""
        if row not in ("0", "1", "2") or len(args) > 2 or (len(args) == 2 and not self._set(row, args[1])):
            yield from self._menu.bad_parameter()
            return
        yield self._rows()[int(row)]

    def _set(self, row: str, text: str) -> bool:
        tuner, value = self._board.tuner, whole(text)
        if row == "2" and text.lower() in POLARITIES:
            tuner.edit(polarity=POLARITIES[text.lower()])
        elif row == "0" and value is not None and FREQUENCIES_KHZ[0] <= value <= FREQUENCIES_KHZ[1]:
            tuner.edit(frequency_khz=value)
        elif row == "1" and value is not None and SYMBOL_RATES_KSPS[0] <= value <= SYMBOL_RATES_KSPS[1]:
            tuner.edit(symbol_rate_ksps=value)
        else:
            return False
        return True

    def _select(self, args: list[str]) -> Script:
        wanted = whole(args[0]) if len(args) == 1 else None
        if args and wanted not in self._board.tuner.channels:
            yield from self._menu.bad_parameter()
            return
        if wanted is not None:
            self._board.tuner.select(wanted)
        yield f"Transponder: {self._board.tuner.transponder}\n"

    def _frequencies(self, args: list[str]) -> Script:  # noqa: ARG002
        for number, channel in self._board.tuner.channels.items():
            yield f"{number:3d}) {channel.frequency_khz} kHz {channel.polarity}\n"

    def _shuffle(self, args: list[str]) -> Script:  # noqa: ARG002
        order = self._board.tuner.order
        self._rng.shuffle(order)
        yield "Order: " + " ".join(map(str, order)) + "\n"

    def _table(self, args: list[str]) -> Script:  # noqa: ARG002
        for number, heard in self._survey():
            yield Pause(self._board.settings.tuner_read_s)
            yield self._line(number, heard) + "\n"

    def _extended_table(self, args: list[str]) -> Script:  # noqa: ARG002
        for number, heard in self._survey():
            yield Pause(self._board.settings.tuner_read_s)
            channel = self._board.tuner.channels[number]
            yield f"{self._line(number, heard)} Sym:{channel.symbol_rate_ksps} RSSI:{heard.rssi}\n"

    def _survey(self) -> Iterator[tuple[int, TunerReading]]:
        for number in self._board.tuner.order:
            yield number, self._board.tuner.survey(number, self._board.now_s)

    def _line(self, number: int, heard: TunerReading) -> str:
        channel = self._board.tuner.channels[number]
        return (
            f"{number:3d}) {channel.frequency_khz} kHz {channel.polarity} "
            f"Lock:{int(heard.locked)} SNR:{heard.snr_db:.1f} NID:{heard.network:04X}"
        )

    def _search(self, args: list[str]) -> Script:  # noqa: ARG002
        """Search the transponders here; then let the dish search by itself if it may."""
        yield "Auto search: blind scan 18000-24000 ksps rolloff 0.35\n"
        found = 0
        for number, heard in self._survey():
            yield Pause(self._board.settings.tuner_read_s)
            if heard.locked:
                found += 1
                yield self._line(number, heard) + "\n"
        yield f"Search done: {found} of {TRANSPONDERS}\n"
        if not found and self._board.settings.srch_moves:
            self._tracker.start()

    def _mode(self, args: list[str]) -> Script:
        value = self._number(args, 9)
        if value is None:
            yield from self._menu.bad_parameter()
            return
        self._search_mode = value if args else self._search_mode
        yield f"Auto search mode: {self._search_mode}\n"

    def _table_timeout(self, args: list[str]) -> Script:
        value = self._number(args, LONGEST_MS)
        if value is None:
            yield from self._menu.bad_parameter()
            return
        self._table_ms = value if args else self._table_ms
        yield f"Table timeout: {self._table_ms} ms\n"

    def _timeout(self, args: list[str]) -> Script:
        value = self._number(args, LONGEST_MS)
        if value is None:
            yield from self._menu.bad_parameter()
            return
        self._to_ms = value if args else self._to_ms
        yield f"Timeout: {self._to_ms} ms\n"

    def _number(self, args: list[str], highest: int) -> int | None:
        """Read the only argument, 0 without one; None when it cannot be used."""
        value = whole(args[0]) if len(args) == 1 else 0 if not args else None
        return value if value is not None and 0 <= value <= highest else None
