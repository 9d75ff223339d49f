"""Nebulae, galaxies and globular clusters that the sky's picture is to show: places (degrees,
J2000), sizes (arcminutes), position angles (degrees from north to east), light.

Places, sizes and magnitudes are those of the NGC and IC, Messier, Sharpless and RCW catalogues, of
the Third Reference Catalogue of Bright Galaxies (de Vaucouleurs et al. 1991) and of the catalogue of
globular clusters by Harris (1996), rounded. The surface brightness of nebulae, as the eye's V has
it, is estimated; few were ever measured over their whole extent."""

import math

import numpy as np

from sphere_image import LUMA, east_north, mean_over_sky, rows_near, separation, solid_angle

# Linear Rec.709 of luminance 1. Glowing hydrogen (H alpha, H beta) with oxygen is outside of that
# space; this is as red as reads as a nebula's pink.
PINK = np.array([1.0, 0.36, 0.46])
ROSE = np.array([1.0, 0.55, 0.62])  # bright cores, where oxygen's green light joins in
BLUE = np.array([0.62, 0.78, 1.0])  # light that dust reflects
AMBER = np.array([1.0, 0.72, 0.45])
KINDS = {"pink": PINK, "rose": ROSE, "blue": BLUE, "amber": AMBER}

# Name, RA, Dec, length, width, position angle, mean mag/arcsec^2, kind.
NEBULAE = [
    ("M 42", 83.82, -5.40, 60, 50, 0, 21.8, "pink"),
    ("M 42, inner", 83.82, -5.40, 22, 18, 45, 19.0, "rose"),
    ("NGC 1977", 83.85, -4.85, 30, 14, 90, 22.5, "blue"),
    ("IC 434", 85.30, -2.45, 70, 12, 0, 23.3, "pink"),
    ("NGC 2024", 85.43, -1.86, 28, 26, 0, 22.3, "amber"),
    ("M 78", 86.69, 0.05, 9, 8, 0, 20.8, "blue"),
    ("Sh 2-264", 83.78, 9.93, 380, 360, 0, 26.4, "pink"),
    ("Rosette", 97.98, 4.95, 80, 70, 0, 22.9, "pink"),
    ("NGC 2264", 100.24, 9.80, 60, 40, 150, 23.4, "pink"),
    ("NGC 2174", 92.40, 20.50, 38, 30, 0, 23.0, "pink"),
    ("IC 443", 94.30, 22.55, 45, 30, 135, 24.0, "pink"),
    ("California", 60.20, 36.42, 150, 40, 115, 23.4, "pink"),
    ("IC 405", 79.10, 34.35, 32, 20, 120, 23.1, "pink"),
    ("IC 410", 80.63, 33.45, 36, 30, 0, 23.3, "pink"),
    ("IC 1805", 38.20, 61.47, 95, 85, 0, 23.3, "pink"),
    ("IC 1848", 43.00, 60.43, 105, 55, 100, 23.4, "pink"),
    ("NGC 281", 13.20, 56.62, 34, 30, 0, 22.9, "pink"),
    ("NGC 7822", 0.90, 67.20, 65, 30, 90, 23.8, "pink"),
    ("NGC 7380", 341.80, 58.10, 26, 22, 0, 23.1, "pink"),
    ("Sh 2-155", 344.20, 62.60, 50, 30, 70, 23.8, "pink"),
    ("IC 1396", 324.75, 57.50, 165, 140, 90, 23.8, "pink"),
    ("North America", 314.75, 44.30, 125, 100, 10, 22.6, "pink"),
    ("Pelican", 312.70, 44.37, 60, 48, 0, 23.0, "pink"),
    ("IC 1318 W", 304.30, 41.85, 50, 30, 45, 23.3, "pink"),
    ("IC 1318 E", 306.90, 40.00, 75, 40, 30, 23.2, "pink"),
    ("NGC 6888", 303.03, 38.36, 18, 12, 40, 22.8, "pink"),
    ("Veil, east", 314.10, 31.60, 75, 8, 165, 23.2, "rose"),
    ("Veil, west", 311.40, 30.70, 70, 7, 10, 23.4, "rose"),
    ("IC 5146", 328.37, 47.27, 12, 11, 0, 22.4, "pink"),
    ("Seagull", 106.10, -10.60, 130, 36, 15, 23.6, "pink"),
    ("RCW 38", 134.80, -47.55, 30, 22, 0, 23.0, "pink"),
    ("Carina", 161.20, -59.85, 125, 105, 40, 22.0, "pink"),
    ("Carina, inner", 161.15, -59.72, 50, 34, 140, 20.3, "rose"),
    ("NGC 3324", 159.33, -58.62, 15, 14, 0, 21.8, "pink"),
    ("NGC 3576", 167.90, -61.30, 26, 16, 0, 22.2, "pink"),
    ("NGC 3603", 168.78, -61.26, 10, 10, 0, 21.5, "rose"),
    ("IC 2944", 174.50, -63.35, 75, 55, 110, 22.9, "pink"),
    ("NGC 6188", 250.10, -48.75, 28, 14, 0, 22.8, "pink"),
    ("IC 4628", 254.30, -40.40, 90, 50, 90, 23.2, "pink"),
    ("NGC 6334", 260.20, -35.90, 38, 26, 45, 22.9, "pink"),
    ("NGC 6357", 261.25, -34.20, 48, 38, 0, 22.8, "pink"),
    ("M 8", 270.95, -24.38, 88, 42, 95, 21.4, "pink"),
    ("M 8, inner", 270.92, -24.38, 20, 14, 90, 19.8, "rose"),
    ("M 20", 270.67, -23.00, 26, 24, 0, 21.9, "rose"),
    ("M 16", 274.72, -13.82, 36, 28, 150, 22.0, "pink"),
    ("M 17", 275.20, -16.18, 26, 18, 70, 20.8, "pink"),
    ("Sh 2-54", 274.40, -11.80, 80, 50, 0, 23.7, "pink"),
    ("zeta Ophiuchi's", 249.30, -10.50, 560, 480, 0, 26.3, "pink"),
    ("Pleiades", 56.75, 24.05, 90, 70, 0, 23.2, "blue"),
    ("IC 2118", 76.40, -7.25, 170, 50, 150, 25.0, "blue"),
    ("IC 4604", 246.40, -23.45, 65, 40, 0, 23.0, "blue"),
    ("Antares'", 247.60, -26.40, 90, 70, 0, 23.6, "amber"),
    ("IC 4592", 243.20, -19.50, 130, 50, 60, 24.0, "blue"),
    ("Tarantula", 84.67, -69.09, 34, 26, 0, 21.0, "rose"),
    ("NGC 1763", 74.20, -66.40, 22, 16, 0, 23.3, "pink"),
    ("NGC 346", 14.77, -72.17, 13, 11, 0, 22.8, "rose"),
]
# Barnard's Loop: part of a circle.
LOOP = (83.3, -2.2, 6.5, 15, 165)  # RA, Dec, radius in degrees, position angles from and to
LOOP_WIDTH, LOOP_BRIGHTNESS = 0.5, 26.0

