// The exception of scenes that are sound but too large for the machine.
#pragma once
#include "scene/error.h"

namespace stokes {

/// A scene asks for more memory than there is or than is allowed: need and have are in the message.
class SceneMemoryError : public SceneError {
 public:
  using SceneError::SceneError;
};

}  // namespace stokes
