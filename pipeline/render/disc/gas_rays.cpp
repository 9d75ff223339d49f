#include "pipeline/render/disc/gas_rays.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipeline/base/simd/vector_math.h"
#include "pipeline/render/scene/effect_ratios.h"
#include "pipeline/sources/disc/disc_light.h"

namespace domefall {
namespace {

using std::numbers::pi;

// A disc's gas is left out beyond so many of its heights, where 2e-6 of it is left.
constexpr double kHeights = 4.75;
// Steps are at most this part of a disc's height.  Were they longer on rays that graze it, filaments
// would have faults where their number changes.
constexpr double kFine = 0.3;

WorkingRgb sum(const WorkingRgb& a, const WorkingRgb& b, double factor) {
  const auto f = static_cast<float>(factor);
  return {a.r + f * b.r, a.g + f * b.g, a.b + f * b.b};
}

// Returns from which part of an even layer of this optical depth its light comes in the mean.
double depth_of_light(double depth) {
  return depth < 1e-3 ? 0.5 - depth / 12 : 1 / depth - 1 / (exponential(depth) - 1);
}

// Falls smoothly from 1 below `begin` to 0 above `end`.
double falling(double x, double begin, double end) {
  const double t = std::clamp((end - x) / (end - begin), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

// Returns the part of the way from one place to the next on which 1/r comes to w, or 0.
double part_at(const LightPath::Place& a, const LightPath::Place& b, double w) {
  if ((a.w > w) == (b.w > w)) return 0;
  double low = 0, high = 1;
  for (int k = 0; k < 40; ++k) {
    const double middle = (low + high) / 2;
    ((LightPath::inverse_radius(a, b, middle) > w) == (a.w > w) ? low : high) = middle;
  }
  return low;
}

}  // namespace

GasRays::GasRays(const FrameScene& scene)
    : scene_(scene),
      halo_(scene.plan.halo),
      jet_(scene.plan.jet),
      view_(scene.tracer.lens()->gas_view().value()) {
  if (const auto* hole = std::get_if<ChargedHole>(&view_.view.space.kind()))
    orbits_ = GasOrbits(*hole);
  if (view_.spinning) orbits_ = GasOrbits(view_.spinning->hole, false);
  const ObserverState& observer = scene.state.observer;
  const auto in_lens = [&](const SkyDirection& axis) {
    return apply_transposed(observer.sky_from_tetrad, axis.v);
  };
  if (const auto* hole = std::get_if<SpinningHole>(&observer.spacetime.kind()))
    spin_ = Spin{KerrClock(hole->kerr), orbits_.spin(), 1, in_lens({axis_of(*hole)}),
                 observer.null_time};
  const Effects& effects = scene.effects;
  const auto colour_of = [&](const auto& gas) {
    return GasColour(gas.temperature, gas.luminance, gas.r, effects.doppler_colour,
                     effects.intensity);
  };
  if (const Halo* halo = halo_) {
    halo_normal_ = in_lens(halo->normal);
    halo_colour_.emplace(colour_of(*halo));
    outer_ = std::max(outer_, reach(*halo));
    finest_ = std::min(finest_, halo->height);
  }
  if (const Jet* jet = jet_) {
    jet_normal_ = in_lens(jet->normal);
    jet_colour_.emplace(colour_of(*jet));
    outer_ = std::max(outer_, reach(*jet));
    finest_ = std::min(finest_, jet->opening);
  }
  if (!scene.disc || !(scene.disc->disc().height > 0)) return;
  disc_ = &scene.disc->disc();
  disc_normal_ = in_lens(disc_->normal);
  node_ = in_lens(disc_->node);
  quarter_ = disc_normal_.cross(node_);
  outer_ = std::max(outer_, disc_->outer);
  disc_step_ = kFine * disc_->height_at(disc_->inner);
  finest_ = std::min(finest_, disc_->height_at(disc_->inner));
  opacity_ = scene.state.settings.disc_opacity;
  gain_ = scene.state.settings.disc_gain;
  if (spin_ && disc_->orbits.spin() < 0) spin_->sense = -1;
  if (has_pattern() && !spin_) clock_.emplace(view_.view, observer.null_time);
}

LightPath GasRays::path(double alpha, const V3d& across) const {
  if (!view_.spinning) return light_path(view_.view, alpha, outer_);
  return kerr_light_path(*view_.spinning, alpha, std::atan2(-across.z, -across.y), outer_);
}

GasRays::Ray GasRays::ray_of(const LightPath& path, const V3d& across, double frequency) const {
  const V3d beside(0, -across.z, across.y);  // R x across
  const auto along = [&](const V3d& v) {
    return spin_ ? v : V3d(v.x, v.dot(across), v.dot(beside));
  };
  return {path,
          frequency,
          along(disc_normal_),
          along(halo_normal_),
          along(jet_normal_),
          along(node_),
          along(quarter_),
          spin_ ? spin_->axis : V3d(0, 0, 0)};
}

bool GasRays::counts_from_hole() const {
  return view_.view.straight || !is_outgoing(view_.view.tetrad);
}

V3d GasRays::direction_of(double alpha, const V3d& across) const {
  const SineCosine at = sin_cos(alpha);
  return across * at.sine + V3d(counts_from_hole() ? -at.cosine : at.cosine, 0, 0);
}

// Returns into how many steps a part of a path is divided, two for each of Gauss's pairs: none where no
// gas is.
int GasRays::steps_between(const LightPath::Place& a, const LightPath::Place& b,
                           const Ray& ray) const {
  const double length = (b.at - a.at).length();
  const V3d at = (a.at + b.at) / 2;
  const auto latitude = [&](const V3d& normal) { return std::abs(at.dot(normal)); };
  double longest = HUGE_VAL;
  if (halo_) longest = longest_step(*halo_, latitude(ray.halo), length);
  if (jet_) longest = std::min(longest, longest_step(*jet_, latitude(ray.jet), length));
  // The sine of a latitude changes by no more than the angle.
  if (disc_ && std::min(a.w, b.w) < 1 / disc_->inner &&
      latitude(ray.disc) < kHeights * disc_->height + length / 2)
    longest = std::min(longest, disc_step_);
  // Where light moves along r, gas changes as fast by that.
  const double onward = std::max(length, std::abs(b.w - a.w) / std::max(a.w, b.w));
  return 2 * static_cast<int>(std::ceil(onward / (2 * longest)));
}

// Above the plane the circles of gas are smaller, and gas is slower against who rests.  Returns by what
// its four-velocity is too long there.
double GasRays::speed_at_latitude(double r, double latitude_sine) const {
  const double s = latitude_sine;
  const GasOrbits& orbits = disc_->orbits;
  const bool falls = r < orbits.last_stable();
  if (!spin_ || falls) {
    const double turning = falls ? orbits.plunge_momentum() / r
                                 : r * orbits.circling(r) / std::sqrt(orbits.slowing_squared(r));
    return std::sqrt(1 + s * s * turning * turning);
  }
  const double a = orbits.spin(), omega = orbits.circling(r), sine2 = (1 - s) * (1 + s);
  const double near = (2 * r - orbits.charge_squared()) / (r * r + a * a * s * s),
               dragged = 1 - a * omega * sine2;
  const double square = 1 - omega * omega * sine2 * (r * r + a * a) - near * dragged * dragged;
  return std::sqrt(square / orbits.slowing_squared(r));
}

GasRays::Layer GasRays::layer(const Ray& ray, const Step& step) const {
  const double energy = ray.path.energy, momentum = ray.path.momentum;
  Layer layer{step.psi, step.time, step.at, {0, 0, 0}, 0, 0, 0};
  // What a step along the ray is in the light's own measure, for whom light of frequency 1 goes 1 M.
  double sigma = step.r * step.r;
  if (spin_) {
    const double s = spin_->a * step.at.dot(ray.axis);
    sigma += s * s;
  }
  const double way = step.length * sigma / ray.path.rate;
  const auto add_thin = [&](const auto& gas, const V3d& normal, const GasColour& colour) {
    const GasPlace at{step.r, step.at.dot(normal), step.rising};
    const double n = density(gas, orbits_, at);
    if (n < 1e-6) return;
    const double sent =
        sent_frequency(gas, orbits_, {energy, momentum, ray.path.about.dot(normal)}, at);
    layer.light = sum(layer.light, colour.light(ray.frequency / sent), n * sent * way);
  };
  if (halo_) add_thin(*halo_, ray.halo, *halo_colour_);
  if (jet_) add_thin(*jet_, ray.jet, *jet_colour_);
  if (!disc_ || step.r <= disc_->inner || step.r >= disc_->outer) return layer;
  const double s = step.at.dot(ray.disc), height = disc_->height_at(step.r), off = s / height;
  if (std::abs(off) > kHeights) return layer;
  const GasOrbits& orbits = disc_->orbits;
  const double sent = disc_shift(orbits, {energy, momentum, ray.path.about.dot(ray.disc)}, step.r,
                                 step.r < orbits.last_stable() && step.rising > 0) /
                      speed_at_latitude(step.r, s);
  // Light that a path leads to above the plane need not get to its circles in it.
  if (!(sent > 0)) return layer;
  const double thickness = std::sqrt(2 * pi) * height * step.r;
  layer.depth =
      static_cast<float>(std::min(depth_across(*disc_, step.r, scene_.state.observer.r), 1e6) /
                         thickness * exponential(-off * off / 2) * sent * way);
  layer.r = static_cast<float>(step.r);
  layer.ratio = static_cast<float>(ray.frequency / sent);
  return layer;
}

GasSight GasRays::sight(const LightPath& path, const V3d& across, double frequency,
                        double until) const {
  // Nothing is seen behind so much gas.
  constexpr float kOpaque = 16;
  const Ray ray = ray_of(path, across, frequency);
  thread_local std::vector<Layer> layers;
  layers.clear();
  const double least = 1 / outer_, horizon = 1 / orbits_.horizon();
  float depth = 0;
  for (std::size_t k = 1; k < path.places.size() && !(opacity_ == 1 && depth > kOpaque); ++k) {
    const LightPath::Place &a = path.places[k - 1], &b = path.places[k];
    if (a.psi >= until) break;
    // Where the path is only inside the horizon or beyond all gas, there is nothing.
    if ((a.w < least && b.w < least) || (a.w > horizon && b.w > horizon)) continue;
    const int steps = steps_between(a, b, ray);
    // Steps begin and end on the horizon itself, where gas may be opaque.
    const double crossed = part_at(a, b, horizon) * (b.psi - a.psi);
    const double from = a.psi + (a.w > horizon ? crossed : 0),
                 to = std::min(b.w > horizon ? a.psi + crossed : b.psi, until), way = to - from;
    for (int n = 0; n < steps; ++n) {
      // Gauss's two places of each pair of steps.
      const int second = n % 2;
      const double aside = (second == 1 ? 1 : -1) / std::sqrt(3.0);
      const double psi = from + way * (n - second + 1 + aside) / steps,
                   part = (psi - a.psi) / (b.psi - a.psi);
      const double w = LightPath::inverse_radius(a, b, part);
      if (!(w > least && w < horizon)) continue;
      Layer one = layer(ray, {psi, way / steps, LightPath::direction(a, b, part), 1 / w,
                              a.time + part * (b.time - a.time),
                              LightPath::slope(a, b, part) * path.rate / (w * w)});
      if (!(one.depth > 0 || one.light.r + one.light.g + one.light.b > 0)) continue;
      if (one.depth > 0) {
        one.psi -= (0.5 - depth_of_light(one.depth)) * way / steps;
        const double there = (one.psi - a.psi) / (b.psi - a.psi);
        one.r = static_cast<float>(1 / LightPath::inverse_radius(a, b, there));
        one.time = a.time + there * (b.time - a.time);
        one.at = LightPath::direction(a, b, there);
      }
      layers.push_back(one);
      depth += one.depth;
    }
  }
  return seen(ray, layers);
}

// Adds the light of a layer of the disc to a look.
void GasRays::add_look(const Ray& ray, const Layer& layer, const WorkingRgb& light, double weight,
                       GasLook& to) const {
  const std::array<double, 3> c{weight * light.r, weight * light.g, weight * light.b};
  for (std::size_t n = 0; n < 3; ++n) to.light[n] += static_cast<float>(c[n]);
  const double share = c[0] + c[1] + c[2], radius = layer.r;
  const bool slow = scene_.disc->disc().slow_light;
  double time = observer_time(), x = layer.at.dot(ray.node), y = layer.at.dot(ray.quarter);
  if (!spin_) {
    if (slow) time = clock_->time_at(radius, layer.time);
  } else {
    if (slow) time += layer.time - spin_->clock.tortoise(radius);
    // From the angle of light that falls to that of Boyer and Lindquist.
    const SineCosine twist = sin_cos(spin_->sense * spin_->clock.twist(radius));
    const double turned = x * twist.cosine + y * twist.sine;
    y = y * twist.cosine - x * twist.sine, x = turned;
  }
  // Gas at another height has other filaments, since no pattern is the same all through the disc.
  constexpr double kOutwards = 2;
  const double s = layer.at.dot(ray.disc), rounded = disc_->height / 2;
  const double shown = share * radius * (1 + kOutwards * std::sqrt(s * s + rounded * rounded));
  to.x += static_cast<float>(shown * x);
  to.y += static_cast<float>(shown * y);
  to.time += static_cast<float>(share * (time - observer_time()));
}

// Returns where a ray crosses the disc's plane first, or would if it did not end before, so that nothing
// changes suddenly where rays begin to end.
double GasRays::first_crossing(const Ray& ray) const {
  const std::vector<LightPath::Place>& places = ray.path.places;
  for (std::size_t k = 1; k < places.size(); ++k) {
    const double before = places[k - 1].at.dot(ray.disc), after = places[k].at.dot(ray.disc);
    if ((before > 0) != (after > 0))
      return places[k - 1].psi + (places[k].psi - places[k - 1].psi) * before / (before - after);
  }
  const LightPath::Place& last = places.back();
  const double above = last.at.dot(ray.disc), rising = last.turning.dot(ray.disc);
  return last.psi + arc_tangent2(std::abs(above), above > 0 ? -rising : rising);
}

// Lays layers behind each other, the nearest first.
GasSight GasRays::seen(const Ray& ray, const std::vector<Layer>& layers) const {
  thread_local std::vector<float> r, ratio;
  thread_local std::vector<WorkingRgb> light;
  GasSight sight;
  if (layers.empty()) return sight;
  if (disc_) {
    r.clear(), ratio.clear();
    for (const Layer& l : layers) {
      r.push_back(l.depth > 0 ? l.r : 10);
      ratio.push_back(static_cast<float>(colour_ratio(scene_.effects, l.ratio)));
    }
    light.resize(layers.size());
    scene_.disc->light(r, ratio, light);
  }
  const double crossing = has_pattern() ? first_crossing(ray) : 0;
  const double up = disc_ ? std::abs(ray.path.places.front().at.dot(ray.disc)) : 0;
  const double amid = disc_ ? falling(up / disc_->height, 1.5, 3) : 0;
  double left = 1;
  WorkingRgb plain{0, 0, 0};
  for (std::size_t k = 0; k < layers.size(); ++k) {
    const Layer& l = layers[k];
    // Thin gas amid that of the disc is hidden by what of it is in front.
    const double depth = l.depth, kept = exponential(-depth),
                 passed = depth > 1e-6 ? (1 - kept) / depth : 1;
    plain = sum(plain, l.light, 1 - opacity_ + opacity_ * left * passed);
    if (!(depth > 0)) continue;
    const double weight =
        opacity_ * gain_ * left * (1 - kept) * surface_brightness_ratio(scene_.effects, l.ratio);
    left *= kept;
    if (!has_pattern()) {
      plain = sum(plain, light[k], weight);
      continue;
    }
    // What is next to an observer in the gas passes into what is about a crossing without a jump.
    const double near = amid * falling(l.psi, 0.6, 1);
    if (near > 0) add_look(ray, l, light[k], weight * near, sight.looks[0]);
    if (near == 1) continue;
    const auto about =
        static_cast<std::size_t>(std::max(1.0, std::floor((l.psi - crossing) / pi + 0.5) + 1));
    if (about < sight.looks.size())
      add_look(ray, l, light[k], weight * (1 - near), sight.looks[about]);
    else
      plain = sum(plain, light[k], weight * (1 - near));
  }
  sight.light = {plain.r, plain.g, plain.b};
  sight.left = static_cast<float>(1 - opacity_ + opacity_ * left);
  return sight;
}

GasSight GasRays::sight_before(const CameraDirection& n, double psi) const {
  FrameRayBatch at;
  scene_.tracer.into_frame(&n, 1, at);
  const double beside = std::sqrt(at.y[0] * at.y[0] + at.z[0] * at.z[0]),
               alpha = arc_tangent2(beside, counts_from_hole() ? -at.x[0] : at.x[0]);
  const V3d across = beside > 0 ? V3d(0, at.y[0] / beside, at.z[0] / beside) : V3d(0, 1, 0);
  const LightPath way = path(alpha, across);
  return sight(way, across, at.frequency[0], spin_ ? psi * way.rate / std::abs(way.energy) : psi);
}

}  // namespace domefall
