"""The app at F8 over the stand-in engine, and how to wait for it."""

import asyncio

import setup_stand_in
import stand_in
from birdcage_tui.pages.setup import SetupPage
from birdcage_tui.setup.form import ChoiceButton
from birdcage_tui.setup.setup_words import StepWords
from birdcage_tui.widgets.footer import KeyBar
from birdcage_tui.widgets.status import BadDayRow, StatusLine, StopButton
from textual.widgets import Input


def run(test, engine="home", state="idle", size=(80, 24), **options):
    async def body():
        made = setup_stand_in.ENGINES[engine]()
        app = stand_in.app_in(state, setup=lambda: made, first_page="setup", **options)
        async with app.run_test(size=size) as pilot:
            await settle(app, pilot)
            await settle(app, pilot)
            return await test(app, pilot, made)

    return asyncio.run(body())


async def settle(app, pilot):
    """Draw one frame, and wait until the layout has followed it."""
    app.paint()
    for _ in range(3):
        await pilot.pause()


async def press(app, pilot, *keys):
    await pilot.press(*keys)
    await settle(app, pilot)


async def read(app, pilot, engine):
    return stand_in.text_of(app)


def inside(app, engine, *, causes):
    """Assert that what is needed lies in the screen, whole, and over nothing else."""
    page = app.query_one(SetupPage)
    frame = [app.query_one(kind) for kind in (StatusLine, StopButton, BadDayRow, KeyBar, SetupPage)]
    parts = [page.query_one("#setup-steps"), *page.query(ChoiceButton), *page.query(Input)]
    parts += [each for each in (page.query_one(StepWords), page.query_one("#setup-rest")) if each.display]
    if causes:
        parts.append(page.query_one("#setup-extra"))
    step = page.query_one("#setup-step")
    for part in (*frame, *parts):
        assert part.region.area > 0, part
        assert app.screen.region.contains_region(part.region), f"{part} {part.region}"
        if step in part.ancestors:
            assert step.region.contains_region(part.region), f"{part} {part.region} is outside {step.region}"
    for number, part in enumerate(parts):
        for other in parts[number + 1 :]:
            assert not part.region.overlaps(other.region), f"{part} lies over {other}"
    shown = next(view for view in engine.steps() if view.name == engine.current)
    assert len(page.query(ChoiceButton)) == len(shown.choices)
    folded = page.form.folded
    assert not folded or causes or app.size.height < 30, "fields fold only where there is no room for them"
    assert len(page.query(Input)) == sum(len(choice.fields) for choice in shown.choices if choice.name not in folded)
    for button in page.query(ChoiceButton):
        assert button.region.width == button.styles.width.value, "no choice is cut off"
