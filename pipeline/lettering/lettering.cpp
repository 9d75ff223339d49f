#include "pipeline/lettering/lettering.h"

namespace domefall {

// The library stays for good, since fontconfig keeps what it has read of the machine's fonts.
const Lettering& lettering() {
  static const auto& loaded = late_library<Lettering>("domefall_pango_lettering", "writes text");
  return loaded;
}

}  // namespace domefall
