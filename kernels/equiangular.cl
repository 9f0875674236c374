// Distances along a ray, drawn so that all angles under which they are seen from a place beside it are equally likely (Kulla and Fajardo 2012).
// The density falls with the inverse square of the distance from the place, as light from there does. Knows no media and no lights.
#ifndef STOKES_EQUIANGULAR_CL
#define STOKES_EQUIANGULAR_CL
#include "math.cl"

typedef struct {
  Real foot;    // where the ray is nearest to the place
  Real height;  // how far it is there
  Real angle;   // under which the whole way is seen
  Real reach;   // its length, or STOKES_FAR
} Equiangular;

/// For distances in [0, reach]. The place is taken to be a bit further off the ray, by `size2` squared, so that the density stays bounded.
STOKES_FN Equiangular equiangular_towards(Real3 origin, Real3 direction, Real3 place, Real size2, Real reach) {
  Equiangular e;
  const Real3 to = sub3(place, origin);
  e.foot = dot3(to, direction);
  const Real3 off = madd3(to, direction, -e.foot);
  e.height = sqrt_real(dot3(off, off) + size2);
  e.reach = reach;
  // The angle between the ways from the place to both ends: as a difference of two angles it would be lost where the place is far.
  const Mask endless = reach >= real(STOKES_FAR);
  const Real cosine = fma(e.height, e.height, -e.foot * (reach - e.foot));
  e.angle = atan2_real(endless ? e.height : e.height * reach, endless ? -e.foot : cosine);
  return e;
}

STOKES_FN Real equiangular_sample(const Equiangular* e, Real u) {
  Real s, c;
  sincos_real(u * e->angle, &s, &c);
  const Real across = fma(e->height, c, e->foot * s);
  const Real distance = fma(e->height, e->height, e->foot * e->foot) * s / across;
  return across > real(0.0f) ? min_real(distance, e->reach) : e->reach;
}

/// Per unit length.
STOKES_FN Real equiangular_pdf(const Equiangular* e, Real distance) {
  const Real along = distance - e->foot;
  return e->height / (e->angle * fma(e->height, e->height, along * along));
}
#endif
