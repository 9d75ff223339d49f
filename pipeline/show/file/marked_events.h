// Markers that name events get their times while the timeline is read.
#pragma once

#include <optional>
#include <vector>

#include "pipeline/show/file/item.h"
#include "pipeline/show/show.h"

namespace domefall {

// MarkedEvents follow the segments of a show in their order.  The way is followed in steps of a
// quarter of a frame, so that two turns within one may be missed.
class MarkedEvents {
 public:
  MarkedEvents(std::vector<Marker>& markers, double frames_per_second)
      : markers_(markers), frames_per_second_(frames_per_second) {}

  // Gives their times to the markers whose events happen first in this segment, which begins at
  // that show second and is not in flat space.
  void follow(const Segment& segment, double begin_s);

  // Returns the marker that a time names, if its event has not happened yet, or null.
  Marker* coming(const Item& time) const;

 private:
  class Way;
  std::optional<double> part_at_periastron(const Way& way);

  std::vector<Marker>& markers_;
  double frames_per_second_;
  bool falls_ = false;  // r, at the end of the last segment
  double r_ = 0;        // there
};

// Returns the proper time, not before `begin`, at which an event happens.  Returns nothing if it
// never does, and for a periastron that is not known in closed form.
std::optional<ProperTime> time_of_event(const MarkerEvent& event, const Trajectory& trajectory,
                                        const ProperTime& begin);

// Reports each event that has no time after the whole timeline.  `list` is `markers`.
void report_missing_events(const Item& list, const std::vector<Marker>& markers);

}  // namespace domefall
