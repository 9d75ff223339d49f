// HoleOptics hold all that light does in a static, spherical space between where it starts and a
// frame that is in radial motion at one place.  Frames of equal r share one.  Aberration, camera and
// projection stay outside.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "pipeline/light/emission_time_table.h"
#include "pipeline/light/lens.h"
#include "pipeline/light/schwarzschild_zone.h"
#include "pipeline/light/white_hole_table.h"
#include "pipeline/spacetime/regions.h"

namespace domefall {

// A SkyPart is a part of the view in which a sky is seen, with its table if that sky is wanted.
struct SkyPart {
  SkyRegion sky;
  SkyZone zone;
  std::optional<SkyTable> table;
};

struct HoleOptics {
  Radius at = kFlatSpace;
  Tetrad tetrad = Tetrad::kRain;
  int table_bits = OctaveCurve::kPerOctaveBits;  // of tables to be made; see OctaveCurve
  ViewEnergy energy;                             // that of every zone
  double inward = 1;                             // that of every zone
  // These are at most two zones, whether their skies are wanted or not, that of the tetrad's own sky
  // first.  Both may be of one sky.  Beyond both is light of the white hole, or none.
  std::vector<SkyPart> parts;
  std::optional<WhiteHoleTable> white_hole;
  std::optional<EmissionTimeTable> emission_times;

  // Returns the tables of a sky, which are none where it is not seen or no table was made.
  std::vector<const SkyTable*> tables_of(SkyRegion sky) const;
  // Returns the first one, or null.
  const SkyTable* table_of(SkyRegion sky) const;
};

// Makes the optics at a radius of a Schwarzschild hole.  For r = kFlatSpace there is no table at
// all.  The tetrad's own sky is there for rain at any r and for the outgoing tetrad outside, the
// other one for rain at r < 2, and the white hole always.  What is not there is not made.
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
// and the observer are in line, and on a level edge.  Where no light sweeps so much, the
// amplification is 0.  In flat space there is k = 0 only.
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

// Returns the primary image, in the frame of the optics, of a direction on the own sky of the tetrad,
// without its table.  It serves to aim a camera and is exact to 1e-14.  There must be a zone.
TetradDirection primary_image(const HoleOptics& optics, const V3d& source);

}  // namespace domefall
