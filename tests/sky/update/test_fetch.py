"""One request: whole, or an error in a sentence, and over at its deadline."""

from __future__ import annotations

import gzip
import socket
import time
import tracemalloc
import zlib

import pytest
from birdcage.sky.update.errors import FetchError
from birdcage.sky.update.fetch import _Request, check_url, fetch
from birdcage.sky.update.unpack import unpack


def refused(url, **more):
    with pytest.raises(FetchError) as caught:
        fetch(url, **more)
    return caught.value


def test_an_answer_comes_with_its_status_and_headers_and_we_say_who_asks(server):
    server.answers["/x"] = (418, {"ETag": '"v1"'}, b"a teapot")
    reply = fetch(server.url("/x"), headers={"If-None-Match": '"v0"'})
    assert (reply.status, reply.body, reply.headers["etag"]) == (418, b"a teapot", '"v1"')
    ((_, sent),) = server.asked
    assert sent["user-agent"].startswith("birdcage/")
    assert sent["if-none-match"] == '"v0"'
    assert sent["accept-encoding"] == "gzip"


def test_redirects_are_followed_to_the_end_but_not_round_and_round(server):
    server.answers["/a"] = (301, {"Location": "/b"}, b"")
    server.answers["/b"] = (302, {"Location": server.url("/c")}, b"gone there")
    server.answers["/c"] = (200, {}, b"here")
    assert fetch(server.url("/a")).body == b"here"
    server.answers["/c"] = (307, {"Location": "/a"}, b"")
    assert refused(server.url("/a")).reason == "redirects"
    assert len(server.asked) == 3 + 6


def test_a_redirect_out_of_http_is_refused(server):
    server.answers["/a"] = (301, {"Location": "file:///etc/passwd"}, b"")
    assert refused(server.url("/a")).reason == "url"


def test_nothing_leads_from_an_encrypted_address_to_a_plain_one():
    request = _Request("https://celestrak.org/x", {}, 0.0, 0)
    assert request._next("https://celestrak.org/x", "/y") == "https://celestrak.org/y"
    assert request._next("http://celestrak.org/x", "https://celestrak.org/x") == "https://celestrak.org/x"
    with pytest.raises(FetchError) as caught:
        request._next("https://celestrak.org/x", "http://celestrak.org/x")
    assert caught.value.reason == "redirects"


def test_gzip_is_unpacked_by_header_or_by_itself_and_never_half(server):
    packed = gzip.compress(b"elements " * 1000)
    server.answers["/named"] = (200, {"Content-Encoding": "gzip"}, packed)
    server.answers["/file.gz"] = (200, {"Content-Type": "application/gzip"}, packed)
    server.answers["/cut"] = (200, {"Content-Encoding": "gzip"}, packed[:-20])
    server.answers["/bad"] = (200, {"Content-Encoding": "gzip"}, packed[:10] + b"\xff" * 40)
    server.answers["/plain"] = (200, {"Content-Encoding": "gzip"}, b"not packed at all")
    server.answers["/br"] = (200, {"Content-Encoding": "br"}, b"xx")
    for path in ("/named", "/file.gz"):
        assert fetch(server.url(path)).body == b"elements " * 1000
    assert fetch(server.url("/plain")).body == b"not packed at all"
    assert refused(server.url("/cut")).reason == "truncated"
    assert refused(server.url("/bad")).reason == "garbage"
    assert refused(server.url("/br")).reason == "garbage"


def test_what_unpacks_to_too_much_is_refused(server):
    server.answers["/bomb"] = (200, {"Content-Encoding": "gzip"}, gzip.compress(bytes(3_000_000)))
    server.answers["/long"] = (200, {}, bytes(300_000))
    assert refused(server.url("/bomb"), largest=100_000).reason == "too_large"
    assert refused(server.url("/long"), largest=100_000).reason == "too_large"
    assert len(fetch(server.url("/long"), largest=300_000).body) == 300_000


def test_a_bomb_is_unpacked_no_further_than_the_bound():
    """The whole is never in memory: 200 MB in 200 kB."""
    packer = zlib.compressobj(9, wbits=31)
    bomb = b"".join([packer.compress(bytes(1_000_000)) for _ in range(200)]) + packer.flush()
    tracemalloc.start()
    try:
        with pytest.raises(FetchError) as error:
            unpack(bomb, "gzip", 1_000_000, "http://server/bomb")
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert error.value.reason == "too_large"
    assert peak < 5_000_000


def test_a_file_of_endless_empty_parts_is_refused():
    assert unpack(gzip.compress(b"ab") + gzip.compress(b"c"), "", 100, "url") == b"abc"
    with pytest.raises(FetchError, match="parts"):
        unpack(gzip.compress(b"") * 1000, "gzip", 1_000_000, "url")


def test_a_body_shorter_than_promised_is_refused(server):
    def chunked(handler):
        handler.wfile.write(b"HTTP/1.1 200 OK\r\nTransfer-Encoding: chunked\r\n\r\n5\r\nhello\r\n")

    server.answers["/chunked"] = chunked
    server.answers["/short"] = lambda handler: handler.wfile.write(
        b"HTTP/1.1 200 OK\r\nContent-Length: 1000\r\n\r\nonly this"
    )
    for path in ("/short", "/chunked"):
        error = refused(server.url(path))
        assert error.reason == "truncated", path
        assert "broke off" in str(error)


@pytest.mark.parametrize("where", ["before the header", "in the header", "in the body", "in one chunk"])
def test_a_server_that_trickles_is_left_at_the_deadline(server, where):
    starts = {
        "before the header": b"",
        "in the header": b"HTTP/1.1 200 OK\r\n",
        "in the body": b"HTTP/1.1 200 OK\r\nContent-Length: 100000\r\n\r\n",
        "in one chunk": b"HTTP/1.1 200 OK\r\nTransfer-Encoding: chunked\r\n\r\nFFFF\r\n",
    }

    def trickle(handler):
        handler.wfile.write(starts[where])
        while not server.closing.wait(0.02):
            try:
                handler.wfile.write(b"" if where == "before the header" else b"X-A: b\r\n"[:1])
                handler.wfile.flush()
            except OSError:
                return

    server.answers["/slow"] = trickle
    begun = time.monotonic()
    assert refused(server.url("/slow"), deadline_s=0.4).reason == "timeout"
    assert 0.3 < time.monotonic() - begun < 20.0, "it drips for ever"


def test_no_server_is_told_with_its_address(server):
    with socket.socket() as nobody:
        nobody.bind(("127.0.0.1", 0))
        host = f"127.0.0.1:{nobody.getsockname()[1]}"
        error = refused(f"http://{host}/x")
    assert error.reason == "offline"
    assert host in str(error)
    assert "onnection refused" in str(error)
    assert "object at" not in str(error)


def test_garbage_instead_of_http_is_told(server):
    server.answers["/garbage"] = lambda handler: handler.wfile.write(b"SSH-2.0-OpenSSH_9.6\r\n")
    assert refused(server.url("/garbage")).reason == "truncated"


def test_only_http_addresses_are_asked():
    assert check_url("https://celestrak.org/x") == "celestrak.org"
    for url in ("ftp://host/x", "file:///x", "celestrak.org/x", "http://", "http://host:port/", ""):
        with pytest.raises(FetchError) as caught:
            check_url(url)
        assert caught.value.reason == "url", url
