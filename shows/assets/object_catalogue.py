"""Nebulae, galaxies and clusters of d3-celestial that deep_sky.py does not name."""

import json
import math
import tarfile

from deep_sky import CLUSTERS, GALAXIES, MAGELLANIC, NEBULAE
from make_stars_to_8 import check_package

TABLE = "package/data/dsos.14.json"
FAINTEST_GALAXY, FAINTEST_CLUSTER, FAINTEST_IN_CLOUDS = 11.0, 9.5, 13.6
# A galaxy whose mean surface brightness would be above this has a wrong magnitude in the table.
BRIGHTEST_GALAXY = 20.2  # mag/arcsec^2
# Mean surface brightness (V, mag/arcsec^2) of Sharpless' classes 1 to 3 of brightness, and of the
# nebulae of Rodgers, Campbell and Whiteoak, which have none: estimates, after those of NEBULAE.
SHARPLESS = {1: 26.3, 2: 25.2, 3: 23.8}
RCW = 24.8
LARGE, FAINTER_IF_LARGE = 60, 0.8  # arcminutes: few that large have their class' light all over
NEBULA_SIZES = 8, 320  # arcminutes; what is larger are regions that hold many


def apart(a, b):
    """Degrees, between places close to each other."""
    east = (a[0] - b[0] + 180) % 360 - 180
    return math.hypot(east * math.cos(math.radians((a[1] + b[1]) / 2)), a[1] - b[1])


class Entry:
    def __init__(self, feature):
        properties = feature["properties"]
        self.name, self.type = properties["desig"], properties["type"]
        ra, dec = feature["geometry"]["coordinates"]
        self.place = ra % 360, dec
        self.v = self.number(properties["mag"], 999)
        self.b_v = self.number(properties["bv"], 0.75)
        sizes = [self.number(x, 0) for x in str(properties["dim"]).strip("'").split("x")]
        self.length, self.width = sizes[0], sizes[-1]
        self.classes = properties["morph"].split("; ")

    @staticmethod
    def number(text, otherwise):
        try:
            return float(text)
        except ValueError:
            return otherwise

    def sharpless_class(self):
        """The last of three numbers like "3, 2, 3": form, structure, brightness."""
        for text in self.classes:
            numbers = text.split(", ")
            if len(numbers) == 3 and all(n in ("1", "2", "3") for n in numbers):
                return int(numbers[2])
        return None


def surface_brightness(entry):
    """Of a nebula, or None if there is nothing to tell it by."""
    large = FAINTER_IF_LARGE if entry.length > LARGE else 0
    if entry.sharpless_class():
        return SHARPLESS[entry.sharpless_class()] + large
    return RCW + large if entry.name.startswith("RCW ") else None


class Catalogue:
    """Rows like those of deep_sky.py. The table has no position angles: what is not round is drawn
    round and of the same area."""

    def __init__(self, archive):
        check_package(archive)
        with tarfile.open(archive) as package:
            table = json.load(package.extractfile(TABLE))
        entries = [Entry(feature) for feature in table["features"]]
        self.galaxies = [self.galaxy(e) for e in entries if self.is_further_galaxy(e)]
        self.clusters = [(e.name, *e.place, e.v, min(0.1 * max(e.length, 5), 2.0))
                         for e in entries if self.is_further_cluster(e)]
        self.nebulae = self.further_nebulae(entries)
        self.in_magellanic_clouds = [
            (e.name, *e.place, e.v, e.type not in ("oc", "gc")) for e in entries
            if e.type in ("oc", "gc", "en", "bn", "sfr") and e.v < FAINTEST_IN_CLOUDS
            and self.in_cloud(e) and not self.named(e, NEBULAE + CLUSTERS, 0.15)]
        print(f"d3-celestial: {len(self.nebulae)} nebulae, {len(self.galaxies)} galaxies, "
              f"{len(self.clusters)} clusters, {len(self.in_magellanic_clouds)} in the Magellanic "
              "Clouds")

    @staticmethod
    def named(entry, rows, degrees):
        return any(apart(entry.place, row[1:3]) < degrees for row in rows)

    @staticmethod
    def in_cloud(entry):
        return any(apart(entry.place, row[1:3]) < row[3] for row in MAGELLANIC)

    def is_further_galaxy(self, e):
        if (e.type not in ("s", "s0", "e", "i", "sd") or e.v > FAINTEST_GALAXY
                or not e.width or not e.name.startswith(("M ", "NGC ", "IC "))):
            return False
        mean = e.v + 2.5 * math.log10(math.pi / 4 * e.length * e.width * 3600)
        return mean > BRIGHTEST_GALAXY and not self.named(e, GALAXIES, 0.08)

    @staticmethod
    def galaxy(e):
        size = math.sqrt(e.length * e.width)
        b_v = e.b_v if 0.3 < e.b_v < 1.1 else 0.75
        return e.name, *e.place, size, size, 0, e.v, b_v, 0.6 if e.type in ("e", "s0") else 0.2

    def is_further_cluster(self, e):
        return (e.type == "gc" and e.v < FAINTEST_CLUSTER and not self.in_cloud(e)
                and not self.named(e, CLUSTERS, 0.1))

    @staticmethod
    def further_nebulae(entries):
        taken = [(row[1:3], row[3]) for row in NEBULAE]
        rows = []
        for e in sorted(entries, key=lambda e: e.name):
            brightness = surface_brightness(e)
            size = math.sqrt(e.length * e.width)
            if (brightness is None or e.type in ("pn", "s", "i", "e")
                    or not NEBULA_SIZES[0] <= size or e.length > NEBULA_SIZES[1]):
                continue
            # Two catalogues' entries of one nebula, or the parts of one that is there whole.
            if any(apart(e.place, place) * 60 < 0.6 * max(length, 0.6 * size)
                   and length > 0.3 * size for place, length in taken):
                continue
            taken.append((e.place, size))
            rows.append((e.name, *e.place, size, size, 0, brightness, "pink"))
        return rows
