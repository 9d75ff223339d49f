#include "pipeline/render/key_parts.h"

#include "pipeline/render/rays/key_rounding.h"

namespace domefall {

void add_observer(Digest& digest, const ObserverState& o) {
  digest.add(region_name(o.region))
      .add(tetrad_name(o.tetrad))
      .add(rounded_for_key(o.r))
      .add(rounded_for_key(o.proper_time));
  // A spacetime without parameters, or of a mass alone, is told by r, which is in units of it.
  const std::vector<double> parameters = o.spacetime.parameters();
  if (!parameters.empty())
    digest.add("spacetime").add(static_cast<int>(o.spacetime.kind().index()));
  for (const double parameter : parameters) digest.add(rounded_for_key(parameter));
  if (o.universe != 0) digest.add("universe").add(o.universe);
  if (o.spacetime.is<Wormhole>())  // throughout whose cylinder r is the same
    for (const double v : {o.l, o.mouth_at_start.x, o.mouth_at_start.y, o.mouth_at_start.z})
      digest.add(rounded_for_key(v));
  for (const double v : {o.celerity.x, o.celerity.y, o.celerity.z}) digest.add(rounded_for_key(v));
  add_rotation(digest, o.sky_from_tetrad);
  add_rotation(digest, o.tetrad_from_camera);
}

void add_projection(Digest& digest, const Projection& p) {
  digest.add(projection_name(p)).add(columns(p)).add(rows(p));
  for (const double parameter : further_parameters(p)) digest.add(rounded_for_key(parameter));
}

void add_effects(Digest& digest, const Effects& e) {
  if (e == Effects{}) return;
  digest.add("effects");
  for (const bool on : {e.aberration, e.doppler_colour, e.intensity, e.lensing})
    digest.add(on ? "on" : "off");
  digest.add(static_cast<double>(e.amplification));
}

void add_disc(Digest& digest, const std::optional<Disc>& disc) {
  if (!disc) return;
  // This is raised with every change that alters the pixels of discs alone.
  constexpr int kDiscVersion = 4, kSlabVersion = 2;
  digest.add("disc").add(kDiscVersion).add(disc->inner).add(disc->outer);
  // The axes come from sines, which differ between processors.  The other numbers stand in the
  // show.
  for (const V3d& axis : {disc->normal.v, disc->node.v})
    for (const double v : {axis.x, axis.y, axis.z}) digest.add(rounded_for_key(v));
  digest.add(disc->t_max_k).add(disc->luminance).add(disc->opacity);
  if (!disc->is_opaque()) digest.add(disc->optical_depth).add(disc->rim);
  if (disc->height > 0) digest.add("height").add(kSlabVersion).add(disc->height);
  digest.add(disc->plunging ? "plunging" : "stable");
  // Without a pattern the disc looks the same at all times, and slow light changes nothing.
  if (disc->patterns.empty()) return;
  digest.add(disc->slow_light ? "slow" : "fast");
  for (const PatternKind& pattern : disc->patterns) {
    digest.add(static_cast<double>(pattern.index()));
    if (const auto* p = std::get_if<TurbulencePattern>(&pattern))
      digest.add(p->contrast).add(p->orbits).add(static_cast<double>(p->seed));
    if (const auto* p = std::get_if<RingPattern>(&pattern))
      digest.add(p->spacing).add(p->contrast).add(p->inward_speed);
    if (const auto* p = std::get_if<MapPattern>(&pattern)) digest.add(p->at);
    if (const auto* p = std::get_if<SpotPattern>(&pattern))
      digest.add(p->r).add(p->azimuth).add(p->size).add(p->brightness);
  }
}

void add_gas(Digest& digest, const Show& show) {
  constexpr int kGasVersion = 1;
  const auto add = [&digest](const auto& gas) {
    for (const double x : {gas.normal.v.x, gas.normal.v.y, gas.normal.v.z})
      digest.add(rounded_for_key(x));
    digest.add(gas.r).add(gas.luminance).add(gas.temperature.value_or(0));
  };
  if (const auto& halo = show.halo) {
    digest.add("halo").add(kGasVersion).add(halo->height);
    add(*halo);
  }
  if (const auto& jet = show.jet) {
    digest.add("jet").add(kGasVersion).add(jet->lorentz).add(rounded_for_key(jet->opening));
    digest.add(jet->length);
    add(*jet);
  }
}

}  // namespace domefall
