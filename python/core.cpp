// The module stokes._core: renders, comparisons and devices for the Python package, whose face is python/stokes. Knows no numpy beyond
// arrays' memory; spelling, grouping and types of results are Python's.
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <atomic>
#include <cmath>
#include <filesystem>
#include <future>

#include "cli/commands.h"
#include "cli/outputs.h"
#include "cli/scene_options.h"
#include "cli/scene_text.h"
#include "cli/version.h"
#include "device/error.h"
#include "image/error.h"
#include "image/image_file.h"
#include "image/parity.h"
#include "scene/memory_error.h"

namespace nb = nanobind;
using namespace nb::literals;

namespace stokes {
namespace {

/// A scene file, or a scene's text with the folder that its files are in.
struct SceneSource {
  std::optional<std::string> text;
  std::string path, directory;
};

struct Request {
  SceneSource scene;
  SceneOptions options;
  AovChoice aovs;
  SpectralBins bins;
};

struct Picture {
  Image image;
  std::string device;
  std::uint64_t invalid = 0;
  int samples = 0;
  double load_seconds = 0, build_seconds = 0, render_seconds = 0;
  std::vector<std::string> warnings;
};

/// What a computation on another thread shares with the one that waits for it.
struct Watch {
  std::atomic<bool> stop = false;
  std::atomic<double> done = 0;  ///< fraction
};

/// Runs `work(watch)` on a thread of its own without the GIL. Meanwhile Python's signal handlers run, so that Ctrl-C raises
/// KeyboardInterrupt, and `progress`, unless None, is called with the fraction done; either's exception stops the work and is rethrown.
template <class Work>
auto run_watched(Work work, nb::object progress) {
  Watch watch;
  auto future = std::async(std::launch::async, [&] { return work(watch); });
  std::optional<nb::python_error> raised;
  const auto wait = [&] {
    nb::gil_scoped_release release;
    return future.wait_for(std::chrono::milliseconds(20)) == std::future_status::ready;
  };
  while (!wait()) {
    if (raised) continue;
    try {
      if (PyErr_CheckSignals() != 0) throw nb::python_error();
      if (!progress.is_none()) progress(watch.done.load());
    } catch (nb::python_error& error) {
      watch.stop = true;
      raised.emplace(std::move(error));
    }
  }
  if (raised) throw std::move(*raised);
  return future.get();
}

class Stopped : public std::exception {};

LoadedScene load(const Request& r) {
  if (r.scene.text) return load_scene_text(*r.scene.text, r.scene.path, r.scene.directory, r.options, r.aovs, r.bins);
  return load_scene(r.scene.path, r.options, r.aovs, r.bins, true);
}

/// The film of a scene with all its samples. `from` and `share` say which part of the whole work this is.
Film render_film(const LoadedScene& scene, Backend& backend, Watch& watch, double from, double share) {
  Film film = scene.empty_film(scene.whole());
  const double all = static_cast<double>(film.width) * film.height * scene.compiled.samples;
  const int end = backend.render(film, scene.compiled.seed, 0, scene.compiled.samples, [&](const BackendProgress& p) {
    watch.done = from + share * static_cast<double>(p.samples_done) / all;
    return !watch.stop;
  });
  if (end < scene.compiled.samples) throw Stopped();
  return film;
}

Picture render_picture(const Request& request, Watch& watch) {
  const LoadedScene scene = load(request);
  const auto backend = make_backend(scene.compiled, scene.device, {request.options.threads, request.options.kernel_dir});
  const auto start = std::chrono::steady_clock::now();
  FilmRecord record;
  record.film = render_film(scene, *backend, watch, 0, 1);
  record.render_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const std::string& integrator = scene.description.integrator.name;
  record.identity = {program_version(), scene.hash, std::filesystem::path(scene.path).filename().string(), scene.device.name(),
                     integrator.empty() ? "path tracer mis" : integrator, scene.compiled.seed};
  record.samples_total = record.sample_end = scene.compiled.samples;
  Picture out;
  out.image = picture(record, request.aovs.variance);
  out.device = scene.device.name();
  out.invalid = film_totals(record.film).invalid;
  out.samples = scene.compiled.samples;
  out.load_seconds = scene.load_seconds;
  out.build_seconds = backend->build_seconds();
  out.render_seconds = record.render_seconds;
  out.warnings = scene.compiled.warnings;
  for (const std::string& warning : backend->warnings()) out.warnings.push_back(warning);
  return out;
}

struct Comparison {
  ParityResult result;
  std::string device;
};

Comparison compare(Request request, const ParityOptions& options, Watch& watch) {
  const std::string device = request.options.device;
  const auto film = [&](const std::string& where, double from, std::string& name) {
    request.options.device = where;
    const LoadedScene scene = load(request);
    if (scene.compiled.samples < 2) throw UsageError("--spp: parity needs at least 2 samples per pixel, to know the noise");
    name = scene.device.name();
    const auto backend = make_backend(scene.compiled, scene.device, {request.options.threads, request.options.kernel_dir});
    return render_film(scene, *backend, watch, from, 0.5);
  };
  Comparison comparison;
  std::string reference;
  const Film truth = film("reference", 0, reference);
  comparison.result = test_parity(estimate_of(film(device, 0.5, comparison.device)), estimate_of(truth), options);
  return comparison;
}

// What Python says of a render, as the command line's options.
Request make_request(std::optional<std::string> text, std::string path, std::string directory, const nb::dict& o) {
  Request r;
  r.scene = {std::move(text), std::move(path), std::move(directory)};
  // A dict is the caller's own: whoever writes a file's name into it means it.
  r.options.allow_outside = r.scene.text.has_value() || nb::cast<bool>(o["allow_outside"]);
  const auto given = [&](const char* key) { return o.contains(key) && !nb::object(o[key]).is_none(); };
  if (given("device")) r.options.device = nb::cast<std::string>(o["device"]);
  if (given("spp")) r.options.samples = nb::cast<int>(o["spp"]);
  if (given("seed")) r.options.seed = nb::cast<std::uint32_t>(o["seed"]);
  if (given("size")) r.options.size = nb::cast<std::string>(o["size"]);
  if (given("integrator")) r.options.integrator = nb::cast<std::string>(o["integrator"]);
  if (given("mode")) r.options.mode = nb::cast<std::string>(o["mode"]);
  if (given("wavelengths_per_path")) r.options.wavelengths_per_path = nb::cast<int>(o["wavelengths_per_path"]);
  if (given("threads")) r.options.threads = nb::cast<int>(o["threads"]);
  if (given("overrides")) r.options.settings = nb::cast<std::vector<std::string>>(o["overrides"]);
  if (given("aov")) r.aovs = parse_aovs(nb::cast<std::string>(o["aov"]));
  if (given("spectral")) r.bins = parse_spectral(nb::cast<std::string>(o["spectral"]));
  return r;
}

nb::dict channels_of(const Picture& p) {
  nb::dict channels;
  for (const Image::Channel& channel : p.image.channels) {
    auto* values = new std::vector<float>(channel.values);
    nb::capsule owner(values, [](void* v) noexcept { delete static_cast<std::vector<float>*>(v); });
    const std::size_t shape[2] = {static_cast<std::size_t>(p.image.height), static_cast<std::size_t>(p.image.width)};
    channels[channel.name.c_str()] = nb::ndarray<nb::numpy, float, nb::ndim<2>>(values->data(), 2, shape, owner);
  }
  return channels;
}

nb::dict to_dict(const ParityTest& t) {
  nb::dict d;
  d["channel"] = t.channel, d["x"] = t.x, d["y"] = t.y, d["width"] = t.width, d["height"] = t.height;
  d["device"] = t.mean_a, d["reference"] = t.mean_b, d["z"] = t.z, d["p"] = t.p;
  return d;
}

nb::dict to_dict(const Comparison& c) {
  nb::list means, rejected;
  for (const ParityTest& t : c.result.means) means.append(to_dict(t));
  for (const ParityTest& t : c.result.rejected) rejected.append(to_dict(t));
  nb::dict d;
  d["agree"] = c.result.agree, d["device"] = c.device, d["tests"] = c.result.tests, d["block"] = c.result.block;
  d["largest_z"] = std::fabs(c.result.worst.z), d["threshold_z"] = c.result.threshold, d["p"] = c.result.p;
  d["means"] = means, d["rejected"] = rejected, d["report"] = describe(c.result);
  return d;
}

nb::list devices() {
  std::string best;
  try {
    const DeviceInfo d = choose_device("auto");
    best = std::to_string(d.platform) + ":" + std::to_string(d.device);
  } catch (const DeviceError&) {
    // The list says which devices are not usable, and why.
  }
  nb::list list;
  for (const DeviceInfo& i : list_devices()) {
    nb::dict d;
    const std::string id = std::to_string(i.platform) + ":" + std::to_string(i.device);
    d["id"] = id, d["name"] = i.name, d["platform"] = i.platform_name, d["type"] = i.type, d["vendor"] = i.vendor;
    d["version"] = i.version, d["driver"] = i.driver, d["compute_units"] = i.compute_units, d["memory_bytes"] = i.memory_bytes;
    d["usable"] = i.usable, d["why_not"] = i.why_not, d["auto"] = id == best;
    list.append(d);
  }
  return list;
}

// An instance of a class of stokes._errors becomes the current exception.
template <class... Arguments>
void raise(const char* name, const Arguments&... arguments) {
  const nb::object type = nb::module_::import_("stokes._errors").attr(name);
  PyErr_SetObject(type.ptr(), type(arguments...).ptr());
}

void translate(const std::exception_ptr& pointer, void*) {
  try {
    std::rethrow_exception(pointer);
  } catch (const SceneMemoryError& e) {
    PyErr_SetString(PyExc_MemoryError, e.what());
  } catch (const SceneError& e) {
    raise("SceneError", std::string(e.what()));
  } catch (const KernelBuildError& e) {
    raise("DeviceError", std::string(e.what()) + "\n" + e.log());
  } catch (const DeviceError& e) {
    if (e.out_of_memory())
      PyErr_SetString(PyExc_MemoryError, e.what());
    else
      raise("DeviceError", std::string(e.what()));
  } catch (const UsageError& e) {
    const std::string text = e.what();
    PyErr_SetString(PyExc_ValueError, text.starts_with("--") ? text.c_str() + 2 : text.c_str());
  } catch (const OutOfMemory& e) {
    PyErr_SetString(PyExc_MemoryError, e.what());
  } catch (const OutputError& e) {
    PyErr_SetString(PyExc_OSError, e.what());
  } catch (const InputError& e) {
    PyErr_SetString(PyExc_ValueError, e.what());
  }
}

}  // namespace

}  // namespace stokes

