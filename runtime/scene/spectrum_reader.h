// Reads the forms of a spectrum. Knows nothing of where a spectrum stands, beyond its role and the range its values must keep.
#pragma once
#include "scene/read_context.h"

namespace stokes {

/// Any form of spectrum, or the name of one. Every value of it must lie in `range`, where it is used (280 to 780 nm and at every
/// sample); numbers of emission and of the rest alike. Throws SceneError.
SpectrumPtr read_spectrum(ReadContext& context, const JsonNode& node, SpectrumRole role, const Range& range);

/// True when `node` is an object whose type is that of a spectrum.
bool is_spectrum_type(const std::string& canonical_type);
/// The types of spectra, as the format spells them.
const std::vector<std::string>& spectrum_types();

/// The entries of the top-level `spectra`.
void read_named_spectra(ReadContext& context, const JsonNode& list);

SpectrumPtr make_number_spectrum(double value, const std::string& pointer);

/// The curve at `lambda` as its description says, without colour: illuminants and blackbodies count as 1, an [r,g,b] as its
/// largest component. Good for checking ranges, not for rendering.
double plain_value(const Spectrum& s, SpectrumRole role, double lambda);

/// The two columns of a CSV file: nm and value. `#` comments and one header line are allowed. Throws SceneError at `node`.
std::pair<std::vector<double>, std::vector<double>> read_spectrum_file(const JsonNode& node, const std::string& path,
                                                                       const InputLimits& limits);

}  // namespace stokes
