#!/usr/bin/env python3
"""Makes the table of places on the sky that a show can name besides stars.

    make_sky_places.py [d3-celestial-0.7.35.tgz] > sky_places.csv

Constellations by the middle of their figures, Messier's objects, all objects of the NGC and the IC
that the source has, objects with a proper name, and the few places below. The archive is the one
that make_stars_to_8.py takes; without one it is fetched. Standard library only.
"""

import csv
import json
import math
import re
import sys
import tarfile
import tempfile
import unicodedata

from make_stars_to_8 import GREEK, angle, check_package, fetched

# Degrees, J2000. Sagittarius A*: Reid and Brunthaler 2004 (ApJ 616, 872). The others are the axes
# of the IAU's galactic coordinates, and the axes of the earth and of its orbit.
OTHER_PLACES = {
    "Sgr A*": (266.41684, -29.00781), "Sagittarius A*": (266.41684, -29.00781),
    "galactic centre": (266.40499, -28.93617), "galactic anticentre": (86.40499, 28.93617),
    "galactic north pole": (192.85948, 27.12825), "north galactic pole": (192.85948, 27.12825),
    "galactic south pole": (12.85948, -27.12825), "south galactic pole": (12.85948, -27.12825),
    "north celestial pole": (0, 90), "south celestial pole": (0, -90),
    "north ecliptic pole": (270, 66.56071), "south ecliptic pole": (90, -66.56071)}

# Usual names that the source does not have, and what they mean.
FURTHER_NAMES = {
    "Large Magellanic Cloud": "LMC", "Small Magellanic Cloud": "SMC",
    "Carina Nebula": "NGC 3372", "Eta Carinae Nebula": "NGC 3372", "Omega Centauri": "NGC 5139",
    "47 Tucanae": "NGC 104", "47 Tuc": "NGC 104", "Beehive Cluster": "M 44", "Beehive": "M 44",
    "Whirlpool Galaxy": "M 51", "Sombrero Galaxy": "M 104", "Coalsack": "Coalsack Nebula",
    "Swan Nebula": "M 17", "Triangulum Galaxy": "M 33", "Southern Cross": "Crux"}

# Objects of Messier's that the source's large table does not have or has more than 0.1 degrees
# beside SIMBAD's places. They are taken from its Messier table.
FROM_MESSIER_TABLE = {"M 40", "M 87", "M 98", "M 102"}

# Positions to be met, in degrees (J2000): SIMBAD's, rounded, and how far off they may be.
CHECKS = {"M 31": (10.6847, 41.2688, 0.01), "M 42": (83.8187, -5.3897, 0.05),
          "M 45": (56.601, 24.114, 0.2), "M 87": (187.7059, 12.3911, 0.02),
          "NGC 104": (6.0224, -72.0815, 0.01), "NGC 5139": (201.697, -47.4795, 0.01),
          "NGC 7000": (314.75, 44.37, 0.2), "IC 434": (85.25, -2.45, 0.2),
          "LMC": (80.8942, -69.7561, 0.01), "SMC": (13.1583, -72.8003, 0.01),
          "Orion": (83, 6, 4), "Crux": (187.5, -60, 1.5), "Ursa Major": (165, 55, 5)}


def ascii_text(name):
    """The name with Greek letters spelled out and without accents and typographic marks."""
    name = re.sub("[α-ω]", lambda m: GREEK[m[0]], name.replace("’", "'").replace("´", "'"))
    name = unicodedata.normalize("NFKD", name)
    return re.sub(r"\s+", " ", "".join(c for c in name if ord(c) < 128)).strip()


def unit_vector(place):
    ra, dec = map(math.radians, place)
    return (math.cos(dec) * math.cos(ra), math.cos(dec) * math.sin(ra), math.sin(dec))


def middle(places):
    """The centre of the smallest cap that holds the places (Badoiu and Clarkson 2003).

    After n steps the centre is within 1/sqrt(n) of the cap's radius, and in practice 1/n.
    """
    points = sorted({unit_vector(place) for place in places})
    at = [sum(column) for column in zip(*points)]
    for step in range(1, 3000):
        length = math.sqrt(sum(x * x for x in at))
        at = [x / length for x in at]
        far = min(points, key=lambda p: sum(x * y for x, y in zip(at, p)))
        at = [x + (y - x) / (step + 1) for x, y in zip(at, far)]
    length = math.sqrt(sum(x * x for x in at))
    return (math.degrees(math.atan2(at[1], at[0])) % 360, math.degrees(math.asin(at[2] / length)))


