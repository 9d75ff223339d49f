// A dome throws light upon itself, which lifts its blacks.  This light is simulated for a screen,
// or taken away for the dome.
//
// Let the dome be half a sphere of radius R over a floor that reflects nothing.  It reflects the
// part rho of the light that falls upon it, evenly in all directions.  Of the light that a patch
// sends out, the patch dA at a distance d receives the part cos a cos b dA/(pi d^2).  Two points of
// a sphere see each other at equal angles to its normals, with cos a = cos b = d/(2 R).  So this
// part is dA/(4 pi R^2) wherever the two are, and light that has bounced is the same everywhere.
// The dome has half the sphere's area, so it receives E = <B>/2 of its mean radiosity <B>, and the
// other half goes to the floor.  With B = B0 + rho E, of which B0 is the projectors' part,
//
//     <B> = <B0> + (rho/2) <B>,   so   B = B0 + k <B0>  with  k = rho/(2 - rho).
//
// All bounces together add k times the mean, taken over the dome's area.  To show B a projector
// therefore sends B0 = max(B - c, 0) with c = k <max(B - c, 0)>.  This has one solution, because
// the left side rises with c from 0 and the right side falls.
//
// All this is about light that the dome sends out, so it follows the grade.  Codes become the
// display's light, and that becomes codes again.  Before the view the sums would be of light that a
// tone curve has yet to change.  Light is linear in the channels of a display, so each channel goes
// by itself.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "pipeline/grade/grade_settings.h"
#include "pipeline/image/frame_buffer.h"

namespace domefall {

// Returns k, the part of its mean light that a dome adds everywhere, for 0 <= reflectance <= 1.
constexpr double bounced_part(double reflectance) { return reflectance / (2 - reflectance); }

inline constexpr int kCodes = 65536;  // that 16 bits have

// DomeCodes say what part of a dome has which code, for each channel.  They are a histogram by area
// on the dome.  Areas are whole numbers, so that sums do not depend on their order.
class DomeCodes {
 public:
  // Adds the rows y0 <= y < y1 of a domemaster, inside its circle.  Nothing is defined for a frame
  // that is not square.
  void add_rows(const GradedFrame& frame, int y0, int y1);
  void add(const DomeCodes& other);

  // Returns the area with that code of the channel, and that of all codes, in one unit.
  std::uint64_t area(int channel, int code) const { return areas_[index(channel, code)]; }
  std::uint64_t whole() const { return whole_; }

 private:
  static std::size_t index(int channel, int code) {
    return static_cast<std::size_t>(channel) * kCodes + static_cast<std::size_t>(code);
  }
  std::vector<std::uint64_t> areas_ = std::vector<std::uint64_t>(std::size_t{3} * kCodes);
  std::uint64_t whole_ = 0;
};

// A CodeMap says what becomes of each code of each channel.
struct CodeMap {
  std::array<std::vector<unsigned short>, 3> codes;  // of kCodes each

  // Changes pixels of three channels.
  void change(unsigned short* rgb, std::ptrdiff_t pixels) const;
  // Changes the rows y0 <= y < y1 of a domemaster, inside its circle.
  void change_rows(GradedFrame& frame, int y0, int y1) const;
};

class DomeLight {
 public:
  // This is the light of each of the kCodes codes, for each channel, strictly ascending and in any
  // unit.
  using Curves = std::array<std::vector<double>, 3>;

  // `settings` says what to do, which is not kNone.
  DomeLight(const DomeSettings& settings, Curves curves);

  // Returns what becomes of a picture that the dome's audience sees while its codes are those.
  // Light above white is cut, and compensation never goes below black.  This takes 2 ms.
  CodeMap map_for(const DomeCodes& dome) const;

  // Returns the light that is added to each channel, or taken away if it is negative, in the
  // curves' unit.
  std::array<double, 3> change_for(const DomeCodes& dome) const;

 private:
  DomeSettings settings_;
  Curves curves_;
};

}  // namespace domefall
