#!/usr/bin/env python3
"""Makes a table of stars from the star data of d3-celestial.

    make_stars_to_8.py [d3-celestial-0.7.35.tgz] > stars_to_8.csv

It has every star of the source, which ends at V = 8. The archive is the npm package of that name and version; without one it is fetched with `npm pack`.
Its SHA-256 is checked. Stars without a colour get an empty b_v. Standard library only.
"""

import argparse
import csv
import hashlib
import json
import math
import os
import re
import subprocess
import sys
import tarfile
import tempfile

PACKAGE = "d3-celestial@0.7.35"
SHA256 = "490796718c201e15f38c324bda5458fc4de22519313093bf261b628185eaae81"

GREEK = dict(zip(
    "αβγδεζηθικλμνξοπρστυφχψω",
    "alpha beta gamma delta epsilon zeta eta theta iota kappa lambda mu nu xi omicron pi rho sigma "
    "tau upsilon phi chi psi omega".split()))
SUPERSCRIPTS = str.maketrans("¹²³⁴⁵⁶⁷⁸⁹⁰", "1234567890")

# Faint stars that a show names, by Hipparcos number: the source has no designation for them.
FAINT_NAMES = {32073: "HD 49359"}

# Positions to be met, in degrees (J2000): SIMBAD's, rounded.
CHECKS = {"Sirius": (101.2872, -16.7161), "Vega": (279.2347, 38.7837),
          "Betelgeuse": (88.7929, 7.4071), "HD 49359": (100.52023, -69.70654)}


def designation(hip, entry):
    """Bayer letter, else Flamsteed number, with the constellation: 'alpha CMa', '61 Cyg'."""
    if hip in FAINT_NAMES:
        return FAINT_NAMES[hip]
    letter = entry.get("bayer", "").translate(SUPERSCRIPTS)
    letter = re.sub(r"[α-ω]", lambda m: GREEK.get(m[0], "sigma"), letter)
    label = letter or entry.get("flam", "")
    return f"{label} {entry['c']}" if label and entry.get("c") else ""


def angle(a, b):
    """Degrees between two (ra, dec), for small angles."""
    (ra, dec), (ra2, dec2) = a, b
    return math.hypot((ra - ra2) * math.cos(math.radians(dec)), dec - dec2)


def rows(stars, names):
    for star in stars:
        v_mag = star["properties"]["mag"]
        ra, dec = star["geometry"]["coordinates"]
        entry = names.get(str(star["id"]), {})
        yield [star["id"], f"{ra % 360:.4f}", f"{dec:.4f}", f"{v_mag:.2f}",
               star["properties"]["bv"], entry.get("name", ""), designation(star["id"], entry)]


def fetched(folder):
    """The package as npm gives it, in that folder."""
    done = subprocess.run(["npm", "pack", "--silent", PACKAGE], cwd=folder, check=True,
                          stdout=subprocess.PIPE, text=True)
    return os.path.join(folder, done.stdout.split()[-1])


def check_package(archive):
    """Stops unless it is the one archive this was written for."""
    with open(archive, "rb") as file:
        if hashlib.sha256(file.read()).hexdigest() != SHA256:
            sys.exit(f"{archive}: not the package this was written for")


def read_package(archive):
    """The stars and their names."""
    check_package(archive)
    with tarfile.open(archive) as package:
        def load(name):
            return json.load(package.extractfile(f"package/data/{name}"))
        return load("stars.8.json")["features"], load("starnames.json")


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("archive", nargs="?", help="the package; fetched if not given")
    return parser.parse_args()


def check_places(table):
    """Stops if one of CHECKS that should be in the table is elsewhere or missing."""
    places = {name: (float(row[1]), float(row[2])) for row in table for name in row[5:] if name}
    for name, place in CHECKS.items():
        off = angle(places[name], place)
        print(f"{name}: {off * 3600:.1f} arcsec off", file=sys.stderr)
        if off > 2e-4:
            sys.exit(f"{name} is not where it should be")


def main():
    options = arguments()
    if options.archive:
        stars, names = read_package(options.archive)
    else:
        with tempfile.TemporaryDirectory() as folder:
            stars, names = read_package(fetched(folder))
    table = sorted(rows(stars, names), key=lambda row: (float(row[3]), row[0]))
    check_places(table)

    out = csv.writer(sys.stdout, lineterminator="\n")
    print(f"# Stars of V <= {float(table[-1][3]):g}, J2000, from d3-celestial 0.7.35 (BSD-3-Clause),"
          " which compiled them from XHIP and Hipparcos.")
    out.writerow("hip ra_deg dec_deg v_mag b_v name designation".split())
    out.writerows(table)
    proper = {row[5] for row in table if row[5]}
    print(f"{len(table)} stars, {len(proper)} with a proper name, "
          f"{sum(not row[4] for row in table)} without a colour", file=sys.stderr)


if __name__ == "__main__":
    main()
