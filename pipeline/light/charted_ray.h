// A ray on its way is held in one of two charts of the maximal extension, Schwarzschild's
// coordinates far from the horizon and Kruskal's around it.  This file says when to change the
// chart and where the ray has ended, and gives the last stretch to infinity or to the singularity
// in closed form.
//
// Kruskal's chart serves 1/2 < r < 5/2.  So the light circle is passed in Schwarzschild's
// coordinates, as in [Riazuelo] sec. ssec_max.  A ray from region II back to region IV that turns
// below 5/2 stays in Kruskal's chart through both horizons.
#pragma once

#include "pipeline/light/geodesic_equations.h"
#include "pipeline/light/integrated_ray.h"

namespace domefall {

struct ChartedRay {
  Chart chart = Chart::kSchwarzschild;
  Region region = Region::kI;  // of the last change of chart
  RayState y{};
  double shift = 0;  // of t: Kruskal's U and V are those of t - shift
};

// RayGoals are the far and near radii that end an integration.  They depend on the ray's impact
// parameter, for the sake of the series beyond them.  They also depend on where the ray began, so
// that something is left to integrate.
struct RayGoals {
  double far = 0, near = 0;
};

double radius_of(const ChartedRay& ray);  // units of M

// Returns v and u of a place on the ray, in units of M.  In Kruskal's chart they are 4 ln|U| and -4
// ln|V|.
NullTimes null_times_of(const ChartedRay& ray);

// Returns the ray with t = 0 at the observer.  Any other t is only a shift.
ChartedRay charted_ray(const PhotonAtObserver& photon);

RayGoals goals_of(const PhotonAtObserver& photon);

// Changes the chart if another is due, and says whether it did.
bool change_chart(ChartedRay& ray);

// Makes r' anew from E and L by the null condition, inside the horizon in Schwarzschild's
// coordinates.  The second-order set alone lets a violation N of that condition grow as 2N/r, which
// turns a nearly radial ray back before it reaches the singularity.  Elsewhere nothing is changed,
// because r' may vanish there.
void restore_null_condition(ChartedRay& ray);

// Returns where the light of the ray started, or nothing while the ray is on its way.
std::optional<SkyRegion> origin_of(const ChartedRay& ray, const RayGoals& goals);

// Returns the azimuth swept from the goal on, by series in 1/r (b/r < 1e-3) or in sqrt(r).  The
// relative truncation is below 1e-13.
double azimuth_beyond(const ChartedRay& ray, SkyRegion origin);

}  // namespace domefall
