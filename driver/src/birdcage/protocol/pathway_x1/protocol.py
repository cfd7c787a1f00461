"""Winegard Pathway X1 (`docs/reference/g2-kin.md`): the only program for it reads none of its answers."""

from __future__ import annotations

from typing import ClassVar

from birdcage.console.dialect import ConsoleDialect
from birdcage.protocol.hazard import HazardTable
from birdcage.protocol.pathway_x1.model import DIALECT, FEATURES, PATHWAY_X1
from birdcage.protocol.trk.kin import TrkKin
from birdcage.protocol.trk.kin_commands import kin_commands
from birdcage.protocol.trk.kin_hazards import kin_hazards
from birdcage.rotator.facts import Facts
from birdcage.rotator.feature_table import FeatureTable
from birdcage.rotator.raw import CommandDoc


class PathwayX1Protocol(TrkKin):
    """What it answers is open: a move counts as taken unless the answer refuses it, or names another angle."""

    name: ClassVar[str] = "pathway-x1"
    model: Facts = PATHWAY_X1
    dialect: ClassVar[ConsoleDialect] = DIALECT
    feature_table: ClassVar[FeatureTable] = FEATURES
    hazards: ClassVar[HazardTable] = kin_hazards(DIALECT, PATHWAY_X1)
    commands: ClassVar[tuple[CommandDoc, ...]] = kin_commands(DIALECT.prompts)
