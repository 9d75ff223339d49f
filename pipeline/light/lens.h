// A Lens says how light reaches one observer, and is asked for many directions or places at a time.
// It works in one frame at the observer's place, whose axes are R, Theta and Phi of the reference
// tetrad.  Aberration, camera and projection stay outside (view_tracer.h).
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "pipeline/light/amplification.h"
#include "pipeline/light/body_image.h"
#include "pipeline/light/direction_batch.h"
#include "pipeline/light/kerr_plane.h"
#include "pipeline/light/light_path.h"
#include "pipeline/light/plane_rays.h"
#include "pipeline/light/sky_points.h"
#include "pipeline/light/sphere_image.h"
#include "pipeline/spacetime/regions.h"
#include "trajectories/celerity.h"
#include "trajectories/directions.h"

namespace domefall {

// A ViewRay describes the light that reaches the observer from one direction.
struct ViewRay {
  SkyRegion sky = SkyRegion::kIV;  // where the light started
  // This is true if that sky has a table.  Otherwise only to_edge is set of all that follows.
  bool known = false;
  V3d sky_direction;           // equatorial J2000
  double frequency_ratio = 1;  // observed / emitted; 1 for the singularity, which has no redshift
  // The derivative of the place on the sky by the direction n of view, by its singular values.  A
  // small angle in the view along the unit vector `axis`, at right angles to n, moves the place by
  // scale_along times that angle along the unit vector `along`.  One along n x axis moves it by
  // scale_across times that angle along sky_direction x along, or against that if what is seen is
  // the mirror image of the sky.
  V3d axis, along;  // in the frame of n; equatorial J2000
  double scale_along = 0, scale_across = 0;
  bool mirrored = false;
  // These two are set for the singularity's light if its emission times are tabulated.
  // emission_time is the time t of the emission (M), counted from the observer's v or u as in
  // EmissionTimeTable.  time_scale is its derivative by the angle in the view.
  double emission_time = 0, time_scale = 0;
  // These two are for skies I and III.  Each half turn about the hole begins another order of
  // images.
  RayBundle bundle;
  // By the light about the hole, radians; 0 for straight light.  About a spin it is pi times the half
  // turns of its latitude.
  double swept = 0;
  // The angle in the view to the nearest edge of a sky (radians) is right to first order in it, and
  // infinite without an edge.  A rim along which images of a sky are crowded counts as an edge, and
  // is no nearer than the rim is wide.
  double to_edge = HUGE_VAL;

  // The ellipse on the sky that a small circle of view becomes has these axes per angle of view.
  double longer() const { return std::max(scale_along, scale_across); }
  double shorter() const { return std::min(scale_along, scale_across); }
  // Returns by how much the place moves as the direction n of view moves by a small vector across n.
  V3d moved(const V3d& n, const V3d& by) const {
    const V3d across = mirrored ? axis.cross(n) : n.cross(axis);
    return along * (scale_along * by.dot(axis)) +
           sky_direction.cross(along) * (scale_across * by.dot(across));
  }
};

// A ViewRayBatch holds the same quantities for many rays, column by column, but of the derivative
// only the ellipse on the sky.
struct ViewRayBatch {
  static constexpr int kSize = DirectionBatch::kSize;
  template <class T>
  using Column = DirectionBatch::Column<T>;
  alignas(64) Column<double> sky_x, sky_y, sky_z;
  // This is 0 where the two scales are equal and the ellipse is a circle.
  alignas(64) Column<double> along_x, along_y, along_z;
  alignas(64) Column<double> frequency_ratio, scale_along, scale_across, to_edge;
  alignas(64) Column<double> emission_time, time_scale;  // 0 where those times are not tabulated
  Column<SkyRegion> sky;

  V3d sky_direction(int k) const { return {sky_x[k], sky_y[k], sky_z[k]}; }
  V3d along(int k) const { return {along_x[k], along_y[k], along_z[k]}; }
  double longer(int k) const { return std::max(scale_along[k], scale_across[k]); }
  double shorter(int k) const { return std::min(scale_along[k], scale_across[k]); }
};

// A ViewCircle consists of the directions n with n.axis = cosine.
struct ViewCircle {
  V3d axis;  // unit vector
  double cosine, sine;
};
// A ViewCurve is a circle, or a closed polygon of directions that runs counter-clockwise about what
// it encloses, as seen from where the directions begin, and has so many corners that it counts as
// smooth.
using ViewCurve = std::variant<ViewCircle, std::vector<V3d>>;
// A SkyBorder is a curve on which a sky ends.
struct SkyBorder {
  ViewCurve curve;
  bool sky_within;  // whether the sky lies where n.axis > cosine, or within the polygon
  SkyRegion sky;
};

// A SkySample is a piece of a sky as it is seen in the frame of a lens.
struct SkySample {
  V3d direction, sky_direction;
  double frequency_ratio;
  double solid_angle;  // of its image, steradians
  double footprint;    // its longer side on the sky, radians
  RayBundle bundle;
};

// WantedSkies says which skies a lens must know, and how well.  What a black sky would show is not worth a
// table.
struct WantedSkies {
  PerSky<bool> sky{true, true, false, true};
  bool emission_times = false;  // of the past singularity's light, only with its sky
  double pixel = 0;  // radians; light about a spin need not be known to less than a twentieth of it
};

class Lens {
 public:
  Lens() = default;
  Lens(const Lens&) = delete;
  Lens& operator=(const Lens&) = delete;
  virtual ~Lens() = default;

