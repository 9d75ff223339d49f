#include "pipeline/light/traced_wormhole.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "pipeline/base/errors.h"
#include "pipeline/light/wormhole_azimuth.h"
#include "pipeline/light/wormhole_lens.h"

namespace domefall {
namespace {

using std::numbers::pi;

void require_ratio(const char* name, long double value, double low, double high) {
  // NaN passes neither comparison.
  if (!(value >= low && value <= high))
    throw InputError(fmt::format("{} over rho must be from {} to {}, got {}", name, low, high,
                                 static_cast<double>(value)));
}

// Returns a request without its ray.
WormholeRequest wormhole_at(const WormholePlace& place) {
  const bool ellis = place.profile == "ellis";
  if (!ellis && place.profile != "dngr")
    throw InputError(fmt::format("profile must be ellis or dngr, got '{}'", place.profile));
  if (!(place.rho > 0))
    throw InputError(fmt::format("rho must be above 0, got {}", static_cast<double>(place.rho)));
  if (ellis && (place.a.value_or(0) != 0 || place.m))
    throw InputError("the profile ellis has no cylinder of a length a, and no m");
  if (!ellis && !place.m) throw InputError("the profile dngr needs m");
  const long double a = place.a.value_or(0) / place.rho, l = place.l / place.rho;
  require_ratio("a", a, 0, 1e12);
  require_ratio("l", l, -1e12, 1e12);
  WormholeRequest request;
  request.l = static_cast<double>(l);
  request.wormhole.profile = ellis ? Wormhole::Profile::kEllis : Wormhole::Profile::kDngr;
  if (ellis) return request;
  const long double m = *place.m / place.rho;
  require_ratio("m", m, 1e-30, 1e30);
  request.wormhole.length = static_cast<double>(2 * a);
  request.wormhole.lensing_width = static_cast<double>(m * Wormhole::kWidthOfMass);
  return request;
}

double edge_delta(const WormholeRequest& request) {
  const HalfAngle edge = throat_edge(request.wormhole, request.l);
  return edge.angle();
}

const SkyTable& wormhole_table(const WormholeRequest& request, bool own) {
  struct Kept {
    Wormhole wormhole;
    double l = std::numeric_limits<double>::quiet_NaN();
    HoleOptics optics;
  };
  thread_local Kept kept;
  if (kept.l != request.l || kept.wormhole != request.wormhole) {
    ObserverState observer;
    observer.l = request.l;
    observer.r = request.wormhole.radius(request.l);
    kept = {request.wormhole, request.l, make_wormhole_optics(request.wormhole, observer)};
  }
  const SkyRegion sky = kept.optics.parts[own ? 0 : 1].sky;
  WantedSkies wanted{};
  for (const SkyRegion other : kEverySky) wanted.sky[other] = other == sky;
  add_tables(kept.optics, wanted);
  return *kept.optics.parts[own ? 0 : 1].table;
}

// A four-point difference is right to 1e-9 at steps of a thousandth of the way to the edge.
double wormhole_slope(const WormholeRequest& request) {
  const double h = 1e-3 * std::min(1.0, std::abs(request.offset));
  const auto phi = [&](double steps) {
    return wormhole_azimuth(request.wormhole, request.l, request.offset + steps * h);
  };
  return (8 * (phi(1) - phi(-1)) - (phi(2) - phi(-2))) / (12 * h);
}

}  // namespace

WormholeRequest wormhole_ray_at_angle(const WormholePlace& place, long double delta) {
  WormholeRequest request = wormhole_at(place);
  if (!(delta >= 0 && delta <= std::numbers::pi_v<long double>))
    throw InputError(fmt::format("delta must be from 0 to pi, got {}", static_cast<double>(delta)));
  request.delta = static_cast<double>(delta);
  request.offset = static_cast<double>(delta - edge_delta(request));
  return request;
}

WormholeRequest wormhole_ray_at_edge(const WormholePlace& place, std::string_view edge,
                                     double offset) {
  WormholeRequest request = wormhole_at(place);
  if (edge != "throat")
    throw InputError(fmt::format("edge must be throat or empty, got '{}'", edge));
  request.offset = offset;
  request.delta = edge_delta(request) + offset;
  if (!(request.delta >= 0 && request.delta <= pi))
    throw InputError(
        fmt::format("edge and offset must give an angle from 0 to pi, got {}", request.delta));
  return request;
}

TracedWormhole trace_wormhole(const WormholeRequest& request, bool tables) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  const bool own = request.offset > 0;
  if (request.offset == 0) return {own, kInfinite, kInfinite, 0};
  TracedWormhole ray{own, 0, 0, 0};
  if (tables) {
    const SkyTable& table = wormhole_table(request, own);
    const double x = std::min(2 * std::tan(std::abs(request.offset) / 4), table.x_max());
    ray.azimuth = table.azimuth(x);
    ray.slope = own ? -table.slope(x) : table.slope(x);
  } else {
    ray.azimuth = wormhole_azimuth(request.wormhole, request.l, request.offset);
    ray.slope = wormhole_slope(request);
  }
  // On the axis both sines vanish, in the ratio of the angles.
  const double sine = std::sin(request.delta), swept = std::sin(ray.azimuth);
  const bool on_axis = sine < 1e-9 && std::abs(ray.azimuth) < 1;
  ray.amplification = on_axis ? 1 / (ray.slope * ray.slope) : sine / std::abs(swept * ray.slope);
  return ray;
}

}  // namespace domefall
