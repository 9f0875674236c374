// Runs the render kernel over a film: context, buffers, launches. Knows the kernel's arguments, not what it computes.
#include "device/renderer.h"

#include <algorithm>
#include <chrono>
#include <stdexcept>

#include "device/build_constants.h"
#include "device/calls.h"
#include "device/device_list.h"
#include "device/kernel_files.h"
#include "device/launch_plan.h"
#include "device/program.h"
#include "device/scene_buffers.h"

namespace stokes {

namespace {

// A launch is long against its 6 us of overhead and short enough that progress and cancellation feel immediate.
constexpr double kLaunchSeconds = 0.05;
// In dense media that absorb little a few paths outlive all others by far, and at the end of every launch each work-item's lanes wait for
// its longest. Where lanes are idle for more than this share of a launch, later ones are longer and use fewer work-items.
constexpr double kMostIdle = 0.25;
constexpr double kLongLaunchSeconds = 0.5;
constexpr std::uint32_t kFewerItems = 4;  // a quarter of them
// A stop inside a sample pass finishes the pass if that takes no longer than this; else the pass is dropped.
constexpr double kFinishSeconds = 0.25;
// While passes are slow, the film is copied between passes at most this often; a dropped pass costs the work since then.
constexpr double kCopySeconds = 1.0;

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

// The first `threads` cores of a CPU device, or the device itself where it cannot be divided.
cl::Device restrict_threads(const cl::Device& device, int threads, std::vector<std::string>& warnings) {
  const auto units = device.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>();
  if (threads <= 0 || static_cast<cl_uint>(threads) >= units) return device;
  const cl_device_partition_property by_counts[] = {CL_DEVICE_PARTITION_BY_COUNTS, threads, CL_DEVICE_PARTITION_BY_COUNTS_LIST_END, 0};
  const cl_device_partition_property equally[] = {CL_DEVICE_PARTITION_EQUALLY, threads, 0};
  const auto offered = device.getInfo<CL_DEVICE_PARTITION_PROPERTIES>();
  for (const cl_device_partition_property* way : {by_counts, equally}) {
    // Only ways that the device offers: Rusticl ends the process when asked for another.
    if (std::find(offered.begin(), offered.end(), way[0]) == offered.end()) continue;
    try {
      std::vector<cl::Device> parts;
      cl::Device(device).createSubDevices(way, &parts);
      if (!parts.empty()) return parts.front();
    } catch (const cl::Error&) {
      // The next way, or none.
    }
  }
  warnings.push_back("the device cannot be limited to " + std::to_string(threads) + " threads; all of its " + std::to_string(units) + " are used");
  return device;
}

// The launch geometry, fixed for a renderer's life: PoCL compiles the kernel again for another one.
struct Geometry {
  std::uint32_t work_items, local_size;
  std::uint64_t most_paths_per_item;
};

Geometry choose_geometry(const cl::Device& device, const DeviceInfo& info) {
  constexpr std::uint64_t kAny = 1u << 30;
  const cl_uint units = std::max<cl_uint>(1, device.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>());
  if (info.type != "cpu") return {std::min<cl_uint>(units * 2048u, 1u << 20), 64, kAny};
  // Mesa's llvmpipe silently leaves every loop once a work-item has done 65,535 iterations in all, so each gets very few paths.
  if (info.platform_name == "rusticl") return {4096, 1, 1};
  return {std::clamp<cl_uint>(units * 32u, 64u, 4096u), 1, kAny};
}

}  // namespace

struct Renderer::State {
  DeviceInfo info;
  std::string name;  // for messages
  cl::Device device;
  cl::Context context;
  cl::CommandQueue queue;
  cl::Kernel kernel;
  SceneBuffers scene_buffers;
  std::uint64_t scene_bytes = 0;
  cl::Buffer launch_buffer, counter_buffer, film_buffer, film_copy;
  std::size_t film_bytes = 0;
  Geometry geometry{};
  bool long_launches = false;
  int lanes = 1;
  layout::Scene header{};
  RenderCounters counters;
  double build_seconds = 0;
  std::vector<std::string> warnings;

