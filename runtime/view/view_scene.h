// A scene that can be rendered piece by piece from any side: what a session works with. Who reads files and owns devices implements it.
#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "compiled/compiled_scene.h"
#include "image/film_file.h"

namespace stokes {

class ViewScene {
 public:
  virtual ~ViewScene() = default;
  virtual const CompiledScene& compiled() const = 0;
  /// The camera as the scene file and the options give it.
  virtual const CameraDescription& camera() const = 0;
  virtual std::string hash() const = 0;
  virtual std::string device() const = 0;
  /// The scene file and all files that it names.
  virtual std::vector<std::string> files() const = 0;
  virtual std::vector<std::string> warnings() const = 0;
  /// What rendering needs besides the scene (kernels); may take long, returns its seconds. Called once, before look and render.
  virtual double prepare() = 0;
  /// From now on the scene is seen by this camera.
  virtual void look(const CameraDescription& camera) = 0;
  /// No samples yet, of the present camera; with what an output says about where it came from.
  virtual FilmRecord empty_record() const = 0;
  /// Adds whole passes of the samples [begin, end) to the film; `go_on` gets the pixel samples of this call and returns false to stop.
  /// Returns the end of the samples done.
  virtual int render(Film& film, int begin, int end, const std::function<bool(std::uint64_t)>& go_on) = 0;
};

/// Reads and compiles the scene as its files are now. Throws SceneError and others.
using ViewSceneLoader = std::function<std::unique_ptr<ViewScene>()>;

}  // namespace stokes
