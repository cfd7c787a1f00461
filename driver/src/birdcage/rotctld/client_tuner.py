"""The dish's own tuner as one client has it: read through the station, never while somebody else uses it."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from concurrent.futures import Future
from statistics import fmean
from typing import Any, TypeVar

from birdcage.base.errors import BirdcageError, LinkError, NoReply
from birdcage.rotator.feature import ENABLE_LNA, RSSI, Feature, Reading
from birdcage.rotctld.rotor import SignalCounts
from birdcage.rotctld.rprt import RotctldError, Rprt
from birdcage.station.access import StationAccess
from birdcage.station.requests import Read, Set

TUNER = "tuner"
"""The signal source of the dish itself (`StationState.signal_owners`)."""
FRESH_S = 10.0
"""A reading of whoever owns the tuner stands for so long: they come in bursts some five seconds apart."""
MOST_READS = 100
"""More are not read for one command: the station reads nothing else meanwhile."""
Told = TypeVar("Told")


class ClientTuner:
    """Of one client. Nothing here waits."""

    def __init__(self, station: StationAccess, holder: str) -> None:
        self._station, self._holder = station, holder

    def abilities(self) -> tuple[str, ...]:
        """Return `rssi` and `lna`, as far as the dish has them."""
        return tuple(word for word, feature in (("rssi", RSSI), ("lna", ENABLE_LNA)) if self._feature(feature))

    def read(self, reads: int) -> Future[SignalCounts]:
        """Have the signal read so often, or a little more often where one reading averages several.

        While a monitor, a pass or a scan owns the tuner: its latest reading, ERJCTED if there is none.
        """
        feature = self._need(RSSI)
        if owner := self._station.state.signal_owners.get(TUNER):
            latest, now = self._station.state.readings.get(RSSI), self._station.clock.monotonic()
            if latest is None or now - latest.at > FRESH_S:
                raise RotctldError(Rprt.ERJCTED, f"The tuner is in use ({owner}), and has told nothing yet.")
            return _done(_counts([latest], feature.samples))
        told: Future[SignalCounts] = Future()
        times = math.ceil(min(max(reads, 1), MOST_READS) / feature.samples)
        self._read_on(times, feature.samples, [], told)
        return told

    def enable_lna(self) -> Future[None]:
        """Switch the supply of the LNB on."""
        self._need(ENABLE_LNA)
        if owner := self._station.state.signal_owners.get(TUNER):
            raise RotctldError(Rprt.ERJCTED, f"The tuner is in use ({owner}): its supply stays as it is.")
        # The command says what it does, as its hazard does; whoever sends it has agreed.
        asked = self._station.submit(Set(ENABLE_LNA, True, self._holder, agreed=True))
        return then(asked, lambda _reading: None)

    def _feature(self, name: str) -> Feature | None:
        dish = self._station.state.dish
        return None if dish is None else dish.features.get(name)

    def _need(self, name: str) -> Feature:
        feature = self._feature(name)
        if feature is None:
            raise RotctldError(Rprt.EIO, "This dish has no tuner that can do that.")
        return feature

    def _read_on(self, times: int, samples: int, readings: list[Reading], told: Future[SignalCounts]) -> None:
        def take(asked: Future[object]) -> None:
            if error := asked.exception():
                told.set_exception(refusal(error))
                return
            result: Any = asked.result()
            answer: Mapping[str, Reading] = result
            if RSSI not in answer:
                told.set_exception(RotctldError(Rprt.EIO, "The dish did not tell its signal."))
                return
            readings.append(answer[RSSI])
            if len(readings) < times:
                self._read_on(times, samples, readings, told)
            else:
                told.set_result(_counts(readings, samples))

        self._station.submit(Read((RSSI,))).add_done_callback(take)


def _counts(readings: list[Reading], samples: int) -> SignalCounts:
    values = [float(reading.value) for reading in readings]
    return SignalCounts(samples * len(values), round(fmean(values)), round(values[-1]))


def _done(value: Told) -> Future[Told]:
    future: Future[Told] = Future()
    future.set_result(value)
    return future


def then(asked: Future[object], made: Callable[[Any], Told]) -> Future[Told]:
    """Return what is made of a request's result, or its error as one that the protocol has a code for."""
    future: Future[Told] = Future()

    def take(done: Future[object]) -> None:
        if error := done.exception():
            future.set_exception(refusal(error))
        else:
            future.set_result(made(done.result()))

    asked.add_done_callback(take)
    return future


def refusal(error: BaseException) -> RotctldError:
    """Return an error of the station as one of the protocol: out of reach, silent, or refused."""
    if not isinstance(error, BirdcageError):
        raise error
    code = Rprt.EIO if isinstance(error, LinkError) else Rprt.ETIMEOUT if isinstance(error, NoReply) else Rprt.ERJCTED
    return RotctldError(code, str(error))
