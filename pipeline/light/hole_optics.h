// HoleOptics hold all that light does between where it starts and the frame of free fall at one
// radius.  Frames of equal r share one.  Aberration, camera and projection stay outside.
//
// Within this package skies are named from the observer's side.  The home sky is the own sky of the
// reference tetrad (own_sky), and the far sky is the other one, which is seen inside the horizon.
// All others name a sky by its region.
#pragma once

#include <array>
#include <optional>

#include "pipeline/light/emission_time_table.h"
#include "pipeline/light/lens.h"
#include "pipeline/light/sky_table.h"
#include "pipeline/light/white_hole_table.h"
#include "pipeline/spacetime/regions.h"

namespace domefall {

struct HoleOptics {
  Radius at = kFlatSpace;
  Tetrad tetrad = Tetrad::kRain;
  int table_bits = OctaveCurve::kPerOctaveBits;  // of tables to be made; see OctaveCurve
  // Here the skies end, whether they are wanted or not.  Beyond both is light of the white hole.
  std::optional<SkyEdge> home_edge, far_edge;
  std::optional<SkyTable> home_sky, far_sky;
  std::optional<WhiteHoleTable> white_hole;
  std::optional<EmissionTimeTable> emission_times;

  // Returns the skies of regions I and III, with the home sky first.
  std::array<SkyRegion, 2> skies() const {
    const SkyRegion home = own_sky(tetrad);
    return {home, home == SkyRegion::kI ? SkyRegion::kIII : SkyRegion::kI};
  }
  // Returns the edge of the sky of region I or III, or null where it is not seen or space is flat.
  const SkyEdge* edge_of(SkyRegion sky) const {
    const auto& edge = sky == own_sky(tetrad) ? home_edge : far_edge;
    return edge && sky != SkyRegion::kIV ? &*edge : nullptr;
  }
  // Returns the table of such a sky, or null where there is no edge or no table was made.
  const SkyTable* table_of(SkyRegion sky) const {
    const auto& table = sky == own_sky(tetrad) ? home_sky : far_sky;
    return table && sky != SkyRegion::kIV ? &*table : nullptr;
  }
};

// Makes the optics at a radius.  For r = kFlatSpace there is no table at all.  The home sky is
// there for rain at any r and for the outgoing tetrad outside, the far sky for rain at r < 2, and
// the white hole always.  What is not there is not made.
HoleOptics make_hole_optics(const Radius& at, Tetrad tetrad, WantedSkies wanted);
// Says whether a wanted table is not there, though it may be none that can be made.
bool lacks_tables(const HoleOptics& optics, const WantedSkies& wanted);
// Makes the wanted tables that `optics` does not have yet.
void add_tables(HoleOptics& optics, WantedSkies wanted);

// These say how many tables there are, and how many nodes they have together.
int table_count(const HoleOptics& optics);
std::size_t node_count(const HoleOptics& optics);

// Returns the k-th image of the point `source`, a unit vector with components along R, Theta and
// Phi.  k = 0 is the primary image, and those of odd k lie on the opposite side of the hole.  The
// swept azimuth is phi* + k pi for even k and (k+1) pi - phi* for odd k.  `axis_blur` (radians, >
// 0) is the angular radius of the source, which bounds the amplification where the source, the hole
// and the observer are in line.  In flat space there is k = 0 only.
SkyImage image_of(const SkyTable* table, const V3d& source, int order, double axis_blur);

// WhiteHoleImages are the images of the same order of a point of the past singularity, of which
// there may be two, one or none.  Their frequency_ratio is 1, because light from there has no
// redshift to speak of.  axis_blur also bounds the amplification on the caustic, where two images
// merge.
struct WhiteHoleImages {
  int count = 0;
  std::array<SkyImage, 2> image;
};
WhiteHoleImages images_of(const WhiteHoleTable& table, const V3d& source, int order,
                          double axis_blur);

// Returns the primary image, in the frame of the tetrad, of a direction on the home sky, without
// making a table.  It serves to aim a camera and is exact to 1e-14.  It is not for the outgoing
// tetrad at r <= 2, in region IV, from where no sky is seen.
TetradDirection primary_image(double r, Tetrad tetrad, const V3d& source);

}  // namespace domefall
