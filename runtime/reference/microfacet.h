// The isotropic GGX distribution with Smith's height-correlated shadowing, in a frame whose z is the normal. Knows nothing of Fresnel.
#pragma once
#include "math/vec.h"

namespace stokes::reference {

/// Density of microfacet normals h (Walter et al. 2007, Trowbridge & Reitz 1975).
double ggx_d(Vec3d h, double alpha);
/// The fraction of microfacets visible from v (Smith).
double ggx_g1(Vec3d v, double alpha);
/// Visible from both, height-correlated (Heitz 2014); the directions may be on different sides.
double ggx_g2(Vec3d v, Vec3d w, double alpha);
/// Density of ggx_sample_visible: D G1 max(0, v.h) / |v.z|; v.z > 0.
double ggx_visible_pdf(Vec3d v, Vec3d h, double alpha);
/// A microfacet normal among those visible from v (Heitz 2018); v.z > 0.
Vec3d ggx_sample_visible(Vec3d v, double alpha, double u1, double u2);

}  // namespace stokes::reference
