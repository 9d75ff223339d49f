// A ray on its way, in one of two charts of the maximal extension: Schwarzschild's coordinates far
// from the horizon, Kruskal's around it; when to change, where the ray has ended, and the last
// stretch to infinity or to the singularity in closed form.
//
// Kruskal's chart serves 1/2 < r < 5/2.  So the light circle is passed in Schwarzschild's
// coordinates, as in [Riazuelo] sec. ssec_max, and a ray from region II back to region IV that
// turns below 5/2 stays in Kruskal's through both horizons.
#pragma once

#include "pipeline/optics/geodesic_equations.h"
#include "pipeline/optics/integrated_ray.h"

namespace domefall {

struct ChartedRay {
  Chart chart = Chart::kSchwarzschild;
  Region region = Region::kI;  // of the last change of chart
  RayState y{};
  double shift = 0;  // of t: Kruskal's U and V are those of t - shift
};

// Far and near radii that end an integration; they depend on the ray's impact parameter, for the
// sake of the series beyond them, and on where it began, lest nothing be left to integrate.
struct RayGoals {
  double far = 0, near = 0;
};

double radius_of(const ChartedRay& ray);  // units of M

// v and u of a place on the ray, units of M: 4 ln|U| and -4 ln|V| in Kruskal's chart.
NullTimes null_times_of(const ChartedRay& ray);

// t = 0 at the observer: all else is a shift.
ChartedRay charted_ray(const PhotonAtObserver& photon);

RayGoals goals_of(const PhotonAtObserver& photon);

// Changes the chart if another is due; says whether it did.
bool change_chart(ChartedRay& ray);

// Inside the horizon in Schwarzschild's coordinates, r' made anew from E and L by the null
// condition.  The second-order set alone lets a violation N of it grow as 2N/r, which turns a
// nearly radial ray back before it reaches the singularity.  Elsewhere nothing is changed: r' may
// vanish there.
void restore_null_condition(ChartedRay& ray);

// Where the light of the ray started; nothing while the ray is on its way.
std::optional<SkyRegion> origin_of(const ChartedRay& ray, const RayGoals& goals);

// The azimuth swept from the goal on, by series in 1/r (b/r < 1e-3) or in sqrt(r); relative
// truncation below 1e-13.
double azimuth_beyond(const ChartedRay& ray, SkyRegion origin);

}  // namespace domefall
