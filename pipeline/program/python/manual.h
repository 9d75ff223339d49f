// This is what help(domefall) prints, in the terms of Python.  A function's text begins with its
// signature.
#pragma once

#include <string>

#include "projections/projection.h"

namespace domefall::manual {

inline constexpr const char* kModule = R"(Black-hole shows for planetariums, as arrays.

    import domefall
    show = domefall.Show("shows/first_light.yaml")
    states = show.states()                        # where the observer is, frame by frame
    picture = show.frame(120, size=512)           # a frame in linear light
    rays = domefall.trace(6.0, [0.3, 1.0, 2.0])   # where light comes from

All numbers are those of the program domefall, by the same functions: states as `domefall states`
prints them, rays as `domefall trace`, frames as `domefall render` writes them.

Units: lengths and times are in M, with G = c = 1, unless a name says otherwise (`_s` seconds,
`_deg` degrees); angles are in radians.  One M of a hole of m solar masses is
m * SECONDS_PER_SOLAR_MASS seconds.

Assets are found beside the installed program, or where $DOMEFALL_ASSETS says.  Long calls let
other threads of Python go on, and Ctrl-C ends them.  Processes that use this module are to be
started by multiprocessing's method "spawn", since threads do not outlive a fork.)";

inline constexpr const char* kInputError =
    "What the caller can mend: a wrong show, file, frame or number.  The message carries the "
    "place.";

inline constexpr const char* kTemporaryError =
    "What is worth trying again, here or elsewhere: a file that is away, a lack of threads.";

inline constexpr const char* kShow = R"(A show, read from its YAML file and checked.

Threads of Python may share one; their frames are rendered one after the other.  A file that changes
later is not read again.)";

inline constexpr const char* kShowInit = R"(__init__(self, file, threads=0)
--

Reads a show.

file: path of the show, as str or os.PathLike.
threads: with which frames are rendered, 0 to 1024; 0 takes one for each processor.

Raises InputError with a line for each mistake in the file, and TemporaryError if a file that it
names is not there.)";

inline constexpr const char* kFile = "Path of the show's file (pathlib.Path, absolute).";
inline constexpr const char* kTitle = "Title of the show (str).";
inline constexpr const char* kFrames = "How many frames the show has (int); the first is number 0.";
inline constexpr const char* kFramesPerSecond =
    "Frames per second of show time (float); frame n shows the instant n / frames_per_second.";
inline constexpr const char* kMassSolar =
    "Mass of the hole in solar masses (float), or None in flat space.";
inline std::string projection() {
  std::string text = "Name of the projection (str), as camera.projection of shows:\n";
  for (const ProjectionTraits& traits : kEveryProjectionTraits)
    text.append(text.ends_with('\n') ? "" : ", ").append(traits.name);
  return text + ".";
}
inline constexpr const char* kSize = "Width and height of the show's frames in pixels (two ints).";

inline constexpr const char* kStates = R"(states($self, frames=None)
--

Where the observer is, as a numpy structured array with the columns of `domefall states`.

frames: None for all frames, an integer, or an array of integers in any shape and order.

Returns an array in the shape of `frames`, or (show.frames,) for None.  Its columns are

    frame           number of the frame
    show_time_s     seconds since the start of the show
    segment         number of the segment in the timeline, from 1
    region          I, II, III or IV of the extended spacetime, and V or VI in a charged hole
    tetrad          reference tetrad: rain, outgoing, rain_of_III or outgoing_to_III
    r               radius, M
    proper_time     of the observer since the start of the segment's orbit, M; seconds in flat space
    celerity_r, celerity_theta, celerity_phi
                    gamma v against the tetrad, along R, Theta and Phi
    ra_deg, dec_deg the observer's place as seen from the hole, degrees, J2000
    azimuth_deg     swept in the planes of its orbits since the start of the show, degrees
    x_r ... z_phi   the camera's axes x, y, z in the boosted R, Theta, Phi
    null_time       v = t + r* where the tetrad is rain, u = t - r* where it is outgoing, M
    universe        number of the universe, of those that follow each other through a charged hole
    l               place along a wormhole, in whose throat's radii all lengths are; 0 elsewhere
    latitude_deg    above the equator of a hole that spins, degrees; 0 elsewhere

so that states["r"] is an array of radii, with all digits of a float64.

Raises InputError for a frame that the show does not have, and TypeError for what is no integer.)";

inline constexpr const char* kFrame = R"(frame($self, number, size=None)
--

A frame in linear light, before it is graded for a display.

number: of the frame, from 0 to show.frames - 1.
size: None for the show's own; else as --size of `domefall render` takes it: a number of pixels for
    a dome, a whole sphere or the faces of a cube, (width, height) for a flat picture, or a text
    such as "4k".

Returns float32 of the shape (height, width, 3): red, green and blue in ACEScg (the primaries AP1),
row 0 at the top, 1 being the luminance that the show's exposure makes 1.  The numbers are those of
the EXR file that the show has with output: {linear: float}.

Raises InputError for a frame or a size that cannot be and for damaged assets, and TemporaryError
for assets that are away.)";

inline constexpr const char* kGraded = R"(graded($self, number, size=None)
--

