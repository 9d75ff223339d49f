// paper_curves() draws the curves of [Riazuelo]'s figures from the tables that frames are rendered
// with.
#pragma once

#include <vector>

#include "pipeline/report/plot.h"

namespace domefall {

// Each plot is named by the LaTeX label of its figure.  fig_dev, dev_III, dev_wh_0 and dev_wh show
// the deviation function phi_infinity(delta) for delta from 0 to 2 pi.  It has the paper's sign: in
// flat space phi_infinity = delta - pi.  So the function is minus the swept azimuth for delta < pi,
// and it is odd about pi.  fig_IV_dev shows the swept azimuth with the sign of L, as the paper
// does.  fig_delta_ee shows which sky is seen at which angle from the front, against r.
std::vector<NamedPlot> paper_curves();

}  // namespace domefall
