// `stokes render`: a scene to a picture. Knows options and their order of work; the work itself is elsewhere.
#include <sys/resource.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/display.h"
#include "cli/exit_codes.h"
#include "cli/interrupt.h"
#include "cli/outputs.h"
#include "cli/overwriting.h"
#include "cli/render_job.h"
#include "cli/scene_options.h"
#include "cli/supervisor.h"
#include "device/driver_cache.h"
#include "device/error.h"
#include "image/error.h"
#include "image/replace_file.h"
#include "input/text.h"

namespace stokes {
namespace {
namespace fs = std::filesystem;

struct RenderOptions {
  std::string scene;
  SceneOptions scene_options;
  OutputOptions output;
  FilmOptions film;
  std::string max_time, samples, checkpoint, display_server, expect_scene;
  std::string progress = "auto";
  std::string launch_timeout = "60s";
  bool resume = false, restart = false, json = false, quiet = false, stats = false;
};

constexpr double kCheckpointSeconds = 60, kCheckpointShare = 0.05;

/// What the text of the options means, checked before any work is done.
struct Plan {
  AovChoice aovs;
  SpectralBins bins;
  double max_seconds = 0, checkpoint_seconds = kCheckpointSeconds, launch_seconds = 0;
  ProgressMode progress = ProgressMode::Auto;
  std::string checkpoint_path;
};

struct Timing {
  double load = 0, build = 0;
};

void say(const RenderOptions& o, const std::string& line) {
  if (!o.quiet) std::fprintf(stderr, "%s\n", line.c_str());
}

Plan make_plan(RenderOptions& o) {
  Plan plan;
  if (o.output.path.empty()) o.output.path = fs::path(o.scene).stem().string() + ".exr";
  plan.aovs = o.film.aovs();
  plan.bins = o.film.bins();
  if (!o.max_time.empty()) plan.max_seconds = parse_duration("--max-time", o.max_time);
  if (!o.checkpoint.empty()) plan.checkpoint_seconds = o.checkpoint == "none" ? 0 : parse_duration("--checkpoint", o.checkpoint);
  plan.launch_seconds = parse_duration("--launch-timeout", o.launch_timeout);
  if (!o.scene_options.size.empty()) parse_size(o.scene_options.size);
  if (!o.scene_options.integrator.empty()) parse_integrator(o.scene_options.integrator);
  for (const std::string& setting : o.scene_options.settings) parse_setting(setting);
  if (o.progress == "plain") plan.progress = ProgressMode::Plain;
  if (o.progress == "json") plan.progress = ProgressMode::Json;
  if (o.progress == "none" || o.quiet) plan.progress = ProgressMode::None;
  o.output.variance = plan.aovs.variance;
  o.output.part = !o.samples.empty();
  plan.checkpoint_path = o.output.path + ".checkpoint";
  return plan;
}

/// An empty record for what is to be rendered; its samples_total and range follow --spp and --samples.
FilmRecord empty_record(const RenderOptions& o, const LoadedScene& scene) {
  FilmRecord record = scene.empty_record(o.film.window(scene.whole()));
  if (o.output.variance) record.notes.emplace_back(kVarianceNote, "yes");
  if (!o.samples.empty()) {
    const auto [begin, end] = parse_samples(o.samples);
    if (end > record.samples_total)
      throw UsageError("--samples: " + o.samples + " goes beyond the render's " + std::to_string(record.samples_total) +
                       " samples per pixel; say --spp " + std::to_string(end) + " for every part");
    record.sample_begin = record.sample_end = begin;
  }
  return record;
}

/// Continues from the checkpoint where --resume asks for it. Foreign and damaged ones are refused.
void adopt_checkpoint(const RenderOptions& o, Plan& plan, int sample_end, FilmRecord& record) {
  const std::string& path = plan.checkpoint_path;
  if (!fs::exists(path)) {
    if (o.resume) say(o, "there is no " + path + " yet: starting with the first sample");
    return;
  }
  if (o.restart) return;
  if (!o.resume) {
    if (!o.checkpoint.empty() && plan.checkpoint_seconds > 0)
      throw UsageError("--checkpoint: " + path + " exists already; --resume continues it, --restart begins anew");
    say(o, "note: " + path + " is left alone, and no other is written; --resume would continue it, --restart replace it");
    plan.checkpoint_seconds = 0;
    return;
  }
  FilmRecord found = read_film(path);
  std::string reason = film_mismatch(found, record);
  if (reason.empty() && found.identity.device != record.identity.device)
    reason = "it was rendered on " + found.identity.device + ", not on " + record.identity.device;
  if (reason.empty() && found.sample_begin != record.sample_begin)
    reason = "it begins with sample " + std::to_string(found.sample_begin) + ", not " + std::to_string(record.sample_begin);
  if (reason.empty() && found.sample_end > sample_end)
    reason = "it already holds the samples up to " + std::to_string(found.sample_end) + ", more than the " + std::to_string(sample_end) + " asked for";
  if (!reason.empty()) throw InputError(path + ": cannot be resumed: " + reason + "; --restart begins anew");
  found.samples_total = record.samples_total;
  found.notes = record.notes;
  record = std::move(found);
  say(o, "resuming " + path + " after " + std::to_string(record.sample_end - record.sample_begin) + " samples per pixel");
}

nlohmann::ordered_json summary(const FilmRecord& record, const std::vector<std::string>& files, const Timing& timing, bool complete) {
  struct rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  std::string driver;
  for (const auto& [name, value] : record.notes)
    if (name == "stokes:driver") driver = value;
  nlohmann::ordered_json j;
  j["output"] = files.empty() ? "" : files.front();
  j["files"] = files;
  j["complete"] = complete;
  j["render_seconds"] = record.render_seconds;
  j["build_seconds"] = timing.build;
  j["load_seconds"] = timing.load;
  j["samples"] = record.sample_end - record.sample_begin;
  j["width"] = record.film.width;
  j["height"] = record.film.height;
  j["rays"] = record.rays;
  j["shadow_rays"] = record.shadow_rays;
  j["scatterings"] = record.scatterings;
  j["device"] = record.identity.device;
  j["driver"] = driver;
  j["integrator"] = record.identity.integrator;
  j["seed"] = record.identity.seed;
  j["scene_hash"] = record.identity.scene_hash;
  j["version"] = record.identity.version;
  j["peak_memory_bytes"] = static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
  j["invalid_samples"] = film_totals(record.film).invalid;
  return j;
}

void print_statistics(const FilmRecord& r, const Timing& timing) {
  const double seconds = std::max(1e-9, r.render_seconds);
  const double samples = static_cast<double>(film_totals(r.film).samples);
  std::fprintf(stderr, "load      %10.3f s\nkernels   %10.3f s\nrender    %10.3f s\n", timing.load, timing.build, r.render_seconds);
  std::fprintf(stderr, "samples   %14.0f  %10.3f M/s\n", samples, samples / seconds * 1e-6);
  const auto line = [&](const char* name, std::uint64_t count) {
    if (r.paths > 0)
      std::fprintf(stderr, "%s%14llu  %10.3f M/s  %8.2f per path\n", name, static_cast<unsigned long long>(count),
                   static_cast<double>(count) / seconds * 1e-6, static_cast<double>(count) / static_cast<double>(r.paths));
  };
  line("rays      ", r.rays);
  line("shadows   ", r.shadow_rays);
  line("scatters  ", r.scatterings);
}

std::unique_ptr<Backend> prepare(const RenderOptions& o, const LoadedScene& scene, const WorkerAttempt& attempt, Timing& timing) {
  enter_stage(WorkStage::Building);
  if (!scene.device.reference) say(o, "preparing kernels for " + scene.device.name() + " ...");
  auto backend = make_backend(scene.compiled, scene.device, {o.scene_options.threads, o.scene_options.kernel_dir, attempt.optimise, !attempt.empty_caches});
  timing.load = scene.load_seconds;
  timing.build = backend->build_seconds();
  char text[64];
  std::snprintf(text, sizeof text, "kernels ready in %.2f s", timing.build);
  if (!scene.device.reference) say(o, text);
  for (const std::string& warning : backend->warnings()) say(o, "warning: " + warning);
  return backend;
}

/// The checkpoint of an interrupted render. Where it cannot be written, the picture so far is at least tried before the error is told.
void save_interrupted(const RenderOptions& o, const Plan& plan, const RenderJob& job) {
  const FilmRecord& record = job.record;
  try {
    write_film(plan.checkpoint_path, record);
  } catch (const OutputError&) {
    write_outputs(record, o.output);
    throw;
  }
  std::fprintf(stderr, "interrupted after %d of %d samples per pixel; saved %s, continue with --resume\n", record.sample_end - record.sample_begin,
               job.sample_end - record.sample_begin, plan.checkpoint_path.c_str());
}

/// Everything after the last sample: files, checkpoint, messages, exit code.
int conclude(const RenderOptions& o, const Plan& plan, const RenderJob& job, RenderEnd end, const Timing& timing, bool checkpoint_is_ours) {
  const FilmRecord& record = job.record;
  const int samples = record.sample_end - record.sample_begin;
  if (end == RenderEnd::Interrupted) {
    if (samples == 0) {
      std::fprintf(stderr, "interrupted before the first sample pass was complete: nothing to save\n");
      return kExitInterrupted;
    }
    save_interrupted(o, plan, job);
  }
  const std::vector<std::string> files = write_outputs(record, o.output);
  if (end != RenderEnd::Interrupted && checkpoint_is_ours) fs::remove(plan.checkpoint_path);
  if (end == RenderEnd::TimeUp) say(o, "time is up after " + std::to_string(samples) + " samples per pixel");
  if (o.stats) print_statistics(record, timing);
  if (o.json)
    std::cout << summary(record, files, timing, end != RenderEnd::Interrupted).dump(2) << "\n";
  else
    for (const std::string& file : files) std::cout << file << "\n";
  if (end == RenderEnd::Interrupted) return kExitInterrupted;
  const std::string invalid = describe_invalid(record, *job.backend);
  if (invalid.empty()) return kExitDone;
  std::fprintf(stderr, "error: %s\n", invalid.c_str());
  return kExitInternal;
}

/// The samples, with a word about the checkpoint when the device fails.
RenderEnd render_samples(RenderJob& job, const Plan& plan, const bool& checkpoint_is_ours) {
  enter_stage(WorkStage::Rendering);
  try {
    const RenderEnd end = run_job(job);
    job.progress->finish();
    enter_stage(WorkStage::Writing);
    return end;
  } catch (const DeviceError& e) {
    job.progress->finish();
    if (!checkpoint_is_ours) throw;
    throw DeviceError(std::string(e.what()) + "; " + plan.checkpoint_path + " holds what was done by then, --resume continues it", e.out_of_memory());
  }
}

int render_scene(RenderOptions o, Plan plan, const WorkerAttempt& attempt) {
  if (attempt.resume) o.resume = true, o.restart = false;
  if (attempt.empty_caches) isolate_driver_cache(DriverCachePlace::Temporary);
  exit_on_interrupt();
  const DisplayFeed display = open_display(o.display_server, fs::path(o.scene).filename().string());

  const LoadedScene scene = load_scene(o.scene, o.scene_options, plan.aovs, plan.bins, o.quiet);
  if (!o.expect_scene.empty() && o.expect_scene != scene.hash)
    throw InputError(o.scene + ": is not the scene that is expected: its hash is " + scene.hash + ", not " + o.expect_scene);
  require_no_input(o.output, scene.description.files, "the scene");
  RenderJob job;
  job.record = empty_record(o, scene);
  job.sample_end = o.samples.empty() ? job.record.samples_total : parse_samples(o.samples).second;
  adopt_checkpoint(o, plan, job.sample_end, job.record);
  bool checkpoint_is_ours = job.record.sample_end > job.record.sample_begin;

  Timing timing;
  const std::unique_ptr<Backend> backend = prepare(o, scene, attempt, timing);
  const std::uint64_t pixels = static_cast<std::uint64_t>(job.record.film.width) * static_cast<std::uint64_t>(job.record.film.height);
  const int all = job.sample_end - job.record.sample_begin, already = job.record.sample_end - job.record.sample_begin;
  ProgressReport progress(plan.progress, pixels * static_cast<std::uint64_t>(all), pixels * static_cast<std::uint64_t>(already), all);
  job.backend = backend.get();
  job.progress = &progress;
  job.max_seconds = plan.max_seconds;
  job.checkpoint_seconds = plan.checkpoint_seconds;
  if (o.checkpoint.empty()) job.checkpoint_share = kCheckpointShare;
  job.save_checkpoint = [&](const FilmRecord& record) {
    enter_stage(WorkStage::Writing);
    // A disk that is full now may not be when the picture is written, and a render of hours is worth the try.
    try {
      write_film(plan.checkpoint_path, record);
      checkpoint_is_ours = true;
      tell_checkpoint_saved();
    } catch (const OutputError& error) {
      std::fprintf(stderr, "warning: %s; rendering goes on\n", visible_line(error.what()).c_str());
    }
    enter_stage(WorkStage::Rendering);
  };
  if (display) job.publish = [&display](const FilmRecord& record) { display(record.film); };
  catch_interrupts();
  const RenderEnd end = render_samples(job, plan, checkpoint_is_ours);
  return conclude(o, plan, job, end, timing, checkpoint_is_ours);
}

int run_render(RenderOptions o) {
  const Plan plan = make_plan(o);
  require_outputs(o.output);
  require_writable(plan.checkpoint_path);
  // The reference has no driver that could crash or hang.
  if (o.scene_options.device == "reference") return render_scene(o, plan, {});
  return supervise({plan.launch_seconds, plan.checkpoint_path, o.quiet}, [&](const WorkerAttempt& attempt) { return render_scene(o, plan, attempt); });
}

}  // namespace

Command add_render(CLI::App& root) {
  auto o = std::make_shared<RenderOptions>();
  CLI::App* app = root.add_subcommand("render", "Renders a scene to an EXR");
  app->add_option("scene", o->scene, "SCENE.json")->required();
  app->add_option("-o,--output", o->output.path, "OUT.exr, .png or .film [the scene's name with .exr, in this folder]");
  o->scene_options.add_to(*app);
  o->film.add_to(*app);
  app->add_option("--max-time", o->max_time, "Stop after this time (60s, 5m, 2h) with the samples done by then [none]");
  o->output.add_picture_to(*app);
  app->add_option("--samples", o->samples, "a:b: only these samples of every pixel, as a part for `stokes merge` [all]");
  app->add_option("--expect-scene", o->expect_scene, "Refuse the scene if its hash (--json, info) is another [none]");
  app->add_option("--launch-timeout", o->launch_timeout, "Give up a device that is silent so much longer than before")->capture_default_str();
  app->add_option("--checkpoint", o->checkpoint, "Save OUT.checkpoint this often (60s), or none [60s; with a large film seldomer]");
  CLI::Option* resume = app->add_flag("--resume", o->resume, "Continue from OUT.checkpoint where there is one");
  app->add_flag("--restart", o->restart, "Begin anew, whatever checkpoint there is")->excludes(resume);
  app->add_option("--display-server", o->display_server, "HOST:PORT of a tev viewer that shall show the picture as it grows [none]");
  app->add_option("--progress", o->progress, "auto, plain, json or none")->capture_default_str()->check(CLI::IsMember({"auto", "plain", "json", "none"}));
  app->add_flag("--json", o->json, "Print a summary as one JSON object");
  app->add_flag("-q,--quiet", o->quiet, "No progress and no messages but errors");
  app->add_flag("--stats", o->stats, "Print counters and rates at the end");
  return {app, [o] { return run_render(*o); }};
}

}  // namespace stokes