A frame as it is shown, graded by the show's display and view.

number, size: as for frame().

Returns uint16 of the shape (height, width, 3): display-encoded red, green and blue from 0 to 65535,
row 0 at the top, as in the graded PNG or TIFF of 16 bits.

Raises what frame() raises.)";

inline constexpr const char* kTrace =
    R"(trace(r, delta=None, *, edge=None, offset=None, observer='rain', method='table', tolerance=1e-10)
--

Where light comes from and how far it was bent, for rays that reach an observer at radius r.

The arguments are numbers or texts, or arrays of them, which are broadcast against each other.

r: radius in M, 1e-9 to 1e12.  Near the horizon (2) and the light circle (3) a float has lost most
    digits of the distance to them; decimals in text ("2.000001") keep them.
delta: angle in radians, 0 to pi, between the direction of view and -R of the observer's frame,
    which outside is the direction of the hole.
edge, offset: instead of delta, an edge of the sky and the angle in radians from it, which keeps all
    digits of rays that nearly touch it.  The edge is "silhouette", or "region3" for the border of
    the other sky inside the horizon; the ray has delta = edge + offset, and a delta
    that is given, too, must be that to 1e-9 of both.  Where the edge is "", delta counts.  An
    offset that is not given is 0.
observer: "rain" falls from rest at infinity; "static" hovers at r > 2; "outgoing" rises to rest at
    infinity, from region IV where r <= 2; "T_II" and "T_IV" are at rest in t inside the future
    and past horizon, r < 2.
method: "table" is what renders frames (phi within 2.1e-11 over the reference rays), "exact" is the
    elliptic integral (1e-13); "rk4", "dopri5", "rkf78", "binet-dopri5", "binet-rkf78" integrate
    step by step.
tolerance: of the integrators, relative, for each step, 1e-13 to 1e-3.

Returns a numpy structured array in the broadcast shape, with the columns of `domefall trace`:

    observer, r, delta, edge, offset
                   the ray; offset is NaN where no edge was given
    origin         the sky on which it started: I or III at infinity, IV for the past singularity;
                   empty where an integrator's steps ran out
    phi            azimuth that the light swept about the hole, radians; inf where it circles for
                   ever
    one_plus_z     frequency at the source over that observed; NaN for light from the singularity
    slope          d phi / d delta
    amplification  of a star, sin(delta) / |sin(phi) slope|

A table for a radius is made once for all rays that follow each other at the same r, so let r be the
slowest index of an array.

Raises InputError, naming the element, for numbers that are no ray, ValueError for shapes that
cannot be broadcast, and TypeError for arrays that are not of real numbers.)";

inline constexpr const char* kTraceSpin =
    R"(trace_spin(r, delta=None, *, spin=0, charge=0, theta=pi/2, eta=0, edge=None, offset=None)
--

Where light near a hole comes from that spins, is charged, both or neither.

The arguments are numbers or texts, or arrays of them, which are broadcast against each other.

r, theta: the observer's place, r in M and the angle from the hole's axis in radians.
spin, charge: a and q, in M.  A hole that spins has spin^2 + charge^2 <= 1.
delta, eta: the photon's direction in the frame T of docs/kerr.md; delta = 0 looks at the hole, and
    eta goes from Theta to Phi.
edge, offset: as for trace(); the edge is "silhouette", "region3" between the horizons or, near a
    charge without spin, "inner".

Returns a numpy structured array in the broadcast shape, with the columns of `domefall trace --table`:

    spin, charge, r, theta, delta, eta, edge, offset
                   the ray as it was given; delta is NaN where an edge was given alone
    origin         I, III, H for the past horizon, or B for nowhere; empty inside the inner horizon
                   of a hole that spins
    beyond         what lies beyond H where nothing spins: E, S or B
    theta_sky, phi_sky, x, y, z
                   the place on that sky; NaN without one, as the last three
    one_plus_z     frequency at the source over that observed
    amplification  solid angle seen over solid angle on the sky
    turns          how often cos(theta) was extreme on the way
    mino           Mino time on the way

Raises what trace() raises.)";

inline constexpr const char* kTraceWormhole =
    R"(trace_wormhole(l, delta=None, *, profile='ellis', rho=1, a=None, m=None, edge=None, offset=None, method='table')
--

Where light in a wormhole comes from, for an observer at rest.

The arguments are numbers or texts, or arrays of them, which are broadcast against each other.

l: the observer's place, a length from the middle of the throat, in the unit of rho.
profile: "ellis", or "dngr", which has a and m.
rho, a, m: radius of the throat, half of its cylinder's length, and mass (docs/wormholes.md).
delta: angle in radians, 0 to pi, from the direction of the throat.
edge, offset: as for trace(); the edge is "throat".
method: "table" is what renders frames, "exact" is the integral.

Returns a numpy structured array in the broadcast shape, with the columns of `domefall trace --table`:

    profile, rho, a, m, l, delta, edge, offset
                   the ray; NaN where nothing was given
    origin         own or other, the side of the sky; empty where light circles for ever
    azimuth, slope, one_plus_z, amplification
                   as phi and the rest of trace()

Raises what trace() raises.)";

}  // namespace domefall::manual
