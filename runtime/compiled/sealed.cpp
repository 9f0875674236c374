// Which media light enters by refraction alone: integrators need not look for light from inside them.
#include "compiled/compilation.h"

namespace stokes::compiled {
namespace {

struct Boundary {
  bool open = false;       // a component is index-matched
  bool refracts = false;   // a component is a dielectric
};

void look_at(const Compilation& c, std::uint32_t material, Boundary& b) {
  const layout::Material& m = c.out.materials[material];
  b.open |= m.type == layout::MATERIAL_INTERFACE;
  b.refracts |= m.type == layout::MATERIAL_DIELECTRIC;
  if (m.type != layout::MATERIAL_BLEND) return;
  look_at(c, m.child_a, b);
  look_at(c, m.child_b, b);
}

}  // namespace

void seal_media(Compilation& c) {
  std::vector<bool> open(c.out.media.size()), refracts(c.out.media.size());
  for (const layout::Surface& s : c.out.surfaces) {
    Boundary b;
    look_at(c, s.material, b);
    for (const std::uint32_t side : {s.medium_outside, s.medium_inside}) {
      open[side] = open[side] || b.open;
      refracts[side] = refracts[side] || b.refracts;
    }
    if (s.emission != STOKES_NONE) open[s.medium_outside] = true;  // it shines from its front side
  }
  for (std::size_t i = 1; i < c.out.media.size(); i++)
    if (refracts[i] && !open[i] && c.out.header.camera.medium != i) c.out.media[i].flags |= MEDIUM_SEALED;
}

}  // namespace stokes::compiled
