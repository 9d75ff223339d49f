#!/usr/bin/python3
"""Makes the sky of a far place, for the other side of a wormhole: nothing of it exists.

    make_far_sky.py DOMEFALL FOLDER

DOMEFALL is the program, which packs the stars. FOLDER receives far_sky.exr, 4096 x 2048, without the
stars of V <= 9, and far_stars.stars, those. Needs python3-numpy and python3-openimageio; it takes
ten minutes of a processor and 5 GB of memory. PROVENANCE.md says what is to be seen.

The picture lies as milky_way.exr does, and has its unit. A spiral galaxy stands at AHEAD, where the
mouth of a wormhole is by default, so that it is straight ahead of those who come through.
"""

import csv
import math
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

import far_galaxy
from deep_sky_light import ellipse_radius, of_flux, turbulence
from far_galaxy import PINK, SEED
from far_stars import stars_of
from make_milky_way import S10, starlight_rgb, write
from sphere_image import (blurred, column_row, directions, east_north, rows_near, separation,
                          solid_angle, unit_vector)

HEIGHT = 2048
AHEAD = (266.405, -28.936)
# The place, as seen from the galaxy: its distance (kpc), how far from the axis of the disc it is, and
# at which azimuth; and by how much the galaxy is turned in its sky, from north through east.
DISTANCE, SLANT, AZIMUTH, TURN = 20.0, 42.0, 70.0, 30.0
CLUSTER = (74.0, 245.0)  # degrees from the galaxy, and in which direction there
DARKEST = 0.9  # S10, of the light of all far galaxies


def aside(distance, position_angle):
    """RA and Dec (degrees) of a place that is so far from AHEAD, in that direction."""
    ahead = unit_vector(*AHEAD)
    east = np.cross([0, 0, 1], ahead)
    east /= np.linalg.norm(east)
    north = np.cross(ahead, east)
    a, p = math.radians(distance), math.radians(position_angle)
    v = math.cos(a) * ahead + math.sin(a) * (math.cos(p) * north + math.sin(p) * east)
    return math.degrees(math.atan2(v[1], v[0])) % 360, math.degrees(math.asin(v[2]))


def view_of_galaxy():
    """The place in the galaxy's axes (kpc), and the matrix from those axes to the sky's."""
    slant, azimuth, turn = (math.radians(x) for x in (SLANT, AZIMUTH, TURN))
    outward = np.array([math.sin(slant) * math.cos(azimuth), math.sin(slant) * math.sin(azimuth),
                        math.cos(slant)])
    right = np.cross([0, 0, 1], outward)
    right /= np.linalg.norm(right)
    up = np.cross(outward, right)
    ahead = unit_vector(*AHEAD)
    east = np.cross([0, 0, 1], ahead)
    east /= np.linalg.norm(east)
    north = np.cross(ahead, east)
    sky_up = math.cos(turn) * north + math.sin(turn) * east
    sky_right = np.cross(ahead, sky_up)
    return DISTANCE * outward, (np.outer(sky_right, right) + np.outer(sky_up, up)
                                - np.outer(ahead, outward))


def galaxy(disc, place, sky_from_galaxy):
    """In bands of rows, to save memory."""
    sky = np.zeros((HEIGHT, 2 * HEIGHT, 3), np.float32)
    old = starlight_rgb(0.98).astype(np.float32)
    for first in range(0, HEIGHT, 128):
        rows = slice(first, first + 128)
        there = directions(HEIGHT)[rows] @ sky_from_galaxy.astype(np.float32)
        before, behind = far_galaxy.round_light(place, there)
        left = np.ones(there.shape, np.float32)
        seen = there[..., 2] < -0.2
        if seen.any():
            light, left[seen] = far_galaxy.disc_light(disc, place, there[seen], math.pi / HEIGHT)
            sky[rows][seen] = light
        sky[rows] += (before[..., None] + behind[..., None] * left) * old
    return sky


def splatted(ra, dec, light):
    """S10 of many points, without a blur."""
    x, y = column_row(ra, dec, HEIGHT)
    sky = np.zeros((HEIGHT, 2 * HEIGHT))
    np.add.at(sky, (np.clip(np.round(y).astype(int), 0, HEIGHT - 1),
                    np.round(x).astype(int) % (2 * HEIGHT)), light)
    return sky / (solid_angle(HEIGHT) * math.degrees(1) ** 2)