# Name, RA, Dec, diameters to 25 mag/arcsec^2 in B, position angle, V, B-V, part of the light that
# is a bulge's.
GALAXIES = [
    ("M 31", 10.685, 41.269, 190, 60, 35, 3.44, 0.92, 0.28),
    ("M 32", 10.674, 40.866, 8.7, 6.5, 170, 8.08, 0.95, 0.7),
    ("M 110", 10.092, 41.685, 22, 11, 170, 8.07, 0.85, 0.2),
    ("M 33", 23.462, 30.660, 71, 42, 23, 5.72, 0.55, 0.03),
    ("NGC 55", 3.72, -39.20, 32, 5.6, 108, 7.9, 0.55, 0.0),
    ("NGC 253", 11.888, -25.288, 27.5, 6.8, 52, 7.2, 0.85, 0.15),
    ("NGC 300", 13.72, -37.68, 22, 16, 111, 8.1, 0.59, 0.0),
    ("NGC 2403", 114.21, 65.60, 22, 12, 127, 8.5, 0.47, 0.05),
    ("M 81", 148.888, 69.065, 27, 14, 157, 6.94, 0.95, 0.4),
    ("M 82", 148.968, 69.680, 11, 4.3, 65, 8.41, 0.89, 0.2),
    ("M 106", 184.740, 47.304, 18.6, 7.2, 150, 8.41, 0.69, 0.2),
    ("M 104", 189.998, -11.623, 8.7, 3.5, 89, 7.98, 0.98, 0.6),
    ("M 94", 192.721, 41.120, 11.2, 9.1, 105, 8.24, 0.75, 0.5),
    ("M 64", 194.182, 21.683, 10, 5.4, 115, 8.52, 0.84, 0.3),
    ("NGC 4945", 196.364, -49.468, 20, 3.8, 43, 8.4, 1.1, 0.1),
    ("NGC 5128", 201.365, -43.019, 26, 20, 35, 6.84, 1.0, 0.5),
    ("M 51", 202.470, 47.195, 11.2, 6.9, 163, 8.36, 0.6, 0.2),
    ("M 83", 204.254, -29.866, 12.9, 11.5, 0, 7.54, 0.66, 0.1),
    ("M 101", 210.802, 54.349, 28.8, 26.9, 0, 7.86, 0.45, 0.05),
    ("NGC 6744", 287.442, -63.857, 20, 12.9, 15, 8.35, 0.8, 0.15),
    ("NGC 6822", 296.236, -14.803, 15.5, 13.5, 10, 8.7, 0.6, 0.0),
]

