"""What the Carryout G2 and its kin share: a root `TRK>`, motors at `MOT>` and settings at `NVS>`.

`docs/reference/g2.md` has the G2, `docs/reference/g2-kin.md` its kin. Each of them is a dialect of its own, which says
as data how it answers a move, and whether it may be asked where it points.
"""

from __future__ import annotations
