"""A made-up spiral galaxy: its disc as pictures from above, and how it is seen from a place above it.

Lengths are in kpc, light is in S10(V) as from straight above, before dust. Everything random comes
from SEED."""

import functools
import math

import numpy as np

from sphere_image import LUMA

SEED = 1916  # the year of L. Flamm's paper, whose funnels are the first wormholes
SIZE, REACH = 4096, 18.0  # pixels of the disc's pictures, from -REACH to REACH
PITCH = math.radians(17)  # of the arms
ARMS_BEGIN = 3.1  # at the ends of the bar
BAR, BAR_WIDTH = 2.9, 0.85
BAR_ANGLE = math.radians(28)

EXTINCTION = np.array([0.72, 1.0, 1.38], np.float32)  # of dust, in R, G, B
PINK = np.array([1.0, 0.22, 0.42], np.float32)  # hydrogen's lines
PINK = PINK / (PINK @ LUMA.astype(np.float32))


# ---- random fields ----

def random_field(shape, slope, name, stretch=1.0, longest=1.0, turn=PITCH):
    """A periodic field of mean 0 and variance 1, whose amplitudes fall with that power of the wave
    number. Its axes are ln r and the azimuth, 2 pi each. It is `stretch` times as long along the
    arms as across them; waves longer than a `longest` of the circle are left out."""
    random = np.random.default_rng([SEED, *name.encode()])
    height, width = shape
    k_r, k_a = np.fft.fftfreq(height, 1 / height)[:, None], np.fft.rfftfreq(width, 1 / width)
    along = (k_r * math.sin(turn) + k_a * math.cos(turn)) * stretch
    k = np.hypot(along, k_r * math.cos(turn) - k_a * math.sin(turn))
    amplitude = np.where(k >= 1 / longest, np.maximum(k, 1) ** -slope, 0)
    waves = np.fft.rfft2(random.standard_normal(shape).astype(np.float32)) * amplitude
    field = np.fft.irfft2(waves, shape).astype(np.float32)
    return field / field.std()


def ridges(field):
    """1 along the lines where a field is 0, falling to both sides of them."""
    return np.exp(-4 * np.abs(field))


def sampled(picture, row, column, wrap=False):
    """Bilinear; beyond the picture its border, or it repeats along both axes."""
    height, width = picture.shape[:2]
    j, i = np.floor(row).astype(np.int32), np.floor(column).astype(np.int32)
    y, x = (row - j).astype(np.float32), (column - i).astype(np.float32)
    if wrap:
        j0, j1, i0, i1 = j % height, (j + 1) % height, i % width, (i + 1) % width
    else:
        j0, j1 = np.clip(j, 0, height - 1), np.clip(j + 1, 0, height - 1)
        i0, i1 = np.clip(i, 0, width - 1), np.clip(i + 1, 0, width - 1)
    if picture.ndim == 3:
        x, y = x[..., None], y[..., None]
    return ((picture[j0, i0] * (1 - x) + picture[j0, i1] * x) * (1 - y)
            + (picture[j1, i0] * (1 - x) + picture[j1, i1] * x) * y)


# ---- the disc from above ----

@functools.lru_cache(maxsize=1)
def plane():
    """Radius and azimuth of the pixels."""
    x = ((np.arange(SIZE) + 0.5) / SIZE * 2 - 1).astype(np.float32) * np.float32(REACH)
    return np.hypot(x[None, :], x[:, None]), np.arctan2(x[:, None], x[None, :])


def on_disc(field):
    r, azimuth = plane()
    height, width = field.shape
    return sampled(field, np.log(np.maximum(r, 0.05)) / (2 * math.pi) * height,
                   azimuth / (2 * math.pi) * width, wrap=True)


@functools.lru_cache(maxsize=1)
def bends():
    """Radians by which the arms are led astray."""
    return (0.16 * on_disc(random_field((1024, 1024), 2.6, "bends", 1.5))
            + 0.035 * on_disc(random_field((1024, 1024), 1.6, "wiggles", 1.5, 0.06)))


