#!/usr/bin/python3
"""Makes milky_way.exr, the sky behind the stars, from a panorama and a catalogue.

    make_milky_way.py milkyway.png TYCHO2_FOLDER milky_way.exr
    make_milky_way.py --check milky_way.exr

milkyway.png: textures/milkyway.png of Debian's stellarium-data 0.22 (Axel Mellinger's panorama).
TYCHO2_FOLDER: tyc2.dat.00 to .19 of Debian's source package tycho2 2-4.
Needs python3-numpy and python3-openimageio. PROVENANCE.md says what is done and why.

Out: linear Rec.709, equirectangular, J2000, RA 0h in the middle and growing to the left, Dec +90 at
the top; a pixel value of 1 is 1e-4 cd/m^2.
"""

import math
import sys

import numpy as np
import OpenImageIO as oiio

import milky_way_check
from sphere_image import (GALACTIC_POLE, HEIGHT, LUMA, SOLID_ANGLE, WIDTH, blurred, column_row,
                          decoded, directions, encoded, mean_over_sky, separation)

# One star of V = 10 in a square degree, S10(V), is 27.78 mag/arcsec^2; L = 10.8e4 10^(-0.4 mu)
# cd/m^2 gives 8.3e-7 cd/m^2.
S10 = 8.3e-7 / 1e-4

# The catalogue's stars that are run together: V from, V to, and over how many degrees, so that some
# tens of stars share each place. Brighter ones are drawn as stars, fainter ones it does not hold.
GLOW = [(6.5, 8.0, 5.0), (8.0, 9.5, 2.5), (9.5, 10.5, 1.5), (10.5, 11.5, 0.9)]
# Light of the fainter ones beyond the band, as a share of it. Above 60 degrees of galactic latitude
# half a magnitude of stars gives 2.1 S10(V) at V = 9, 1.5 at 11.25; the decline, continued, sums up
# to 9 for 19 in GLOW.
FAINTER_SHARE = 0.45
BAND_S10 = 60  # where the panorama, blurred, has this much, it has half of that light already
FAINTER_REDDENING = 0.25  # of B-V, in the band, where the fainter stars are the farther ones

CLOUD = (271.0, -28.5)  # the Large Sagittarius Star Cloud
CLOUD_S10 = 640  # with 20.8 mag/arcsec^2, the brightest part of the Milky Way
# The rest was judged by eye.
PANORAMA_GAMMA = 0.8  # its contrast is a print's
DUST_IN_GLOW = 0.9  # how far the panorama's dust, sharp, shows in the catalogue's light, blurred
STAR_SATURATION, STAR_CONTRAST = 0.9, 1.5  # of the colours of starlight; in B-V, about 0.7
HUE_DETAIL, HUE_LARGE = 1.0, 0.5  # what is kept of the panorama's hues below and above 8 degrees
GREEN = 0.4  # what is kept of its green, which no starlight is

# Not stars though small (degrees): left where stars are taken out. A globular cluster, here a few
# pixels with an edge, is softened.
NEBULAE = [(10.68, 41.27, 1.8), (13.2, -72.8, 2.2), (80.9, -69.8, 4.5), (161.3, -59.7, 1.3),
           (274.7, -13.8, 0.5), (270.9, -24.4, 0.6)]
CLUSTERS = [(6.02, -72.08, 0.8), (201.70, -47.48, 0.8)]


