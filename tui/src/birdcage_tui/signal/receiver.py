"""What the receiver behind the dish says of itself: lock, SNR, network, gain, channel, the supply of its LNB."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import zip_longest

from birdcage.rotator.feature import LOCK, NETWORK, SNR, TRANSPONDER, Reading

from birdcage_tui.drawing.canvas import Cells
from birdcage_tui.shown.state_words import age_text
from birdcage_tui.shown.view import View
from birdcage_tui.widgets.pane import Pane

SUPPLY, CHANNEL_POLARISATION = "lnb_supply", "polarisation"
FEATURES = (
    LOCK, SNR, NETWORK, "rf_agc", "if_agc", "raw_rssi", TRANSPONDER, "frequency", "symbol_rate", CHANNEL_POLARISATION,
    SUPPLY, "tuner_chip",
)  # fmt: skip
"""What is watched; what a machine lacks is left out."""
CONSTANT = ("tuner_chip",)
"""What does not grow old."""
OLD_S = 60.0
"""A reading that is older shows its age: they are asked for in turn, one every few seconds."""
VERTICAL_V, HORIZONTAL_V = (11.0, 15.0), (16.0, 21.0)
"""The supply, in volts, by which a receiver asks an LNB for either polarisation: 13 and 18, about."""
POLARISATIONS = {"V": "vertical", "H": "horizontal"}
GAP, LEAST_GAP, WIDEST_GAP = 3, 2, 8
"""Columns between two values, where there is little room, and much."""


@dataclass(frozen=True, slots=True)
class Item:
    """One value with its name; `age` is empty while it is fresh."""

    name: str
    value: str
    ink: str
    age: str = ""

    def width(self, *, aged: bool) -> int:
        """Return the columns that it takes."""
        return len(self.name) + 1 + len(self.value) + (len(self.age) if aged else 0)


class ReceiverPane(Pane):
    """Names and values: three rows by what they are about, or what counts where there is less room."""

    HELP = (
        "What the dish's own receiver tells. - is what it has not told. n tunes it to a transponder, V feeds the LNB "
        "with 13 V."
    )

    def __init__(self, *, id: str | None = None) -> None:  # noqa: A002
        super().__init__(id=id)
        self.border_title = "Receiver"

    def draw(self, cells: Cells, view: View) -> None:
        """Write what the machine has, a dash for what it has not told."""
        dish = view.state.dish
        if dish is None or not any(name in dish.features for name in FEATURES):
            words = "This dish has no receiver of its own." if dish is not None else "Known once the dish answers."
            cells.put(1, 0, words, "dim")
            return
        items = _items(view)
        rows = _rows(items, cells.width - 2, cells.height)
        columns = _columns(rows, cells.width - 2)
        for y, row in enumerate(rows):
            _put(cells, y, row, columns)


def _items(view: View) -> dict[str, Item]:
    """Return what there is to write, by what it is called here."""
    has = view.state.dish.features if view.state.dish is not None else {}
    items: dict[str, Item] = {}
    readings = view.state.readings

    def add(name: str, label: str, feature: str, text: str, ink: str = "text") -> None:
        """Add what was told by a feature, if the machine has it."""
        if feature not in has:
            return
        reading = readings.get(feature)
        if reading is None or not text:
            items[name] = Item(label, "-", "dim")
            return
        old = feature not in CONSTANT and view.now - reading.at > OLD_S
        age = f" ({age_text(view.now - reading.at)} old)" if old else ""
        items[name] = Item(label, text, "dim" if old else ink, age)

    def told(feature: str) -> str:
        return value_text(readings.get(feature))

    add("lock", "lock", LOCK, told(LOCK), "accent-strong" if told(LOCK) == "yes" else "text")
    add("snr", "SNR", SNR, told(SNR))
    add("network", "network", NETWORK, told(NETWORK))
    gains = [value_text(readings.get(each), unit=False) or "-" for each in ("rf_agc", "if_agc")]
    add("agc", "AGC RF/IF", "if_agc" if gains[0] == "-" else "rf_agc", "/".join(gains) if gains != ["-", "-"] else "")
    add("raw", "ADC", "raw_rssi", told("raw_rssi"))
    add("transponder", "transponder", TRANSPONDER, told(TRANSPONDER))
    add("rf", "RF", "frequency", rf_text(view))
    add("if", "IF", "frequency", _megahertz(readings.get("frequency")))
    add("symbols", "symbols", "symbol_rate", told("symbol_rate"))
    supply = supply_polarisation(readings.get(SUPPLY))
    wanted = told(CHANNEL_POLARISATION)
    differs = bool(supply and wanted) and supply != wanted
    needs = POLARISATIONS.get(wanted, wanted) + (" ▲" if differs else "")
    add("wants", "wants", CHANNEL_POLARISATION, needs, "warn" if differs else "text")
    add("lnb", "LNB", SUPPLY, supply_text(readings.get(SUPPLY)), "warn" if differs else "text")
    add("chip", "chip", "tuner_chip", told("tuner_chip"))
    return items


BY_ROW = (
    ("lock", "snr", "network", "agc", "raw"),
    ("transponder", "rf", "if", "symbols", "wants"),
    ("lnb", "chip"),
)
"""Reception, channel, what feeds it."""
BY_WORTH = ("lock", "snr", "network", "lnb", "transponder", "rf", "agc", "if", "wants", "raw", "symbols", "chip")


def _rows(items: dict[str, Item], width: int, height: int) -> list[list[Item]]:
    """Return the rows: by subject where all of them fit, else as many as fit, in the order of what counts."""
    rows = [[items[name] for name in names if name in items] for names in BY_ROW]
    rows = [row for row in rows if row]
    if len(rows) <= height and all(_width(row, aged=False) <= width for row in rows):
        return rows
    left, rows = [items[name] for name in BY_WORTH if name in items], []
    while left and len(rows) < height:
        row: list[Item] = []
        for item in tuple(left):
            if _width([*row, item], aged=False) <= width:
                row.append(item)
                left.remove(item)
        if not row:
            break
        rows.append(row)
    return rows


def _width(row: Sequence[Item], *, aged: bool) -> int:
    return sum(item.width(aged=aged) for item in row) + LEAST_GAP * (len(row) - 1)


def _columns(rows: Sequence[Sequence[Item]], width: int) -> tuple[int, ...]:
    """Return where the items of all rows begin, one below the other; nothing where there is no room for that."""
    widest = [max(item.width(aged=True) for item in column if item) for column in zip_longest(*rows)]
    if sum(widest) + GAP * (len(widest) - 1) > width:
        return ()
    gap = min(max((width - sum(widest)) // max(len(widest), 1), GAP), WIDEST_GAP)
    return tuple(1 + sum(widest[:each]) + gap * each for each in range(len(widest)))


def _put(cells: Cells, y: int, row: Sequence[Item], columns: Sequence[int]) -> None:
    """Write a row, with ages where there is room for all of them."""
    aged = bool(columns) or _width(row, aged=True) <= cells.width - 2
    x = 1
    for index, item in enumerate(row):
        x = cells.put(columns[index] if columns else x, y, f"{item.name} ", "dim")
        x = cells.put(x, y, item.value + (item.age if aged else ""), item.ink) + LEAST_GAP


def value_text(reading: Reading | None, *, unit: bool = True) -> str:
    """Return a value with its unit, or without; empty for none."""
    if reading is None:
        return ""
    value = reading.value
    if isinstance(value, bool):
        return "yes" if value else "no"
    shown = f"{value:.5g}" if isinstance(value, float) else str(value)
    return f"{shown} {reading.unit}".rstrip() if unit else shown


def supply_polarisation(supply: Reading | None) -> str:
    """Return which polarisation the supply of the LNB asks for: `V`, `H`, or empty where it is neither voltage."""
    if supply is None or not isinstance(supply.value, float):
        return ""
    for polarisation, (low, high) in (("V", VERTICAL_V), ("H", HORIZONTAL_V)):
        if low <= supply.value <= high:
            return polarisation
    return ""


def supply_text(supply: Reading | None) -> str:
    """Return the supply of the LNB, and the polarisation that it means; empty for none."""
    meant = POLARISATIONS.get(supply_polarisation(supply), "")
    return " ".join(part for part in (value_text(supply), meant) if part)


def rf_text(view: View) -> str:
    """Return the frequency in the sky; empty where it is not known, or the LO of the feed is not set."""
    behind, converter = view.state.readings.get("frequency"), view.state.converter
    if behind is None or converter is None or not isinstance(behind.value, int | float):
        return ""
    return f"{converter.rf_hz(behind.value * 1e6) / 1e6:.1f} MHz"


def _megahertz(reading: Reading | None) -> str:
    return "" if reading is None or not isinstance(reading.value, int | float) else f"{reading.value:.1f} MHz"
