"""An RTL-SDR behind rtl_tcp: tuned from here, the power of a channel and a spectrum measured from its samples.

On connecting rtl_tcp sends 12 bytes, `RTL0`, the tuner's type and how many gains it has, then samples without end: I
and Q in turn, a byte each, 127.4 for nothing. A command is a byte and a 32-bit number, big-endian.
"""

from __future__ import annotations

import socket
import struct
from dataclasses import dataclass
from typing import TYPE_CHECKING

from birdcage.base.clock import Clock
from birdcage.base.errors import ConfigError
from birdcage.radio.opening import parse_address
from birdcage.signal.meter import MeterError, MeterReading
from birdcage.signal.source import Spectrum

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

FREQUENCY, SAMPLE_RATE, GAIN_MODE, GAIN, DIGITAL_AGC = 0x01, 0x02, 0x03, 0x04, 0x08
AUTOMATIC, BY_HAND = 0, 1
HEADER, MAGIC = 12, b"RTL0"
CONNECT_S, HEADER_S = 2.0, 2.0
BINS, SHOWN = 1024, 256
DWELL_S = 0.1
STALE_S = 0.3
"""After tuning, samples of before are still on their way."""
CHUNK = 65_536
ZERO = 127.4
"""The mean of a sample byte, by the RTL2832U's own offset."""
LEAST_POWER = 1e-20
"""Silence has a level, too: -200 dB."""
DC_BINS = 3
"""The middle of the spectrum holds the receiver's own offset: a channel is measured beside it."""


@dataclass(frozen=True, slots=True)
class Tuned:
    """How the receiver is set."""

    freq_hz: float
    sample_rate_hz: float
    channel_hz: float
    gain_db: float | None
    """None: the tuner's own automatic gain."""

    @property
    def centre_hz(self) -> float:
        """Where it is tuned: beside the channel, so that its own offset is not in it, where there is room for that."""
        aside = self.channel_hz / 2.0 + 2.0 * DC_BINS * self.sample_rate_hz / BINS
        fits = aside + self.channel_hz / 2.0 <= self.sample_rate_hz * 0.45
        return self.freq_hz - aside if fits else self.freq_hz