# Name, RA, Dec, V, radius of half the light.
CLUSTERS = [
    ("47 Tucanae", 6.024, -72.081, 3.95, 3.2), ("NGC 362", 15.809, -70.849, 6.4, 0.8),
    ("NGC 1851", 78.528, -40.047, 7.14, 0.5), ("M 79", 81.046, -24.525, 7.73, 0.65),
    ("NGC 2808", 138.013, -64.864, 6.2, 0.8), ("NGC 3201", 154.403, -46.412, 6.75, 3.1),
    ("NGC 4833", 194.891, -70.876, 6.9, 2.4), ("omega Centauri", 201.697, -47.480, 3.68, 5.0),
    ("M 3", 205.548, 28.377, 6.19, 2.3), ("M 5", 229.638, 2.081, 5.65, 1.8),
    ("M 80", 244.260, -22.976, 7.33, 0.6), ("M 4", 245.897, -26.526, 5.63, 4.3),
    ("M 13", 250.422, 36.460, 5.78, 1.7), ("M 12", 251.809, -1.949, 6.7, 1.8),
    ("M 62", 255.303, -30.114, 6.45, 0.9), ("M 10", 254.288, -4.100, 6.4, 1.95),
    ("M 19", 255.657, -26.268, 6.77, 1.3), ("M 92", 259.281, 43.136, 6.44, 1.0),
    ("M 9", 259.799, -18.516, 7.72, 1.0), ("NGC 6388", 264.072, -44.736, 6.72, 0.5),
    ("M 14", 264.401, -3.246, 7.6, 1.3), ("NGC 6397", 265.175, -53.674, 5.73, 2.9),
    ("NGC 6441", 267.554, -37.051, 7.15, 0.6), ("NGC 6541", 272.010, -43.715, 6.3, 1.1),
    ("M 28", 276.137, -24.870, 6.79, 2.0), ("M 22", 279.100, -23.905, 5.1, 3.4),
    ("M 54", 283.764, -30.480, 7.6, 0.8), ("NGC 6752", 287.717, -59.985, 5.4, 1.9),
    ("M 55", 294.999, -30.965, 6.32, 2.8), ("M 15", 322.493, 12.167, 6.2, 1.0),
    ("M 2", 323.363, -0.823, 6.47, 1.1), ("M 30", 325.092, -23.180, 7.19, 1.0),
]

# Name, RA, Dec, degrees within which the panorama's picture of it is used, V, B-V (NED), and of
# the exponential disc for what the panorama is too dark for: its part of the light, scale in degrees,
# axis ratio, position angle.
MAGELLANIC = [
    ("Large Magellanic Cloud", 79.8, -69.2, 5.2, 0.40, 0.51, 0.40, 1.45, 0.85, 170),
    ("Small Magellanic Cloud", 13.6, -72.75, 3.0, 2.20, 0.45, 0.35, 0.75, 0.65, 45),
]

# What the panorama shows of these is taken out, to be put there anew: RA, Dec, degrees.
REPLACED = [(10.68, 41.27, 2.0), (23.46, 30.66, 0.9), (201.70, -47.48, 0.8), (6.30, -72.08, 0.8),
            (15.81, -70.85, 0.4)]
REPLACED_CLOUDS = [(79.8, -69.2, 5.6), (13.6, -72.75, 3.2)]


def s10(mag_arcsec2):
    """Stars of V = 10 per square degree; one is 27.78 mag/arcsec^2."""
    return 10 ** (0.4 * (27.78 - mag_arcsec2))


def ellipse_radius(ra, dec, length, width, angle, height, rows):
    """1 on the ellipse of these diameters (arcminutes), at each pixel."""
    east, north = east_north(ra, dec, height, rows)
    cos, sin = math.cos(math.radians(angle)), math.sin(math.radians(angle))
    return np.hypot((north * cos + east * sin) * 120 / length,
                    (east * cos - north * sin) * 120 / width)


def of_flux(profile, v, height, rows):
    """The profile, its light that of a star of magnitude v (S10(V) times square degrees)."""
    total = (profile * solid_angle(height)[rows]).sum() * math.degrees(1) ** 2
    return profile * (10 ** (-0.4 * (v - 10)) / total)


def resolved(length, width, height):
    """Diameters (arcminutes) that pixels can show."""
    pixel = 60 * 180 / height
    return math.hypot(length, 2.2 * pixel), math.hypot(width, 2.2 * pixel)


