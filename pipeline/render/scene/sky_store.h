// The backgrounds and stars of a show's skies, each loaded when a frame first needs it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <variant>

#include "pipeline/render/scene/frame_plan.h"
#include "pipeline/render/scene/scene_stars.h"
#include "pipeline/show/show.h"
#include "pipeline/sky/maps/dark_level.h"
#include "pipeline/sky/maps/sky_map.h"
#include "trajectories/sky_region.h"

namespace domefall {

struct Grid {};
struct Black {};
using Rings = RingsSky;

// The sky of one region as it is loaded.
struct Sky {
  std::variant<Black, Grid, std::shared_ptr<const SkyMap>, Rings> background;
  std::shared_ptr<const SceneStars> stars;  // never null, but empty if there are none
  // What is taken from a map's light as its black (PanoramaSky::black), in the unit of its texels
  // and as luminance.
  DarkLevel black;
};

// How much of the files is loaded.  A frame of few pixels needs less than is there.
struct SkyDetail {
  int largest_face = kLargestFace;  // no level of a map has more texels along an edge (read_sky)
  // That many stars are loaded as they are, and fewer of the rest (thinned), unless a show changes
  // the faintest magnitude as it goes on; 0 for all as they are.
  std::size_t whole_stars = 0;
  // Maps that are made of images, a gigabyte of one that is 8192 pixels wide, are dropped beyond so
  // many bytes, unless one of the last two plans shows them: a frame in a dissolve has two.
  std::size_t most_made_bytes = std::size_t{2} << 30;
};

class SkyStore {
 public:
  // The show must outlive the store.
  explicit SkyStore(const Show& show, SkyDetail detail = {}) : show_(show), detail_(detail) {}

  // A sky with this background, if any, and with its stars.  What an earlier call loaded is kept as
  // long as there is room for it, and a file that several skies name is loaded once.  The reference
  // is valid until the plan after the next is asked for.  Throws InputError if a file cannot be
  // read.
  const Sky& sky(SkyRegion which, const std::optional<SkyBackground>& background, bool stars);
  // Loads all that any frame of the show may need of a region's sky.
  void load(SkyRegion which);
  // The skies that a plan asks for, and null for the others.
  PerSky<const Sky*> skies_of(const FramePlan& plan);
  // Loads what a plan asks for as far as there is room, and otherwise sees that it can be read.
  void load(const FramePlan& plan);

 private:
  struct Kept {
    std::optional<SkyBackground> background;
    Sky sky{Black{}, std::make_shared<const SceneStars>(), {}};
    bool has_background = false, has_stars = false;  // whether they are loaded
    std::uint64_t plan = 0;                          // the last one that showed it
  };
  Kept& kept_sky(SkyRegion which, const std::optional<SkyBackground>& background);
  void load_background(Kept& kept);
  // Whether another made map of usual size fits, and makes it fit if it can.
  bool has_room() const;
  void make_room();
  void load_stars(SkyRegion which, Kept& kept);
  bool limit_changes(SkyRegion which) const;
  // The magnitude of the faintest stars that any frame of the show draws.
  double faintest_magnitude(SkyRegion which) const;

  const Show& show_;
  SkyDetail detail_;
  std::mutex loading_;
  PerSky<std::deque<Kept>> skies_;  // whose elements stay where they are
  std::map<std::filesystem::path, std::shared_ptr<const SkyMap>> maps_;
  std::set<std::filesystem::path> made_;  // those of the maps that are made of images
  std::set<std::filesystem::path> tried_;
  std::uint64_t plans_ = 0;
};

}  // namespace domefall