NB_MODULE(_core, m) {
  using namespace stokes;
  nb::register_exception_translator(translate);
  nb::class_<Picture>(m, "Picture")
      .def_ro("device", &Picture::device)
      .def_ro("invalid", &Picture::invalid)
      .def_ro("samples", &Picture::samples)
      .def_ro("load_seconds", &Picture::load_seconds)
      .def_ro("build_seconds", &Picture::build_seconds)
      .def_ro("render_seconds", &Picture::render_seconds)
      .def_ro("warnings", &Picture::warnings)
      .def("channels", &channels_of)
      .def("metadata",
           [](const Picture& p) {
             nb::dict d;
             for (const auto& [name, value] : p.image.metadata) d[name.c_str()] = value;
             return d;
           })
      .def("write_exr", [](const Picture& p, const std::string& path) { write_exr(path, p.image); })
      .def("write_png", [](const Picture& p, const std::string& path, double exposure) { write_png(path, p.image, exposure); });
  m.def("render",
        [](std::optional<std::string> text, std::string path, std::string directory, const nb::dict& options, nb::object progress) {
          const Request request = make_request(std::move(text), std::move(path), std::move(directory), options);
          return run_watched([&](Watch& watch) { return render_picture(request, watch); }, std::move(progress));
        },
        "text"_a.none(), "path"_a, "directory"_a, "options"_a, "progress"_a.none());
  m.def("parity",
        [](std::optional<std::string> text, std::string path, std::string directory, const nb::dict& options, double alpha, int block,
           nb::object progress) {
          const Request request = make_request(std::move(text), std::move(path), std::move(directory), options);
          ParityOptions parity;
          parity.alpha = alpha;
          parity.block = block;
          return to_dict(run_watched([&](Watch& watch) { return compare(request, parity, watch); }, std::move(progress)));
        },
        "text"_a.none(), "path"_a, "directory"_a, "options"_a, "alpha"_a, "block"_a, "progress"_a.none());
  m.def("devices", &devices);
  m.def("version", [] { return program_version(); });
}
