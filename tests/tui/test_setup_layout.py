"""F8: what is seen of the setup lies inside the screen at every size, and says what it should."""

from dataclasses import replace

import pytest
import setup_stand_in
import stand_in
from birdcage.setup.step import Choice, Field, Mark, StepView
from birdcage.setup.wiring import connectors
from birdcage_tui.setup import wiring
from birdcage_tui.setup.fold import fold
from birdcage_tui.setup.form import AnswerForm
from birdcage_tui.setup.setup_words import StepText
from setup_stage import inside, press, read, run, settle
from textual.widgets import Input

SIZES = [(80, 24), (120, 36), (160, 48), (200, 60)]


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_the_eleven_steps_are_told_with_mark_title_and_evidence(size):
    text = run(read, size=size)
    for step in setup_stand_in.STEPS:
        assert f"{step.number:<2} {step.title}" in text
    for words in ("✓ 1  Link", "▶ ○ 4  Home", "– 8  Level", "… 11 First", "ttyUSB0, FTDI, 115200 8N1"):
        assert words in text
    assert "Homing can't be stopped" in text
    assert "Area is clear: home" in text
    assert "▲ moves the dish" in text


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_what_each_step_needs_is_inside_the_screen(size):
    async def regions(app, pilot, engine):
        for step in setup_stand_in.STEPS:
            engine.current = step.name
            await settle(app, pilot)
            inside(app, engine, causes=False)

    run(regions, size=size)


@pytest.mark.parametrize("size", SIZES, ids=str)
@pytest.mark.parametrize(
    ("engine", "state"), [("mute", "silent"), ("busy", "idle"), ("finished", "idle"), ("home", "fault")]
)
def test_what_is_needed_on_a_bad_day_is_inside_the_screen(engine, state, size):
    async def regions(app, pilot, made):
        inside(app, made, causes=engine == "mute")

    run(regions, engine, state, size)


def test_the_list_folds_around_the_step_that_is_looked_at():
    assert [(row.first, row.last) for row in fold(11, 0, 3)] == [(0, 0), (1, 1), (2, 10)]
    assert [(row.first, row.last) for row in fold(11, 10, 3)] == [(0, 8), (9, 9), (10, 10)]
    assert [(row.first, row.last) for row in fold(11, 5, 3)] == [(0, 4), (5, 5), (6, 10)]
    assert [(row.first, row.last) for row in fold(11, 3, 11)] == [(index, index) for index in range(11)]
    for looked in range(11):
        for room in range(3, 12):
            rows = fold(11, looked, room)
            assert len(rows) <= room
            assert [index for row in rows for index in range(row.first, row.last + 1)] == list(range(11))
            assert any(row.single and row.first == looked for row in rows)


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_a_mute_port_walks_through_the_causes(size):
    async def walk(app, pilot, engine):
        text = stand_in.text_of(app)
        flat = " ".join(text.replace("│", " ").split())
        for words in (
            "57600: 34 bytes, garbage", "115200: silence", "9600: own echo", "1/7 Not permitted",
            "sudo usermod -aG dialout $USER", "2/7 Wrong baud rate", "ModemManager", "brltty", "Look at other speeds",
        ):  # fmt: skip
            assert words in flat, words
        assert flat.count("57600: 34 bytes, garbage") == 1
        await press(app, pilot, "right", "right")
        flat = " ".join(stand_in.text_of(app).replace("│", " ").split())
        assert "Swap the two wires of the receiving pair" in flat
        await press(app, pilot, "left")
        assert app.page.chosen == 1
        await press(app, pilot, "p")
        assert engine.asked == [("link", "probe", {})]

    run(walk, "mute", "silent", size)


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_w_draws_the_plug_and_w_puts_it_away(size):
    async def wiring(app, pilot, engine):
        await press(app, pilot, "w")
        text = stand_in.text_of(app)
        for words in ("Carryout G2", "RJ-12", "1 ╪══ white  GND", "3 ╪══ red    TX+", "clip pointed away", "TA"):
            assert words.lower() in text.lower(), words
        seen = text
        for _ in range(20):
            await press(app, pilot, "down")
            seen += stand_in.text_of(app)
        for words in ("four signal wires", "SH-U11", "560 ohm"):
            assert words in seen, f"{words}: it scrolls to its end"
        await press(app, pilot, "escape")
        return stand_in.text_of(app)

    assert "Area is clear: home" in run(wiring, size=size)[:] or size != (80, 24)


def test_a_finished_setup_says_so_and_what_comes_next():
    async def done(app, pilot, engine):
        text = " ".join(stand_in.text_of(app).replace("│", " ").split())
        assert "The setup is complete, but for Level (skipped)." in text
        assert "To repeat a step, select it with the arrows" in text
        assert text.count("as answered") >= 4

    for size in SIZES:
        run(done, "finished", size=size)


