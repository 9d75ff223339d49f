#include "pipeline/program/python/hole_arrays.h"

#include <fmt/format.h>

#include <atomic>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "pipeline/base/errors.h"
#include "pipeline/light/ray_request.h"
#include "pipeline/light/traced_spin.h"
#include "pipeline/light/traced_wormhole.h"
#include "pipeline/program/python/arguments.h"
#include "pipeline/program/python/decimals.h"
#include "pipeline/program/python/record_array.h"

namespace py = pybind11;

namespace domefall {
namespace {

constexpr double kAbsent = std::numeric_limits<double>::quiet_NaN();

py::object or_nothing(const py::object& value) {
  return value.is_none() ? py::object(py::float_(kAbsent)) : value;
}
py::object or_no_edge(const py::object& value) {
  return value.is_none() ? py::object(py::str("")) : value;
}

std::optional<long double> given(const Decimals& decimals, std::size_t k) {
  return decimals.is_given(k) ? std::optional(decimals.number(k)) : std::nullopt;
}

double or_absent(const std::optional<long double>& number) {
  return number ? static_cast<double>(*number) : kAbsent;
}

std::vector<RecordColumn> record(std::initializer_list<const char*> names) {
  std::vector<RecordColumn> columns;
  for (const std::string name : names) {
    const bool text = name == "edge" || name == "origin" || name == "beyond" || name == "profile";
    columns.push_back({name, text              ? CellKind::kText
                             : name == "turns" ? CellKind::kCount
                                               : CellKind::kNumber});
  }
  return columns;
}

void add_spin_ray(RecordArray& records, const SpinRay& asked, const TracedSpinRay& ray) {
  const auto number = [](long double x) { return static_cast<double>(x); };
  for (const long double value : {asked.hole.spin, asked.hole.charge, asked.r, asked.theta})
    records.add(number(value));
  records.add(or_absent(asked.delta));
  records.add(number(asked.eta));
  records.add(std::string_view(asked.edge));
  records.add(asked.edge.empty() ? kAbsent : number(asked.offset.value_or(0)));
  records.add(ray.origin);
  records.add(ray.beyond);
  const V3d none(kAbsent, kAbsent, kAbsent), sky = ray.sky.value_or(none);
  for (const double value :
       {std::atan2(std::hypot(sky.x, sky.y), sky.z), std::atan2(sky.y, sky.x), sky.x, sky.y, sky.z,
        ray.origin.empty() ? kAbsent : ray.one_plus_z, ray.sky ? ray.amplification : kAbsent})
    records.add(value);
  records.add(ray.turns);
  records.add(ray.sky ? ray.mino : kAbsent);
}

}  // namespace

py::array trace_spin_arrays(const SpinArrays& rays) {
  const std::vector<py::array> all =
      broadcast({rays.r, or_nothing(rays.delta), rays.spin, rays.charge, rays.theta, rays.eta,
                 or_no_edge(rays.edge), or_nothing(rays.offset)});
  const std::vector<py::ssize_t> shape = shape_of(all[0]);
  const Decimals r(all[0], "r"), delta(all[1], "delta"), spin(all[2], "spin"),
      charge(all[3], "charge"), theta(all[4], "theta"), eta(all[5], "eta"),
      offset(all[7], "offset");
  const std::vector<std::string> edges = texts(all[6]);
  std::vector<SpinRay> asked(edges.size());
  each_ray(edges.size(), shape, [&](std::size_t k) {
    asked[k] = {{spin.number(k), charge.number(k), spin.rest(k)},
                r.number(k),
                theta.number(k),
                eta.number(k),
                given(delta, k),
                edges[k],
                given(offset, k)};
  });
  RecordArray records(record({"spin", "charge", "r", "theta", "delta", "eta", "edge", "offset",
                              "origin", "beyond", "theta_sky", "phi_sky", "x", "y", "z",
                              "one_plus_z", "amplification", "turns", "mino"}),
                      shape);
  interruptible([&](const std::atomic<bool>& stop) {
    each_ray(records.size(), shape, [&](std::size_t k) {
      if (stop) return;
      const TracedSpinRay traced = trace_spin_ray(asked[k]);
      records.start(k);
      add_spin_ray(records, asked[k], traced);
    });
  });
  return records.array();
}

py::array trace_wormhole_arrays(const WormholeArrays& rays, const std::string& method) {
  if (method != "table" && method != "exact")
    throw InputError(fmt::format("method must be table or exact, got '{}'", shown(method)));
  const std::vector<py::array> all =
      broadcast({rays.l, or_nothing(rays.delta), rays.profile, rays.rho, or_nothing(rays.a),
                 or_nothing(rays.m), or_no_edge(rays.edge), or_nothing(rays.offset)});
  const std::vector<py::ssize_t> shape = shape_of(all[0]);
  const Decimals l(all[0], "l"), delta(all[1], "delta"), rho(all[3], "rho"), a(all[4], "a"),
      m(all[5], "m"), offset(all[7], "offset");
  const std::vector<std::string> profiles = texts(all[2]), edges = texts(all[6]);
  std::vector<WormholeRequest> asked(edges.size());
  each_ray(edges.size(), shape, [&](std::size_t k) {
    const WormholePlace place{profiles[k], rho.number(k), given(a, k), given(m, k), l.number(k)};
    const auto own = given(delta, k), from = given(offset, k);
    if (edges[k].empty()) {
      if (from) throw InputError("offset is given without an edge");
      if (!own) throw InputError("a ray takes delta, or an edge and perhaps an offset from it");
      asked[k] = wormhole_ray_at_angle(place, *own);
      return;
    }
    asked[k] = wormhole_ray_at_edge(place, edges[k], static_cast<double>(from.value_or(0)));
    if (own) require_delta(*own, asked[k].delta - asked[k].offset, asked[k].offset);
  });
  RecordArray records(record({"profile", "rho", "a", "m", "l", "delta", "edge", "offset", "origin",
                              "azimuth", "slope", "one_plus_z", "amplification"}),
                      shape);
  interruptible([&](const std::atomic<bool>& stop) {
    for (std::size_t k = 0; k < records.size() && !stop; ++k) {
      const TracedWormhole ray = trace_wormhole(asked[k], method == "table");
      const bool from_sky = std::isfinite(ray.azimuth);
      records.start(k);
      records.add(std::string_view(profiles[k]));
      for (const auto& number :
           {std::optional(rho.number(k)), given(a, k), given(m, k), std::optional(l.number(k))})
        records.add(or_absent(number));
      records.add(asked[k].delta);
      records.add(std::string_view(edges[k]));
      records.add(edges[k].empty() ? kAbsent : asked[k].offset);
      records.add(std::string_view(!from_sky ? "" : ray.own ? "own" : "other"));
      for (const double value : {ray.azimuth, ray.slope, from_sky ? 1 : kAbsent, ray.amplification})
        records.add(value);
    }
  });
  return records.array();
}

}  // namespace domefall
