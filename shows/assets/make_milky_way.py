#!/usr/bin/python3
"""Makes milky_way.exr, the sky behind the stars, from a panorama and a catalogue.

    make_milky_way.py milkyway.png TYCHO2_FOLDER milky_way.exr

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

WIDTH, HEIGHT = 2048, 1024
DEC = np.radians(90 - 180 * (np.arange(HEIGHT) + 0.5) / HEIGHT)
SOLID_ANGLE = (2 * math.pi / WIDTH) * (math.pi / HEIGHT) * np.cos(DEC)[:, None]
LUMA = np.array([0.2126, 0.7152, 0.0722])

# One star of V = 10 in a square degree, S10(V), is 27.78 mag/arcsec^2; L = 10.8e4 10^(-0.4 mu)
# cd/m^2 gives 8.3e-7 cd/m^2.
S10 = 8.3e-7 / 1e-4
BRIGHTEST_CLOUD_S10 = 520  # the Sagittarius star cloud, 21.0 mag/arcsec^2
PANORAMA_SATURATION = 0.7  # the panorama was made for print
GLOW_SATURATION = 0.6  # this faint, an eye sees little colour
GLOW_FAINTEST, GLOW_BRIGHTEST = 11.5, 9.0


def blurred(image, degrees):
    """Gaussian on the sphere: along rows wider towards the poles, along columns across them."""
    sigma = math.radians(degrees)
    row_sigma = np.minimum(sigma / np.maximum(np.cos(DEC), 1e-3), 4.0)
    k = np.fft.rfftfreq(WIDTH, 1 / WIDTH)
    rows = np.fft.rfft(image, axis=1) * np.exp(-0.5 * (k[None, :] * row_sigma[:, None]) ** 2)[..., None]
    image = np.fft.irfft(rows, WIDTH, axis=1)
    # A meridian and the one opposite make one great circle, on which nothing ends.
    half = WIDTH // 2
    circle = np.concatenate([image[:, :half], image[::-1, half:]], axis=0)
    k = np.fft.rfftfreq(2 * HEIGHT, 1 / (2 * HEIGHT))
    circle = np.fft.irfft(
        np.fft.rfft(circle, axis=0) * np.exp(-0.5 * (k * sigma) ** 2)[:, None, None], 2 * HEIGHT, axis=0)
    return np.concatenate([circle[:HEIGHT], circle[HEIGHT:][::-1]], axis=1)


def read_panorama(path):
    """Linear, RA 0h in the middle (the file has RA 18h there)."""
    image = oiio.ImageBuf(path).get_pixels(oiio.FLOAT)[..., :3].astype(np.float64)
    if image.shape != (HEIGHT, WIDTH, 3):
        sys.exit(f"{path}: expected {WIDTH} x {HEIGHT} pixels")
    linear = np.where(image <= 0.04045, image / 12.92, ((image + 0.055) / 1.055) ** 2.4)
    return np.roll(linear, WIDTH // 4, axis=1)


def without_specks(image):
    """Where a pixel stands far above the median of its neighbours, that median."""
    padded = np.pad(np.concatenate([image[:, -3:], image, image[:, :3]], axis=1),
                    ((3, 3), (0, 0), (0, 0)), mode="reflect")
    ring = [(j, i) for j in range(7) for i in range(7) if max(abs(j - 3), abs(i - 3)) >= 2]
    median = np.median(np.stack([padded[j:j + HEIGHT, i:i + WIDTH] @ LUMA for j, i in ring]), axis=0)
    luma = image @ LUMA
    excess = luma > 1.35 * median + 0.0015
    return np.where(excess[..., None], image * (median / np.maximum(luma, 1e-9))[..., None], image)


def debanded(image):
    """Blurred the more the fewer steps of 8 bits there are to show its shape, in five scales."""
    scales = [blurred(image, s) for s in (0.07, 0.22, 0.7, 2.0, 5.0)]
    level = np.maximum(blurred(image, 1.0) @ LUMA, 1e-9)
    code = 255 * np.where(level <= 0.0031308, 12.92 * level, 1.055 * level ** (1 / 2.4) - 0.055)
    where = np.clip(np.log2(14 / np.maximum(code, 1e-3)), 0, 4)[..., None]  # 14 codes: finest
    weights = [np.clip(1 - np.abs(where - k), 0, 1) for k in range(5)]
    return sum(w * s for w, s in zip(weights, scales))


def temperature(b_v):
    """Ballesteros 2012 (EPL 97, 34008)."""
    return 4600 * (1 / (0.92 * b_v + 1.7) + 1 / (0.92 * b_v + 0.62))


def blackbody_rgb(t):
    """Linear Rec.709 of luminance 1 (Wyman, Sloan & Shirley 2013 for CIE 1931)."""
    nm = np.arange(380, 781, 5.0)
    planck = 1 / (nm ** 5 * np.expm1(1.438777e7 / (nm * t)))

    def lobe(mean, low, high):
        return np.exp(-0.5 * ((nm - mean) / np.where(nm < mean, low, high)) ** 2)
    x = 1.056 * lobe(599.8, 37.9, 31.0) + 0.362 * lobe(442, 16, 26.7) - 0.065 * lobe(501.1, 20.4, 26.2)
    y = 0.821 * lobe(568.8, 46.9, 40.5) + 0.286 * lobe(530.9, 16.3, 31.1)
    z = 1.217 * lobe(437, 11.8, 36) + 0.681 * lobe(459, 26, 13.8)
    xyz = np.array([(planck * c).sum() for c in (x, y, z)])
    rgb = np.array([[3.2406, -1.5372, -0.4986], [-0.9689, 1.8758, 0.0415],
                    [0.0557, -0.2040, 1.0570]]) @ (xyz / xyz[1])
    return np.maximum(rgb, 0)


def catalogue_glow(folder):
    """Tycho-2's stars of 9 < V < 11.5 run together, in S10(V), coloured by their mean B-V."""
    v_light, b_light = np.zeros((HEIGHT, WIDTH)), np.zeros((HEIGHT, WIDTH))
    count = 0
    for part in range(20):
        with open(f"{folder}/tyc2.dat.{part:02d}", encoding="ascii") as file:
            for line in file:
                bt, vt = line[110:116].strip(), line[123:129].strip()
                if not bt or not vt:
                    continue
                v, b_v = float(vt) - 0.09 * (float(bt) - float(vt)), 0.85 * (float(bt) - float(vt))
                if not GLOW_BRIGHTEST < v < GLOW_FAINTEST:
                    continue
                place = line[152:177] if line[13] == "X" else line[15:40]
                ra, dec = (float(x) for x in place.split("|"))
                column = int((0.5 - ra / 360) % 1 * WIDTH) % WIDTH
                row = min(int((90 - dec) / 180 * HEIGHT), HEIGHT - 1)
                v_light[row, column] += 10 ** (-0.4 * (v - 10))
                b_light[row, column] += 10 ** (-0.4 * (v + min(max(b_v, -0.4), 2.0) - 10))
                count += 1
    print(f"{count} stars run together")
    per_degree = SOLID_ANGLE * math.degrees(1) ** 2
    light = blurred(np.stack([v_light, b_light], axis=2) / per_degree[..., None], 2.5)
    v, b = np.maximum(light[..., 0], 1e-3), np.maximum(light[..., 1], 1e-3)
    colours = np.linspace(0, 1.6, 33)
    table = np.array([blackbody_rgb(temperature(c)) for c in colours])
    mean_b_v = -2.5 * np.log10(b / v)
    colour = np.stack([np.interp(mean_b_v, colours, table[:, k]) for k in range(3)], axis=2)
    return 1 + GLOW_SATURATION * (colour - 1), v


