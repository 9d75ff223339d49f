// A ShowWarning is something that `check` and the live preview warn of, and its place in the show.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pipeline/show/frame_state.h"
#include "pipeline/show/show.h"

namespace domefall {

inline constexpr int kWholeShow = -1;
struct ShowWarning {
  double time_s = 0;  // show seconds
  int frame = 0;
  int segment = 0;  // kWholeShow if it belongs to no segment
  std::string text;
};

// A NearBodies is shown the states of a show one by one, in the order of frames.  It looks for
// bodies whose direct image is left out, since no picture of a sphere can be made where the
// observer is in it or sees it more than about 114 degrees wide.  Only bodies that are large
// against their orbits are looked at, which takes a tenth of a millisecond for each, in at most
// some 500 frames.
class NearBodies {
 public:
  // The show must outlive this object.
  explicit NearBodies(const Show& show);

  void add(const FrameState& state);

  // Returns one warning for each such body, with the first frame and the last.
  std::vector<ShowWarning> warnings() const;

 private:
  struct LargeBody {
    const Body* body;
    double radius, low, high;  // M; the last two are the least and the largest r of its way
    std::optional<ShowWarning> first;
    int last_frame = 0;
  };

  const Show& show_;
  std::vector<LargeBody> bodies_;
};

// A NearGas is shown the states in the same way.  It looks for stretches in which the observer is so
// deep in the gas of a disc with a height that less than a tenth of the light of all else comes
// through it, whatever the direction.
class NearGas {
 public:
  // The show must outlive this object.
  explicit NearGas(const Show& show) : show_(show) {}

  void add(const FrameState& state);

  // Returns one warning for each stretch, with the first frame and the last.
  std::vector<ShowWarning> warnings() const;

 private:
  struct Stretch {
    ShowWarning first;
    int last_frame;
  };

  const Show& show_;
  std::vector<Stretch> stretches_;
};

// Returns a warning for each passage of a horizon of a charged hole at which light of a sky that the
// show lights is blueshifted without bound.
std::vector<ShowWarning> horizon_warnings(const Show& show);

// Returns a warning where a hole that spins is not seen at its `at` when the show begins, since the
// first segment has a latitude of its own.
std::vector<ShowWarning> place_warnings(const Show& show);

// Returns a warning for each title
// - that no frame shows, because it begins and ends between two,
// - that has only invisible characters,
// - whose font the machine does not have,
// - with letters that no font of this machine has,
// - whose middle is not in the picture when it appears,
// - whose capitals are lower than 2 pixels there, or
// - which is so long that it runs into itself.
//
// Throws as title_letters does.
std::vector<ShowWarning> title_warnings(const Show& show);

}  // namespace domefall
