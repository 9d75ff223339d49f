"""The light of a catalogue's faint stars, run together: by a kernel for each star whose width is
that of the circle in which its like are some tens (adaptive kernel estimation; Silverman 1986,
Density Estimation, section 5.3)."""

import math

import numpy as np

from sphere_image import blurred, column_row, doubled, galactic_latitude, solid_angle

# Kernels of these sigmas (degrees); a star's light is shared between the two next to its own.
SIGMAS = 0.15 * np.sqrt(2) ** np.arange(13)
LIKE = (9.0, 10.0, 10.75, 11.5, 99.0)  # V between which stars are each other's like
# Stars in a kernel, so that the light of each kind wavers by an eighth near the galactic equator,
# where clouds have small shapes, and by an eighteenth beyond 30 degrees, where none do.
STARS_IN_KERNEL = 64, 320


def read_tycho2(folder):
    """RA, Dec (degrees), V and B-V (0.7 where a magnitude is missing) of Tycho-2 and its first
    supplement."""
    parts = []

    def column(rows, first, last):
        cut = np.ascontiguousarray(rows[:, first - 1:last])
        return np.char.strip(cut.view(f"S{last - first + 1}")[:, 0])

    def add(ra, dec, bt, vt):
        whole = (bt != b"") & (vt != b"")
        lone = np.where(vt == b"", bt, vt)
        v = np.where(whole, vt, lone).astype(float)
        difference = np.where(whole, bt, lone).astype(float) - v
        parts.append(np.stack([ra.astype(float), dec.astype(float), v - 0.09 * difference,
                               np.where(whole, 0.85 * difference, 0.7)]))
    for part in range(20):
        text = np.fromfile(f"{folder}/tyc2.dat.{part:02d}", np.uint8).reshape(-1, 207)
        # A row without mean place (flag X) has the observed one.
        observed = text[:, 13] == ord("X")
        add(np.where(observed, column(text, 153, 164), column(text, 16, 27)),
            np.where(observed, column(text, 166, 177), column(text, 29, 40)),
            column(text, 111, 116), column(text, 124, 129))
    text = np.fromfile(f"{folder}/suppl_1.dat", np.uint8).reshape(-1, 123)
    add(column(text, 16, 27), column(text, 29, 40), column(text, 84, 89), column(text, 97, 102))
    return np.concatenate(parts, axis=1)


def pixels_of(ra, dec, height):
    column, row = column_row(ra, dec, height)
    row = np.clip(np.round(row), 0, height - 1).astype(int)
    return row * 2 * height + np.round(column).astype(int) % (2 * height)


def summed(pixel, weight, height):
    """Weight per square degree."""
    total = np.bincount(pixel, weight, 2 * height * height).reshape(height, 2 * height)
    return total / (solid_angle(height) * math.degrees(1) ** 2)


def kernel_levels(ra, dec):
    """Where each star's kernel lies among SIGMAS, as a number with a fraction."""
    height = 512
    pixel = pixels_of(ra, dec, height)
    density = summed(pixel, np.ones(len(pixel)), height)
    # How many stars a Gaussian holds: one is as good as a circle of the area 4 pi sigma^2.
    held = np.stack([blurred(density, max(s, 0.35)) * 4 * math.pi * s ** 2 for s in SIGMAS])
    held = np.maximum.accumulate(np.maximum(held, 1e-6), axis=0).reshape(len(SIGMAS), -1)[:, pixel]
    beyond = np.clip((np.abs(galactic_latitude(height)).ravel()[pixel] - 8) / 22, 0, 1)
    wanted = STARS_IN_KERNEL[0] * (STARS_IN_KERNEL[1] / STARS_IN_KERNEL[0]) ** beyond
    level = np.full(len(pixel), len(SIGMAS) - 1.0)
    for k in range(len(SIGMAS) - 2, -1, -1):
        enough = held[k + 1] >= wanted
        part = np.clip(np.log(wanted / held[k]) / np.log(held[k + 1] / held[k] + 1e-9),
                       0, 1)
        level = np.where(enough, k + part, level)
    return level


def glow(catalogue, brightest, height, shape):
    """Light of the stars fainter than `brightest` in V and in B, stars of V = 10 per square degree.
    `shape(sigma)` is what the light of kernels of that sigma is multiplied by, for the detail that
    they blur."""
    ra, dec, v, b_v = catalogue[:, catalogue[2] > brightest]
    level = np.empty(len(v))
    for low, high in zip(LIKE[:-1], LIKE[1:]):
        like = (v > low) & (v <= high)
        level[like] = kernel_levels(ra[like], dec[like])
    light = np.stack([10 ** (-0.4 * (v - 10)), 10 ** (-0.4 * (v + np.clip(b_v, -0.3, 2.0) - 10))])
    total = np.zeros((height, 2 * height, 2))
    for k, sigma in enumerate(SIGMAS):
        share = np.clip(1 - np.abs(level - k), 0, 1)
        near = share > 0
        if not near.any():
            continue
        small = height  # wide kernels need few pixels
        while small > 256 and sigma > 3 * 180 / small:
            small //= 2
        pixel = pixels_of(ra[near], dec[near], small)
        maps = np.stack([summed(pixel, share[near] * x[near], small) for x in light], axis=2)
        maps = blurred(maps, sigma)
        while len(maps) < height:
            maps = doubled(maps)
        total += maps * shape(sigma)[..., None]
        print(f"  sigma {sigma:.2f} deg: {share.sum():.0f} stars")
    return np.maximum(total, 1e-3)
