"""A map as FITS: the image, a table of all samples with where they lie in the sky, and a table of the settings."""

from __future__ import annotations

import io
from collections.abc import Sequence
from datetime import datetime
from typing import Any

from birdcage.skymap.equatorial import equatorial, offline
from birdcage.skymap.fits_head import UNITS, comments_of, image_cards, number_of, plain, stamp
from birdcage.skymap.place_blur import is_blurred
from birdcage.skymap.sample_columns import SampleColumn, columns_of
from birdcage.skymap.sky_map import MapSample, SkyMap

WHOLE = ("cell", "cross_number", "n", "settings", "lock")
TEXTS = ("utc", "polarisation", "target", "state")
NULL = -1
SKY = (
    ("ra_deg", "right ascension, ICRS"), ("dec_deg", "declination, ICRS"), ("glon_deg", "galactic longitude"),
    ("glat_deg", "galactic latitude"),
)  # fmt: skip


def as_fits(sky_map: SkyMap) -> bytes:
    """Return the file: image in the primary unit, then the tables SAMPLES and SETTINGS. Needs astropy."""
    with offline():
        from astropy.io import fits  # type: ignore[import-untyped]

        image = fits.PrimaryHDU(sky_map.grid())
        for keyword, value, comment in image_cards(sky_map):
            image.header[keyword] = (value, comment)
        units = [image, _samples(fits, sky_map), _settings(fits, sky_map)]
        for unit in units:
            for comment in comments_of(sky_map):
                unit.header["COMMENT"] = comment
        written = io.BytesIO()
        fits.HDUList(units).writeto(written, output_verify="exception")
    return written.getvalue()


def _samples(fits: Any, sky_map: SkyMap) -> Any:  # noqa: ANN401 - astropy has no types
    samples = (*sky_map.samples, *sky_map.crosses)
    told = columns_of(sky_map)
    columns = [_column(fits, each, sky_map, samples) for each in told]
    meanings = [each.meaning for each in told]
    place = sky_map.place()
    if place is not None and not is_blurred(sky_map) and any(each.utc for each in samples):
        values = equatorial(samples, *place, number_of(sky_map.about, "height_m") or 0.0)
        columns += [
            fits.Column(name=name, format="D", unit="deg", array=each)
            for (name, _meaning), each in zip(SKY, values, strict=True)
        ]
        meanings += [meaning for _name, meaning in SKY]
    table = fits.BinTableHDU.from_columns(columns, name="SAMPLES")
    for number, meaning in enumerate(meanings, start=1):
        table.header.comments[f"TTYPE{number}"] = meaning.partition(";")[0]
    return table


def _column(fits: Any, column: SampleColumn, sky_map: SkyMap, samples: Sequence[MapSample]) -> Any:  # noqa: ANN401
    import numpy as np

    told = [column.of(each) for each in samples]
    if column.name in WHOLE:
        whole = np.array([NULL if each is None else int(each) for each in told], dtype=np.int32)  # type: ignore[call-overload]
        return fits.Column(name=column.name, format="J", null=NULL, array=whole)
    if column.name in TEXTS:
        return _text_column(fits, column.name, told)
    unit = sky_map.unit if column.unit == "value" else column.unit
    real = np.array([np.nan if each is None else each for each in told], dtype=np.float64)
    return fits.Column(name=column.name, format="D", unit=plain(UNITS.get(unit, unit)) or None, array=real)


def _text_column(fits: Any, name: str, told: Sequence[object]) -> Any:  # noqa: ANN401
    import numpy as np

    texts = [stamp(each) if isinstance(each, datetime) else plain(each or "") for each in told]
    wide = max(map(len, texts), default=0) or 1
    return fits.Column(name=name, format=f"{wide}A", array=np.array(texts, dtype=f"S{wide}"))


def _settings(fits: Any, sky_map: SkyMap) -> Any:  # noqa: ANN401
    import numpy as np

    rows = [(number, *pair) for number, each in enumerate(sky_map.settings) for pair in each.items()]
    numbers = np.array([number for number, _name, _value in rows], dtype=np.int32)
    columns = [
        fits.Column(name="settings", format="J", array=numbers),
        _text_column(fits, "name", [name for _number, name, _value in rows]),
        _text_column(fits, "value", [value for _number, _name, value in rows]),
    ]
    return fits.BinTableHDU.from_columns(columns, name="SETTINGS")
