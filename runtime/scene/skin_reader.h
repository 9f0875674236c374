// The skin preset: a material that stands for two layers. Knows the layers' optics from spectral/skin.h; nothing of how light moves in them.
#pragma once
#include "scene/read_context.h"

namespace stokes {

/// The keys of a material of type `skin`, beside type and name.
const std::vector<std::string>& skin_keys();

/// Reads a material of type `skin`: the dielectric that light meets first, with the layers below it in `m.skin`. Coefficients are stored
/// per millimetre.
void read_skin(ReadContext& context, const JsonObject& o, MaterialDescription& m);

/// Replaces every surface of skin by its two boundaries: itself, with the epidermis inside, and an interface as deep below it as the epidermis
/// is thick, with the epidermis outside and the dermis inside. Below a quad or a triangle the dermis is a half space, and the epidermis
/// has no sides. Throws SceneError for surfaces that have no such parallel: open meshes, ellipsoids, balls thinner than the layer.
void expand_skin(ReadContext& context);

/// Throws the SceneErrors of expand_skin that a surface shows without its mesh.
void check_skin(const ReadContext& context, const SurfaceDescription& surface);

}  // namespace stokes
