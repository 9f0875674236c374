// `stokes distribute`: a render cut into parts that any engine may render, in any order and more than once, and merged to the bits of
// one render. Knows options and their order of work; the folder's contract is in distribute/.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <system_error>
#include <thread>

#include "cli/commands.h"
#include "cli/exit_codes.h"
#include "cli/outputs.h"
#include "cli/scene_options.h"
#include "cli/version.h"
#include "distribute/driver_text.h"
#include "distribute/job_folder.h"
#include "distribute/process.h"
#include "image/error.h"
#include "image/replace_file.h"

namespace stokes {
namespace {
namespace fs = std::filesystem;

struct DistributeOptions {
  std::string scene;
  SceneOptions scene_options;
  OutputOptions output;
  FilmOptions film;
  std::string folder, scheduler, worker_program;
  int workers = 0, parts = 0;
  std::optional<int> unit;
  bool plan = false, any_device = false, end_with_parent = false, quiet = false;
};

std::string absolute(const std::string& path) { return fs::absolute(path).lexically_normal().string(); }

/// The options of `stokes render` by which every part is rendered; the number of samples is that of the whole.
std::vector<std::string> render_words(const DistributeOptions& o, int samples) {
  const SceneOptions& s = o.scene_options;
  std::vector<std::string> words = {"--spp", std::to_string(samples)};
  const auto add = [&](const char* name, const std::string& value) {
    if (!value.empty()) words.insert(words.end(), {name, value});
  };
  add("--device", s.device);
  if (s.seed) add("--seed", std::to_string(*s.seed));
  add("--size", s.size);
  add("--integrator", s.integrator);
  add("--mode", s.mode);
  if (s.wavelengths_per_path) add("--wavelengths-per-path", std::to_string(*s.wavelengths_per_path));
  for (const std::string& setting : s.settings) add("--set", setting);
  if (!s.kernel_dir.empty()) add("--kernel-dir", absolute(s.kernel_dir));
  for (const std::string& limit : s.limits) add("--limit", limit);
  if (s.allow_outside) words.push_back("--allow-outside");
  add("--crop", o.film.crop);
  add("--aov", o.film.aov);
  add("--spectral", o.film.spectral);
  return words;
}

std::vector<std::string> merge_words(const DistributeOptions& o) {
  std::vector<std::string> words;
  if (o.output.png) words.push_back("--png");
  if (o.output.exposure != 0) words.insert(words.end(), {"--exposure", std::to_string(o.output.exposure)});
  return words;
}

/// The job that the options ask for. Loads the scene for its fingerprint; with --any-device this machine needs none of the devices.
Job asked_job(const DistributeOptions& o) {
  SceneOptions scene_options = o.scene_options;
  if (o.any_device) scene_options.device = "reference";
  const LoadedScene scene = load_scene(o.scene, scene_options, o.film.aovs(), o.film.bins(), o.quiet);
  Job job;
  job.folder = absolute(o.folder.empty() ? o.output.path + ".parts" : o.folder);
  job.scene = absolute(o.scene);
  job.options = render_words(o, scene.compiled.samples);
  job.wanted.identity = {program_version(), scene.hash, {}, o.any_device ? std::string() : scene.device.name(), {}, scene.compiled.seed};
  job.wanted.samples_total = scene.compiled.samples;
  job.wanted.film = scene.empty_film(o.film.window(scene.whole()));
  job.wanted.film.words = {};
  job.output = absolute(o.output.path);
  job.merge_options = merge_words(o);
  const int parts = o.parts > 0 ? o.parts : o.workers > 0 ? 4 * o.workers : 32;
  job.parts = cut_samples(scene.compiled.samples, parts, job.folder);
  return job;
}

/// Writes the manifest, or continues the folder's job if it is the same render: the parts stay as they were cut.
Job settle_job(const DistributeOptions& o) {
  Job asked = asked_job(o);
  if (fs::exists(manifest_path(asked.folder))) {
    const Job found = read_job(asked.folder);
    const std::string reason = job_mismatch(found, asked);
    if (!reason.empty()) throw InputError(asked.folder + ": holds another job: " + reason + "; --dir names another folder");
    if (o.parts > 0 && found.parts.size() != asked.parts.size())
      throw InputError(asked.folder + ": its job has " + std::to_string(found.parts.size()) + " parts, not " + std::to_string(asked.parts.size()));
    asked.parts = found.parts;
  }
  std::error_code error;
  fs::create_directories(asked.folder, error);
  if (error) throw OutputError(asked.folder + ": cannot be made: " + error.message());
  write_job(asked);
  return asked;
}

/// Renders one part in place of this process, unless it is done.
int run_unit(const DistributeOptions& o) {
  if (o.end_with_parent) end_with_parent();
  const Job job = read_job(absolute(o.folder));
  if (*o.unit < 0 || *o.unit >= static_cast<int>(job.parts.size()))
    throw UsageError("--unit: " + std::to_string(*o.unit) + " is none of the job's parts, 0 to " + std::to_string(job.parts.size() - 1));
  if (job.wanted.identity.version != program_version())
    throw InputError(job.folder + ": its job is of version " + job.wanted.identity.version + ", and this is " + program_version());
  const JobPart& part = job.parts[static_cast<std::size_t>(*o.unit)];
  if (examine_part(job, part).state == PartState::Done) {
    std::printf("%s\n", part.file.c_str());
    return kExitDone;
  }
  std::vector<std::string> words = part_arguments(job, part);
  words.insert(words.begin(), own_executable());
  words.insert(words.end(), {"--threads", std::to_string(o.scene_options.threads), "--progress", "plain"});
  if (o.quiet) words.push_back("-q");
  become_process(words);
}

/// Drives Dask by the Python program that this one carries. There are never more workers than parts left for them.
int run_driver(const DistributeOptions& o, const Job& job, int open) {
  const int workers = std::min(o.workers, open);
  int threads = o.scene_options.threads;
  if (threads == 0 && workers > 0) threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()) / workers);
  const nlohmann::json drive = {{"program", o.worker_program.empty() ? own_executable() : o.worker_program},
                                {"folder", job.folder},
                                {"threads", threads},
                                {"workers", workers},
                                {"scheduler", o.scheduler},
                                {"quiet", o.quiet}};
  const char* chosen = std::getenv("STOKES_DASK_PYTHON");
  const std::string python = chosen && *chosen ? chosen : "python3";
  try {
    return run_process({python, "-c", driver_files().at("drive.py"), drive.dump()});
  } catch (const std::system_error& e) {
    std::fprintf(stderr, "error: %s cannot be run: %s; STOKES_DASK_PYTHON names a Python that has the module 'distributed'\n", python.c_str(), e.code().message().c_str());
    return kExitDevice;
  }
}

