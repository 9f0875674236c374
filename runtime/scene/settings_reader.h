// Reads what is neither made of anything nor anywhere: camera, sampler, integrator, background, film.
#pragma once
#include "scene/read_context.h"

namespace stokes {

CameraDescription read_camera(ReadContext& context, const JsonNode& node);
void read_sampler(ReadContext& context, const JsonNode& node);
IntegratorDescription read_integrator(const JsonNode& node);
BackgroundDescription read_background(ReadContext& context, const JsonNode& node);
void read_film(ReadContext& context, const JsonNode& node);

}  // namespace stokes
