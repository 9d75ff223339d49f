#!/usr/bin/env python3
"""Makes the table of the lines of constellations.

    make_figures.py [d3-celestial-0.7.35.tgz] > figures.csv

Each line is a number within its constellation and goes through its places in their order (J2000). The archive is the
one that make_stars_to_8.py takes; without one it is fetched. Standard library only.
"""

import csv
import json
import sys
import tarfile
import tempfile

from make_sky_places import ascii_text
from make_stars_to_8 import check_package, fetched


def rows(load):
    names = {}
    for feature in load("constellations.json"):
        # Serpens has an entry for its head and one for its tail.
        name = ascii_text(feature["properties"]["name"])
        names[feature["id"]] = name.split()[0] if feature["id"] == "Ser" else name
    lines = {}
    for feature in load("constellations.lines.json"):
        for line in feature["geometry"]["coordinates"]:
            lines.setdefault(feature["id"], []).append(line)
    for short in sorted(lines):
        for number, line in enumerate(lines[short], 1):
            for ra, dec in line:
                yield [names[short], short, number, f"{ra % 360:.4f}", f"{dec:.4f}"]


def main(archive):
    check_package(archive)
    with tarfile.open(archive) as package:
        found = list(rows(lambda name: json.load(package.extractfile(f"package/data/{name}"))["features"]))
    if len({row[0] for row in found}) != 88:
        sys.exit(f"{len({row[0] for row in found})} constellations instead of 88")
    print("# Lines of constellations, J2000: from d3-celestial 0.7.35 (BSD-3-Clause).")
    writer = csv.writer(sys.stdout, lineterminator="\n")
    writer.writerow(["constellation", "abbreviation", "line", "ra_deg", "dec_deg"])
    writer.writerows(found)


if __name__ == "__main__":
    if len(sys.argv) > 1:
        main(sys.argv[1])
    else:
        with tempfile.TemporaryDirectory() as folder:
            main(fetched(folder))
