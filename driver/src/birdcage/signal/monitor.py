"""Reads the source of the mounted feed while somebody looks, and tells what any source was read to say."""

from __future__ import annotations

from collections.abc import Sequence

from birdcage.signal.source import MONITOR, Hear, SignalFacts, SignalSource


class SignalMonitor:
    """For one thread, apart from `add`; `hear` is called on the sources' own."""

    def __init__(self, sources: Sequence[SignalSource], chosen: str, hear: Hear) -> None:
        """`chosen` is the id of the source that the feed names: one of them."""
        self._sources = {source.facts.id: source for source in sources}
        self._chosen = self._sources[chosen]
        self._watches = self._steadily = False
        self._hear = hear
        self._unsubscribe = [source.subscribe(hear) for source in sources]

    def add(self, source: SignalSource) -> None:
        """Hear one more source. Any thread."""
        self._sources[source.facts.id] = source
        self._unsubscribe.append(source.subscribe(self._hear))

    @property
    def chosen(self) -> SignalSource:
        """The source of the mounted feed."""
        return self._chosen

    def facts_of(self, source: str) -> SignalFacts:
        """Return what the readings of a source mean."""
        return self._sources[source].facts

    def choose(self, source: str) -> None:
        """Take another one: another feed is mounted."""
        before, self._chosen = self._chosen, self._sources[source]
        if self._watches and before is not self._chosen:
            before.unwatch(MONITOR)
            self._chosen.watch(MONITOR, steady=self._steadily)

    def watch(self, *, on: bool, steady: bool = False) -> None:
        """Read it from now on, `steady` as often as it can tell, or no more."""
        if (on, steady and on) == (self._watches, self._steadily):
            return
        self._watches, self._steadily = on, steady and on
        if on:
            self._chosen.watch(MONITOR, steady=steady)
        else:
            self._chosen.unwatch(MONITOR)

    def close(self) -> None:
        """Read nothing more, and tell nothing."""
        for unsubscribe in self._unsubscribe:
            unsubscribe()
        self._unsubscribe.clear()
        self.watch(on=False)
