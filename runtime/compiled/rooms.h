// Rooms: quads that are faces of one box along the axes, which rays are tested against together. Knows quads, not what they are made of.
#pragma once
#include <vector>

#include "layout.h"

namespace stokes::compiled {

/// The boxes along the axes that have at least three of the first kMaxAnalyticQuads quads for faces; at most SCENE_ROOMS, those with most faces
/// first. A quad is a face of one room at most. It must fill its side of the box but for a millionth; its own plane is the box's. Quads that
/// lie in the plane of another and touch it are no faces, so that which of the two is seen stays settled.
std::vector<layout::Room> find_rooms(const std::vector<layout::Quad>& quads);

}  // namespace stokes::compiled