/// Removes what this program has put into the folder, and the folder if nothing else is in it.
void remove_folder(const Job& job) {
  std::error_code error;
  for (const JobPart& part : job.parts) {
    fs::remove(part.file, error);
    fs::remove(part.file + ".checkpoint", error);
  }
  fs::remove(manifest_path(job.folder), error);
  std::vector<fs::path> left;
  for (const fs::directory_entry& entry : fs::directory_iterator(job.folder, error))
    if (entry.path().filename().string().rfind(".part-", 0) == 0) left.push_back(entry.path());  // of renders that were killed
  for (const fs::path& file : left) fs::remove(file, error);
  fs::remove(job.folder, error);
}

void require_sense(const DistributeOptions& o) {
  if (o.unit) {
    if (o.folder.empty() || !o.scene.empty()) throw UsageError("--unit needs --dir, and takes the scene from there");
    return;
  }
  if (o.scene.empty()) throw UsageError("distribute needs a SCENE.json");
  if (o.output.path.empty()) throw UsageError("distribute needs -o OUT.exr");
  if ((o.workers > 0) + !o.scheduler.empty() + o.plan != 1) throw UsageError("distribute needs one of --workers N, --scheduler tcp://HOST:PORT, --plan");
  if (!o.scheduler.empty() && o.scheduler.find("://") == std::string::npos)
    throw UsageError("--scheduler: '" + o.scheduler + "' is not an address as in tcp://127.0.0.1:8786");
  require_outputs(o.output);
}

int run_distribute(const DistributeOptions& o) {
  require_sense(o);
  if (o.unit) return run_unit(o);
  const Job job = settle_job(o);
  if (o.plan) {
    std::printf("%zu\n", job.parts.size());
    if (!o.quiet)
      std::fprintf(stderr, "%s holds %zu parts: `stokes distribute --dir DIR --unit I` renders one, `stokes status DIR` says which are open\n",
                   job.folder.c_str(), job.parts.size());
    return kExitDone;
  }
  const auto is_open = [&](const JobPart& part) { return examine_part(job, part).state != PartState::Done; };
  if (const auto open = std::count_if(job.parts.begin(), job.parts.end(), is_open); open > 0) {
    const int code = run_driver(o, job, static_cast<int>(open));
    if (code != kExitDone) return code > 128 ? kExitInternal : code;
  }
  std::vector<std::string> words = merge_arguments(job, job.output);
  words.insert(words.begin(), own_executable());
  const int code = run_process(words);
  if (code == kExitDone && o.folder.empty()) remove_folder(job);
  return code > 128 ? kExitInternal : code;
}

}  // namespace

Command add_distribute(CLI::App& root) {
  auto o = std::make_shared<DistributeOptions>();
  CLI::App* app = root.add_subcommand("distribute", "Renders a scene in parts on several workers, to the bits of one render");
  app->add_option("scene", o->scene, "SCENE.json");
  app->add_option("-o,--output", o->output.path, "OUT.exr, .png or .film");
  app->add_option("--workers", o->workers, "Dask workers on this machine")->check(CLI::Range(1, 1024));
  app->add_option("--scheduler", o->scheduler, "tcp://HOST:PORT of a Dask scheduler, whose workers see the same files");
  app->add_flag("--plan", o->plan, "Only write the job's folder, for another engine; prints the number of parts");
  app->add_option("--unit", o->unit, "Render this part of --dir here, from 0; done at once where it is there");
  app->add_option("--parts", o->parts, "How many parts, at most one a sample [4 a worker, else 32]")->check(CLI::Range(1, 1000000));
  app->add_option("--dir", o->folder, "The job's folder, which then stays [OUT.exr.parts, removed after the merge]");
  app->add_flag("--any-device", o->any_device, "Parts of different devices will do: the bits then depend on who rendered which");
  app->add_option("--worker-program", o->worker_program, "stokes on the workers [this file]");
  o->scene_options.add_to(*app);
  o->film.add_to(*app);
  o->output.add_picture_to(*app);
  app->add_flag("-q,--quiet", o->quiet, "No progress and no messages but errors");
  app->add_flag("--end-with-parent", o->end_with_parent, "With --unit: end when the process that started it ends");
  return {app, [o] { return run_distribute(*o); }};
}

}  // namespace stokes
