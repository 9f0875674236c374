// Which medium a surface stands in that names none: Mitsuba and pbrt leave a ray's medium as it is there, ours needs its name.
#pragma once
#include "import/imported_scene.h"

namespace stokes {

/// Until the media are named, a surface says under this key which file and line it is from.
constexpr const char* kPlaceKey = "(place)";
/// The value of that key.
ImportJson place_of(const std::string& file, int line);

/// Gives every surface without "inside" and "outside" the medium around it: that of the side of the boundary which rays from it meet first, or,
/// where they meet none, `camera_medium` (with a note) or vacuum. One that stands in several media is noted. Takes the places away.
void name_media_around(ImportedScene& scene, const ImportTarget& target, const std::string& camera_medium);

}  // namespace stokes
