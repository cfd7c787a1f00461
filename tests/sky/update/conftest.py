"""A web server on this machine that says what a test wants, and remembers what it was asked."""

from __future__ import annotations

import json
import threading
from datetime import UTC, datetime, timedelta
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer

import pytest
from birdcage.sky.catalogue import Catalogue

NOW = datetime(2026, 7, 4, 12, 0, tzinfo=UTC)


class Server:
    """Answers by path; `answers[path]` is a function of the handler, or (status, headers, body)."""

    def __init__(self) -> None:
        self.answers = {}
        self.asked: list[tuple[str, dict[str, str]]] = []
        self.closing = threading.Event()
        outer = self

        class Handler(BaseHTTPRequestHandler):
            protocol_version = "HTTP/1.1"

            def do_GET(self) -> None:
                outer.asked.append((self.path, {name.lower(): value for name, value in self.headers.items()}))
                answer = outer.answers[self.path]
                if callable(answer):
                    self.close_connection = True
                    answer(self)
                    return
                status, headers, body = answer
                self.send_response(status)
                if status != 304:
                    headers = {"Content-Length": str(len(body)), **headers}
                for name, value in headers.items():
                    self.send_header(name, value)
                self.end_headers()
                if status != 304:
                    self.wfile.write(body)

            def log_message(self, *_args) -> None:
                pass

        class Quiet(ThreadingHTTPServer):
            daemon_threads = True

            def handle_error(self, *_request) -> None:
                """Say nothing: clients that hang up are what the tests are about."""

        self._server = Quiet(("127.0.0.1", 0), Handler)
        self._thread = threading.Thread(target=self._server.serve_forever, args=(0.01,), daemon=True)
        self._thread.start()
        self.host = f"127.0.0.1:{self._server.server_address[1]}"

    def url(self, path: str) -> str:
        return f"http://{self.host}{path}"

    def close(self) -> None:
        self.closing.set()
        self._server.shutdown()
        self._server.server_close()
        self._thread.join(5)


@pytest.fixture
def server():
    server = Server()
    yield server
    server.close()


@pytest.fixture
def catalogue(tmp_path):
    with Catalogue(tmp_path / "catalogue.sqlite") as catalogue:
        yield catalogue


class Now:
    """A time of day that a test moves."""

    def __init__(self) -> None:
        self.time = NOW

    def __call__(self) -> datetime:
        return self.time

    def pass_by(self, **span) -> None:
        self.time += timedelta(**span)


@pytest.fixture
def now():
    return Now()


def omm(name="NOAA 20", norad_id=43013, day=1, **more):
    """Return an OMM as CelesTrak writes one in JSON."""
    return {
        "OBJECT_NAME": name, "OBJECT_ID": "2017-073A", "EPOCH": f"2026-07-{day:02d}T12:00:00.123456",
        "MEAN_MOTION": 14.19553, "ECCENTRICITY": 0.0001234, "INCLINATION": 98.7, "RA_OF_ASC_NODE": 123.4,
        "ARG_OF_PERICENTER": 12.5, "MEAN_ANOMALY": 350.25, "EPHEMERIS_TYPE": 0, "CLASSIFICATION_TYPE": "U",
        "NORAD_CAT_ID": norad_id, "ELEMENT_SET_NO": 999, "REV_AT_EPOCH": 41234, "BSTAR": 1.5e-5,
        "MEAN_MOTION_DOT": 2e-7, "MEAN_MOTION_DDOT": 0, **more,
    }  # fmt: skip


def many(count, day=1):
    return json.dumps([omm(f"SAT {number}", number, day) for number in range(1, count + 1)]).encode()


@pytest.fixture
def make():
    """Make bodies: `make(3)` is a group of three."""
    return many


@pytest.fixture
def make_omm():
    return omm
