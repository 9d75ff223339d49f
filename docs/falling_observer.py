# What does a falling observer see?
#
# A lesson with the Python module of Domefall.  Each part between two lines of `# %%` is a cell:
# Jupyter (by jupytext), Spyder and Visual Studio Code run them one by one, and
#
#     python3 docs/falling_observer.py
#
# runs them all, from the folder in which `shows` is.  Where matplotlib is installed, figures are
# saved in the folder of OUT; otherwise only numbers are printed.
#
# Units: G = c = 1, so that lengths and times are measured in the mass M of the hole.  The horizon is
# at r = 2 M, and light can circle the hole at r = 3 M.

# %% Load a show.
from pathlib import Path

import numpy as np

import domefall

try:
    import matplotlib.pyplot as plt
except ImportError:
    plt = None

OUT = Path("out/falling_observer")
show = domefall.Show("shows/first_light.yaml")
states = show.states()
seconds_per_m = show.mass_solar * domefall.SECONDS_PER_SOLAR_MASS
print(f"{show.title}: {show.frames} frames, a hole of {show.mass_solar:.3g} solar masses.")
print(f"One M is {seconds_per_m:.1f} s for this hole.")

# %% How long does the fall take?
# The observer falls from rest at infinity.  Newton's law gives the time that is left at a radius r,
# sqrt(2)/3 r^(3/2), and so does Einstein's, if the time is that of the falling observer's own clock.
# Nothing happens to that clock at the horizon.
r, tau = states["r"], states["proper_time"]
left = np.sqrt(2) / 3 * r**1.5
difference = np.abs((tau + left) - (tau + left)[0]).max()
minutes = left[0] * seconds_per_m / 60
print(f"\nThe show begins at r = {r[0]:.0f} M, {minutes:.0f} minutes before the end.")
print(f"From the horizon on, {4 / 3 * seconds_per_m:.0f} s are left: 4/3 M.")
print(f"The fall differs from the formula by at most {difference:.1e} M.")

# %% How large does the hole look?
# A ray on the edge of the silhouette comes from the circle of light at r = 3, with the impact
# parameter 3 sqrt(3).  Who hovers sees this edge at the angle delta from the direction of the hole
# with
#     sin(delta) = 3 sqrt(3)/r sqrt(1 - 2/r),
# and who falls with the velocity v = sqrt(2/r) from infinity, with
#     r sin(delta) = 3 sqrt(3) (1 - v cos(delta)).
# Below r = 3 the larger of the two solutions counts, as light that has just escaped moves outward.
def edge_of_static(r):
    angle = np.arcsin(np.minimum(1, 3 * np.sqrt(3) / r * np.sqrt(1 - 2 / r)))
    return np.where(r > 3, angle, np.pi - angle)


def edge_of_falling(r):
    v = np.sqrt(2 / r)
    length, turn = np.hypot(r, 3 * np.sqrt(3) * v), np.arctan2(3 * np.sqrt(3) * v, r)
    angle = np.arcsin(np.minimum(1, 3 * np.sqrt(3) / length))
    return np.where(r > 3, angle, np.pi - angle) - turn


# Domefall's own numbers for both.
near, far = np.geomspace(0.05, 30, 400), np.geomspace(2.001, 30, 400)
falling = domefall.trace(near, edge="silhouette", observer="rain")["delta"]
hovering = domefall.trace(far, edge="silhouette", observer="static")["delta"]
print("\nAngular radius of the silhouette, in degrees:")
print("     r     falling   hovering")
for at in (30, 6, 3, 2.1, 2, 1, 0.1):
    line = f"{at:6.1f}  {np.degrees(domefall.trace(at, edge='silhouette')['delta']):9.2f}"
    if at > 2:  # nobody can hover at the horizon, or within
        edge = domefall.trace(at, edge="silhouette", observer="static")["delta"]
        line += f"  {np.degrees(edge):9.2f}"
    print(line)
difference = max(np.abs(falling - edge_of_falling(near)).max(),
                 np.abs(hovering - edge_of_static(far)).max())
print(f"They differ from the formulas by at most {difference:.1e} radians.")

