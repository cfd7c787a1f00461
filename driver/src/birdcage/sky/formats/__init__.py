"""Element sets as files and texts hold them: TLE, OMM in four notations, Gpredict's files."""

from __future__ import annotations

from birdcage.sky.formats.parse_result import Complaint, NumberGroup, ParseResult
from birdcage.sky.formats.read import read_path, read_text

__all__ = ["Complaint", "NumberGroup", "ParseResult", "read_path", "read_text"]