def read_panorama(path):
    """Linear, RA 0h in the middle (the file has RA 18h there)."""
    image = oiio.ImageBuf(path).get_pixels(oiio.FLOAT)[..., :3].astype(np.float64)
    if image.shape != (HEIGHT, WIDTH, 3):
        sys.exit(f"{path}: expected {WIDTH} x {HEIGHT} pixels")
    return np.roll(decoded(image), WIDTH // 4, axis=1)


def without_specks(image):
    """Where a pixel stands far above the median of those around it, it takes that median."""
    padded = np.pad(np.concatenate([image[:, -3:], image, image[:, :3]], axis=1),
                    ((3, 3), (0, 0), (0, 0)), mode="reflect")
    ring = [(j, i) for j in range(7) for i in range(7) if max(abs(j - 3), abs(i - 3)) >= 2]
    around = np.stack([padded[j:j + HEIGHT, i:i + WIDTH] @ LUMA for j, i in ring])
    median = np.median(around, axis=0)
    luma = image @ LUMA
    speck = luma > 1.3 * median + 0.001
    for ra, dec, radius in NEBULAE + CLUSTERS:
        speck &= separation(ra, dec) > radius
    # A star's colour is not the sky's: that comes from around.
    hue = blurred(np.where(speck[..., None], 0, image), 0.6)
    hue /= np.maximum(hue @ LUMA, 1e-9)[..., None]
    print(f"{speck.mean():.1%} of the panorama's pixels are stars' and filled in")
    image = np.where(speck[..., None], hue * median[..., None], image)
    soft = blurred(image, 0.25)
    for ra, dec, radius in CLUSTERS:
        share = np.clip(2 - 2 * separation(ra, dec) / radius, 0, 1)[..., None]
        image = (1 - share) * image + share * soft
    return image


def between_like(image, code):
    """Each pixel's mean with those within about 1 degree and 2 codes: steps go, edges stay."""
    levels = np.arange(0, 33, 2.0)
    out, total = np.zeros_like(image), np.zeros(code.shape)
    for level in levels:
        like = np.exp(-0.5 * ((code - level) / 2) ** 2)
        sums = blurred(np.concatenate([image * like[..., None], like[..., None]], axis=2), 1.0)
        here = np.maximum(1 - np.abs(code - level) / 2, 0)
        out += here[..., None] * sums[..., :3] / np.maximum(sums[..., 3:], 1e-6)
        total += here
    return out / np.maximum(total, 1e-6)[..., None]


def debanded(image):
    """The fewer of 8 bits' steps there are to show a shape, the more it is blurred."""
    code = encoded(blurred(image, 0.2) @ LUMA)
    grain = np.clip((blurred(code, 0.5) - 25) / 50, 0, 1)[..., None]
    fine = grain * blurred(image, 0.07) + (1 - grain) * blurred(image, 0.2)
    middle = between_like(blurred(image, 0.15), np.minimum(code, 32))
    share = np.clip((blurred(code, 0.5) - 10) / 14, 0, 1)
    share = (share * share * (3 - 2 * share))[..., None]
    mixed = share * fine + (1 - share) * middle
    # Where nearly all is clipped, specks and noise are all there is.
    wide = np.clip((encoded(blurred(image, 1.5) @ LUMA) - 3) / 5, 0, 1)[..., None]
    return np.maximum(wide * mixed + (1 - wide) * blurred(image, 2.5), 0)


def temperature(b_v):
    """Ballesteros 2012 (EPL 97, 34008)."""
    return 4600 * (1 / (0.92 * b_v + 1.7) + 1 / (0.92 * b_v + 0.62))


def blackbody_rgb(t):
    """Linear Rec.709 of luminance 1 (Wyman, Sloan & Shirley 2013 for CIE 1931)."""
    nm = np.arange(380, 781, 5.0)
    planck = 1 / (nm ** 5 * np.expm1(1.438777e7 / (nm * t)))

    def lobe(mean, low, high):
        return np.exp(-0.5 * ((nm - mean) / np.where(nm < mean, low, high)) ** 2)
    x = (1.056 * lobe(599.8, 37.9, 31.0) + 0.362 * lobe(442, 16, 26.7)
         - 0.065 * lobe(501.1, 20.4, 26.2))
    y = 0.821 * lobe(568.8, 46.9, 40.5) + 0.286 * lobe(530.9, 16.3, 31.1)
    z = 1.217 * lobe(437, 11.8, 36) + 0.681 * lobe(459, 26, 13.8)
    xyz = np.array([(planck * c).sum() for c in (x, y, z)])
    rgb = np.array([[3.2406, -1.5372, -0.4986], [-0.9689, 1.8758, 0.0415],
                    [0.0557, -0.2040, 1.0570]]) @ (xyz / xyz[1])
    return np.maximum(rgb, 0)


def starlight_rgb(b_v):
    """Linear Rec.709 of luminance 1 for each pixel's mean B-V."""
    b_v = 0.7 + STAR_CONTRAST * (b_v - 0.7)
    known = np.linspace(-0.3, 1.6, 39)
    table = np.array([blackbody_rgb(temperature(c)) for c in known])
    rgb = np.stack([np.interp(b_v, known, table[:, k]) for k in range(3)], axis=2)
    return 1 + STAR_SATURATION * (rgb - 1)


def read_catalogue(folder):
    """RA, Dec (degrees), V and B-V of the stars with both magnitudes."""
    parts = []
    for part in range(20):
        text = np.fromfile(f"{folder}/tyc2.dat.{part:02d}", np.uint8).reshape(-1, 207)

        def column(first, last, rows=text):
            cut = np.ascontiguousarray(rows[:, first - 1:last])
            return np.char.strip(cut.view(f"S{last - first + 1}")[:, 0])
        bt, vt = column(111, 116), column(124, 129)
        # A row without mean place (flag X) has the observed one.
        observed = text[:, 13] == ord("X")
        ra = np.where(observed, column(153, 164), column(16, 27))
        dec = np.where(observed, column(166, 177), column(29, 40))
        whole = (bt != b"") & (vt != b"")
        ra, dec, bt, vt = (x[whole].astype(float) for x in (ra, dec, bt, vt))
        parts.append(np.stack([ra, dec, vt - 0.09 * (bt - vt), 0.85 * (bt - vt)]))
    return np.concatenate(parts, axis=1)


def catalogue_glow(folder):
    """The light of GLOW's stars run together, in S10(V), and its mean B-V."""
    ra, dec, v, b_v = read_catalogue(folder)
    column, row = column_row(ra, dec)
    row = np.clip(np.round(row), 0, HEIGHT - 1).astype(int)
    pixel = row * WIDTH + np.round(column).astype(int) % WIDTH
    light, count = 0, 0
    for brightest, faintest, degrees in GLOW:
        chosen = (v >= brightest) & (v < faintest)
        count += chosen.sum()
        magnitudes = v[chosen], v[chosen] + np.clip(b_v[chosen], -0.4, 2.0)
        maps = np.stack([np.bincount(pixel[chosen], 10 ** (-0.4 * (m - 10)), WIDTH * HEIGHT)
                         for m in magnitudes], axis=1).reshape(HEIGHT, WIDTH, 2)
        light = light + blurred(maps / (SOLID_ANGLE * math.degrees(1) ** 2)[..., None], degrees)
    light = np.maximum(light, 1e-3)
    print(f"{count} stars run together, mean {mean_over_sky(light[..., 0]):.1f} S10(V)")
    return light[..., 0], -2.5 * np.log10(light[..., 1] / light[..., 0])


def panorama_hue(detail):
    """The panorama's departure from the hue of the whole, tempered, grey where it is dark."""
    whole = np.array([mean_over_sky(detail[..., k]) for k in range(3)])
    whole /= whole @ LUMA

    def hue(image, darkest):
        image = image + darkest * whole
        ratio = np.log(np.maximum(image / (image @ LUMA)[..., None] / whole, 1e-3))
        green = ratio[..., 1] - (ratio[..., 0] + ratio[..., 2]) / 2
        ratio[..., 1] -= (1 - GREEN) * np.maximum(green, 0)
        return ratio
    large = hue(blurred(detail, 8.0), 0.004)
    return np.exp(HUE_DETAIL * (hue(detail, 0.008) - large) + HUE_LARGE * large)


def dust_in_glow(band):
    """What the panorama's dust leaves of light that is blurred over it, within 25 degrees of the
    galactic equator (beyond, a galaxy would cast a shadow around itself)."""
    faintest = 0.003 ** PANORAMA_GAMMA
    band = np.minimum(band, 1.5 * blurred(band, 2.0))  # nor may a cluster
    dust = (blurred(band, 0.3) + faintest) / (blurred(band, 2.0) + faintest)
    latitude = np.abs(np.degrees(np.arcsin(directions() @ GALACTIC_POLE)))
    return np.clip(dust, 0.15, 1.3) ** (DUST_IN_GLOW * np.clip((25 - latitude) / 10, 0, 1))


def make(panorama, folder):
    glow, b_v = catalogue_glow(folder)
    detail = debanded(without_specks(read_panorama(panorama)))
    band = np.maximum(detail @ LUMA, 0) ** PANORAMA_GAMMA
    glow = glow * dust_in_glow(band)
    cloud = separation(*CLOUD) < 1
    band *= (CLOUD_S10 - glow[cloud].mean()) / band[cloud].mean()
    glow *= 1 + FAINTER_SHARE / (1 + blurred(band, 2.0) / BAND_S10)

    stars = starlight_rgb(b_v) * glow[..., None]
    far = starlight_rgb(b_v + FAINTER_REDDENING) * panorama_hue(detail)
    far *= (band / np.maximum(far @ LUMA, 1e-9))[..., None]
    return (stars + far) * S10


def write(sky, out):
    spec = oiio.ImageSpec(WIDTH, HEIGHT, 3, oiio.HALF)
    spec.attribute("compression", "zip")
    spec.attribute("oiio:ColorSpace", "lin_srgb")
    spec.attribute("ImageDescription",
                   "Milky Way without stars, linear Rec.709, 1 = 1e-4 cd/m^2; see PROVENANCE.md")
    spec.attribute("Copyright", "Axel Mellinger, Univ. of Potsdam (panorama); "
                                "ESA, Tycho-2 (light of the stars)")
    spec.attribute("DateTime", "2026:11:21 00:00:00")  # else that of writing
    pixels = np.ascontiguousarray(sky, dtype=np.float32)
    file = oiio.ImageOutput.create(out)
    if not (file and file.open(out, spec) and file.write_image(pixels) and file.close()):
        sys.exit(oiio.geterror() or file.geterror())


def main():
    if len(sys.argv) == 3 and sys.argv[1] == "--check":
        sys.exit(milky_way_check.check(sys.argv[2]))
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    panorama, folder, out = sys.argv[1:]
    write(make(panorama, folder), out)
    sys.exit(milky_way_check.check(out))


if __name__ == "__main__":
    main()