  State(const CompiledScene& scene, const DeviceInfo& device, const DeviceOptions& options);
  void build(const CompiledScene& scene, const DeviceOptions& options);
  void build_and_try(const std::string& source, BuildChoices choices);
  void set_arguments();
  void enqueue(const layout::Launch& launch);
  void prepare_film(const Film& film);
  void read_counters();
  void run(const Film& film, std::uint32_t seed, const LaunchPlan::Range& range);
  bool lanes_wait(const RenderCounters& before) const;
  Film read_film(const cl::Buffer& buffer, const Film& shape) const;
};

Renderer::State::State(const CompiledScene& scene, const DeviceInfo& chosen, const DeviceOptions& options)
    : info(chosen), name(describe_device(chosen)), header(scene.header) {
  device = restrict_threads(find_device(info), info.type == "cpu" ? options.threads : 0, warnings);
  geometry = choose_geometry(device, info);
  lanes = options.lanes > 0 ? options.lanes : default_lanes(info);

  std::uint64_t largest = 0;
  for (const SceneArray& array : list_scene_arrays(scene)) largest = std::max<std::uint64_t>(largest, array.bytes);
  scene_bytes = stokes::scene_bytes(scene);
  require_memory(device, name, scene_bytes, largest);

  context = cl::Context(device);
  queue = cl::CommandQueue(context, device);
  // Mesa's CPU device keeps a copy of its own all the same.
  scene_buffers = upload_scene(context, scene, info.type == "cpu" && info.platform_name != "rusticl");
  launch_buffer = cl::Buffer(context, CL_MEM_READ_ONLY, sizeof(layout::Launch));
  const std::size_t counter_bytes = std::size_t(geometry.work_items) * COUNTER_COUNT * sizeof(cl_ulong);
  counter_buffer = cl::Buffer(context, CL_MEM_READ_WRITE, counter_bytes);
  queue.enqueueFillBuffer<cl_ulong>(counter_buffer, 0, 0, counter_bytes);
  film_buffer = cl::Buffer(context, CL_MEM_READ_WRITE, 16);
  build(scene, options);
}

void Renderer::State::build(const CompiledScene& scene, const DeviceOptions& options) {
  const Clock::time_point start = Clock::now();
  const std::string constants = build_constants(scene, {lanes, probe_x86(device, info)});
  const KernelFiles files = options.kernel_dir.empty() ? embedded_kernels() : read_kernel_dir(options.kernel_dir);
  const std::string source = assemble_program(files, "render.cl", constants);
  // The compiler is at work in the first launch too, and a cached binary may be whole and yet of no use: what fails then is built again.
  std::vector<BuildChoices> ways = {{options.optimise, options.use_cache}};
  if (options.use_cache) ways.push_back({options.optimise, false});
  if (options.optimise) ways.push_back({false, false});
  for (std::size_t way = 0;; way++) {
    try {
      build_and_try(source, ways[way]);
      if (options.optimise && !ways[way].optimise)
        warnings.push_back("the first launch failed on " + name + " until the kernels were built without optimisation; rendering will be slow");
      break;
    } catch (const cl::Error& error) {
      const std::string call = error.what();
      const bool launch = call == "clEnqueueNDRangeKernel" || call == "clFinish";
      if (way + 1 == ways.size() || !launch || is_out_of_memory(error.err())) throw;
      queue = cl::CommandQueue(context, device);
    }
  }
  build_seconds = seconds_since(start);
}

void Renderer::State::build_and_try(const std::string& source, BuildChoices choices) {
  const BuiltProgram built = build_program(context, device, info, source, choices);
  if (!built.warning.empty()) warnings.push_back(built.warning);
  kernel = cl::Kernel(built.program, "render");
  set_arguments();
  // PoCL compiles at the first enqueue: an empty launch takes that here, and only then is the binary worth keeping.
  enqueue(layout::Launch{});
  queue.finish();
  store_program(built);
}

void Renderer::State::set_arguments() {
  cl_uint index = 0;
  for (const cl::Buffer& buffer : scene_buffers.buffers) kernel.setArg(index++, buffer);
  kernel.setArg(index++, launch_buffer);
  kernel.setArg(index++, film_buffer);
  kernel.setArg(index++, counter_buffer);
}

void Renderer::State::enqueue(const layout::Launch& launch) {
  queue.enqueueWriteBuffer(launch_buffer, CL_TRUE, 0, sizeof launch, &launch);
  queue.enqueueNDRangeKernel(kernel, cl::NullRange, geometry.work_items, geometry.local_size);
}

// A zeroed film on the device, as large as `film`.
void Renderer::State::prepare_film(const Film& film) {
  const std::size_t bytes = film.words.size() * sizeof(std::int64_t);
  if (bytes != film_bytes) {
    film_buffer = cl::Buffer();
    film_copy = cl::Buffer();
    film_bytes = 0;
    require_memory(device, name, scene_bytes + bytes, bytes);
    film_buffer = cl::Buffer(context, CL_MEM_READ_WRITE, bytes);
    film_bytes = bytes;
    set_arguments();
  }
  queue.enqueueFillBuffer<cl_ulong>(film_buffer, 0, 0, bytes);
}

void Renderer::State::run(const Film& film, std::uint32_t seed, const LaunchPlan::Range& range) {
  layout::Launch launch{};
  launch.seed = seed;
  launch.pixel_begin = range.pixel_begin;
  launch.pixel_end = range.pixel_end;
  launch.sample_begin = range.sample_begin;
  launch.sample_end = range.sample_end;
  const std::uint32_t items = long_launches ? geometry.work_items / kFewerItems : geometry.work_items;
  launch.chunk = (range.pixel_end - range.pixel_begin + items - 1) / items;
  launch.crop_x = film.crop_x;
  launch.crop_y = film.crop_y;
  launch.crop_width = film.width;
  launch.crop_height = film.height;
  enqueue(launch);
  queue.finish();
}

void Renderer::State::read_counters() {
  std::vector<cl_ulong> words(std::size_t(geometry.work_items) * COUNTER_COUNT);
  queue.enqueueReadBuffer(counter_buffer, CL_TRUE, 0, words.size() * sizeof words[0], words.data());
  RenderCounters sum;
  for (std::size_t i = 0; i < words.size(); i += COUNTER_COUNT) {
    sum.rays += words[i + COUNTER_RAYS];
    sum.shadow_rays += words[i + COUNTER_SHADOW_RAYS];
    sum.scatterings += words[i + COUNTER_SCATTERINGS];
    sum.paths += words[i + COUNTER_PATHS];
    sum.flights += words[i + COUNTER_FLIGHTS];
    sum.lane_steps += words[i + COUNTER_LANE_STEPS];
  }
  sum.invalid = counters.invalid;
  counters = sum;
}

// Whether lanes were idle for too much of what has run since the counters were `before`.
bool Renderer::State::lanes_wait(const RenderCounters& before) const {
  const auto flights = static_cast<double>(counters.flights - before.flights), steps = static_cast<double>(counters.lane_steps - before.lane_steps);
  return flights < (1 - kMostIdle) * steps;
}

Film Renderer::State::read_film(const cl::Buffer& buffer, const Film& shape) const {
  Film film = shape;
  queue.enqueueReadBuffer(buffer, CL_TRUE, 0, film_bytes, film.words.data());
  return film;
}

Renderer::Renderer(const CompiledScene& scene, const DeviceInfo& device, const DeviceOptions& options)
    : state_(checked(describe_device(device), [&] { return std::make_unique<State>(scene, device, options); },
                     stokes::scene_bytes(scene), device.memory_bytes)) {}

Renderer::~Renderer() = default;

int Renderer::render_samples(Film& film, std::uint32_t seed, int begin, int end, const std::function<bool(const RenderProgress&)>& progress) {
  State& state = *state_;
  if (film.stride != static_cast<int>(state.header.film_stride)) throw std::invalid_argument("the film was not made for this scene");
  if (begin < 0 || end <= begin || film.words.empty()) return begin;
  return checked(state.name, [&] {
    const Clock::time_point start = Clock::now();
    const auto pixels = static_cast<std::uint32_t>(film.width) * static_cast<std::uint32_t>(film.height);
    const std::uint64_t first_paths = std::uint64_t(state.geometry.work_items) * state.lanes;
    const std::uint64_t most_paths = state.geometry.work_items * state.geometry.most_paths_per_item;
    LaunchPlan plan(pixels, begin, end, first_paths, most_paths, state.long_launches ? kLongLaunchSeconds : kLaunchSeconds);
    const bool adapts = state.lanes > 1 && state.info.type == "cpu" && state.geometry.most_paths_per_item > 1;
    RenderProgress report;
    report.samples_total = std::uint64_t(pixels) * (end - begin);
    state.prepare_film(film);

    // The samples that film_copy holds; before any copy there is nothing to keep.
    std::uint32_t copied_end = begin;
    Clock::time_point copied_at = start;
    bool stopping = false;
    while (!plan.done()) {
      // While a pass is too slow to be finished on a stop, keep a film of whole passes to fall back to.
      if (plan.between_passes() && plan.seconds_per_pass() > kFinishSeconds && plan.whole_passes_end() > copied_end &&
          seconds_since(copied_at) > kCopySeconds) {
        if (!state.film_copy()) state.film_copy = cl::Buffer(state.context, CL_MEM_READ_WRITE, state.film_bytes);
        state.queue.enqueueCopyBuffer(state.film_buffer, state.film_copy, 0, 0, state.film_bytes);
        state.queue.finish();
        copied_end = plan.whole_passes_end();
        copied_at = Clock::now();
      }

      const LaunchPlan::Range range = plan.next();
      const RenderCounters before = state.counters;
      const Clock::time_point launched = Clock::now();
      state.run(film, seed, range);
      const double seconds = seconds_since(launched);
      plan.complete(range, seconds);
      if (adapts || progress) state.read_counters();
      if (adapts && !state.long_launches && seconds > 0.5 * kLaunchSeconds && state.lanes_wait(before)) {
        state.long_launches = true;
        plan.aim(kLongLaunchSeconds);
      }
      report.samples_done += range.paths();

      // After a stop only the rest of a short pass is rendered.
      if (!stopping && progress) {
        report.counters = state.counters;
        report.seconds = seconds_since(start);
        stopping = !progress(report);
      }
      if (stopping && (plan.between_passes() || plan.seconds_to_pass_end() > kFinishSeconds)) break;
    }

    // A pass cut short goes, with what was not copied before it.
    const bool whole = plan.between_passes();
    const std::uint32_t samples_end = whole ? plan.whole_passes_end() : copied_end;
    if (samples_end > static_cast<std::uint32_t>(begin)) {
      const Film part = state.read_film(whole ? state.film_buffer : state.film_copy, film);
      film_accumulate(film, part);
      state.counters.invalid += film_totals(part).invalid;
    }
    state.read_counters();
    return static_cast<int>(samples_end);
  }, state.scene_bytes + film.words.size() * sizeof(std::int64_t), state.info.memory_bytes);
}

void Renderer::set_header(const layout::Scene& header) {
  State& state = *state_;
  if (header.film_stride != state.header.film_stride || header.light_count != state.header.light_count)
    throw std::invalid_argument("the header belongs to another scene");
  checked(state.name, [&] {
    state.queue.enqueueWriteBuffer(state.scene_buffers.buffers.front(), CL_TRUE, 0, sizeof header, &header);
    return 0;
  });
  state.header = header;
}

const RenderCounters& Renderer::counters() const { return state_->counters; }
double Renderer::build_seconds() const { return state_->build_seconds; }
const DeviceInfo& Renderer::device() const { return state_->info; }
const std::vector<std::string>& Renderer::warnings() const { return state_->warnings; }

}  // namespace stokes
