// `stokes devices`: which OpenCL devices there are, which one `auto` takes and why, and whether they lay structs out as we do.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/exit_codes.h"
#include "device/error.h"
#include "device/layout_check.h"
#include "device/renderer.h"

namespace stokes {
namespace {

struct DevicesOptions {
  bool json = false, check = false;
};

bool same(const DeviceInfo& a, const DeviceInfo& b) { return a.platform == b.platform && a.device == b.device; }

std::string gibibytes(std::uint64_t bytes) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f GiB", static_cast<double>(bytes) / (1024.0 * 1024 * 1024));
  return text;
}

/// Why `auto` takes this device: the rule that chose it.
std::string why_chosen(const DeviceInfo& d) {
  if (d.type == "gpu") return "the first usable GPU";
  if (d.type == "accelerator") return "there is no usable GPU; the first accelerator";
  return "there is no usable GPU or accelerator; the first CPU";
}

nlohmann::ordered_json to_json(const DeviceInfo& d, bool chosen) {
  nlohmann::ordered_json j;
  j["id"] = std::to_string(d.platform) + ":" + std::to_string(d.device);
  j["platform"] = d.platform_name;
  j["name"] = d.name;
  j["type"] = d.type;
  j["vendor"] = d.vendor;
  j["version"] = d.version;
  j["driver"] = d.driver;
  j["compute_units"] = d.compute_units;
  j["memory_bytes"] = d.memory_bytes;
  j["lanes"] = default_lanes(d);
  j["usable"] = d.usable;
  if (!d.usable) j["why_not"] = d.why_not;
  j["auto"] = chosen;
  if (chosen) j["why"] = why_chosen(d);
  return j;
}

void print_device(const DeviceInfo& d, bool chosen) {
  std::printf("%d:%d  %-4s %s\n", d.platform, d.device, d.type.c_str(), d.name.c_str());
  std::printf("     %s, driver %s, %u compute units, %s\n", d.platform_name.c_str(), d.driver.c_str(), d.compute_units,
              gibibytes(d.memory_bytes).c_str());
  if (!d.usable) std::printf("     not usable: %s\n", d.why_not.c_str());
  if (chosen) std::printf("     auto takes this one: %s\n", why_chosen(d).c_str());
}

/// Compares struct layouts on every usable device; returns whether all agree.
bool check_devices(const std::vector<DeviceInfo>& devices) {
  bool agree = true;
  for (const DeviceInfo& device : devices) {
    if (!device.usable) continue;
    const std::vector<std::string> differences = check_layout(device);
    std::printf("%d:%d  layout of shared structs: %s\n", device.platform, device.device, differences.empty() ? "agrees" : "DIFFERS");
    for (const std::string& difference : differences) std::printf("     %s\n", difference.c_str());
    agree &= differences.empty();
  }
  return agree;
}

int run_devices(const DevicesOptions& o) {
  const std::vector<DeviceInfo> devices = list_devices();
  bool any = false;
  DeviceInfo best;
  try {
    best = choose_device("auto");
    any = true;
  } catch (const DeviceError& e) {
    std::fprintf(stderr, "auto finds no device: %s\n", e.what());
  }
  if (o.json) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const DeviceInfo& d : devices) list.push_back(to_json(d, any && same(d, best)));
    std::cout << list.dump(2) << "\n";
  } else {
    for (const DeviceInfo& d : devices) print_device(d, any && same(d, best));
    std::printf("reference: the CPU integrator, needs no OpenCL\n");
  }
  if (!any) return kExitDevice;
  return !o.check || check_devices(devices) ? kExitDone : kExitDevice;
}

}  // namespace

Command add_devices(CLI::App& root) {
  auto o = std::make_shared<DevicesOptions>();
  CLI::App* app = root.add_subcommand("devices", "Lists the OpenCL devices, numbered as by clinfo -l");
  CLI::Option* json = app->add_flag("--json", o->json, "As JSON");
  app->add_flag("--check", o->check, "Also ask every device for its layout of the shared structs")->excludes(json);
  return {app, [o] { return run_devices(*o); }};
}

}  // namespace stokes