def faint_stars(rows):
    """Their light, the more smoothed the farther from the cluster's middle."""
    near = separation(*aside(*CLUSTER), HEIGHT)[..., None]
    sky = np.zeros((HEIGHT, 2 * HEIGHT, 3), np.float32)
    for low, high in ((-1, 0.55), (0.55, 0.85), (0.85, 1.15), (1.15, 3)):  # of B-V
        some = rows[(rows[:, 3] >= low) & (rows[:, 3] < high)]
        light = splatted(some[:, 0], some[:, 1], 10 ** (-0.4 * (some[:, 2] - 10)))
        smooth = np.stack([blurred(light, degrees) for degrees in (0.8, 1.8, 6.0)], axis=2)
        share = np.concatenate([near < 6, (near >= 6) & (near < 20), near >= 20], axis=2)
        share = blurred(share.astype(np.float32), 2.0)
        sky += (smooth * share).sum(axis=2)[..., None] * starlight_rgb(
            (max(low, 0) + min(high, 1.4)) / 2)
    return sky


def stream(place, sky_from_galaxy):
    """What is left of a dwarf galaxy, along its orbit about the great one."""
    random = np.random.default_rng([SEED, 4])
    count = 400_000
    angle = random.vonmises(0.4, 0.5, count)
    along = np.stack([21 * np.cos(angle) - 7, 15 * np.sin(angle), np.zeros(count)], axis=1)
    tilt, node = math.radians(72), math.radians(15)
    turned = np.stack([along[:, 0], along[:, 1] * math.cos(tilt), along[:, 1] * math.sin(tilt)], axis=1)
    x, y = turned[:, 0], turned[:, 1]
    turned[:, 0] = x * math.cos(node) - y * math.sin(node)
    turned[:, 1] = x * math.sin(node) + y * math.cos(node)
    width = 0.35 + 0.5 * np.abs(angle - 0.4)[:, None] / math.pi
    there = turned + width * random.standard_normal((count, 3)) - place
    d = np.linalg.norm(there, axis=1)
    v = there @ sky_from_galaxy.T / d[:, None]
    light = splatted(np.degrees(np.arctan2(v[:, 1], v[:, 0])), np.degrees(np.arcsin(v[:, 2])),
                     1 / d ** 2)
    total = (light * solid_angle(HEIGHT)).sum() * math.degrees(1) ** 2
    return blurred(light * (10 ** (-0.4 * (3.2 - 10)) / total), 0.35)[..., None] * starlight_rgb(0.78)


def small_galaxy(sky, ra, dec, length, width, angle, v, b_v, bulge):
    """An exponential disc with a bulge; minutes of arc, degrees."""
    pixel = 60 * 180 / HEIGHT
    rows = rows_near(dec, 1.4 * max(length, 3 * pixel) / 60, HEIGHT)
    east, north = east_north(ra, dec, HEIGHT, rows)

    def part(a, b, fall):
        a, b = math.hypot(a, 1.8 * pixel), math.hypot(b, 1.8 * pixel)
        r = np.hypot(ellipse_radius(east, north, a, b, angle), 0.6 * pixel / b)
        return np.exp(-fall * r) * np.clip((2.6 - r) / 0.8, 0, 1)
    disc = of_flux(part(length, width, 3.0), v, HEIGHT, rows)
    size = min(0.3 * length, 0.6 * width)
    core = of_flux(part(size, 0.8 * size, 2.5), v, HEIGHT, rows)
    sky[rows] += ((1 - bulge) * disc[..., None] * starlight_rgb(b_v - 0.15 * (bulge > 0))
                  + bulge * core[..., None] * starlight_rgb(b_v + 0.1))


