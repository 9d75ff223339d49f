#!/usr/bin/python3
"""Makes the sky behind the stars from a panorama, a catalogue, and lists of nebulae and galaxies.

    make_milky_way.py milkyway.png TYCHO2_FOLDER d3-celestial-0.7.35.tgz FOLDER
    make_milky_way.py --check d3-celestial-0.7.35.tgz FOLDER

milkyway.png: textures/milkyway.png of Debian's stellarium-data 0.22 (Axel Mellinger's panorama).
TYCHO2_FOLDER: tyc2.dat.00 to .19 and suppl_1.dat of Debian's source package tycho2 2-4.
d3-celestial-0.7.35.tgz: the npm package, for nebulae, galaxies and clusters.
FOLDER receives milky_way.exr, 4096 x 2048, the sky without the stars of V <= 9, and
milky_way_deep.exr, 2048 x 1024, the sky without any star that Tycho-2 has.
Needs python3-numpy and python3-openimageio. PROVENANCE.md says what is done and why.

Out: linear Rec.709, equirectangular, J2000, RA 0h in the middle and growing to the left, Dec +90 at
the top; a pixel value of 1 is 1e-4 cd/m^2.
"""

import sys

import numpy as np
import OpenImageIO as oiio

import milky_way_check
from deep_sky_light import objects
from object_catalogue import Catalogue
from panorama import read_panorama
from sphere_image import LUMA, blurred, galactic_latitude, halved, mean_over_sky, separation
from starlight import glow, read_tycho2

HEIGHT = 2048
DRAWN = 9.0  # V to which the catalogue that comes with Domefall draws stars

# One star of V = 10 in a square degree, S10(V), is 27.78 mag/arcsec^2; L = 10.8e4 10^(-0.4 mu)
# cd/m^2 gives 8.3e-7 cd/m^2.
S10 = 8.3e-7 / 1e-4

# Light of the stars that Tycho-2 does not hold, beyond the band, as a share of its stars' beyond
# V = 9. Above 60 degrees of galactic latitude half a magnitude of stars gives 2.1 S10(V) at V = 9,
# 1.5 at 11.25; the decline, continued, sums up to 9 beyond 11.5.
FAINTER_SHARE = 0.8
BAND_S10 = 60  # where the panorama, blurred, has this much, it has half of that light already
FAINTER_REDDENING = 0.65  # of B-V, in the bulge, where the fainter stars are old and far

CLOUD = (271.0, -28.5)  # the Large Sagittarius Star Cloud
CLOUD_S10 = 640  # with 20.8 mag/arcsec^2, the brightest part of the Milky Way
# The rest was judged by eye.
PANORAMA_GAMMA = 0.8  # its contrast is a print's
DUST_IN_GLOW = 0.8  # how far the panorama's dust, sharp, shows in the catalogue's light, blurred
DUST_REDDENING = 0.06  # of B-V, where dust takes a factor of e of the light around
STAR_SATURATION, STAR_CONTRAST = 1.0, 1.3  # of the colours of starlight; in B-V, about 0.65
BLUER = 0.14  # in B-V, so that the darkest parts of the sky are near white
MANTISSA = 7  # bits that are kept of halves' 10: steps of 0.8 %, a third of an eye's
SOURCES = ("Axel Mellinger, Univ. of Potsdam (panorama); ESA, Tycho-2 (light of the stars); "
           "Olaf Frohn, d3-celestial (nebulae and galaxies)")


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
    """Linear Rec.709 of luminance 1 for light of that mean B-V, of each pixel or of an object."""
    b_v = 0.65 - BLUER + STAR_CONTRAST * (np.asarray(b_v) - 0.65)
    known = np.linspace(-0.3, 1.6, 39)
    table = np.array([blackbody_rgb(temperature(c)) for c in known])
    rgb = np.stack([np.interp(b_v, known, table[:, k]) for k in range(3)], axis=-1)
    rgb = 1 + STAR_SATURATION * (rgb - 1)
    return rgb / (rgb @ LUMA)[..., None]


def band_of(luma):
    """The panorama's luminance as light of its own scale."""
    return np.maximum(luma, 0) ** PANORAMA_GAMMA