class RtlTcpMeter:
    """Levels in dB of full scale, each of a tenth of a second."""

    def __init__(self, address: str, tuned: Tuned, clock: Clock) -> None:
        self._address, self._tuned, self._clock = address, tuned, clock
        self._socket: socket.socket | None = None
        self._samples = bytearray()
        self._stale_until = 0.0
        self._wanted: Tuned | None = None
        """How it is to be set from the next reading on."""

    @property
    def tuned(self) -> Tuned:
        """How it is set, or is to be set next."""
        return self._wanted or self._tuned

    def retune(self, tuned: Tuned) -> None:
        """Set it so before the next reading, without hanging up. Any thread."""
        self._wanted = tuned

    def open(self) -> None:
        """Connect, see that it is rtl_tcp, and tune."""
        try:
            host, port = parse_address(self._address)
        except ConfigError:
            raise MeterError(f"{self._address!r} is no address. Write localhost:1234.") from None
        where = f"{host}:{port}"
        try:
            self._socket = socket.create_connection((host, port), CONNECT_S)
            self._socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        except OSError as error:
            raise MeterError(f"rtl_tcp does not listen at {where} ({error.strerror or error}). Start it.") from error
        until = self._clock.monotonic() + HEADER_S
        self._samples.clear()
        while len(self._samples) < HEADER:
            left_s = until - self._clock.monotonic()
            if left_s <= 0.0:
                raise MeterError(f"{where} says nothing. Does another program have the receiver?")
            self._receive(left_s)
        if self._samples[:4] != MAGIC:
            raise MeterError(f"What listens at {where} is not rtl_tcp.")
        del self._samples[:HEADER]
        self._take_wanted()
        self._tune()

    def read(self, within_s: float) -> MeterReading | None:
        """Take samples until a tenth of a second of them is there."""
        if self._take_wanted():
            self._tune()
            del self._samples[: len(self._samples) // 2 * 2]
        want = 2 * BINS * max(1, round(self._tuned.sample_rate_hz * DWELL_S / BINS))
        until = self._clock.monotonic() + within_s
        while len(self._samples) < want:
            left_s = until - self._clock.monotonic()
            if left_s <= 0.0:
                return None
            self._receive(left_s)
            if self._clock.monotonic() < self._stale_until:
                # An even number of bytes: else I and Q would change places.
                del self._samples[: len(self._samples) // 2 * 2]
        taken = bytes(self._samples[:want])
        behind = len(self._samples) - want
        del self._samples[:want]
        blocks = block_spectra(taken)
        spectrum = blocks.mean(axis=0)
        value, scatter = level_of(blocks, self._tuned)
        seconds = 1.0 / (2.0 * self._tuned.sample_rate_hz)
        dwell_s = want * seconds
        return MeterReading(
            value,
            self._clock.monotonic() - behind * seconds - dwell_s / 2.0,
            dwell_s,
            shown_spectrum(spectrum, self._tuned),
            len(blocks),
            scatter,
        )

    def close(self) -> None:
        """Hang up."""
        connection, self._socket = self._socket, None
        if connection is not None:
            connection.close()

    def _receive(self, within_s: float) -> None:
        assert self._socket is not None, "it was opened"
        self._socket.settimeout(max(within_s, 0.001))
        try:
            data = self._socket.recv(CHUNK)
        except TimeoutError:
            return
        except OSError as error:
            raise MeterError(f"The connection to rtl_tcp broke ({error.strerror or error}).") from error
        if not data:
            raise MeterError("rtl_tcp closed the connection. Is the receiver still plugged in?")
        self._samples += data

    def _take_wanted(self) -> bool:
        wanted, self._wanted = self._wanted, None
        if wanted is None:
            return False
        self._tuned = wanted
        return True

    def _tune(self) -> None:
        tuned = self._tuned
        by_hand = tuned.gain_db is not None and tuned.gain_db >= 0.0
        commands = [
            (SAMPLE_RATE, round(tuned.sample_rate_hz)), (FREQUENCY, round(tuned.centre_hz)), (DIGITAL_AGC, 0),
            (GAIN_MODE, BY_HAND if by_hand else AUTOMATIC),
        ]  # fmt: skip
        if by_hand and tuned.gain_db is not None:
            commands.append((GAIN, round(10.0 * tuned.gain_db)))
        assert self._socket is not None, "it was opened"
        try:
            self._socket.sendall(b"".join(struct.pack(">BI", *each) for each in commands))
        except OSError as error:
            raise MeterError(f"The connection to rtl_tcp broke ({error.strerror or error}).") from error
        self._stale_until = self._clock.monotonic() + STALE_S


def block_spectra(samples: bytes) -> npt.NDArray[np.float64]:
    """Return the power in each of `BINS` steps, from the lowest frequency up, a row for each block of samples.

    Hann windows one after the other, without overlap; their mean is the spectrum (P. D. Welch, IEEE Trans. Audio
    Electroacoust. 15, 70, 1967). 1 is a tone of full scale. `samples`: I and Q in turn, at least `2 * BINS` bytes.
    """
    import numpy as np

    raw = np.frombuffer(samples, dtype=np.uint8).astype(np.float32)
    pairs = ((raw - np.float32(ZERO)) / np.float32(128.0)).view(np.complex64)
    blocks = pairs[: len(pairs) // BINS * BINS].reshape(-1, BINS)
    window = np.hanning(BINS + 1)[:BINS].astype(np.float32)
    transformed = np.fft.fftshift(np.fft.fft(blocks * window, axis=1), axes=1)
    # By the window's own power: then the steps of a channel add up to the power that is in it.
    power: npt.NDArray[np.float64] = transformed.real.astype(np.float64) ** 2 + transformed.imag.astype(np.float64) ** 2
    return power / (BINS * float((window.astype(np.float64) ** 2).sum()))


def level_of(blocks: npt.NDArray[np.float64], tuned: Tuned) -> tuple[float, float | None]:
    """Return the level of the channel in dB of full scale, by its mean power, and how much one block scatters, in dB.

    The steps about the receiver's own offset are left out. One block alone has no scatter.
    """
    import numpy as np

    steps = (np.arange(BINS) - BINS // 2) * tuned.sample_rate_hz / BINS
    inside = np.abs(steps - (tuned.freq_hz - tuned.centre_hz)) <= tuned.channel_hz / 2.0
    inside &= np.abs(np.arange(BINS) - BINS // 2) > DC_BINS // 2
    if not inside.any():
        inside[np.abs(steps - (tuned.freq_hz - tuned.centre_hz)).argmin()] = True
    powers = np.maximum(blocks[:, inside].sum(axis=1), LEAST_POWER)
    scatter = float(np.std(10.0 * np.log10(powers), ddof=1)) if len(powers) > 1 else None
    return float(10.0 * np.log10(powers.mean())), scatter


def shown_spectrum(power: npt.NDArray[np.float64], tuned: Tuned) -> Spectrum:
    """Return the spectrum in `SHOWN` steps, in dB of full scale, the receiver's own offset in its middle left in."""
    import numpy as np

    steps = power.reshape(SHOWN, BINS // SHOWN).sum(axis=1)
    levels = 10.0 * np.log10(np.maximum(steps, LEAST_POWER))
    half, channel = tuned.sample_rate_hz / 2.0, tuned.channel_hz / 2.0
    return Spectrum(
        tuple(map(float, levels)), tuned.centre_hz - half, tuned.centre_hz + half,
        (tuned.freq_hz - channel, tuned.freq_hz + channel),
    )  # fmt: skip
