// `stokes status`: which parts of a job folder are there, and the commands for those that are not. Knows nothing of rendering.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/exit_codes.h"
#include "distribute/job_folder.h"
#include "distribute/process.h"

namespace stokes {
namespace {

using Json = nlohmann::ordered_json;

struct StatusOptions {
  std::string folder;
  bool json = false;
};

std::string command(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), own_executable());
  return shell_line(arguments);
}

std::string one_line(std::string text) {
  for (char& c : text)
    if (c == '\n' || c == '\r') c = ' ';
  return text;
}

/// A shell script: what is open as comments and commands, and the merge after them.
void print_script(const Job& job, const std::vector<PartReport>& reports, std::size_t done) {
  std::printf("# %zu of %zu parts are done in %s\n", done, reports.size(), one_line(job.folder).c_str());
  for (std::size_t i = 0; i < reports.size(); i++) {
    if (reports[i].state == PartState::Done) continue;
    const JobPart& part = job.parts[i];
    std::printf("# part %zu, samples %d:%d: %s: %s\n%s\n", i, part.begin, part.end, part_state_name(reports[i].state), one_line(reports[i].reason).c_str(),
                command(part_arguments(job, part)).c_str());
  }
  std::printf("%s%s\n", done < reports.size() ? "# and then\n" : "", command(merge_arguments(job, job.output)).c_str());
}

void print_json(const Job& job, const std::vector<PartReport>& reports, std::size_t done) {
  Json j;
  j["complete"] = done == reports.size();
  j["parts"] = Json::array();
  for (std::size_t i = 0; i < reports.size(); i++) {
    const JobPart& part = job.parts[i];
    Json entry = {{"index", i}, {"samples", {part.begin, part.end}}, {"file", part.file}, {"state", part_state_name(reports[i].state)}};
    if (reports[i].state != PartState::Done) {
      entry["reason"] = reports[i].reason;
      entry["command"] = command(part_arguments(job, part));
    }
    j["parts"].push_back(std::move(entry));
  }
  j["merge"] = command(merge_arguments(job, job.output));
  std::cout << j.dump(2, ' ', false, Json::error_handler_t::replace) << "\n";
}

int run_status(const StatusOptions& o) {
  const Job job = read_job(std::filesystem::absolute(o.folder).lexically_normal().string());
  std::vector<PartReport> reports;
  std::size_t done = 0;
  for (const JobPart& part : job.parts) {
    reports.push_back(examine_part(job, part));
    done += reports.back().state == PartState::Done;
  }
  (o.json ? print_json : print_script)(job, reports, done);
  return done == reports.size() ? kExitDone : kExitInterrupted;
}

}  // namespace

Command add_status(CLI::App& root) {
  auto o = std::make_shared<StatusOptions>();
  CLI::App* app = root.add_subcommand("status", "Says which parts of a distributed render are missing, as a shell script that renders them");
  app->add_option("folder", o->folder, "DIR of `stokes distribute`")->required();
  app->add_flag("--json", o->json, "As JSON");
  return {app, [o] { return run_status(*o); }};
}

}  // namespace stokes
