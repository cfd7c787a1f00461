"""What commands print: lines that stay whole, whatever threads print them."""

from __future__ import annotations

import json
import sys
import threading

from birdcage.cli.say import say, tell_json


class Pieces:
    """A stream that lets other threads run at each write."""

    encoding = "utf-8"

    def __init__(self) -> None:
        self.text, self.turn = "", threading.Event()

    def write(self, piece: str) -> None:
        self.text += piece
        self.turn.wait(0.001)

    def flush(self) -> None:
        pass


def from_threads(print_lines) -> None:
    threads = [threading.Thread(target=print_lines, args=(number,)) for number in range(4)]
    for each in threads:
        each.start()
    for each in threads:
        each.join()


def test_lines_of_json_stay_whole(monkeypatch) -> None:
    out = Pieces()
    monkeypatch.setattr(sys, "stdout", out)
    from_threads(lambda number: [tell_json({"thread": number}) for _ in range(20)])
    assert len([json.loads(line) for line in out.text.splitlines()]) == 80


def test_so_do_sentences(monkeypatch) -> None:
    err = Pieces()
    monkeypatch.setattr(sys, "stderr", err)
    from_threads(lambda number: [say(f"Sentence {number}.") for _ in range(20)])
    assert set(err.text.splitlines()) == {f"Sentence {number}." for number in range(4)}
