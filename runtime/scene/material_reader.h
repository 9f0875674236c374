// Reads materials. Knows nothing of the surfaces that wear them.
#pragma once
#include "scene/read_context.h"

namespace stokes {

/// An inline material, or the name of one.
MaterialPtr read_material(ReadContext& context, const JsonNode& node);
/// The entries of the top-level `materials`.
void read_named_materials(ReadContext& context, const JsonNode& list);

/// What a surface's `dyes`, or a fluorescent material itself, says of one dye. `medium`: its absorption is a coefficient.
DyeDescription read_dye(ReadContext& context, const JsonObject& o, bool medium);
/// An array of dyes.
std::vector<DyeDescription> read_dyes(ReadContext& context, const JsonNode& list, bool medium);

/// A measured reradiation matrix: a CSV with incoming nm in its first row and outgoing nm in its first column, or a bispectral EXR.
std::shared_ptr<const ReradiationMatrix> read_reradiation_file(const JsonNode& node, const std::string& path);

}  // namespace stokes
