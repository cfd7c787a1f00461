"""The contract kit: what every machine owes to whoever uses it, as cases for a test runner.

Write a `MachineBench` for the machine and inherit `Contract`; docs/a-new-machine.md shows how. Needs no test runner
itself.
"""

from birdcage.testing.contract import Contract
from birdcage.testing.line_twin import LineTwin
from birdcage.testing.stage import Stage
from birdcage.testing.twin import ConsoleScene, Golden, MachineBench, SeenCommand, StopScene, Truth, Twin

__all__ = [
    "ConsoleScene",
    "Contract",
    "Golden",
    "LineTwin",
    "MachineBench",
    "SeenCommand",
    "Stage",
    "StopScene",
    "Truth",
    "Twin",
]
