// Which media light enters by refraction alone: integrators need not look for light from inside them.
#include <algorithm>
#include <numeric>

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

/// Media between which light goes straight, because only index-matched boundaries part them, are one enclosure; each names its first.
class Enclosures {
 public:
  explicit Enclosures(std::size_t media) : first_(media) { std::iota(first_.begin(), first_.end(), 0u); }
  std::uint32_t of(std::uint32_t medium) const {
    while (first_[medium] != medium) medium = first_[medium];
    return medium;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    const std::uint32_t first = of(a), other = of(b);
    first_[std::max(first, other)] = std::min(first, other);
  }

 private:
  std::vector<std::uint32_t> first_;
};

}  // namespace

void seal_media(Compilation& c) {
  const std::size_t count = c.out.media.size();
  Enclosures enclosures(count);
  std::vector<Boundary> boundaries;
  for (const layout::Surface& s : c.out.surfaces) {
    Boundary b;
    look_at(c, s.material, b);
    if (b.open) enclosures.join(s.medium_outside, s.medium_inside);
    boundaries.push_back(b);
  }
  // Light reaches an enclosure straight in which the camera stands, which is the vacuum around everything, or into which something shines.
  std::vector<bool> lit(count), refracts(count);
  lit[enclosures.of(0)] = true;
  lit[enclosures.of(c.out.header.camera.medium)] = true;
  for (std::size_t i = 0; i < boundaries.size(); i++) {
    const layout::Surface& s = c.out.surfaces[i];
    if (s.emission != STOKES_NONE) lit[enclosures.of(s.medium_outside)] = true;  // it shines from its front side
    if (boundaries[i].refracts) refracts[enclosures.of(s.medium_outside)] = refracts[enclosures.of(s.medium_inside)] = true;
  }
  for (std::uint32_t i = 1; i < count; i++)
    if (refracts[enclosures.of(i)] && !lit[enclosures.of(i)]) c.out.media[i].flags |= MEDIUM_SEALED;
}

}  // namespace stokes::compiled