def arms(shift, sharpness, turn=0.0):
    """1 on the crest of two arms, less beside it; `shift` kpc outward of them."""
    r, azimuth = plane()
    start = np.log(np.maximum(r - shift, 0.05) / ARMS_BEGIN) / math.tan(PITCH)
    return np.exp(sharpness * (np.cos(2 * (azimuth - BAR_ANGLE - start - turn + bends())) - 1))


def smooth_step(low, high, x):
    t = np.clip((x - low) / (high - low), 0, 1)
    return t * t * (3 - 2 * t)


def along_bar():
    r, azimuth = plane()
    return r * np.cos(azimuth - BAR_ANGLE), r * np.sin(azimuth - BAR_ANGLE)


def arm_light(shift, sharpness):
    """Two great arms, and two small ones farther out."""
    r, _ = plane()
    great = arms(shift, sharpness) * smooth_step(2.4, 3.6, r) * smooth_step(16.5, 10.5, r)
    small = arms(shift, sharpness, 1.3) * smooth_step(3.5, 6.5, r) * smooth_step(15.5, 9.5, r)
    return great + 0.55 * small


def clouds(slope, name, spread, stretch, longest=0.25):
    """Lognormal, of mean 1: a cascade of random factors, that of each octave as strong."""
    field = on_disc(random_field((4096, 4096), slope, name, stretch, longest))
    return np.exp(spread * field - spread ** 2 / 2)


def young_light():
    """Of stars that are as old as the arms in which they were born."""
    r, _ = plane()
    disc = np.exp(-r / 5.0) * smooth_step(1.2, 4.0, r) * smooth_step(17.0, 11.0, r)
    arm = 0.5 * arm_light(0.12, 2.2) + 0.8 * arm_light(0.10, 7.0)
    return 400 * disc * (0.08 + arm) * clouds(1.2, "young", 0.85, 1.8)


def old_light():
    r, _ = plane()
    disc = 420 * np.exp(-r / 2.6) + 36 * np.exp(-r / 6.0)
    x, y = along_bar()
    bar = 700 * np.exp(-0.5 * (np.abs(x / BAR) ** 4 + (y / (0.5 * BAR_WIDTH)) ** 2)
                       - np.abs(x) / 2.2)
    return (disc * (0.8 + 0.5 * arm_light(0.0, 1.2)) + bar) * smooth_step(17.0, 10.0, r)


def dust():
    """Optical depth straight through the disc, in green."""
    r, _ = plane()
    fine = ridges(on_disc(random_field((4096, 4096), 1.6, "filaments", 2.0, 0.07)))
    feathers = ridges(on_disc(random_field((4096, 4096), 1.75, "feathers", 3.5, 0.12,
                                           turn=math.radians(48))))
    cloudy = clouds(1.2, "dust", 0.8, 1.8)
    lanes = arm_light(-0.30, 9.0)
    between = 0.15 + 0.9 * arm_light(-0.05, 1.8)
    x, y = along_bar()
    # Gas falls in along the leading side of the bar.
    side = 0.42 * np.sign(x) * smooth_step(0.1, 1.2, np.abs(x))
    bar_lanes = (np.exp(-((y - side) / 0.13) ** 2) * smooth_step(3.1, 2.2, np.abs(x))
                 * smooth_step(0.1, 0.5, np.abs(x)))
    ring = np.exp(-((r - 0.45) / 0.12) ** 2)
    disc = np.exp(-r / 9.0) * smooth_step(16.0, 10.0, r) * smooth_step(1.8, 3.4, r)
    depth = disc * (4.0 * lanes * (0.3 + fine + 0.5 * feathers)
                    + between * (1.6 * fine + 1.8 * feathers))
    return (depth + (1.0 * bar_lanes + 0.4 * ring) * (0.5 + fine)) * np.minimum(cloudy, 4)


# ---- clusters and nebulae ----

