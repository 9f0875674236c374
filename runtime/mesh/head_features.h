// The features of the procedural head: nose, mouth, closed eyes, ears, and masks for what is coloured differently. Points are in the
// head's frame (see head.h); m is the point with |x| in place of x. Each feature takes the field so far and returns it changed;
// depths of grooves and heights of ridges are in millimetres.
#pragma once
#include "mesh/field.h"
#include "mesh/spline_tube.h"

namespace stokes {

struct Nose {
  double operator()(double d, Vec3d p, Vec3d m) const;

  sdf::SplineTube dorsum{{0, 9, 81, 6.5}, {0, -3, 86.2, 6.0}, {0, -20, 97.6, 6.8}, {0, -34, 105, 7.6}};
  sdf::Rotation ala = sdf::rotation(-8, -24, -14), nostril = sdf::rotation(10, -24, 0);
  sdf::Curve2 alar_groove{{{108, -42}, {104.5, -37.5}, {98, -34}, {91, -35}, {86.5, -40}, {86, -47}}, 10};  // z, y
};

struct Mouth {
  double operator()(double d, Vec3d p, Vec3d m) const;

  sdf::SplineTube upper_lip{{0, -66.2, 98.2, 6.6}, {6, -65.4, 97.8, 7.0}, {14.5, -67.4, 92.8, 5.6}, {25, -72.0, 83.4, 2.0}};
  sdf::SplineTube lower_lip{{0, -78.2, 95.2, 7.2}, {8, -78.4, 94.8, 7.2}, {16, -76.6, 89.8, 5.1}, {25, -72.6, 82.8, 1.8}};
  sdf::SplineTube seat{{0, -72, 107, 3}, {13, -72.2, 103, 3}, {21, -73, 94, 0.8}};
  sdf::Curve2 line{{{0, -72.6}, {5, -71.9}, {13, -72.9}, {25, -72.4}, {28, -71.8}}, 10};
  sdf::Curve2 nasolabial{{{25, -42}, {29.5, -51}, {33.5, -61}, {35.5, -70}}, 6};
};

struct Eyes {
  double operator()(double d, Vec3d m) const;

  sdf::SplineTube fold{{18, 9, 78, 5}, {26, 12, 82, 5.5}, {36, 11.5, 80.5, 5.8}, {49, 5.5, 70, 5.8}};
  sdf::SplineTube margin = make_margin();
  sdf::Curve2 lash_line{{{16.5, -5.2}, {23.5, -9.2}, {32.5, -10.7}, {41.5, -8.6}, {49.5, -3.4}}, 10};
  sdf::Curve2 crease{{{17.5, 0}, {22, 3.6}, {31, 6.4}, {41.5, 5.2}, {51.5, -0.5}}, 10};
  sdf::Curve2 lower_crease{{{17.5, -11.5}, {25.5, -17.5}, {36.5, -18.5}, {46.5, -13.5}}, 8};

 private:
  static sdf::SplineTube make_margin();
};

struct Ear {
  /// The field of the ear alone; joined to the head by the caller.
  double operator()(Vec3d m) const;

  sdf::SplineTube antihelix{{11, -8, 3.2, 2.5}, {12, 1, 3.9, 2.6}, {9.5, 10, 3.9, 2.6}, {5, 19, 3.2, 2.2}};
  sdf::SplineTube crus{{11, 6, 3.2, 2.0}, {4, 9, 2.6, 1.8}, {-4, 8.5, 1.6, 1.5}};
  sdf::SplineTube antitragus{{11, -8, 3.0, 2.4}, {8, -14, 3.2, 2.4}, {3, -17.5, 3.4, 2.6}, {-1, -17.5, 2.6, 2.2}};
  sdf::SplineTube helix = make_helix(false), helix_wall = make_helix(true);
  sdf::Rotation plate = sdf::rotation(0, 0, -6), lobule = sdf::rotation(0, 0, 12), concha = sdf::rotation(0, 0, -10),
                tragus = sdf::rotation(0, -20, 8);

 private:
  static sdf::SplineTube make_helix(bool wall);
};

/// Coloured parts, 0 to 1, at a point of the head's frame.
double lip_mask(Vec3d p);
double lash_mask(Vec3d p);
double brow_mask(Vec3d p);

}  // namespace stokes
