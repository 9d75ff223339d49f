// An ObservedShow is a fixture for shows that are a timeline near a hole, and for what their
// observers do.
#pragma once

#include <string>

#include "pipeline/show/frame_state.h"
#include "pipeline/show/observer_track.h"
#include "tests/pipeline/show/show_file.h"

namespace domefall {

class ObservedShow : public ShowFile {
 protected:
  Show show(const std::string& segments, const std::string& more = "") {
    return read("black_hole: {mass_solar: 4e6}\n" + more + "timeline:\n" + segments);
  }
  // The proper time per second of show at an instant.
  static double rate_at(const Show& s, double t) {
    const double h = 1e-5;
    const int k = segment_at(s, t);
    const auto tau = [&](double at) { return observer_at(s, k, part_at(s, k, at)).proper_time; };
    return (tau(t + h) - tau(t - h)) / (2 * h);
  }
  static ObserverState at(const Show& s, double t) {
    const int k = segment_at(s, t);
    return observer_at(s, k, part_at(s, k, t));
  }
};

}  // namespace domefall