def places_by(weight, count, name):
    """Rows and columns, not whole, of places that are as frequent as the weight is high."""
    random = np.random.default_rng([SEED, *name.encode()])
    sums = np.cumsum(weight.ravel(), dtype=np.float64)
    cell = np.searchsorted(sums, random.random(count) * sums[-1])
    return (cell // SIZE + random.random(count), cell % SIZE + random.random(count), random)


def add_blob(picture, row, column, sigma, light, lumps=None):
    """A Gaussian of this sum, broken up by a field about it."""
    reach = int(math.ceil(3.5 * sigma)) + 1
    j, i = int(row), int(column)
    rows, columns = np.arange(j - reach, j + reach + 1), np.arange(i - reach, i + reach + 1)
    if rows[0] < 0 or columns[0] < 0 or rows[-1] >= SIZE or columns[-1] >= SIZE:
        return
    d2 = (rows[:, None] + 0.5 - row) ** 2 + (columns[None, :] + 0.5 - column) ** 2
    blob = np.exp(-0.5 * d2 / sigma ** 2)
    if lumps is not None:
        blob = blob * lumps[np.ix_(rows % lumps.shape[0], columns % lumps.shape[1])]
    window = picture[rows[0]:rows[-1] + 1, columns[0]:columns[-1] + 1]
    window += (light / blob.sum() * blob).astype(np.float32)


def knots(young, depth):
    """Light of clusters and associations, and that of hydrogen around the youngest of them."""
    r, _ = plane()
    per_kpc = SIZE / (2 * REACH)
    clusters, hydrogen = np.zeros((SIZE, SIZE), np.float32), np.zeros((SIZE, SIZE), np.float32)
    birth = arm_light(0.02, 9.0) * np.exp(-r / 8.0) * smooth_step(16.0, 12.0, r) * smooth_step(2.6, 3.8, r)
    weight = young * (birth + 0.03) * clouds(1.1, "births", 1.1, 1.3, 0.08)
    rows, columns, random = places_by(weight, 12000, "clusters")
    strength = np.minimum(random.pareto(0.95, len(rows)) + 1, 120)
    size = 0.010 * strength ** 0.33 * np.exp(0.35 * random.standard_normal(len(rows)))
    for row, column, sigma, light in zip(rows, columns, size, strength):
        add_blob(clusters, row, column, max(sigma * per_kpc, 0.7), 0.028 * light * per_kpc ** 2)
    lumps = np.exp(1.2 * random_field((1024, 1024), 1.3, "lumps", 1.0, 0.1))
    weight = (birth + 0.01 * np.exp(-r / 4.0) * smooth_step(13.0, 9.0, r)) * (0.3 + np.minimum(depth, 1)) * clouds(1.1, "nebulae", 0.9, 1.3, 0.08)
    rows, columns, random = places_by(weight, 5000, "hydrogen")
    strength = np.minimum(random.pareto(0.95, len(rows)) + 1, 90)
    size = 0.018 * strength ** 0.38 * np.exp(0.3 * random.standard_normal(len(rows)))
    for row, column, sigma, light in zip(rows, columns, size * per_kpc, strength):
        light *= 0.05 * per_kpc ** 2
        add_blob(hydrogen, row, column, max(sigma, 0.8), light, lumps)
        row, column = row + sigma / 2 * random.normal(), column + sigma / 2 * random.normal()
        add_blob(clusters, row, column, max(sigma / 4, 0.7), 0.4 * light)
    return clusters, hydrogen


class Disc:
    """The pictures of the disc, and what light they send towards a place."""

    def __init__(self, starlight_rgb):
        young, depth = young_light(), dust()
        clusters, hydrogen = knots(young, depth)
        r = plane()[0]
        old_colour = starlight_rgb(1.02 - 0.38 * smooth_step(2.0, 9.5, r[::8, ::8]))
        old_colour = np.repeat(np.repeat(old_colour, 8, axis=0), 8, axis=1).astype(np.float32)
        self.old = old_colour * old_light()[..., None]
        self.young = ((young[..., None] * starlight_rgb(0.06)
                       + clusters[..., None] * starlight_rgb(-0.12)
                       + hydrogen[..., None] * PINK)).astype(np.float32)
        self.depth = depth.astype(np.float32)
        self.births = young  # per area, of what is brightest
        self.pyramids = {}

    def pyramid(self, name):
        if name not in self.pyramids:
            levels = [getattr(self, name)]
            while len(levels) < 5:
                p = levels[-1]
                levels.append((p[0::2, 0::2] + p[0::2, 1::2] + p[1::2, 0::2] + p[1::2, 1::2]) / 4)
            self.pyramids[name] = levels
        return self.pyramids[name]

    def at(self, name, x, y, width):
        """What a picture has there, as the mean over about `width` kpc."""
        levels = self.pyramid(name)
        level = np.clip(np.log2(np.maximum(width / (2 * REACH / SIZE), 1)), 0, len(levels) - 1.001)
        out = 0
        for k, picture in enumerate(levels):
            share = np.maximum(1 - np.abs(level - k), 0).astype(np.float32)
            if not share.any():
                continue
            scale = len(picture) / (2 * REACH)
            value = sampled(picture, (y + REACH) * scale - 0.5, (x + REACH) * scale - 0.5)
            value[np.maximum(np.abs(x), np.abs(y)) > 0.995 * REACH] = 0
            out = out + value * (share[..., None] if picture.ndim == 3 else share)
        return out


# Layers from above to below: height in kpc, and their parts of the old and the young stars and of
# the dust.
LAYERS = [(0.45, 0.18, 0, 0), (0.15, 0.22, 0, 0), (0.035, 0, 0, 0.35), (0, 0.2, 1, 0.3),
          (-0.035, 0, 0, 0.35), (-0.15, 0.22, 0, 0), (-0.45, 0.18, 0, 0)]


def disc_light(disc, place, directions, pixel):
    """The disc's light from the directions (kpc's axes, all downward), and what part of a light behind
    the disc is left."""
    down = -directions[..., 2]
    path = 1 / down
    light = np.zeros(directions.shape, np.float32)
    left = np.ones(directions.shape, np.float32)
    for height, old, young, dusty in LAYERS:
        t = (place[2] - height) / down
        x, y = place[0] + t * directions[..., 0], place[1] + t * directions[..., 1]
        width = pixel * t * np.sqrt(path)
        if old:
            light += left * disc.at("old", x, y, width) * (old * path)[..., None]
        if young:
            light += left * disc.at("young", x, y, width) * (young * path)[..., None]
        if dusty:
            depth = disc.at("depth", x, y, width) * (dusty * path)
            left *= np.exp(-depth[..., None] * EXTINCTION)
    return light, left


def round_light(place, directions, steps=96):
    """Light of the bulge and the halo, S10, from before the disc's plane and from behind it."""
    before = np.zeros(directions.shape[:-1], np.float32)
    behind = np.zeros_like(before)
    nearest = -(directions @ place)
    closest = np.sqrt(np.maximum(place @ place - nearest ** 2, 0)) + 0.05
    cosine, sine = math.cos(BAR_ANGLE), math.sin(BAR_ANGLE)
    # s = closest sinh(q) runs through the middle finely and far out coarsely.
    q = np.linspace(-4.5, 4.5, steps)
    for step in q:
        t = nearest + closest * math.sinh(step)
        ds = closest * math.cosh(step) * (q[1] - q[0])
        p = place + t[..., None] * directions
        x, y = p[..., 0] * cosine + p[..., 1] * sine, p[..., 1] * cosine - p[..., 0] * sine
        m2 = (x / 1.35) ** 2 + (y / 0.85) ** 2 + (p[..., 2] / 0.65) ** 2
        bulge = 5200 * (m2 + 0.02) ** -0.9 * np.exp(-np.sqrt(m2) / 0.62) * 0.16
        halo = 1.5 * ((p ** 2).sum(axis=-1) / 9 + 1) ** -1.6
        light = np.where(t > 0, (bulge + halo) * ds, 0)
        above = p[..., 2] > 0
        before += np.where(above, light, 0).astype(np.float32)
        behind += np.where(above, 0, light).astype(np.float32)
    return before, behind
