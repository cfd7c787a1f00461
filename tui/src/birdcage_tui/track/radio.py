"""The receiver that is kept on the frequency: what it was told, what it says, how strong the signal is."""

from __future__ import annotations

from birdcage.radio.now import RadioNow, RadioState
from birdcage.sky.downlinks_age import is_doubtful
from birdcage.sky.downlinks_words import air_words, satdump_words, signal_words

from birdcage_tui.drawing.canvas import Cells
from birdcage_tui.drawing.cell_text import cut, fit, wrap
from birdcage_tui.shown.pursuit import plan_of
from birdcage_tui.shown.view import View
from birdcage_tui.widgets.pane import Pane

SIGNS = {
    RadioState.OFF: ("○", "dim"), RadioState.CONNECTING: ("◌", "text"), RadioState.TUNED: ("●", "good"),
    RadioState.LISTENING: ("●", "text"),
    RadioState.LOST: ("▲", "warn"), RadioState.REFUSED: ("▲", "warn"),
}  # fmt: skip
TWO_COLUMNS = 56
"""From this width on what is sent stands beside the rest, where it has no room below."""
UNSET = 'No receiver set. [radio] rigctld = "localhost:4532" in birdcage.toml tunes SDR++, gqrx or a radio.'


def megahertz(hz: float | None) -> str:
    """Return a frequency; dashes when it is not known."""
    return "---.------ MHz" if hz is None else f"{hz / 1e6:.6f} MHz"


def sent_facts(view: View) -> list[tuple[str, str]]:
    """Return what the target sends at that frequency, SatDump's name for it, and its status: first where doubtful."""
    plan = plan_of(view)
    sent = None if plan is None else plan.aim.downlink
    if plan is None or sent is None:
        return []
    told = [("sends", signal_words(sent)), ("SatDump", satdump_words(sent))]
    told.insert(0 if is_doubtful(sent, plan.made_at) else 2, ("status", air_words(sent, plan.made_at)))
    return [(name, words) for name, words in told if words]


class RadioPane(Pane):
    """One line a fact."""

    def __init__(self, *, id: str | None = None) -> None:  # noqa: A002
        super().__init__(id=id)
        self.border_title = "Radio"

    def draw(self, cells: Cells, view: View) -> None:
        """Write them."""
        radio = RadioNow() if view.track is None else view.track.radio
        aim = None if view.track is None else view.track.aim
        sign, ink = SIGNS[radio.state]
        words = f"{sign} {radio.state.value}  {radio.address}".rstrip()
        self.heat(0, 0, cells.width, "track-frequency")
        cells.put(1, 0, words, ink)
        y = 1
        hz = radio.downlink_hz if radio.downlink_hz is not None else None if aim is None else aim.frequency_hz
        facts = [("F downlink", megahertz(hz))]
        if radio.doppler_hz is not None:
            facts.append(("Doppler", f"{radio.doppler_hz / 1000:+.3f} kHz"))
        if radio.address:
            facts += [("tuned", megahertz(radio.tuned_hz)), ("reads", megahertz(radio.read_back_hz))]
            if radio.strength_db is not None:
                facts.append(("strength", f"{radio.strength_db:.1f} dB"))
            elif radio.strength_refused is not None:
                facts.append(("strength", f"none (RPRT {radio.strength_refused})"))
            if radio.recording is not None:
                facts.append(("recording", "requested" if radio.recording else "no"))
        told = "dim" if not radio.address else "warn" if radio.state is RadioState.TUNED else ink
        sentence = wrap(radio.sentence or ("" if radio.address else UNSET), max(cells.width - 2, 10))
        sent = sent_facts(view)
        aside = y + len(facts) + len(sentence) + len(sent) > cells.height and cells.width >= TWO_COLUMNS
        width = cells.width // 2 if aside else cells.width
        y = _write(cells, y, width, facts)
        for line in sentence:
            if y < cells.height:
                cells.put(1, y, line, told)
                y += 1
        if not aside:
            _write(cells, y, width, sent)
            return
        for row, (name, value) in enumerate(sent, 1):
            words = f"SatDump {value}" if name == "SatDump" else value
            cells.put(width, row, fit(words, cells.width - width - 1), "text")


def _write(cells: Cells, y: int, width: int, facts: list[tuple[str, str]]) -> int:
    """Write names and values below each other, as far as there is room; return the row behind them."""
    for name, value in facts[: max(cells.height - y, 0)]:
        cells.put(1, y, name, "dim")
        cells.put(13, y, cut(value, max(width - 14, 0)), "text")
        y += 1
    return y