def nebulae(red, height):
    """Their light in S10(V), linear Rec.709. `red` is how much redder than its surroundings the
    panorama is: the nebulae's shapes, where it shows them."""
    sky = np.zeros((height, 2 * height, 3))
    for _, ra, dec, length, width, angle, brightness, kind in NEBULAE:
        length, width = resolved(length, width, height)
        rows = rows_near(dec, 0.8 * length / 60, height)
        radius = ellipse_radius(ra, dec, length, width, angle, height, rows)
        inside = radius < 1.6
        r = radius[inside]
        profile = np.exp(-1.2 * r ** 2) * np.clip((1.6 - r) / 0.8, 0, 1)
        shape = red[rows][inside]
        if kind in ("pink", "rose") and shape.max() > 0:
            mean = np.average(shape, weights=profile)
            profile = profile * (0.35 + np.minimum(0.65 * shape / max(mean, 0.004), 4))
        profile *= s10(brightness) / profile[r < 1].mean()
        sky[rows][inside] += profile[:, None] * KINDS[kind] / (KINDS[kind] @ LUMA)
    return sky + barnards_loop(height)[..., None] * PINK / (PINK @ LUMA)


def barnards_loop(height):
    ra, dec, radius, first, last = LOOP
    east, north = east_north(ra, dec, height)
    away, angle = np.hypot(east, north), np.degrees(np.arctan2(east, north))
    arc = np.exp(-0.5 * ((away - radius) / LOOP_WIDTH) ** 2)
    arc += 0.35 * np.exp(-0.5 * ((away - radius + 0.9) / (2.2 * LOOP_WIDTH)) ** 2)
    ends = np.clip(np.minimum(angle - first, last - angle) / 35, 0, 1)
    return arc * ends * ends * (3 - 2 * ends) * s10(LOOP_BRIGHTNESS)


def disc_of(name, r, side):
    """A galaxy's disc, of the radius r; side is degrees to the nearer side of the minor axis."""
    disc = np.exp(-3.2 * r) * (r < 1.5)
    if name == "M 31":  # its ring of young stars, and the dust before its bulge
        disc *= 1 + 0.35 * np.exp(-0.5 * ((r - 0.52) / 0.10) ** 2)
        disc *= 1 - 0.45 * np.clip(6 * side, 0, 1) * np.exp(-0.5 * ((r - 0.33) / 0.12) ** 2)
    return disc


def galaxies(colour, height):
    """Exponential discs with bulges; `colour(b_v)` is linear Rec.709 of luminance 1."""
    sky = np.zeros((height, 2 * height, 3))
    for name, ra, dec, length, width, angle, v, b_v, bulge in GALAXIES:
        a, b = resolved(length, width, height)
        rows = rows_near(dec, a / 60, height)
        r = ellipse_radius(ra, dec, a, b, angle, height, rows)
        east, north = east_north(ra, dec, height, rows)
        side = north * math.sin(math.radians(angle)) - east * math.cos(math.radians(angle))
        disc = of_flux(disc_of(name, r, side), v, height, rows)
        light = (1 - bulge) * disc[..., None] * colour(b_v - 0.1 * (bulge > 0))
        if bulge:
            size = min(0.28 * length, 0.5 * width)
            a, b = resolved(size, size * 0.75, height)
            r = ellipse_radius(ra, dec, a, b, angle, height, rows)
            core = of_flux(np.exp(-2.5 * r) * (r < 3), v, height, rows)
            light += bulge * core[..., None] * colour(b_v + 0.05)
        sky[rows] += light
    return sky


def clusters(colour, height):
    """Globular clusters as Plummer's spheres."""
    sky = np.zeros((height, 2 * height))
    for _, ra, dec, v, half in CLUSTERS:
        core = math.hypot(half / 60, 180 / height)
        rows = rows_near(dec, 12 * core, height)
        away = separation(ra, dec, height, rows).astype(np.float64) / core
        sky[rows] += of_flux((1 + away ** 2) ** -2 * (away < 12), v, height, rows)
    return sky[..., None] * colour(0.75)


def magellanic(luma, colour, height):
    """The two clouds: shapes from the panorama's luminance, light and colours as catalogued."""
    sky = np.zeros((height, 2 * height, 3))
    for _, ra, dec, within, v, b_v, disc, scale, ratio, angle in MAGELLANIC:
        rows = rows_near(dec, 6 * scale, height)
        away = separation(ra, dec, height, rows).astype(np.float64)
        ring = (away > within) & (away < 1.15 * within)
        edge = np.clip((within - away) / (0.75 * within), 0, 1)
        shape = np.maximum(luma[rows] - np.median(luma[rows][ring]), 0)
        shape *= edge * edge * (3 - 2 * edge)
        r = ellipse_radius(ra, dec, 120 * scale, 120 * scale * ratio, angle, height, rows)
        smooth = np.exp(-r) * np.clip(6 - r, 0, 1)
        sky[rows] += ((1 - disc) * of_flux(shape, v, height, rows)
                      + disc * of_flux(smooth, v, height, rows))[..., None] * colour(b_v)
    return sky


def mean_s10(sky):
    return mean_over_sky(sky @ LUMA)
