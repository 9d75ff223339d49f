// The curves of [Riazuelo]'s figures, from the tables that frames are rendered with.
#pragma once

#include <vector>

#include "pipeline/report/plot.h"

namespace domefall {

// fig_dev, dev_III, dev_wh_0, dev_wh, fig_IV_dev: deviation functions phi_infinity(delta), with
// delta from 0 to 2 pi and [Riazuelo]'s sign: phi_infinity = delta - pi in flat space, so minus the
// swept azimuth for delta < pi, and odd about pi.  fig_IV_dev has the sign of L, as there.
// fig_delta_ee: what is seen at which angle from the front, against r.
std::vector<NamedPlot> paper_curves();

}  // namespace domefall
