"""The pursuit desk of a station without a face: what attached programs order goes on when they are gone."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from birdcage.cli.dish import DishSession
    from birdcage.cli.options import Wanted

END_S = 3.0
"""How long the desk may take to leave what is to be remembered."""


@contextmanager
def serve_desk(dish: DishSession, wants: Wanted) -> Iterator[None]:
    """Have a pursuit desk, and let attached programs use it."""
    from birdcage.pursuit.desk import PursuitDesk
    from birdcage.pursuit.desk_service import PURSUIT, DeskService
    from birdcage.pursuit.desk_setup import DeskSetup, observer_of

    setup = DeskSetup(
        wants.paths.catalogue, lambda: wants.settings, wants.paths, observer_of(wants.settings), load=wants.load
    )
    desk = PursuitDesk(dish.station, dish.session.clock, setup, lambda _now: None)
    desk.start()
    withdraw = dish.services.offer(PURSUIT, DeskService(desk))
    try:
        yield
    finally:
        withdraw()
        desk.close()
        if desk.owes:
            desk.wait(END_S)
