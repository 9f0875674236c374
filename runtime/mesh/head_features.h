// The features of the procedural head: nose, lips, closed eyes, ears, and masks for what is coloured differently. Points are in the
// head's frame (see head.h); m is the point with |x| in place of x.
#pragma once
#include "mesh/field.h"

namespace stokes {

struct HeadFeatures {
  double nose(double d, Vec3d p, Vec3d m) const;
  double lips(double d, Vec3d p, Vec3d m) const;
  double eyes(double d, Vec3d m) const;
  double ear(Vec3d m) const;

  // Splines, resampled once.
  sdf::Tube dorsum{{{0, 8, 80, 6.5}, {0, -5, 85, 6.3}, {0, -21, 95, 7.6}, {0, -35.8, 102.2, 8.5}}, 7};
  sdf::Rotation ala = sdf::rotation(-8, -22, -14), nostril = sdf::rotation(18, 0, 20);
  sdf::Tube upper_lip{{{0, -66.1, 100.8, 7.0}, {7, -65.5, 100.1, 7.1}, {16, -67.5, 95.2, 5.8}, {26.5, -73, 85.2, 2.4}}, 26};
  sdf::Tube lower_lip{{{0, -78.8, 96.4, 7.6}, {8, -79.1, 96.2, 7.9}, {17, -77.4, 92, 6.2}, {26.5, -73.6, 84.8, 2.0}}, 26};
  sdf::Tube lip_seat{{{0, -72, 110, 3}, {14, -72, 106, 3}, {21.5, -73, 97, 0.8}}, 16};
  sdf::Curve2 mouth_line{{{0, -72.9}, {6, -72.1}, {14, -72.6}, {26.5, -73.6}, {28.5, -74.2}}, 10};
  sdf::Tube lid_fold{{{17, 9, 77, 5}, {26, 12, 81.5, 5.5}, {36, 12, 79, 5.5}, {48, 7, 68, 5.5}}, 6};
  sdf::Tube lid_margin = make_lid_margin();
  sdf::Curve2 lash_line{{{15.5, -4.4}, {23.5, -9.0}, {32.5, -10.9}, {41.5, -8.8}, {49.5, -3.2}}, 10};
  sdf::Curve2 lid_crease{{{18.5, 3.0}, {25.5, 6.4}, {32.5, 7.6}, {41.5, 6.8}, {50.5, 3.2}}, 10};
  sdf::Curve2 lower_crease{{{18.5, -11.5}, {27.5, -17.5}, {37.5, -18}, {46.5, -13.5}}, 8};
  sdf::Tube antihelix{{{11, -8, 3.0, 2.4}, {12, 1, 3.4, 2.5}, {9.5, 10, 3.2, 2.4}, {5, 19, 2.4, 1.8}}, 6};
  sdf::Tube crus{{{11, 6, 3.2, 2.0}, {4, 9, 2.6, 1.8}, {-4, 8.5, 1.6, 1.5}}, 4};
  sdf::Tube antitragus{{{11, -8, 3.0, 2.4}, {8, -14, 3.2, 2.4}, {3, -17.5, 3.4, 2.6}, {-1, -17.5, 2.6, 2.2}}, 4};
  sdf::Tube helix = make_helix(false), helix_wall = make_helix(true);
  sdf::Rotation plate = sdf::rotation(0, 0, -6), lobule = sdf::rotation(0, 0, 12), concha = sdf::rotation(0, 0, -10), tragus = sdf::rotation(0, -20, 8);

 private:
  static sdf::Tube make_lid_margin();
  static sdf::Tube make_helix(bool wall);
};

/// Coloured parts, 0 to 1, at a point of the head's frame.
double lip_mask(Vec3d p);
double lash_mask(Vec3d p);
double brow_mask(Vec3d p);

}  // namespace stokes
