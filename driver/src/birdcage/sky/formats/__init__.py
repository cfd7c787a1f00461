"""Element sets as files and texts hold them: TLE, OMM in four notations, Gpredict's files."""

from __future__ import annotations

from birdcage.sky.formats.harvest import Complaint, Group, Harvest
from birdcage.sky.formats.read import read_path, read_text

__all__ = ["Complaint", "Group", "Harvest", "read_path", "read_text"]
