"""The contract kit: what every machine owes to whoever uses it, as cases for a test runner.

Write a `TestBench` for the machine and inherit `Contract`; docs/a-new-machine.md shows how. Needs no test runner
itself.
"""

from birdcage.testing.contract import Contract
from birdcage.testing.line_twin import LineTwin
from birdcage.testing.stage import Stage
from birdcage.testing.twin import ConsoleScene, Golden, SeenCommand, StopScene, TestBench, Truth, Twin

__all__ = [
    "ConsoleScene",
    "Contract",
    "Golden",
    "LineTwin",
    "SeenCommand",
    "Stage",
    "StopScene",
    "TestBench",
    "Truth",
    "Twin",
]
