"""The console's line: history, recall, completion."""

from birdcage.station.raw import CONSOLE
from birdcage.station.requests import ListCommands
from birdcage_tui.console.entry import ConsoleInput
from birdcage_tui.console.frame import PromptCell
from birdcage_tui.console.history import History
from console_desk import desk


def test_history_survives_a_restart_and_holds_no_line_twice_in_a_row(tmp_path):
    def session(test):
        async def body(at):
            at.state(holder=CONSOLE, menu="mot")
            return await test(at)

        return desk(body, history_file=tmp_path / "state" / "history.txt")

    async def first(at):
        for line in ("a", "a", "life", "mv"):
            await at.type(line)
            await at.press("enter")

    async def second(at):
        await at.type("p")
        seen = []
        for key in ("up", "up", "up", "up", "down", "down", "down"):
            await at.press(key)
            seen.append(at.line.value)
        return seen

    session(first)
    assert (tmp_path / "state" / "history.txt").read_text() == "a\nlife\nmv\n"
    assert session(second) == ["mv", "life", "a", "a", "life", "mv", "p"]


def test_a_long_history_is_cut_to_its_newest_lines(tmp_path):
    path = tmp_path / "history.txt"
    path.write_text("".join(f"line {number}\n" for number in range(3000)))
    assert History(path).lines[0] == "line 2000"
    assert path.read_text().splitlines()[0] == "line 2000"


def test_a_history_that_cannot_be_written_says_so(tmp_path):
    (tmp_path / "file").write_text("")
    history = History(tmp_path / "file" / "history.txt")
    history.add("a")
    assert "Lines are not saved" in history.problem
    assert history.lines == ["a"]


def test_a_click_on_the_prompt_begins_to_type():
    async def click(at):
        await at.pilot.click(PromptCell)
        await at.pilot.pause()
        return at.app.focused

    assert isinstance(desk(click), ConsoleInput)


def test_recall_finds_takes_and_sends_nothing(tmp_path):
    path = tmp_path / "history.txt"
    path.write_text("rssi 5\nmv\nrssi 10\n")

    async def recall(at):
        await at.press("i", "ctrl+r", "r", "s")
        newest = await at.look()
        await at.press("ctrl+r")
        older = await at.look()
        await at.press("enter")
        return newest, older, at.line.value, at.raw(), at.app.focused

    newest, older, value, raw, focused = desk(recall, history_file=path)
    assert "rssi 10" in newest
    assert "rssi 5" in older
    assert (value, raw) == ("rssi 5", [])
    assert isinstance(focused, ConsoleInput)


def test_tab_completes_from_the_menu_with_usage_and_goes_round():
    async def complete(at):
        at.state(menu="mot")
        await at.type("azscanw")
        await at.press("tab")
        whole = at.line.value
        text = await at.look()
        at.line.value = "m"
        await at.press("tab")
        first = at.line.value
        await at.press("tab")
        return whole, text, first, at.line.value, isinstance(at.app.focused, ConsoleInput)

    whole, text, first, second, still = desk(complete)
    assert whole.strip() == "azscanwxp"
    assert "azscanwxp" in text
    assert first.startswith("m")
    assert second.startswith("m")
    assert first != second
    assert still


def test_tab_on_an_empty_line_asks_the_dish_while_talking():
    async def ask(at):
        at.state(holder=CONSOLE, menu="mot")
        await at.press("i", "tab")
        asked, first = at.app.station.asked_for(ListCommands), at.line.value
        await at.press("tab")
        return asked, first, at.line.value

    asked, first, second = desk(ask)
    assert asked == [ListCommands(CONSOLE)]
    assert first == "", "the list comes first"
    assert second != "", "then Tab goes round"


def test_usage_and_help_of_a_command_show_while_it_is_typed():
    async def usage(at):
        at.state(menu="dvb")
        await at.type("rssi 5")
        await at.look()
        found = next(each for each in at.app.station.commands("dvb") if each.name == "rssi")
        return found, at.words()

    found, words = desk(usage)
    assert found.usage in words
    assert " ".join(found.help.split()) in words


def test_the_footer_says_ctrl_c_while_space_is_a_space():
    async def typing(at):
        await at.press("i")
        return (await at.look()).splitlines()[-1]

    row = desk(typing)
    assert "Ctrl+C STOP" in row
    assert "go to" not in row


def test_a_command_that_is_only_begun_offers_what_it_may_become_and_does_not_warn():
    async def begin(at):
        at.state(menu="dvb", holder=CONSOLE)
        await at.type("rs")
        begun = await at.look()
        await at.press("enter")
        armed = await at.look()
        return begun, armed, at.raw()

    begun, armed, raw = desk(begin)
    assert "rssi" in begun
    assert "SETTING" not in begun
    assert "SETTING (not in the table)" in armed
    assert raw == []
