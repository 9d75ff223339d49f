// Computes the V of images of stars and bodies, as a photometer beside the observer would measure
// it.
#pragma once

#include "pipeline/show/show.h"

namespace domefall {

// Returns bolometric_flux_at_v_zero(T) from a table.  The measured relative error is below 4e-5
// from 1000 K on.
double flux_of_v_zero(double temperature);

// Returns the V of an image.  The star has V = `v` and `temperature` at rest, and its image has
// `brightening` times its bolometric flux and a frequency ratio of g.  It is that of a blackbody of
// the temperature that is seen, so that a star at rest with the V and the temperature of the image
// has the same pixels.  It is infinite for an image without light.
double seen_magnitude(const Effects& effects, double v, double temperature, double brightening,
                      double g);

}  // namespace domefall
