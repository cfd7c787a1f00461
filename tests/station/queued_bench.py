"""A station and a simulated Trav'ler, whose moves queue."""

from __future__ import annotations

from .conftest import Bench


class QueuedBench(Bench):
    """The bench of `conftest`, with every byte that leaves and its time."""

    def __init__(self, more="", **options):
        self.sent = []
        self.on_write = lambda _data: None
        super().__init__(f"hal205?seed=1{'&' if more else ''}{more}", options, firmware="hal205")

    def _open(self, port, baud):
        link = super()._open(port, baud)
        write = self.opened[-1].write

        def writing(data):
            write(data)
            self.sent.append((self.clock.monotonic(), data))
            self.on_write(data)

        self.opened[-1].write = writing
        return link

    def sent_since(self, time):
        """Everything that left since `time`, in one piece."""
        return b"".join(data for at, data in self.sent if at >= time)

    def sent_moves(self, since=0.0):
        """The lines that move an axis and have left since, in their order."""
        lines = b"".join(data for at, data in self.sent if at >= since).decode().split("\r")
        return [line for line in lines if line.startswith(("g ", "a 0 ", "a 1 ", "a 2 "))]


def connected(more="", **options):
    bench = QueuedBench(more, **options)
    bench.connect(12.0)
    bench.step(10.0)
    return bench