@pytest.mark.parametrize("size", SIZES, ids=str)
@pytest.mark.parametrize("step", ["feed", "place", "level", "north"])
def test_fields_stand_one_a_row_labels_in_one_column_values_in_the_next(step, size):
    async def columns(app, pilot, engine):
        boxes = list(app.page.query(Input))
        rows = [list(box.parent.children) for box in boxes]
        assert all([type(part).__name__ for part in row] == ["Label", "Input", "Label"] for row in rows)
        assert len({box.region.y for box in boxes}) == len(boxes) > 0
        for part in range(3):
            assert len({row[part].region.x for row in rows}) == 1, "they line up"
        assert len({box.region.width for box in boxes}) == 1
        text = stand_in.text_of(app).splitlines()
        fields = [field for view in engine.steps() if view.name == step for c in view.choices for field in c.fields]
        for box, field in zip(boxes, fields, strict=True):
            line = text[box.region.y]
            assert line[: box.region.x].rstrip().endswith(field.label)
            assert (field.value or field.hint) in line, "nothing of it is cut"

    run(columns, step, size=size)


@pytest.mark.parametrize("size", [(80, 24), (120, 36)], ids=str)
def test_where_not_all_fields_fit_those_of_the_chosen_answer_unfold(size):
    fields = [Field(f"f{index}", f"field {index}", "deg") for index in range(12)]
    many = tuple(
        Choice(f"way-{key}", key, f"Way {key}", fields=tuple(fields)) for key in ("c", "d", "t")
    )  # fmt: skip

    async def unfold(app, pilot, engine):
        engine.change("level", choices=many)
        await settle(app, pilot)
        assert not app.page.query(Input)
        await press(app, pilot, "d")
        await settle(app, pilot)
        assert [box.name for box in app.page.query(Input)] == [f"way-d/f{index}" for index in range(12)]
        assert app.focused.name == "way-d/f0"
        await press(app, pilot, *"7")
        await press(app, pilot, "escape", "t")
        await settle(app, pilot)
        assert {box.name.partition("/")[0] for box in app.page.query(Input)} == {"way-t"}
        await press(app, pilot, "escape", "d")
        await settle(app, pilot)
        assert app.page.query(Input).first().value == "7"

    run(unfold, "level", size=size)


def test_the_form_has_a_row_for_all_it_asks():
    async def rows(app, pilot, engine):
        return app.query_one(AnswerForm).rows, len(app.query(".answers"))

    wanted, made = run(rows, "feed")
    assert wanted == made >= 4


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_the_step_to_answer_keeps_the_mark_of_how_far_it_is(size):
    async def look(app, pilot, engine):
        engine.current = "link"
        app.page.follow()
        await settle(app, pilot)
        return stand_in.text_of(app)

    text = run(look, size=size)
    assert "▶ ✓ 1  Link" in text
    assert text.count("▶ ✓") == 1


def test_the_wiring_beside_the_link_ends_with_a_whole_sentence_and_names_the_key_for_the_rest():
    async def look(app, pilot, engine):
        engine.current = "link"
        app.station.state = replace(app.station.state, port="/dev/ttyUSB0")
        app.page.follow()
        await settle(app, pilot)
        extra = app.page.query_one("#setup-extra")
        return ["".join(row).strip() for row in extra._cells._chars]

    rows = [row for row in run(look, size=(120, 36)) if row]
    assert "w: all" in rows[0]
    assert rows[-1].endswith(".")


def test_a_simulated_dish_has_no_plug_beside_its_link():
    async def look(app, pilot, engine):
        engine.current = "link"
        app.page.follow()
        await settle(app, pilot)
        return stand_in.text_of(app)

    assert "RJ-12" not in run(look, size=(120, 36))


def test_the_wiring_on_the_screen_tells_what_to_do_and_not_who_said_so():
    text = "\n".join("".join(part for _, part in line) for line in wiring.lines(connectors(), 76))
    for word in ("README", "Source", "earlier project", "winegard-sky-scan"):
        assert word not in text, word
    assert text.count("silence") == 1, "one heading for all that it may mean"
    assert "Swap the two wires of the TX pair." in text


def test_the_notes_on_the_screen_say_of_which_dish_each_is():
    rows = ["".join(part for _, part in line) for line in wiring.lines(connectors(), 120)]
    for each in connectors():
        heading = rows.index(f"Notes: {each.dishes}")
        assert rows[heading + 1 : heading + 1 + len(each.notes)] == [f"· {note}" for note in each.notes]


def test_evidence_that_the_first_sentence_repeats_is_told_once():
    place = "found at 142.85 / 30.74: 161 over the floor"
    step = StepView(11, "first", "First satellite", Mark.TODO, place, ("Found at 142.85 / 30.74 ±0.06: 161.", "More."))
    assert [line for _ink, line in StepText(step, whole=True).lines(80)] == [*step.words]
    other = replace(step, words=("Search it.",))
    assert [line for _ink, line in StepText(other, whole=True).lines(80)] == [place, "Search it."]
