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
  const ObserverState& observer = scene.state.observer;
  const auto in_lens = [&](const SkyDirection& axis) {
    return apply_transposed(observer.sky_from_tetrad, axis.v);
  };
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
  if (has_pattern()) clock_.emplace(view_.view, observer.null_time);
}

bool GasRays::counts_from_hole() const {
  return view_.view.straight || !is_outgoing(view_.view.tetrad);
}

V3d GasRays::direction_of(double alpha, const V3d& across) const {
  const SineCosine at = sin_cos(alpha);
  return across * at.sine + V3d(counts_from_hole() ? -at.cosine : at.cosine, 0, 0);
}

// Returns into how many steps a part of a path is divided: none where no gas is.
int GasRays::steps_between(const LightPath::Place& a, const LightPath::Place& b,
                           const V3d& across) const {
  const double length = b.psi - a.psi, cosine = (a.cosine + b.cosine) / 2,
               sine = (a.sine + b.sine) / 2;
  const auto latitude = [&](const V3d& normal) {
    return std::abs(cosine * normal.x + sine * across.dot(normal));
  };
  double longest = HUGE_VAL;
  if (halo_) longest = longest_step(*halo_, latitude(halo_normal_), length);
  if (jet_) longest = std::min(longest, longest_step(*jet_, latitude(jet_normal_), length));
  // The sine of a latitude changes by no more than the angle.
  if (disc_ && std::min(a.w, b.w) < 1 / disc_->inner &&
      latitude(disc_normal_) < kHeights * disc_->height + length / 2)
    longest = std::min(longest, disc_step_);
  return static_cast<int>(std::ceil(length / longest));
}

GasRays::Layer GasRays::layer(const Ray& ray, const Step& step) const {
  const double energy = ray.path.energy, momentum = ray.path.momentum;
  Layer layer{step.psi, step.time, {0, 0, 0}, 0, 0, 0};
  // What a step along the ray is in the light's own measure, for whom light of frequency 1 goes 1 M.
  const double way = step.length * step.r * step.r / momentum;
  const auto latitude = [&](const V3d& normal) {
    return step.cosine * normal.x + step.sine * ray.across.dot(normal);
  };
  // L_n = -L (R x across).n
  const auto about = [&](const V3d& normal) {
    return momentum * (ray.across.z * normal.y - ray.across.y * normal.z);
  };
  const auto add_thin = [&](const auto& gas, const V3d& normal, const GasColour& colour) {
    const GasPlace at{step.r, latitude(normal), step.outward};
    const double n = density(gas, orbits_, at);
    if (n < 1e-6) return;
    const double sent = sent_frequency(gas, orbits_, {energy, momentum, about(normal)}, at);
    layer.light = sum(layer.light, colour.light(ray.frequency / sent), n * sent * way);
  };
  if (halo_) add_thin(*halo_, halo_normal_, *halo_colour_);
  if (jet_) add_thin(*jet_, jet_normal_, *jet_colour_);
  if (!disc_ || step.r <= disc_->inner || step.r >= disc_->outer) return layer;
  const double s = latitude(disc_normal_), height = disc_->height_at(step.r), off = s / height;
  if (std::abs(off) > kHeights) return layer;
  const bool falls = step.r < orbits_.last_stable();
  // r u^phi in the plane.  At a latitude its circle is smaller, and gas is slower against who rests.
  const double turning =
      falls ? orbits_.plunge_momentum() / step.r
            : step.r * orbits_.circling(step.r) / std::sqrt(orbits_.slowing_squared(step.r));
  const double sent =
      disc_shift(orbits_, {energy, momentum, about(disc_normal_)}, step.r, falls && step.outward) /
      std::sqrt(1 + s * s * turning * turning);
  const double thickness = std::sqrt(2 * pi) * height * step.r;
  layer.depth = static_cast<float>(std::min(depth_across(*disc_, step.r), 1e6) / thickness *
                                   exponential(-off * off / 2) * sent * way);
  layer.r = static_cast<float>(step.r);
  layer.ratio = static_cast<float>(ray.frequency / sent);
  return layer;
}

GasSight GasRays::sight(const LightPath& path, const V3d& across, double frequency,
                        double until) const {
  // Nothing is seen behind so much gas.
  constexpr float kOpaque = 16;
  const Ray ray{path, across, frequency};
  thread_local std::vector<Layer> layers;
  layers.clear();
  const double least = 1 / outer_, horizon = 1 / orbits_.horizon();
  float depth = 0;
  for (std::size_t k = 1; k < path.places.size() && !(opacity_ == 1 && depth > kOpaque); ++k) {
    const LightPath::Place &a = path.places[k - 1], &b = path.places[k];
    if (a.psi >= until) break;
    // Where the path is only inside the horizon or beyond all gas, there is nothing.
    if ((a.w < least && b.w < least) || (a.w > horizon && b.w > horizon)) continue;
    const int steps = steps_between(a, b, across);
    // Steps begin and end on the horizon itself, where gas may be opaque.
    const double crossed = part_at(a, b, horizon) * (b.psi - a.psi);
    const double from = a.psi + (a.w > horizon ? crossed : 0),
                 to = std::min(b.w > horizon ? a.psi + crossed : b.psi, until), way = to - from;
    for (int n = 0; n < steps; ++n) {
      const double psi = from + way * (n + 0.5) / steps, part = (psi - a.psi) / (b.psi - a.psi);
      const double w = LightPath::inverse_radius(a, b, part);
      if (!(w > least && w < horizon)) continue;
      const SineCosine turned = sin_cos(psi);
      Layer one = layer(ray, {psi, way / steps, turned.cosine, turned.sine, 1 / w,
                              a.time + part * (b.time - a.time), b.w > a.w});
      if (!(one.depth > 0 || one.light.r + one.light.g + one.light.b > 0)) continue;
      if (one.depth > 0) {
        one.psi -= (0.5 - depth_of_light(one.depth)) * way / steps;
        const double there = (one.psi - a.psi) / (b.psi - a.psi);
        one.r = static_cast<float>(1 / LightPath::inverse_radius(a, b, there));
        one.time = a.time + there * (b.time - a.time);
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
  const SineCosine at = sin_cos(layer.psi);
  const V3d place = V3d(at.cosine, 0, 0) + ray.across * at.sine;
  const double share = c[0] + c[1] + c[2], radius = layer.r;
  const double time = scene_.disc->disc().slow_light ? clock_->time_at(radius, layer.time)
                                                     : clock_->observer_time();
  // Gas at another height has other filaments, since no pattern is the same all through the disc.
  constexpr double kOutwards = 2;
  const double s = place.dot(disc_normal_), rounded = disc_->height / 2;
  const double shown = share * radius * (1 + kOutwards * std::sqrt(s * s + rounded * rounded));
  to.x += static_cast<float>(shown * place.dot(node_));
  to.y += static_cast<float>(shown * place.dot(quarter_));
  to.time += static_cast<float>(share * (time - clock_->observer_time()));
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
  // Of the disc's normal along the ray, where the ray crosses its plane first.
  const double up = std::abs(disc_normal_.x),
               toward = ray.across.dot(disc_normal_) * (disc_normal_.x > 0 ? -1 : 1);
  const double crossing = arc_tangent2(up, toward);
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
    if (!clock_) {
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
  return sight(path(alpha), across, at.frequency[0], psi);
}

}  // namespace domefall
