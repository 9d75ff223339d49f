"""Made-up stars of a far sky: an old star cluster, in whose outskirts one stands, the brightest stars
of the spiral galaxy beyond, and its globular clusters. Rows are RA, Dec (degrees), V, B-V."""

import math

import numpy as np

from far_galaxy import REACH, SEED, SIZE

LIMIT = 9.0  # of V
CLUSTER_PC = 26  # to its middle
CLUSTER_CORE_PC, CLUSTER_END_PC = 2.2, 75
CLUSTER_STARS = 100_000

# Colours against M_V of an old cluster of few metals: dwarfs, giants, the blue and the red end of the
# horizontal branch; and how many stars a magnitude has, against M_V. Both roughly after M 13.
DWARFS = ([4.0, 4.5, 5, 6, 7, 8, 9, 10, 11], [0.42, 0.44, 0.48, 0.60, 0.78, 0.98, 1.15, 1.30, 1.42])
GIANTS = ([-2.6, -2, -1, 0, 1, 2, 3, 3.4, 4.0], [1.58, 1.36, 1.10, 0.92, 0.80, 0.74, 0.66, 0.52, 0.42])
COUNTS = ([-2.6, -1, 0, 1, 2, 3, 4, 5, 6, 8, 11], [1, 3, 7, 14, 30, 80, 400, 700, 900, 1200, 1500])
BRANCH = 0.012  # of all stars, on the horizontal branch; a quarter as many are blue stragglers


def magnitude_at(absolute, parsec):
    return absolute + 5 * np.log10(parsec / 10)


def drawn(random, count, x, density):
    """Numbers from a density that is given by its values."""
    grid = np.linspace(x[0], x[-1], 4001)
    sums = np.cumsum(np.interp(grid, x, density))
    return np.interp(random.random(count), sums / sums[-1], grid)


def old_stars(random, count):
    """M_V and B-V."""
    absolute = drawn(random, count, *COUNTS)
    colour = np.where(absolute < 4, np.interp(absolute, *GIANTS), np.interp(absolute, *DWARFS))
    colour = colour + 0.015 * random.standard_normal(count)
    kind = random.random(count)
    place = random.random(count)  # along the horizontal branch, from its blue end
    on_branch = kind < BRANCH
    absolute = np.where(on_branch, 0.55 + 1.6 * np.maximum(0.35 - place, 0) ** 1.2, absolute)
    colour = np.where(on_branch, -0.12 + 0.75 * place, colour)
    straggler = (kind >= BRANCH) & (kind < 1.25 * BRANCH)
    return (np.where(straggler, 1.6 + 2 * place, absolute),
            np.where(straggler, 0.02 + 0.33 * place, colour))


def random_directions(random, count):
    v = random.standard_normal((count, 3))
    return v / np.linalg.norm(v, axis=1)[:, None]


def ra_dec(v):
    return (np.degrees(np.arctan2(v[:, 1], v[:, 0])) % 360,
            np.degrees(np.arctan2(v[:, 2], np.hypot(v[:, 0], v[:, 1]))))


def cluster(middle):
    """The old cluster, whose middle is in that direction. Also stars that are fainter than LIMIT."""
    random = np.random.default_rng([SEED, 1])
    r = np.linspace(0, CLUSTER_END_PC, 2000)
    away = drawn(random, CLUSTER_STARS, r, r ** 2 * (1 + (r / CLUSTER_CORE_PC) ** 2) ** -1.5)
    places = middle * CLUSTER_PC + away[:, None] * random_directions(random, CLUSTER_STARS)
    parsec = np.linalg.norm(places, axis=1)
    absolute, colour = old_stars(random, CLUSTER_STARS)
    keep = parsec > 1.5  # none is a sun
    return np.column_stack([*ra_dec(places), magnitude_at(absolute, parsec), colour])[keep]


def supergiants(disc, place, sky_from_galaxy):
    """The brightest stars of the spiral arms, which are seen from `place` (kpc)."""
    random = np.random.default_rng([SEED, 2])
    count = 6000
    sums = np.cumsum(disc.births.ravel(), dtype=np.float64)
    cell = np.searchsorted(sums, random.random(count) * sums[-1])
    x = (np.stack([cell % SIZE, cell // SIZE], axis=1) + random.random((count, 2))) / SIZE
    there = np.column_stack([(2 * x - 1) * REACH, 0.08 * random.standard_normal(count)]) - place
    absolute = drawn(random, count, [-9.2, -8, -7, -6], [1, 5, 18, 50])
    kind = random.random(count)
    colour = np.select([kind < 0.72, kind < 0.82], [-0.14, 0.35], 1.75)
    colour = colour + 0.08 * random.standard_normal(count)
    v = magnitude_at(absolute, 1000 * np.linalg.norm(there, axis=1)) + 0.3 * random.random(count)
    return np.column_stack([*ra_dec(there @ sky_from_galaxy.T), v, colour])


def globular_clusters(place, sky_from_galaxy):
    """From here each is a point."""
    random = np.random.default_rng([SEED, 3])
    count = 180
    r = np.linspace(0, 40, 2000)
    away = drawn(random, count, r, r ** 2 * (r ** 2 + 4) ** -1.75)
    there = away[:, None] * random_directions(random, count) - place
    absolute = -7.3 + 1.2 * random.standard_normal(count)
    v = magnitude_at(absolute, 1000 * np.linalg.norm(there, axis=1))
    colour = 0.75 + 0.08 * random.standard_normal(count)
    return np.column_stack([*ra_dec(there @ sky_from_galaxy.T), v, colour])


def stars_of(disc, place, sky_from_galaxy, cluster_middle):
    """Those to LIMIT, brightest first, and the fainter ones."""
    rows = np.concatenate([cluster(cluster_middle), supergiants(disc, place, sky_from_galaxy),
                           globular_clusters(place, sky_from_galaxy)])
    rows = rows[np.argsort(rows[:, 2], kind="stable")]
    bright = rows[:, 2] <= LIMIT
    return rows[bright], rows[~bright]
