// GasRays say what single rays of one observer get from gas that they go through: a disc with a
// height, a halo, jets.  Along a ray the light of the gas is added up in small steps, dimmed by the
// disc's gas in front of it.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "pipeline/light/kerr_clock.h"
#include "pipeline/light/light_path.h"
#include "pipeline/light/plane_clock.h"
#include "pipeline/render/scene/frame_scene.h"
#include "pipeline/sources/disc/gas.h"

namespace domefall {

// A GasLook is what a ray sees of a disc in one place, such as about a crossing of the plane: light that no pattern
// has multiplied, and, times the sum of its three colours, the place of the gas in the plane (M) and
// the time at which the light left it.
struct GasLook {
  std::array<float, 3> light{};
  float x = 0, y = 0, time = 0;  // GasRays::observer_time() counts as 0
};

// A GasSight is all that a ray sees.
struct GasSight {
  std::array<float, 3> light{};  // what no pattern multiplies
  float left = 1;                // of the light behind all gas
  // Of a disc with a pattern: what is next to the observer, about the first crossing, and about the
  // second.  Later ones count as light alone, since they are thin.
  static constexpr int kLooks = 3;
  std::array<GasLook, kLooks> looks{};

  // All light, as if there were no pattern.
  std::array<float, 3> even_light() const {
    std::array<float, 3> sum = light;
    for (const GasLook& look : looks)
      for (std::size_t c = 0; c < 3; ++c) sum[c] += look.light[c];
    return sum;
  }
};

class GasRays {
 public:
  // The scene must outlive this object.
  explicit GasRays(const FrameScene& scene);

  const FrameScene& scene() const { return scene_; }
  bool has_disc() const { return disc_ != nullptr; }
  bool has_pattern() const { return disc_ && !disc_->patterns.empty(); }
  const GasView& view() const { return view_; }
  // The sine of the smallest angle, as seen from the hole, across which gas changes.
  double finest() const { return finest_; }
  // Returns the path at alpha that leads away from R on the side of the unit vector `across` (along R,
  // Theta and Phi, at right angles to R).
  LightPath path(double alpha, const V3d& across) const;
  // Without a spin it is the same for all sides.
  bool paths_are_alike() const { return !view_.spinning; }

  // The time t from which those of looks are counted.
  double observer_time() const { return spin_ ? spin_->observer_time : clock_->observer_time(); }

  // Adds up the gas on a path, up to psi.  `frequency` is FrameRayBatch::frequency.
  GasSight sight(const LightPath& path, const V3d& across, double frequency,
                 double until = HUGE_VAL) const;

  // Returns what is seen in direction n in front of a place whose light has swept psi, or about a hole
  // that spins |E| times Mino's time.
  GasSight sight_before(const CameraDirection& n, double psi) const;

  // Says whether alpha counts from -R, where the hole is, or from R.
  bool counts_from_hole() const;
  // Returns the direction in the frame of the lens of a ray at alpha in the plane of R and `across`.
  V3d direction_of(double alpha, const V3d& across) const;

 private:
  // A Ray is a path, with what is at right angles to the disc, the halo, the jet, and what the azimuths
  // of the disc count from, along the axes of the path.
  struct Ray {
    const LightPath& path;
    double frequency;
    V3d disc, halo, jet, node, quarter, axis;
  };
  Ray ray_of(const LightPath& path, const V3d& across, double frequency) const;
  // A Step is a small part of a ray.
  struct Step {
    double psi, length;  // of its middle, and radians
    V3d at;
    double r, time;
    double rising;  // as in GasPlace
  };
  // A Layer is the gas of one step: the light of what is thin, and the disc's radius, ratio of the
  // frequency observed to that sent, and optical depth.
  struct Layer {
    double psi, time;
    V3d at;
    WorkingRgb light;
    float r, ratio, depth;
  };
  int steps_between(const LightPath::Place& a, const LightPath::Place& b, const Ray& ray) const;
  double speed_at_latitude(double r, double latitude_sine) const;
  Layer layer(const Ray& ray, const Step& step) const;
  void add_look(const Ray& ray, const Layer& layer, const WorkingRgb& light, double weight,
                GasLook& to) const;
  GasSight seen(const Ray& ray, const std::vector<Layer>& layers) const;
  double first_crossing(const Ray& ray) const;

  const FrameScene& scene_;
  const Halo* halo_;
  const Jet* jet_;
  const Disc* disc_ = nullptr;
  GasView view_;
  V3d disc_normal_{0, 0, 1}, halo_normal_{0, 0, 1}, jet_normal_{0, 0, 1};  // in the lens's frame
  V3d node_, quarter_;
  GasOrbits orbits_;
  std::optional<GasColour> halo_colour_, jet_colour_;
  std::optional<PlaneClock> clock_;  // of a disc's pattern, about a hole without spin
  struct Spin {
    KerrClock clock;
    double a, sense;  // 1 of a disc that goes with the hole, else -1
    V3d axis;
    double observer_time;  // v
  };
  std::optional<Spin> spin_;
  double outer_ = 0, finest_ = 1, disc_step_ = 0, opacity_ = 1, gain_ = 1;
};

}  // namespace domefall