# %% How far is light bent?
# A ray that reaches a distant observer at the angle delta from the hole has swept the azimuth phi
# about it.  Without the hole that would be pi - delta, and the rest is the deflection.  Far from the
# hole it is Einstein's 4 M/b, for the impact parameter b; at b = 3 sqrt(3) light circles for ever.
distance = 1e8
b = 3 * np.sqrt(3) + np.geomspace(1e-6, 1e4, 2501)
delta = np.arcsin(b / distance * np.sqrt(1 - 2 / distance))
exact = domefall.trace(distance, delta, observer="static", method="exact")
table = domefall.trace(distance, delta, observer="static", method="table")
deflection = exact["phi"] - (np.pi - delta)
error = np.abs(table["phi"] - exact["phi"])
sun = 696e6 / 1476.6  # the sun's radius in its own M, which is 1476.6 m
print("\n        b/M  deflection   4/b (degrees)")
for k in range(0, 2501, 500):
    print(f"{b[k]:11.5f}  {np.degrees(deflection[k]):9.4f}  {np.degrees(4 / b[k]):8.4f}")
print(f"At the rim of the sun 4/b is {np.degrees(4 / sun) * 3600:.2f} seconds of arc.")
print(f"The table that renders frames errs by at most {error.max():.1e} radians.")

# %% What does it look like?
# Frames in linear light are for measuring: the sum over a picture is the light that falls in.
# Graded frames are for looking at.
instants = [int(np.argmax(r < at)) for at in (6, 2, 0.5)]
print("\nframe      r   mean of the picture (linear)")
for n in instants:
    print(f"{n:5}  {r[n]:5.2f}   {show.frame(n, size=128).mean():.3f}")

# %% Draw all of this.
BLUE, ORANGE = "tab:blue", "tab:orange"


def save(figure, name):
    OUT.mkdir(parents=True, exist_ok=True)
    figure.savefig(OUT / name, dpi=110)
    print(f"{OUT / name}")


def draw_fall():
    figure, (left_side, right_side) = plt.subplots(1, 2, figsize=(10, 4), layout="constrained")
    left_side.plot(tau, r, BLUE)
    left_side.axhline(2, color="black", linewidth=0.8, linestyle="--")
    left_side.text(2, 2.4, "horizon")
    left_side.set(xlabel="proper time (M)", ylabel="r (M)", title="The fall",
                  xlim=(0, None), ylim=(0, None))
    right_side.plot(near, np.degrees(falling), BLUE, label="falling from infinity")
    right_side.plot(far, np.degrees(hovering), ORANGE, label="hovering")
    for radii, formula, colour in ((near, edge_of_falling, BLUE), (far, edge_of_static, ORANGE)):
        some = radii[::20]
        right_side.plot(some, np.degrees(formula(some)), "o", color=colour, markersize=4)
    right_side.axvline(2, color="black", linewidth=0.8, linestyle="--")
    right_side.text(1.9, 150, "horizon", horizontalalignment="right")
    right_side.set(xscale="log", xlabel="r (M)", ylabel="degrees", ylim=(0, 180),
                   yticks=range(0, 181, 30), title="Angular radius of the silhouette")
    right_side.set_xticks([0.1, 1, 10], ["0.1", "1", "10"])
    right_side.legend(title="dots: formulas", frameon=False)
    save(figure, "fall.png")


def draw_deflection():
    figure, (left_side, right_side) = plt.subplots(1, 2, figsize=(10, 4), layout="constrained")
    beyond = b - 3 * np.sqrt(3)
    left_side.loglog(beyond, np.degrees(deflection), BLUE, label="exact")
    left_side.loglog(beyond, np.degrees(4 / b), "--", color=ORANGE, label="4 M/b")
    left_side.set(xlabel="b/M − 3√3", ylabel="degrees", title="Deflection of light")
    left_side.legend(frameon=False)
    right_side.loglog(beyond, error, ".", color=BLUE, markersize=2)
    right_side.set(xlabel="b/M − 3√3", ylabel="radians",
                   title="Error of the table that renders frames")
    save(figure, "deflection.png")


def draw_frames():
    figure, sides = plt.subplots(1, 3, figsize=(10, 3.7), layout="constrained")
    for side, n in zip(sides, instants):
        side.imshow(show.graded(n, size=512) / 65535)
        side.set_title(f"r = {r[n]:.2f} M")
        side.axis("off")
    save(figure, "frames.png")


if plt:
    print()
    draw_fall()
    draw_deflection()
    draw_frames()
else:
    print("\nmatplotlib is not installed (python3-matplotlib), so there are no figures.")