def constellations(load):
    """Names and abbreviations with the middle of the figure's lines, to 0.01 degree.

    Serpens has two figures, its head in the west.
    """
    figures = {}
    for feature in load("constellations.lines.json"):
        ends = [tuple(end) for line in feature["geometry"]["coordinates"] for end in line]
        figures.setdefault(feature["id"], []).append(ends)
    labels = {}
    for feature in load("constellations.json"):
        labels.setdefault(feature["id"], []).append(feature)
    for short, found in sorted(labels.items()):
        parts = [middle(ends) for ends in figures[short]]
        names = [feature["properties"]["name"] for feature in found]
        if len(found) > 1:
            for feature in found:
                ra = feature["geometry"]["coordinates"][0] % 360  # of the label beside the figure
                yield feature["properties"]["name"], min(parts, key=lambda p: abs(p[0] - ra))
            names = [names[0].split()[0]]
        whole = middle([end for ends in figures[short] for end in ends])
        for name in dict.fromkeys((names[0], ascii_text(names[0]), short)):
            yield name, whole


def objects(load):
    """Designations and proper names of nebulae, clusters and galaxies."""
    table, names = load("dsos.20.json"), load("dsonames.json")
    places = {}
    for feature in table:
        for name in (feature["id"], feature["properties"]["desig"]):
            places.setdefault(name, tuple(feature["geometry"]["coordinates"]))
    for feature in load("messier.json"):
        name = f"M {feature['id'][1:]}"
        if name in FROM_MESSIER_TABLE:
            place = tuple(feature["geometry"]["coordinates"])
            for each in (name, feature["properties"]["desig"]):
                places[each] = place
    def number(name):
        return int(name.split()[1])
    for catalogue in ("M", "NGC", "IC"):
        found = [name for name in places if re.fullmatch(catalogue + r" \d+", name)]
        for name in sorted(found, key=number):
            yield name, places[name]
    for name in ("LMC", "SMC"):
        yield name, places[name]
    for designation, entry in names.items():
        if designation in places:
            yield ascii_text(entry["name"]), places[designation]


def read_package(archive):
    check_package(archive)
    with tarfile.open(archive) as package:
        def load(name):
            data = json.load(package.extractfile(f"package/data/{name}"))
            return data.get("features", data)
        return [*constellations(load), *objects(load)]


def folded(name):
    return re.sub(r"[ _'.*-]", "", name.lower())


def short(degrees):
    return f"{degrees:.4f}".rstrip("0").rstrip(".")


def main():
    if len(sys.argv) > 1:
        found = read_package(sys.argv[1])
    else:
        with tempfile.TemporaryDirectory() as folder:
            found = read_package(fetched(folder))
    places = {}
    for name, place in [*found, *OTHER_PLACES.items()]:
        if re.search("[A-Za-z]", name):
            places.setdefault(folded(name), (name, *place))
    for name, meaning in FURTHER_NAMES.items():
        places.setdefault(folded(name), (name, *places[folded(meaning)][1:]))
    for name, (ra, dec, tolerance) in CHECKS.items():
        _, there, up = places[folded(name)]
        off = angle((there % 360, up), (ra, dec))
        print(f"{name}: {off:.3f} degrees off", file=sys.stderr)
        if off > tolerance:
            sys.exit(f"{name} is not where it should be")
    print("# Places on the sky, J2000: from d3-celestial 0.7.35 (BSD-3-Clause) and, the last ones,"
          " written by hand.")
    out = csv.writer(sys.stdout, lineterminator="\n")
    out.writerow("name ra_deg dec_deg".split())
    for name, ra, dec in places.values():
        out.writerow([name, short(ra % 360), short(dec)])
    print(f"{len(places)} names", file=sys.stderr)


if __name__ == "__main__":
    main()
