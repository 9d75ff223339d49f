// A SkyStore holds the backgrounds and stars of a show's skies.  Each is loaded when a frame first
// needs it.
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
#include "pipeline/sources/sky/dark_level.h"
#include "pipeline/sources/sky/read_sky.h"
#include "pipeline/sources/sky/sky_map.h"
#include "pipeline/spacetime/regions.h"

namespace domefall {

struct Grid {};
struct Black {};
using Rings = RingsSky;

// A Sky is the sky of one region as it is loaded.
struct Sky {
  std::variant<Black, Grid, std::shared_ptr<const SkyMap>, Rings> background;
  std::shared_ptr<const SceneStars> stars;  // never null, but empty if there are none
  // The black of a map (PanoramaSky::black) is subtracted from its light.  It is given in the unit
  // of the map's light and as luminance.
  DarkLevel black;
};

// SkyDetail says how much of the files is loaded.  A frame of few pixels needs less than is there.
struct SkyDetail {
  int largest_face = kLargestFace;  // no level of a map has more texels along an edge (read_sky)
  // This many of the brightest stars are loaded as they are, and fewer of the rest (thin_out).  All
  // are loaded as they are if the show keyframes the faintest magnitude.
  std::size_t whole_stars = kAllWhole;
  // Maps that are made of images are dropped to keep their sum within this many bytes, except those
  // that one of the last two plans shows.  A frame in a dissolve has two plans.  The map of an
  // image that is 8192 pixels wide takes a gigabyte.
  std::size_t most_made_bytes = std::size_t{2} << 30;
};

class SkyStore {
 public:
  // The show must outlive the store.
  explicit SkyStore(const Show& show, SkyDetail detail = {}) : show_(show), detail_(detail) {}

  // Returns a sky with this background, if any, and with its stars if `stars` is set.  What an
  // earlier call loaded is kept as long as there is room for it, and a file that several skies name
  // is loaded once.  The reference is valid until the plan after the next is asked for.  Throws
  // InputError if a file cannot be read.
  const Sky& sky(SkyRegion which, const std::optional<SkyBackground>& background, bool stars);
  // Loads all that any frame of the show may need of a region's sky.
  void load(SkyRegion which);
  // Returns the skies that a plan asks for, and null for the others.
  PerSky<const Sky*> skies_of(const FramePlan& plan);
  // Loads what a plan asks for.  A map for which there is no room is only tested for being
  // readable.
  void load(const FramePlan& plan);

 private:
  struct Kept {
    std::optional<SkyBackground> background;
    Sky sky{Black{}, std::make_shared<const SceneStars>(), {}};
    bool has_background = false, has_stars = false;  // whether they are loaded
    std::uint64_t plan = 0;                          // the last plan that showed this sky
  };
  Kept& kept_sky(SkyRegion which, const std::optional<SkyBackground>& background);
  void load_background(Kept& kept);
  // Says whether another map fits that is as large as the largest one that is kept.
  bool has_room() const;
  // Drops maps until another one fits, as long as there is one that may be dropped.
  void make_room();
  void load_stars(SkyRegion which, Kept& kept);
  struct MagnitudeLimit {
    double faintest;  // the magnitude of the faintest stars that any frame of the show draws
    bool changes;     // whether the show keyframes it
    bool operator==(const MagnitudeLimit&) const = default;
  };
  MagnitudeLimit limit_of(SkyRegion which) const;

  const Show& show_;
  SkyDetail detail_;
  std::mutex loading_;
  PerSky<std::deque<Kept>> skies_;  // a deque, so that elements stay where they are
  std::map<std::filesystem::path, BackgroundMap> maps_;
  std::set<std::filesystem::path> made_;   // the files of maps that are made of images
  std::set<std::filesystem::path> tried_;  // the files that were tested and not loaded
  std::uint64_t plans_ = 0;
};

}  // namespace domefall
