"""Equirectangular pictures of the sky: J2000, RA 0h in the middle and growing to the left (as seen
from inside), Dec +90 at the top, twice as wide as high. What is measured or blurred here is so on
the sphere. A picture's size is that of the array."""

import functools
import math

import numpy as np

LUMA = np.array([0.2126, 0.7152, 0.0722])  # of linear Rec.709
GALACTIC_POLE = np.array([-0.8676661, -0.1980764, 0.4559838])


def declinations(height):
    """Radians, of the rows."""
    return np.radians(90 - 180 * (np.arange(height) + 0.5) / height)


def solid_angle(height):
    """Steradians of the pixels, as a column."""
    return (math.pi / height) ** 2 * np.cos(declinations(height))[:, None]


def mean_over_sky(image):
    """Mean over the sphere of an image with one channel."""
    weight = np.cos(declinations(len(image)))
    return (image.mean(axis=1) * weight).sum() / weight.sum()


def column_row(ra_deg, dec_deg, height):
    """Place in pixels; the middle of the first pixel is (0, 0)."""
    x = (0.5 - np.asarray(ra_deg) / 360) % 1 * 2 * height - 0.5
    return x, (90 - np.asarray(dec_deg)) / 180 * height - 0.5


def unit_vector(ra_deg, dec_deg):
    ra, dec = math.radians(ra_deg), math.radians(dec_deg)
    return np.array([math.cos(dec) * math.cos(ra), math.cos(dec) * math.sin(ra), math.sin(dec)])


@functools.lru_cache(maxsize=2)
def directions(height):
    """A unit vector for each pixel."""
    ra = 2 * math.pi * (0.5 - (np.arange(2 * height) + 0.5) / (2 * height))
    dec = declinations(height)[:, None]
    return np.stack([np.cos(dec) * np.cos(ra), np.cos(dec) * np.sin(ra),
                     np.sin(dec) * np.ones(2 * height)], axis=2).astype(np.float32)


def rows_near(dec_deg, degrees, height):
    """The rows of the pixels that are within some degrees of a declination, as a slice."""
    first, last = ((90 - dec_deg + side * degrees) / 180 * height for side in (-1, 1))
    return slice(max(int(first), 0), min(int(last) + 1, height))


def separation(ra_deg, dec_deg, height, rows=slice(None)):
    """Degrees from each pixel to a place."""
    offset = directions(height)[rows] - unit_vector(ra_deg, dec_deg).astype(np.float32)
    return np.degrees(2 * np.arcsin(np.minimum(np.sqrt((offset ** 2).sum(axis=2)) / 2, 1)))


def galactic_latitude(height):
    """Degrees, of each pixel."""
    return np.degrees(np.arcsin(directions(height) @ GALACTIC_POLE))


def east_north(ra_deg, dec_deg, height, rows=slice(None)):
    """Degrees east and north of a place, of each pixel, in the zenithal equidistant projection."""
    ra = math.radians(ra_deg)
    there = unit_vector(ra_deg, dec_deg)
    east = np.array([-math.sin(ra), math.cos(ra), 0])
    north = np.cross(there, east)
    d = directions(height)[rows].astype(np.float64)
    x, y = d @ east, d @ north
    sine = np.maximum(np.hypot(x, y), 1e-12)
    scale = np.degrees(np.arctan2(sine, d @ there)) / sine
    return x * scale, y * scale


def blurred(image, degrees):
    """Gaussian of that sigma: along columns across the poles, where a pixel weighs as much as its
    area, along rows wider towards them."""
    height, width = image.shape[:2]
    image = image if image.ndim == 3 else image[..., None]
    sigma = math.radians(degrees)
    dec = declinations(height)
    # A meridian and the one opposite make one great circle, on which nothing ends.
    half = width // 2
    circle = np.concatenate([image[:, :half], image[::-1, half:]], axis=0)
    area = np.cos(np.concatenate([dec, dec[::-1]]))[:, None, None]
    k = np.fft.rfftfreq(2 * height, 1 / (2 * height))
    kernel = np.exp(-0.5 * (k * sigma) ** 2)[:, None, None]

    def along(columns):
        return np.fft.irfft(np.fft.rfft(columns, axis=0) * kernel, 2 * height, axis=0)
    circle = along(circle * area) / along(area)
    rows = np.concatenate([circle[:height], circle[height:][::-1]], axis=1)
    # The rows come last, so that at a pole, which is one place, all of a row agrees.
    row_sigma = np.minimum(sigma / np.maximum(np.cos(dec), 1e-3), 4.0)
    k = np.fft.rfftfreq(width, 1 / width)
    kernel = np.exp(-0.5 * (k[None, :] * row_sigma[:, None]) ** 2)[..., None]
    return np.squeeze(np.fft.irfft(np.fft.rfft(rows, axis=1) * kernel, width, axis=1))


def halved(image):
    """Means of two by two pixels, weighted by their area."""
    weight = solid_angle(len(image)).reshape((-1, 1) + (1,) * (image.ndim - 2))
    rows = (image * weight)[0::2] + (image * weight)[1::2]
    rows = rows / (weight[0::2] + weight[1::2])
    return (rows[:, 0::2] + rows[:, 1::2]) / 2


def doubled(image):
    """Twice the size, by Catmull-Rom's cubics, across the wrap and the poles."""
    half = image.shape[1] // 2

    def between(a, b, c, d):  # at 3/4 of the way from b to c
        return (-3 * a + 29 * b + 111 * c - 9 * d) / 128
    top, bottom = np.roll(image[:2][::-1], half, axis=1), np.roll(image[-2:][::-1], half, axis=1)
    tall = np.concatenate([top, image, bottom], axis=0)
    rows = np.empty((2 * image.shape[0],) + image.shape[1:], image.dtype)
    rows[0::2] = between(*(tall[k:k + image.shape[0]] for k in range(4)))
    rows[1::2] = between(*(tall[4 - k:4 - k + image.shape[0]] for k in range(4)))
    out = np.empty((rows.shape[0], 2 * rows.shape[1]) + rows.shape[2:], rows.dtype)
    out[:, 0::2] = between(*(np.roll(rows, 2 - k, axis=1) for k in range(4)))
    out[:, 1::2] = between(*(np.roll(rows, k - 2, axis=1) for k in range(4)))
    return out


def encoded(linear):
    """sRGB's codes, 0 to 255 and not rounded."""
    linear = np.maximum(linear, 0)
    return 255 * np.where(linear <= 0.0031308, 12.92 * linear,
                          1.055 * np.maximum(linear, 1e-9) ** (1 / 2.4) - 0.055)


def decoded(code):
    """Linear, from sRGB's codes of 0 to 1."""
    return np.where(code <= 0.04045, code / 12.92, ((code + 0.055) / 1.055) ** 2.4)
