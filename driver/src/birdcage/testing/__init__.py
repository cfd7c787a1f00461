"""The contract kit: what every machine owes to whoever uses it, as cases for a test runner.

Write a `Bench` for the machine and inherit `Contract`; docs/a-new-machine.md shows how. Needs no test runner itself.
"""

from birdcage.testing.contract import Contract
from birdcage.testing.line_twin import LineTwin
from birdcage.testing.stage import Stage
from birdcage.testing.twin import Bench, ConsoleScene, Golden, StopScene, Taken, Truth, Twin

__all__ = ["Bench", "ConsoleScene", "Contract", "Golden", "LineTwin", "Stage", "StopScene", "Taken", "Truth", "Twin"]
