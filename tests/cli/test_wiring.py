"""`birdcage wiring` needs neither dish nor port."""

from __future__ import annotations

import pytest


@pytest.fixture
def no_ports(monkeypatch):
    def refuse(*args, **more):
        pytest.fail("a port was opened")

    monkeypatch.setattr("birdcage.link.opening.open_link", refuse)
    monkeypatch.setattr("birdcage.link.ports.list_ports", refuse)


@pytest.mark.parametrize("words", [(), ("g2",), ("travler",), ("carryout",), ("pro",), ("adapters",)])
def test_it_prints_plain_text_of_80_columns(run, no_ports, words) -> None:
    result = run("wiring", *words, port="/dev/no-such-port")
    assert (result.exit_code, result.stderr) == (0, "")
    assert result.stdout.isascii()
    assert max(map(len, result.stdout.splitlines())) <= 80


def test_one_plug_is_that_plug_alone(run) -> None:
    text = run("wiring", "g2").stdout
    assert "black  TX-" in text
    assert "T/R-" not in text
    assert "T/R-" in run("wiring").stdout


def test_as_json(run, as_json) -> None:
    told = as_json(run("wiring", "g2", "--json"))
    (plug,) = told["plugs"]
    assert plug["pins"][1] == {"number": 2, "signal": "TX-", "terminal": "TB", "wire": "black"}
    assert {each["saw"] for each in told["symptoms"]} == {"silence", "garbage", "echo"}
    assert any("5 V" in each for each in told["cautions"])


def test_an_unknown_plug_is_refused_by_name(run) -> None:
    result = run("wiring", "kvh")
    assert result.exit_code == 2
    assert "travler" in result.stderr


def test_adapters_have_a_section_of_their_own_that_each_plug_names(run, as_json) -> None:
    text = run("wiring", "adapters").stdout
    assert "SH-U11" in text
    assert "T/R-" not in text
    assert "`birdcage wiring adapters`" in run("wiring", "travler").stdout
    told = as_json(run("wiring", "adapters", "--json"))
    assert told["plugs"] == []
    assert any("DTECH" in each["name"] for each in told["adapters"])
    assert any("560 ohm" in each for each in told["lines"])
