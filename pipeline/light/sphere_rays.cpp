#include "pipeline/light/sphere_rays.h"

#include <numbers>

namespace domefall {
namespace {

using std::numbers::pi;

}  // namespace

SphereRays::SphereRays(const SphereView& view, const BodyMotion& motion, const BodyImage& image,
                       double radius)
    : view(view), motion(motion), image(image), radius(radius), across_(image.across) {
  const double half_turn = std::round(image.psi / pi);
  if (const auto centre = half_turn > 0 ? centre_if_on_axis() : std::nullopt) {
    const bool own_side = (image.psi < half_turn * pi) == (std::fmod(half_turn, 2) == 1);
    across_ = own_side ? *centre : -*centre;
  }
  beside_ = V3d(1, 0, 0).cross(across_);
}

// Finds what is at a place of the plane.  T grows along the body's way at a nearly steady rate.
std::optional<SphereRays::Met> SphereRays::meet(const V3d& e, const V3d& place, double tau) const {
  const double above = place.dot(e), r = std::hypot(above, place.x),
               angle = std::atan2(above, place.x);
  const double psi = angle + 2 * pi * std::round((image.psi - angle) / (2 * pi));
  const auto seen = view.place(r, std::abs(psi));
  if (!seen) return std::nullopt;
  for (int n = 0; n < 40; ++n) {
    if (!(tau > motion.begin && tau < motion.end)) return std::nullopt;
    const SphereCentre centre(view.spacetime, motion.at(tau));
    const double late =
        seen->null_time - centre.at.null_time - slice_of_v(view.spacetime, centre.at.r, r);
    if (std::abs(late) < 1e-11 * r) return Met{tau, centre, centre.own(place), r, psi, *seen};
    tau += late / centre.time_rate();
  }
  return std::nullopt;
}

std::optional<SphereRays::Slope> SphereRays::slope(const V3d& e, const V3d& place,
                                                   double tau) const {
  const double h = 1e-4 * radius;
  const auto at = meet(e, place, tau), by_r = meet(e, place + V3d(h, 0, 0), tau),
             by_e = meet(e, place + e * h, tau);
  if (!at || !by_r || !by_e) return std::nullopt;
  return Slope{*at, (by_r->q - at->q) / h, (by_e->q - at->q) / h};
}

std::optional<SphereRays::Leaving> SphereRays::leaving(const V3d& e, const Met& met) const {
  const double sine = std::sin(met.psi), cosine = std::cos(met.psi);
  Leaving light{fall_frame(view.spacetime, met.r), V3d(cosine, 0, 0) + e * sine, {}, {}, 0, 0};
  const V3d &outwards = light.outwards, onward = e * cosine - V3d(sine, 0, 0);
  const V3d motion_of_centre = met.centre.motion();
  const double rate = light.rate = light.frame.time_along_u();
  light.velocity = light.split(
      motion_of_centre, (outwards.dot(motion_of_centre) * rate - light.frame.u_r) / light.frame.e_r,
      rate);
  const double swept = met.seen.light.angular_momentum / met.r * (met.psi < 0 ? -1 : 1);
  light.ray = (outwards * met.seen.along_r - onward * swept) / met.seen.frequency;
  const double speed2 = light.velocity.length2();
  if (!(speed2 < 1)) return std::nullopt;
  light.doppler = (1 - light.velocity.dot(light.ray)) / std::sqrt(1 - speed2);
  return light;
}

// Returns the direction from the axis to the centre when the light of the axis left, if the sphere
// held the axis then.  The two orders that meet in a ring get the same, and divide the ring by it.
std::optional<V3d> SphereRays::centre_if_on_axis() const {
  const V3d x(1, 0, 0);
  double along = SphereCentre(view.spacetime, motion.at(image.proper_time)).place.x;
  const double h = 1e-4 * radius;
  for (int n = 0; n < 8; ++n) {
    const auto at = meet(across_, x * along, image.proper_time),
               by = meet(across_, x * (along + h), image.proper_time);
    if (!at || !by) return std::nullopt;
    const V3d slope = (by->q - at->q) / h;
    const double step = slope.dot(at->q) / slope.length2();
    along -= step;
    if (std::abs(step) > 1e-9 * radius && n < 7) continue;
    if (at->q.length() > radius) return std::nullopt;
    const V3d centre(0, at->centre.place.y, at->centre.place.z);
    // Of a centre on the axis itself both orders know the opposite sides (image_of_body).
    return centre.length() > 1e-6 * radius ? std::optional(centre.normalized()) : std::nullopt;
  }
  return std::nullopt;
}

std::vector<std::pair<double, double>> SphereRays::ranges(
    const std::function<double(const V3d& e)>& clear) const {
  constexpr double kEnough = 1e-7;
  constexpr int kSteps = 8;  // to each side, the first of which is half as wide as the image
  const double beside = image.r * std::abs(std::sin(image.psi)),
               wide = beside > radius ? std::asin(radius / beside) : pi / 2,
               power = std::max(std::log(wide / pi) / std::log(1.0 / kSteps), 1.0);
  const auto clear_at = [&](double azimuth) { return clear(plane(azimuth)); };
  std::vector<std::pair<double, double>> found;
  double before = -pi / 2, clear_before = 0;
  for (int k = -kSteps; k <= kSteps; ++k) {
    const double azimuth = std::copysign(pi / 2 * std::pow(std::abs(double(k)) / kSteps, power), k),
                 clear_now = clear_at(azimuth);
    if (clear_now > 0) {
      if (k == -kSteps) found.emplace_back(azimuth, azimuth);
      if (!(clear_before > 0) && k > -kSteps)
        found.emplace_back(
            root_between(azimuth, clear_now, before, clear_before, kEnough, clear_at), 0);
      found.back().second = azimuth;
    } else if (clear_before > 0) {
      found.back().second =
          root_between(before, clear_before, azimuth, clear_now, kEnough, clear_at);
    }
    before = azimuth, clear_before = clear_now;
  }
  return found;
}

}  // namespace domefall
