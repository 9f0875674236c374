// Small scenes for parity with few features each, so that their kernels build quickly.
#pragma once
#include <map>
#include <string>

#include "scene/description.h"

namespace stokes::tests {

struct ParityScene {
  SceneDescription scene;
  int samples = 256;
};

/// By name.
std::map<std::string, ParityScene> parity_scenes();

}  // namespace stokes::tests
