// One finger or the thumb of the procedural hand, as one swept form.
#pragma once
#include "mesh/hand_skeleton.h"

namespace stokes {

/// A cross-section of a digit that lies straight: half width, and heights over the axis to the back's and the palm's side, in mm.
struct Section {
  double y, width, back, palm;
};

class HandDigit {
 public:
  HandDigit(const Digit& digit, const FingerShape& shape);
  HandDigit(const Digit& digit, const ThumbShape& shape);
  /// The distance to the digit's skin, its nail and creases included.
  double operator()(Vec3d p) const;
  const Digit& bones() const { return digit_; }

 private:
  Section section(double y) const;
  double bone(int i, Vec3d q) const;
  double nail(double d, Vec3d q) const;
  double creases(double d, Vec3d p, Vec3d q0) const;

  Digit digit_;
  std::vector<Section> sections_;   // by rising y
  std::array<double, 4> begins_;    // y of each bone's joint and of the end
  double tip_, nail_width_, nail_length_;
  bool thumb_;
};

}  // namespace stokes
