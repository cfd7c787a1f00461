"""Write docs/faults.md: every fault of the simulator, and what came of it (tests/faults)."""

from __future__ import annotations

import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))

from tests.faults.table import page  # noqa: E402 - found by the path above


def main() -> None:
    path = ROOT / "docs/faults.md"
    path.write_text(page(), encoding="utf-8")
    print(path.relative_to(ROOT))


if __name__ == "__main__":
    main()
