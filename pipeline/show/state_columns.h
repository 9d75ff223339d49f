// These columns give the state of a frame as a row of a table, for other programs.
#pragma once

#include <array>
#include <stdexcept>
#include <string_view>
#include <variant>

#include "pipeline/show/frame_state.h"

namespace domefall {

// The columns have these units and meanings:
// - r and null_time are in M.  proper_time is in M where there is a hole, and else in seconds.
// - celerity (gamma v) is against the tetrad, along R, Theta and Phi.
// - ra_deg and dec_deg are the observer's place as seen from the hole.
// - azimuth_deg was swept in the planes of the observer's orbits since the start of the show, or about
//   the axis of a hole that spins, on which it stays.
// - x, y and z are the camera's axes in the boosted (R, Theta, Phi).
// - null_time is v = t + r* where the tetrad is rain, and u = t - r* where it is outgoing; in a
//   wormhole t + l.
// - universe counts those that follow each other through a charged hole, from 0.
// - l is the place along a wormhole, 0 elsewhere.  There all lengths are in radii of the throat.
// - latitude_deg is that above the equator of a hole that spins, 0 elsewhere.
inline constexpr std::array kStateColumns{
    "frame",       "show_time_s", "segment",        "region",       "tetrad",    "r",
    "proper_time", "celerity_r",  "celerity_theta", "celerity_phi", "ra_deg",    "dec_deg",
    "azimuth_deg", "x_r",         "x_theta",        "x_phi",        "y_r",       "y_theta",
    "y_phi",       "z_r",         "z_theta",        "z_phi",        "null_time", "universe",
    "l",           "latitude_deg"};

// Returns the name of a column as it is given.  A name that no column has does not compile.
consteval std::string_view state_column(std::string_view name) {
  for (const std::string_view column : kStateColumns)
    if (column == name) return column;
  throw std::logic_error("no such column");
}

// A StateNumber is a number with the count of its digits in a text.
struct StateNumber {
  double value;
  int digits;
};

// A segment is counted from 1.  Each column holds one of the three kinds in all frames.
using StateCell = std::variant<int, const char*, StateNumber>;

// Returns the cells of a frame in the order of the columns.
std::array<StateCell, kStateColumns.size()> state_cells(const FrameState& state);

}  // namespace domefall
