"""Programs beside the dish that tell a level, as they behave on the wire: rtl_tcp, SatDump's server, commands."""

from __future__ import annotations

import http.server
import json
import shlex
import socket
import struct
import sys
import threading
import time

import numpy as np

HEADER = b"RTL0" + struct.pack(">II", 5, 29)
FREQUENCY, SAMPLE_RATE = 1, 2


class RtlTcp:
    """Samples of noise, and of a carrier that stands at a frequency; `mood` says how badly it behaves."""

    def __init__(self, carrier_hz, *, carrier_db=-20.0, noise_db=-30.0, header=HEADER, mood=""):
        self.carrier_hz, self.carrier_db, self.noise_db = carrier_hz, carrier_db, noise_db
        self.header, self.mood = header, mood
        self.commands, self.accepted = [], 0
        self._tuned = {FREQUENCY: 100_000_000, SAMPLE_RATE: 1_024_000}
        self._socket = socket.create_server(("127.0.0.1", 0))
        self.address = f"127.0.0.1:{self._socket.getsockname()[1]}"
        self._open = []
        threading.Thread(target=self._run, daemon=True).start()

    def _run(self):
        while True:
            try:
                client, _ = self._socket.accept()
            except OSError:
                return
            self.accepted += 1
            self._open.append(client)
            threading.Thread(target=self._take_commands, args=(client,), daemon=True).start()
            threading.Thread(target=self._send, args=(client,), daemon=True).start()

    def _take_commands(self, client):
        try:
            with client.makefile("rb") as stream:
                while len(command := stream.read(5)) == 5:
                    name, value = struct.unpack(">BI", command)
                    self.commands.append((name, value))
                    self._tuned[name] = value
        except OSError:
            return

    def _send(self, client):
        generator, sent = np.random.default_rng(1), 0
        try:
            client.sendall(self.header)
            while self.mood != "silent":
                rate, centre = self._tuned[SAMPLE_RATE], self._tuned[FREQUENCY]
                count = 4096
                at = np.arange(sent, sent + count)
                tone = 10 ** (self.carrier_db / 20) * np.exp(2j * np.pi * (self.carrier_hz - centre) / rate * at)
                sigma = 10 ** (self.noise_db / 20) / np.sqrt(2)
                noise = generator.normal(0, sigma, count) + 1j * generator.normal(0, sigma, count)
                pairs = np.column_stack(((tone + noise).real, (tone + noise).imag)).ravel()
                block = np.clip(np.round(pairs * 128 + 127.4), 0, 255).astype(np.uint8).tobytes()
                sent += count
                if self.mood == "odd":  # cut where no pair ends
                    client.sendall(block[:1001])
                    time.sleep(0.001)
                    client.sendall(block[1001:])
                else:
                    client.sendall(block)
                if self.mood == "short" and sent > 400_000:
                    client.shutdown(socket.SHUT_RDWR)
                    return
                if self.mood == "late" and sent > 400_000:
                    time.sleep(30.0)
                time.sleep(count / rate / 2)
        except OSError:
            return

    def close(self):
        self.mood = "silent"
        self._socket.shutdown(socket.SHUT_RDWR)
        self._socket.close()
        for each in self._open:
            each.close()


class SatDump:
    """Its server: statistics of each stage of the pipeline, by the stage's name."""

    def __init__(self, snr=7.25, body=None, status=200):
        self.snr, self.asked = snr, []
        outer = self

        class Handler(http.server.BaseHTTPRequestHandler):
            def do_GET(self):
                outer.asked.append(self.path)
                stages = {"psk_demod": {"freq": -1234.5, "peak_snr": 9.5, "snr": outer.snr}, "ccsds": {"lock": True}}
                told = json.dumps(stages).encode() if body is None else body
                self.send_response(status)
                self.end_headers()
                self.wfile.write(told)

            def log_message(self, *_):
                pass

        self._server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Handler)
        self.url = f"http://127.0.0.1:{self._server.server_address[1]}/api"
        threading.Thread(target=self._server.serve_forever, daemon=True).start()

    def close(self):
        self._server.shutdown()
        self._server.server_close()


def program(text):
    """Return the command line of a program in Python."""
    return shlex.join([sys.executable, "-u", "-c", text])
