"""Names whose signs are two cells wide: cut, padded and drawn by cells, and every row as wide as the screen."""

import pytest
import sky_stand_in
import stand_in
from birdcage_tui.drawing.canvas import Braille, Cells
from birdcage_tui.drawing.cell_text import cell_len, cut, elide, fit, pad, shorten, wrap
from birdcage_tui.drawing.themes import DEFAULT, LOOKS
from stage import run

FENGYUN, TOKYO = "风云三号", "東京タワーの隣の屋上にある小さなアンテナ"


@pytest.mark.parametrize("width", range(1, 12))
def test_no_cut_is_wider_than_it_may_be_and_padding_is_exact(width):
    for text in (FENGYUN, TOKYO, f"A{FENGYUN}B", "plain words", "e\u0301te\u0301 a\u0300 la mer"):
        assert cell_len(cut(text, width)) <= width
        assert cell_len(elide(text, width)) <= width
        assert cell_len(shorten(text, width)) <= width
        assert cell_len(fit(text, width)) <= width
        assert cell_len(pad(text, width)) == width
        assert all(cell_len(row) <= width + 3 for row in wrap(f"{text} {text}", width + 3))


def test_the_middle_of_a_long_name_gives_way_and_both_ends_stay():
    assert elide("METEOR-M2 4 (AP) of 2024-039A", 15) == "METEOR-…24-039A"
    assert fit("STARLINK-31415 of group 6-77", 16) == "STARLINK…up 6-77"
    assert fit("METEOR-M2 4 (AP)", 12) == "METEOR-M2 4"


@pytest.mark.parametrize(("width", "said"), [
    (69, "Peak at azimuth 132.75° ±0.09°, 132 over the floor of 419, 5.5° wide."),
    (68, "Peak at azimuth 132.75° ±0.09°, 132 over the floor of 419 …"),
    (58, "Peak at azimuth 132.75° ±0.09° …"),
    (38, "Peak at azimuth 132.75° ±0.09° …"),
    (30, "Peak at azimuth 132.75° …"),
    (5, "Peak…"),
])  # fmt: skip
def test_a_line_ends_where_a_figure_is_whole(width, said):
    assert shorten("Peak at azimuth 132.75° ±0.09°, 132 over the floor of 419, 5.5° wide.", width) == said


def test_a_line_without_parts_ends_behind_a_word():
    assert shorten("One: the beam looks far ahead of the direction", 31) == "One: the beam looks far ahead …"


def test_a_sign_of_two_cells_takes_two_and_half_of_it_is_never_left():
    cells = Cells(10, 1)
    assert cells.put(0, 0, "风云A") == 5
    cells.right(10, 0, "京")
    assert row_of(cells) == "风云A   京"
    assert cell_len(row_of(cells)) == 10
    cells.put(1, 0, "x")
    assert row_of(cells).startswith(" x云A")
    cells.put(2, 0, "y")
    assert row_of(cells).startswith(" xy A")
    dots = Braille(1, 1)
    dots.dot(0, 0, "accent")
    dots.onto(cells, 9, 0)
    assert row_of(cells).endswith(" ⠁")
    cells.put(9, 0, "風")
    assert row_of(cells).endswith("  "), "a sign across the edge is not drawn"
    assert not cells.free(0, 0, 10)


def row_of(cells, y=0):
    return "".join(segment.text for segment in cells.strip(y, LOOKS[DEFAULT].inks))


PAGES = {"1": FENGYUN, "2,P": "東京タワー", "7": FENGYUN, "2,c": "AZ"}


@pytest.mark.parametrize("size", [(80, 24), (120, 36), (160, 48), (240, 70)], ids=str)
def test_rows_stay_aligned_on_every_page_with_wide_names(size, tmp_path, monkeypatch):
    renamed = [(name.replace("METEOR-M2 4", FENGYUN), *rest) for name, *rest in sky_stand_in.PASSES]
    monkeypatch.setattr(sky_stand_in, "PASSES", renamed)
    presets = tmp_path / "presets.toml"
    presets.write_text(
        f'[[preset]]\nname = "東京タワー"\naz_deg = 180\nel_deg = 40\nnote = "屋上"\n'
        f'[[preset]]\nname = "{TOKYO}"\naz_deg = 90\nel_deg = 30\n',
        encoding="utf-8",
    )

    async def go_through(app, pilot):
        found = {}
        for keys in PAGES:
            await pilot.press(*keys.split(","))
            await pilot.pause()
            app.paint()
            await pilot.pause()
            found[keys] = stand_in.text_of(app)
        return found

    found = run(go_through, "slewing", size, presets_file=presets, sky=sky_stand_in.make(),
                state={"holder": "東京の隣のアンテナの人"})  # fmt: skip
    for keys, text in found.items():
        assert {cell_len(row) for row in text.split("\n")} == {size[0]}, f"{keys}\n{text}"
        assert PAGES[keys] in text, f"{keys}\n{text}"
        assert "東京の" in text.split("\n")[0], f"{keys}\n{text}"