def dust_beyond(band, latitude):
    """A function of sigma: what the panorama's light, sharp, is of itself blurred by that sigma,
    within 25 degrees of the galactic equator (beyond, a galaxy would cast a shadow)."""
    faintest = 0.004 ** PANORAMA_GAMMA
    flat = np.minimum(band, 1.5 * blurred(band, 2.0))  # nor may a cluster
    power = DUST_IN_GLOW * np.clip((25 - np.abs(latitude)) / 10, 0, 1)

    def dust(sigma):
        ratio = (flat + faintest) / (blurred(flat, sigma) + faintest)
        return np.clip(ratio, 0.15, 1.5) ** power
    return dust


def make(panorama, folder, catalogue):
    """The sky without stars of V <= DRAWN, and without all of Tycho-2's, in S10(V)."""
    luma, clouds, red = read_panorama(panorama, HEIGHT)
    latitude = galactic_latitude(HEIGHT)
    band = band_of(luma)
    dust = dust_beyond(band, latitude)
    light = glow(read_tycho2(folder), DRAWN, HEIGHT, dust)
    stars = light[..., 0]
    # Colours need wider means than light.
    ratio = blurred(light, 0.6)
    b_v = -2.5 * np.log10(ratio[..., 1] / ratio[..., 0])

    cloud = separation(*CLOUD, HEIGHT) < 1
    share = FAINTER_SHARE
    band *= (CLOUD_S10 - stars[cloud].mean()) / band[cloud].mean()
    wide = blurred(band, 2.0)
    even = blurred(stars, 1.0) * share / (1 + wide / BAND_S10)
    faint = band + even * dust(1.0)
    reddened = -np.log(np.clip(dust(1.5), 0.3, 1.5)) * DUST_REDDENING
    bulge = wide / (wide + 3 * BAND_S10)
    catalogued = starlight_rgb(b_v + reddened) * stars[..., None]
    beyond = starlight_rgb(b_v + reddened + FAINTER_REDDENING * bulge) * faint[..., None]
    print(f"Tycho-2 beyond V = {DRAWN}: {mean_over_sky(stars):.1f} S10(V); fainter: "
          f"{mean_over_sky(faint):.1f}")
    deep = beyond + objects(red, clouds, starlight_rgb, catalogue, HEIGHT)
    return catalogued + deep, deep


def rounded(sky):
    """Halves of fewer digits, which a file holds in fewer bytes."""
    bits = np.ascontiguousarray(sky, dtype=np.float32).view(np.uint32)
    drop = 23 - MANTISSA
    return ((bits + (1 << (drop - 1))) >> drop << drop).view(np.float32)


def write(sky, out, description, copyright_line):
    spec = oiio.ImageSpec(sky.shape[1], sky.shape[0], 3, oiio.HALF)
    spec.attribute("compression", "zip")
    spec.attribute("oiio:ColorSpace", "lin_srgb")
    spec.attribute("ImageDescription",
                   f"{description}, linear Rec.709, 1 = 1e-4 cd/m^2; see PROVENANCE.md")
    spec.attribute("Copyright", copyright_line)
    spec.attribute("DateTime", "2026:11:22 00:00:00")  # else that of writing
    file = oiio.ImageOutput.create(out)
    if not (file and file.open(out, spec) and file.write_image(rounded(sky)) and file.close()):
        sys.exit(oiio.geterror() or file.geterror())


def main():
    if len(sys.argv) == 4 and sys.argv[1] == "--check":
        sys.exit(milky_way_check.check(sys.argv[3], Catalogue(sys.argv[2])))
    if len(sys.argv) != 5:
        sys.exit(__doc__)
    panorama, tycho2, archive, folder = sys.argv[1:]
    catalogue = Catalogue(archive)
    whole, deep = make(panorama, tycho2, catalogue)
    write(whole * S10, f"{folder}/milky_way.exr", "The sky without stars of V <= 9", SOURCES)
    write(halved(deep) * S10, f"{folder}/milky_way_deep.exr",
          "The sky without the stars of Tycho-2", SOURCES)
    sys.exit(milky_way_check.check(folder, catalogue))


if __name__ == "__main__":
    main()
