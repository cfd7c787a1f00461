"""What there is to know of a feature: its value with all its lines, its source, how it is set and what that risks."""

from __future__ import annotations

from birdcage.rotator.feature import Feature, FeatureKind

from birdcage_tui.drawing.cell_text import wrap
from birdcage_tui.shown.state_words import age_text
from birdcage_tui.shown.system_sheet import cell_text, lines_of, may_be_set_words, sheet_readings
from birdcage_tui.shown.view import View
from birdcage_tui.system.cursor_pane import Line


def held_words(feature: Feature, value: float) -> str:
    """Say what holding a key does to a motor, and what letting go of it does."""
    from birdcage.station.tasks.held_key import HOLD_S
    from birdcage.station.tasks.motor_run import FIRST_S

    assert feature.held is not None, "whoever asks has looked"
    return (
        f"Hold + to run the {feature.held.axis} motor at {value:g}, - at {-value:g}. A terminal reports repeats of a "
        f"key, not its release. STOP is sent {HOLD_S:g} s after the last repeat, {FIRST_S:g} s after a single press, "
        "and short of a limit. Space stops it at once."
    )


def detail_lines(feature: Feature, view: View, width: int) -> list[Line]:
    """Return what there is to say of a feature, what counts most first, wrapped to a width."""
    told = cell_text(feature, sheet_readings(view), view.now)
    lines: list[Line] = []

    def say(ink: str, words: str) -> None:
        lines.extend((ink, line) for line in wrap(words, max(width, 10)) if words)

    if feature.kind is not FeatureKind.MOMENTARY:
        say("strong", f"{told.value}" if told.age_s is None else f"{told.value}, {age_text(told.age_s)} ago")
    if feature.held is not None:
        say("text", held_words(feature, float(told.value.split()[0])))
    if (why := view.sheet.failed.get(feature.id)) is not None:
        say("warn", f"▲ {why}")
    say("text", f"{words}." if (words := may_be_set_words(feature)) else "")
    say("dim", feature.note)
    say("warn", f"▲ {hazard}" if (hazard := feature.hazard or feature.read_hazard) else "")
    asked = f"Command: {feature.asked}. " if feature.asked else ""
    command = f"{'get' if feature.is_readable else 'set'} {feature.id}"
    if feature.held is not None:  # which `birdcage set` refuses
        command = f"motors run {feature.id} {told.value.split()[0]}"
    say("dim", f"{asked}In a shell: `birdcage {command}`." if feature.is_readable or feature.is_writable else "")
    printed = lines_of(feature, sheet_readings(view))
    if len(printed) > 1:
        lines += [("", ""), *(("text", line) for line in printed)]
    return lines