def main():
    panorama, folder, out = sys.argv[1:]
    colour, glow = catalogue_glow(folder)
    detail = debanded(without_specks(read_panorama(panorama)))
    luma = detail @ LUMA
    # The panorama gives the band beyond what the catalogue's stars already do.
    smooth = blurred(detail, 0.5) @ LUMA
    peak = np.unravel_index(np.argmax(smooth), luma.shape)
    luma_s10 = luma * (BRIGHTEST_CLOUD_S10 - glow[peak]) / smooth[peak]
    light = glow + luma_s10
    # Its own hues, as far as its light reaches, around the colour of the stars there, which sets
    # the white.
    hue = detail / np.maximum(luma, 1e-9)[..., None]
    mean_hue = (detail * SOLID_ANGLE[..., None]).sum((0, 1)) / (luma * SOLID_ANGLE).sum()
    share = PANORAMA_SATURATION * (luma_s10 / light)[..., None]
    sky = colour * np.maximum(1 + share * (hue / mean_hue - 1), 0)
    sky *= (light * S10 / (sky @ LUMA))[..., None]

    mean = ((sky @ LUMA) * SOLID_ANGLE).sum() / (4 * math.pi)
    print(f"luminance, S10(V): mean {mean / S10:.0f}, least {(sky @ LUMA).min() / S10:.1f}, "
          f"greatest {(sky @ LUMA).max() / S10:.0f}")
    spec = oiio.ImageSpec(WIDTH, HEIGHT, 3, oiio.HALF)
    spec.attribute("compression", "zip")
    spec.attribute("oiio:ColorSpace", "lin_srgb")
    spec.attribute("ImageDescription",
                   "Milky Way without stars, linear Rec.709, 1 = 1e-4 cd/m^2; see PROVENANCE.md")
    spec.attribute("Copyright", "Axel Mellinger, Univ. of Potsdam (panorama); ESA, Tycho-2 (light of the stars)")
    file = oiio.ImageOutput.create(out)
    if not (file and file.open(out, spec) and file.write_image(np.ascontiguousarray(sky, dtype=np.float32))
            and file.close()):
        sys.exit(oiio.geterror() or file.geterror())


if __name__ == "__main__":
    main()
