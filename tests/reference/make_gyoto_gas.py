#!/usr/bin/env python3
"""Writes gyoto_gas.csv: gas that light goes through, about a hole without spin, as Gyoto sees it.

Usage: make_gyoto_gas.py > gyoto_gas.csv      (gyoto-bin and python3-gyoto 1.4.4, half a minute)

Gyoto follows rays through Kerr's metric in Boyer-Lindquist coordinates, here with spin 0, from an
observer at rest at r = 10,000, and sums up light as its objects say, which Python says here:

halo  grey gas of the density f exp(-(r/6)^2/2 - (cos(theta)/0.3)^2/2), on circles with the angular
      momentum rho^1.5/(1 + rho) for each unit of energy;
slab  a disc from 6 to 20 of the height H/r = 0.1 (r/20)^(1/8) and of the optical depth 3 across,
      which thins out over a fifth of each rim; it has the temperature of Page and Thorne's profile,
      and is so hot that light goes with it.
"""
import pathlib
import subprocess
import tempfile

from make_gyoto_discs import DISTANCE, FIELD, PIXELS, first_images

HALO = """
import math
class Gas:
    def __call__(self, coord):
        return coord[1] - 28.8
    def giveDelta(self, coord):
        return 0.002 * coord[1]
    def getVelocity(self, coord, vel):
        r, s = coord[1], math.sin(coord[2])
        f, rho = 1 - 2 / r, r * s
        l = rho ** 1.5 / (1 + rho)
        energy = 1 / math.sqrt(1 / f - l * l / (rho * rho))
        vel[0], vel[1], vel[2], vel[3] = energy / f, 0, 0, energy * l / (rho * rho)
    def density(self, coord):
        r, c = coord[1], math.cos(coord[2])
        return (1 - 2 / r) * math.exp(-r * r / 72 - c * c / 0.18) if r > 2 else 0
    def emission(self, frequency, length, photon, coord):
        return self.density(coord) * length / 6
    def transmission(self, frequency, length, coord, photon):
        return 1
"""
SLAB = """
import math
class Gas:
    def __call__(self, coord):
        r, c = coord[1], abs(math.cos(coord[2]))
        return max(6 - r, r - 20, r * (c - 0.5))
    def giveDelta(self, coord):
        return 0.0005 * coord[1]
    def getVelocity(self, coord, vel):
        r = coord[1]
        turn = 1 / math.sqrt(1 - 2 / r - math.sin(coord[2]) ** 2 / r)
        vel[0], vel[1], vel[2], vel[3] = turn, 0, 0, turn / r ** 1.5
    def depth(self, length, coord):
        r, c = coord[1], math.cos(coord[2])
        def thinned(t):
            return 1 if t > 1 else t * t * t * (10 - 15 * t + 6 * t * t) if t > 0 else 0
        across = 3 * thinned((1 - r / 20) / 0.2) * thinned((r / 6 - 1) / 0.2)
        height = 0.1 * (r / 20) ** 0.125
        return (across / (math.sqrt(2 * math.pi) * height * r) *
                math.exp(-(c / height) ** 2 / 2) * length)
    def emission(self, frequency, length, photon, coord):
        r = coord[1]
        if r <= 6:
            return 0
        a, b, x = math.sqrt(3), math.sqrt(6), math.sqrt(r)
        rate = x - b + a / 2 * math.log((x + a) * (b - a) / ((x - a) * (b + a)))
        flux = rate / ((r - 3) * r ** 2.5)
        return flux ** 0.25 * (frequency) ** 2 * -math.expm1(-self.depth(length, coord))
    def transmission(self, frequency, length, coord, photon):
        return math.exp(-self.depth(length, coord))
"""
SCENE = """<?xml version="1.0" encoding="UTF-8" standalone="no"?>
<Scenery>
  <Metric kind="KerrBL"><Spin>0.</Spin></Metric>
  <Screen>
    <Distance unit="geometrical">{distance}</Distance>
    <Time unit="geometrical_time">{distance}</Time>
    <FieldOfView unit="radian">{field}</FieldOfView>
    <Resolution>{pixels}</Resolution>
    <Inclination unit="degree">{inclination}</Inclination>
    <PALN unit="degree">0</PALN>
    <Argument unit="degree">0</Argument>
    <FreqObs unit="Hz">1</FreqObs>
  </Screen>
  <Astrobj kind="Python::Standard">
    <RMax>30</RMax>
    <CriticalValue>0</CriticalValue>
    <SafetyValue>0.1</SafetyValue>
    <OpticallyThin/>
    <InlineModule>{module}</InlineModule>
    <Class>Gas</Class>
  </Astrobj>
  <Quantities>Intensity</Quantities>
  <AbsTol>1e-8</AbsTol><RelTol>1e-8</RelTol>
  <MinimumTime>-1000</MinimumTime>
</Scenery>
"""


def view(kind, module, inclination):
    module = module.replace("<", "&lt;")
    with tempfile.TemporaryDirectory() as folder:
        scene, image = pathlib.Path(folder, "gas.xml"), pathlib.Path(folder, "gas.fits")
        scene.write_text(SCENE.format(distance=DISTANCE, field=FIELD, pixels=PIXELS,
                                      inclination=inclination, module=module))
        subprocess.run(["gyoto", "-pstdplug,python3", "-r", str(PIXELS), scene, image], check=True,
                       stdout=subprocess.DEVNULL)
        light = first_images(image.read_bytes(), 1)
    brightest = max(light)
    for k, pixel in enumerate(light):
        # Gyoto's pictures have east at the left.
        right = FIELD / PIXELS * ((PIXELS - 1) / 2 - k % PIXELS)
        up = FIELD / PIXELS * (k // PIXELS - (PIXELS - 1) / 2)
        print(f"{kind},{inclination},{right:.9g},{up:.9g},{pixel / brightest:.8g}")


if __name__ == "__main__":
    print("# Gas that light goes through as Gyoto 1.4.4 sees it, by make_gyoto_gas.py.  Per pixel: its")
    print("# place (radians, the axis upwards) and its light over that of the view's brightest pixel.")
    print("kind,inclination_deg,right,up,light")
    for degrees in 45, 80:
        view("halo", HALO, degrees)
        view("slab", SLAB, degrees)
