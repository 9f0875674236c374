// The Henyey-Greenstein phase function, by its textbook derivation in double. Knows nothing of media.
#pragma once
#include "math/vec.h"

namespace stokes::reference {

/// Per unit solid angle, for the mean cosine g in (-1, 1) and the cosine between the old and the new direction of travel, dot(-wo, wi).
double phase_hg_eval(double g, double cosine);
/// A new direction of travel for light that comes from wo (which points back); its density is phase_hg_eval.
Vec3d phase_hg_sample(double g, Vec3d wo, double u1, double u2);

}  // namespace stokes::reference