def far_galaxies():
    """Some alone, more in two swarms; the fainter the more."""
    random = np.random.default_rng([SEED, 5])
    sky = np.zeros((HEIGHT, 2 * HEIGHT, 3))
    swarms = [(aside(74, 120), 7.0), (aside(128, 40), 4.0)]
    for k in range(900):
        if k % 2:
            (ra, dec), spread = swarms[k // 2 % 3 > 0]
            dec_k = dec + spread * random.standard_normal()
            ra_k = ra + spread * random.standard_normal() / math.cos(math.radians(dec))
        else:
            ra_k, dec_k = 360 * random.random(), math.degrees(math.asin(2 * random.random() - 1))
        length = min(2.2 * (random.pareto(1.9) + 1), 22)
        early = random.random() < (0.75 if k % 2 else 0.3)
        ratio = 0.6 + 0.4 * random.random() if early else 0.15 + 0.85 * random.random()
        v = 22.0 - 2.5 * math.log10(math.pi / 4 * ratio * (60 * length) ** 2) + 0.5 * random.normal()
        if abs(dec_k) < 85:
            small_galaxy(sky, ra_k % 360, dec_k, length, ratio * length, 180 * random.random(), v,
                         0.92 if early else 0.6, 0.8 if early else 0.2)
    return sky


def edge_on():
    """A spiral that shows its edge, and in it the dust."""
    ra, dec = aside(62, 345)
    length, width, angle = 290.0, 44.0, 152.0
    rows = rows_near(dec, 6, HEIGHT)
    east, north = east_north(ra, dec, HEIGHT, rows)
    cos, sin = math.cos(math.radians(angle)), math.sin(math.radians(angle))
    x, y = (north * cos + east * sin) * 60, (east * cos - north * sin) * 60
    ragged = turbulence("edge's dust", x / 60, y / 20, 0.9, 0.1)
    disc = np.exp(-2.6 * np.hypot(2 * x / length, 0.05)) / np.cosh(np.clip(2.2 * y / width, -20, 20)) ** 2
    disc *= np.clip((1.15 - np.abs(2 * x / length)) / 0.3, 0, 1)
    core = 1.6 * np.exp(-2.2 * np.hypot(x / 22, y / 14) ** 0.7)
    lane = np.exp(-((y + 2.7) / (5.4 + 1.4 * ragged)) ** 2) * np.clip(1.1 - np.abs(2 * x / length), 0, 1)
    depth = 1.9 * lane * np.exp(0.35 * ragged)
    shape = (disc[..., None] * starlight_rgb(0.68) * np.exp(0.12 * ragged)[..., None]
             + core[..., None] * starlight_rgb(0.95))
    shape = shape * np.exp(-depth[..., None] * far_galaxy.EXTINCTION)
    sky = np.zeros((HEIGHT, 2 * HEIGHT, 3))
    whole = of_flux(disc + core, 3.2, HEIGHT, rows)
    sky[rows] = shape * (whole.sum() / (disc + core).sum())
    return sky


def cloud():
    """An irregular dwarf beside the great galaxy, with a bar and young stars."""
    ra, dec = aside(47, 55)
    rows = rows_near(dec, 9, HEIGHT)
    east, north = east_north(ra, dec, HEIGHT, rows)
    bent = 0.5 * turbulence("cloud's bend", east, north, 4, 0.5)
    r = ellipse_radius(east + bent, north, 60 * 6.0, 60 * 4.2, 65)
    bar = np.exp(-2.0 * ellipse_radius(east - 0.4, north + 0.3, 60 * 3.2, 60 * 0.9, 88) ** 1.5)
    lumps = np.exp(0.9 * turbulence("cloud's stars", east, north, 2.5, 0.15))
    fire = np.maximum(turbulence("cloud's births", east, north, 1.6, 0.12) - 1.6, 0) ** 1.5
    body = np.exp(-2.6 * r) * np.clip(2.4 - r, 0, 1)
    young, glow = body * lumps ** 1.4, body * fire * 3.0
    sky = np.zeros((HEIGHT, 2 * HEIGHT, 3))
    sky[rows] = (of_flux(body + 0.5 * bar, 2.4, HEIGHT, rows)[..., None] * starlight_rgb(0.6)
                 + of_flux(young, 2.2, HEIGHT, rows)[..., None] * starlight_rgb(0.1)
                 + of_flux(glow, 3.6, HEIGHT, rows)[..., None] * PINK)
    return sky


def make_sky(disc, place, sky_from_galaxy, faint):
    sky = galaxy(disc, place, sky_from_galaxy) + faint_stars(faint) + stream(place, sky_from_galaxy)
    others = far_galaxies() + edge_on() + cloud()
    small_galaxy(others, *aside(31, 325), 55, 42, 20, 6.4, 0.9, 0.5)  # a satellite
    return sky + np.maximum(blurred(others, 0.6 * 180 / HEIGHT), 0) + DARKEST


def write_stars(program, rows, out):
    with tempfile.TemporaryDirectory() as folder:
        table = pathlib.Path(folder, "far_stars.csv")
        with open(table, "w", newline="", encoding="ascii") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(["ra_deg", "dec_deg", "v_mag", "b_v"])
            writer.writerows((f"{ra:.4f}", f"{dec:.4f}", f"{v:.2f}", f"{b_v:.2f}")
                             for ra, dec, v, b_v in rows)
        subprocess.run([program, "stars", "import", "csv", table, "--out", out], check=True)


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    program, folder = sys.argv[1:]
    place, sky_from_galaxy = view_of_galaxy()
    disc = far_galaxy.Disc(starlight_rgb)
    bright, faint = stars_of(disc, place, sky_from_galaxy, unit_vector(*aside(*CLUSTER)))
    write_stars(program, bright, f"{folder}/far_stars.stars")
    write(make_sky(disc, place, sky_from_galaxy, faint) * S10, f"{folder}/far_sky.exr",
          "A far sky, made up, without stars of V <= 9", "The Domefall authors")


if __name__ == "__main__":
    main()