  // Returns the celerity of the lens's frame.  Most lenses work in the reference tetrad.
  virtual Celerity<ReferenceTetrad> frame() const { return {}; }

  // Follows count <= ViewRayBatch::kSize directions back to a sky.  The columns `sky` and `to_edge`
  // are always set, and the others where that sky is known.
  virtual void rays(const DirectionBatch& directions, int count, ViewRayBatch& rays) const = 0;
  // Follows one direction with the functions of the C library.  It answers questions about single
  // rays, and tests hold the batch against it.
  virtual ViewRay ray(const V3d& direction) const = 0;

  // Returns the borders of the skies that are seen.  That of the tetrad's own sky comes first.
  virtual std::vector<SkyBorder> borders() const { return {}; }
  // Returns the curves on which the point straight behind the hole is seen first, one for each sky
  // that is known.  About a spin no point is seen as a ring, and the curves are those on which points
  // of the first caustic are seen without end bright.
  virtual std::vector<ViewCurve> einstein_rings() const { return {}; }
  // Returns the outline of a spinning hole's ergosphere (kerr_ergosphere.h), which is seen from
  // outside of it.
  virtual std::optional<ViewCurve> ergosphere() const { return std::nullopt; }
  // Finds images of points of a sky, in batches if a tolerance is given.  Nothing is returned where
  // the sky is not seen or not known.  The lens must outlive what is returned.
  virtual std::unique_ptr<const SkyPoints> points(
      SkyRegion sky, const std::optional<PointTolerance>& tolerance) const = 0;
  // Returns where a point of the own sky of the tetrad has its first image.  It serves to aim a
  // camera and is exact to 1e-14, whether or not the sky is known.  It is not for region IV, from
  // where no sky is seen.
  virtual V3d primary_image(const V3d& source) const = 0;
  // Returns the image of a body that moves near the hole (image_of_body), for an observer with this
  // null time.
  virtual std::optional<BodyImage> body_image(double, const BodyMotion&, int, double) const {
    return std::nullopt;
  }
  // The same of a place outside the hole, at psi radians from R (seen_place).
  virtual std::optional<SeenPlace> place(double, double, double) const { return std::nullopt; }
  // Some lenses find all images of a body of a radius together, the direct one first (kerr_body_image.h),
  // and the pieces of one of them, of which those of `earlier` are already there (kerr_sphere_image.h).
  virtual bool lists_bodies() const { return false; }
  virtual std::vector<BodyImage> body_images(double, const BodyMotion&, double) const { return {}; }
  virtual RingedSphere sphere(double, const BodyMotion&, const BodyImage&,
                              std::span<const BodyImage>, double, const RingPlane&,
                              const std::function<double(const V3d&)>&) const {
    return {};
  }

  // Finds where rays meet a plane through the hole.  Nothing is returned where that is not known.
  virtual std::unique_ptr<const PlaneRays> plane(const PlaneRings&, double) const {
    return nullptr;
  }

  // Finds the same of the equator of a hole that spins.  The lens need not outlive it.
  virtual std::shared_ptr<const KerrPlane> kerr_plane(const KerrRings&) const { return nullptr; }

  // Returns from where the lens sees matter all around the hole (light_path.h).  Nothing is returned
  // where that is not known.
  virtual std::optional<GasView> gas_view() const { return std::nullopt; }

  // A sky may be crowded around the directions in which it is seen farthest from its borders.
  // Nothing is returned if it is not seen or not known, or is never crowded.
  virtual std::vector<V3d> far_ends(SkyRegion) const { return {}; }
  // Divides such a sky evenly in the angle from its border and in the angle about the far end.
  virtual std::vector<SkySample> divided(SkyRegion, int, int) const { return {}; }
  // Returns directions around which rays change too fast to be interpolated from a coarse grid,
  // although no edge of a sky is near.
  virtual std::vector<V3d> special_directions() const { return {}; }
};

}  // namespace domefall
