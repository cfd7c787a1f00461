"""Cases: the raw console, where there is one."""

from __future__ import annotations

from birdcage.base.errors import CommandRefused, ConfirmationNeeded, Held
from birdcage.rotator import machines
from birdcage.rotator.verdict import Grade
from birdcage.station.requests import Goto, Raw, Release, ReleaseLease
from birdcage.testing.stage import Stage, require
from birdcage.testing.twin import ConsoleScene, MachineBench

CONSOLE = "console"


class RawConsoleContract:
    """A person may type anything that the bench can stand; what a machine has no line for is refused."""

    def test_a_line_and_its_answer_or_no_console_at_all(self, bench: MachineBench) -> None:
        """The machine's own words come back; without a console the request is refused, and says so."""
        require(
            (machines.make(bench.machine).raw is None) is (bench.console is None),
            "the bench has a console scene exactly where the machine has a raw console",
        )
        with Stage(bench) as stage:
            stage.ready()
            scene = bench.console
            if scene is None:
                stage.refused(Raw("anything", CONSOLE, Grade.RUINS), CommandRefused)
                return
            grade = stage.station.judge(scene.ask).grade
            require(
                grade is Grade.HARMLESS, f"{scene.ask!r} counts as {grade.name}: `hazards` needs a harmless row for it"
            )
            reply = stage.do(Raw(scene.ask, CONSOLE), 60.0)
            said = "\n".join(reply.lines)
            require(scene.answer in said, f"{scene.ask!r} was answered {said!r}, without {scene.answer!r}")

    def test_a_line_that_moves_is_told_as_such_and_refused_while_held(self, bench: MachineBench) -> None:
        """It needs a person's confirmation, and while the machine is HELD it does not go out at all."""
        scene = bench.console
        if scene is None:
            require(machines.make(bench.machine).raw is None, "there is a console, and the bench has no scene for it")
            return
        with Stage(bench) as stage:
            stage.ready()
            self._held_line(stage, scene)

    @staticmethod
    def _held_line(stage: Stage, scene: ConsoleScene) -> None:
        stage.do(Raw(scene.ask, CONSOLE), 60.0)
        require(stage.station.judge(scene.moves).grade >= Grade.MOVES, f"{scene.moves!r} is not said to move anything")
        stage.refused(Raw(scene.moves, CONSOLE), ConfirmationNeeded)
        stage.station.stop("contract")
        stage.step(3.0)
        since = stage.clock.monotonic()
        stage.refused(Raw(scene.moves, CONSOLE, Grade.RUINS), Held)
        require(stage.rests_for(3.0), f"{scene.moves!r} moved it while it was HELD")
        require(not stage.taken_since(since), f"{stage.taken_since(since)} went out while it was HELD")
        stage.do(Release("contract"))

    def test_no_line_of_ours_ends_its_console(self, bench: MachineBench) -> None:
        """The byte that ends a console where it stands (`q` at a root prompt) goes out only if a person insists.

        Through meeting, a go-to, the raw console and leaving.
        """
        if bench.frail is None or bench.console is None:
            require(bench.console is None or not bench.console.ends, "lines that end it, and no twin that can be ended")
            return
        stage = Stage(bench, bench.frail)
        with stage:
            stage.ready().go(10.0, 4.0)
            stage.do(ReleaseLease("contract"))
            *lines, last = bench.console.ends
            for line in lines:
                stage.do(Raw(line, CONSOLE, Grade.SETTING), 60.0)
            stage.refused(Raw(last, CONSOLE, Grade.SETTING), ConfirmationNeeded)
            require(not stage.twin.is_wrecked(), f"{last!r} has ended its console")
            stage.do(Goto(*stage.target(10.0, 4.0), "contract", take_over=True))
        require(not stage.twin.is_wrecked(), "leaving has ended its console")
