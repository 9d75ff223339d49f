"""Equirectangular pictures of the sky: J2000, RA 0h in the middle and growing to the left (as seen
from inside), Dec +90 at the top. What is measured or blurred here is so on the sphere."""

import math

import numpy as np

WIDTH, HEIGHT = 2048, 1024
DEC = np.radians(90 - 180 * (np.arange(HEIGHT) + 0.5) / HEIGHT)
SOLID_ANGLE = (2 * math.pi / WIDTH) * (math.pi / HEIGHT) * np.cos(DEC)[:, None] * np.ones(WIDTH)
LUMA = np.array([0.2126, 0.7152, 0.0722])  # of linear Rec.709
GALACTIC_POLE = np.array([-0.8676661, -0.1980764, 0.4559838])


def mean_over_sky(image):
    """Mean over the sphere of an image with one channel."""
    return (image * SOLID_ANGLE).sum() / SOLID_ANGLE.sum()


def column_row(ra_deg, dec_deg):
    """Place in pixels; the middle of the first pixel is (0, 0)."""
    x = (0.5 - np.asarray(ra_deg) / 360) % 1 * WIDTH - 0.5
    return x, (90 - np.asarray(dec_deg)) / 180 * HEIGHT - 0.5


def directions():
    """A unit vector for each pixel."""
    ra = 2 * math.pi * (0.5 - (np.arange(WIDTH) + 0.5) / WIDTH)
    cos_dec = np.cos(DEC)[:, None]
    return np.stack([cos_dec * np.cos(ra), cos_dec * np.sin(ra),
                     np.sin(DEC)[:, None] * np.ones(WIDTH)], axis=2)


def separation(ra_deg, dec_deg):
    """Degrees from each pixel to a place."""
    ra, dec = math.radians(ra_deg), math.radians(dec_deg)
    there = [math.cos(dec) * math.cos(ra), math.cos(dec) * math.sin(ra), math.sin(dec)]
    chord = np.linalg.norm(directions() - np.array(there), axis=2)
    return np.degrees(2 * np.arcsin(np.minimum(chord / 2, 1)))


def blurred(image, degrees):
    """Gaussian of that sigma: along columns across the poles, where a pixel weighs as much as its
    area, along rows wider towards them."""
    image = image if image.ndim == 3 else image[..., None]
    sigma = math.radians(degrees)
    # A meridian and the one opposite make one great circle, on which nothing ends.
    half = WIDTH // 2
    circle = np.concatenate([image[:, :half], image[::-1, half:]], axis=0)
    area = np.cos(np.concatenate([DEC, DEC[::-1]]))[:, None, None]
    k = np.fft.rfftfreq(2 * HEIGHT, 1 / (2 * HEIGHT))
    kernel = np.exp(-0.5 * (k * sigma) ** 2)[:, None, None]

    def along(columns):
        return np.fft.irfft(np.fft.rfft(columns, axis=0) * kernel, 2 * HEIGHT, axis=0)
    circle = along(circle * area) / along(area)
    rows = np.concatenate([circle[:HEIGHT], circle[HEIGHT:][::-1]], axis=1)
    # The rows come last, so that at a pole, which is one place, all of a row agrees.
    row_sigma = np.minimum(sigma / np.maximum(np.cos(DEC), 1e-3), 4.0)
    k = np.fft.rfftfreq(WIDTH, 1 / WIDTH)
    kernel = np.exp(-0.5 * (k[None, :] * row_sigma[:, None]) ** 2)[..., None]
    return np.squeeze(np.fft.irfft(np.fft.rfft(rows, axis=1) * kernel, WIDTH, axis=1))


def encoded(linear):
    """sRGB's codes, 0 to 255 and not rounded."""
    linear = np.maximum(linear, 0)
    return 255 * np.where(linear <= 0.0031308, 12.92 * linear,
                          1.055 * np.maximum(linear, 1e-9) ** (1 / 2.4) - 0.055)


def decoded(code):
    """Linear, from sRGB's codes of 0 to 1."""
    return np.where(code <= 0.04045, code / 12.92, ((code + 0.055) / 1.055) ** 2.4)
