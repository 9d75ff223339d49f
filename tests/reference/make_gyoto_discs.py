#!/usr/bin/env python3
"""Writes gyoto_discs.csv, Page-Thorne discs about holes without and with spin, as Gyoto sees them.

Usage: make_gyoto_discs.py > gyoto_discs.csv      (Debian's gyoto-bin 1.4.4, a minute)

Gyoto (Vincent et al., Class. Quantum Grav. 28, 225011 (2011)) follows rays through Kerr's metric in
Boyer-Lindquist coordinates from an observer at rest at r = 10,000. The disc reaches from the last
stable orbit to 20. One view is nearly face-on, since Gyoto has no observer on the axis; the others
are 80 degrees from the axis, as Luminet's, and 20 degrees.
"""
import pathlib
import struct
import subprocess
import tempfile

DISTANCE, FIELD, PIXELS = 10000, 0.005, 20
SCENE = """<?xml version="1.0" encoding="UTF-8" standalone="no"?>
<Scenery>
  <Metric kind="KerrBL"><Spin>{spin}</Spin></Metric>
  <Screen>
    <Distance unit="geometrical">{distance}</Distance>
    <Time unit="geometrical_time">{distance}</Time>
    <FieldOfView unit="radian">{field}</FieldOfView>
    <Resolution>{pixels}</Resolution>
    <Inclination unit="degree">{inclination}</Inclination>
    <PALN unit="degree">0</PALN>
    <Argument unit="degree">0</Argument>
  </Screen>
  <Astrobj kind="PageThorneDisk">
    <InnerRadius>{inner}</InnerRadius>
    <OuterRadius>20</OuterRadius>
  </Astrobj>
  <Quantities>Redshift User4</Quantities>
  <MinimumTime>-1000</MinimumTime>
</Scenery>
"""


def first_images(fits, images):
    """The numbers of the first array of a FITS file, whose header says that they are doubles."""
    at, header = 0, ""
    while "END     " not in header:
        header += fits[at:at + 2880].decode("ascii")
        at += 2880
    count = images * PIXELS ** 2
    return struct.unpack(f">{count}d", fits[at:at + 8 * count])


def view(spin, inner, inclination):
    with tempfile.TemporaryDirectory() as folder:
        scene, image = pathlib.Path(folder, "disc.xml"), pathlib.Path(folder, "disc.fits")
        scene.write_text(SCENE.format(distance=DISTANCE, field=FIELD, pixels=PIXELS,
                                      spin=spin, inner=inner, inclination=inclination))
        subprocess.run(["gyoto", "-r", str(PIXELS), scene, image], check=True,
                       stdout=subprocess.DEVNULL)
        numbers = first_images(image.read_bytes(), 2)
    ratios, fluxes = numbers[:PIXELS ** 2], numbers[PIXELS ** 2:]
    brightest = max(fluxes)
    for k, (ratio, flux) in enumerate(zip(ratios, fluxes)):
        # Gyoto's pictures have east at the left.
        right = FIELD / PIXELS * ((PIXELS - 1) / 2 - k % PIXELS)
        up = FIELD / PIXELS * (k // PIXELS - (PIXELS - 1) / 2)
        print(f"{spin},{inclination},{right:.9g},{up:.9g},{ratio:.8g},{flux / brightest:.8g}")


if __name__ == "__main__":
    print("# Page-Thorne discs as Gyoto 1.4.4 sees them, by make_gyoto_discs.py.  Per pixel: its place")
    print("# (radians, the disc's axis upwards), frequency observed over the one sent, and bolometric")
    print("# flux over that of the view's brightest pixel; 0 and 0 where there is no disc.")
    print("spin,inclination_deg,right,up,frequency_ratio,flux")
    for degrees in 1, 80:
        view(0, 6, degrees)
    for degrees in 20, 80:
        view(0.9, 2.3208830417618873, degrees)
