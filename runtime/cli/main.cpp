// The executable's entry: the command line to a subcommand, and every error to a message and an exit code. The one catch is here.
#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <iostream>
#include <new>
#include <vector>

#include "cli/commands.h"
#include "cli/exit_codes.h"
#include "cli/import.h"
#include "cli/supervisor.h"
#include "cli/version.h"
#include "device/error.h"
#include "image/error.h"
#include "input/limits.h"
#include "scene/memory_error.h"

namespace stokes {
namespace {

/// CLI11's own exit codes would collide with ours: help and version are successes, all else is a bad command line.
int exit_of_parse(const CLI::App& app, const CLI::ParseError& error) {
  const int code = app.exit(error, std::cout, std::cerr);
  return code == 0 ? kExitDone : kExitUsage;
}

int fail(const std::string& message, int code) {
  std::cerr << message << "\n";
  return code;
}

int run(int argc, char** argv) {
  CLI::App app("Stokes: a spectral path tracer with fluorescence and participating media, for any OpenCL device", "stokes");
  app.set_version_flag("--version", "stokes " + program_version());
  app.require_subcommand(1);
  app.set_help_all_flag("--help-all", "Help of all commands");
  const std::vector<Command> commands = {add_render(app), add_check(app),  add_devices(app),    add_compare(app), add_parity(app),
                                         add_bench(app),  add_plot(app),   add_merge(app),      add_info(app),    add_new(app),
                                         add_view(app),   add_import(app), add_distribute(app), add_status(app)};
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return exit_of_parse(app, error);
  }
  for (const Command& command : commands)
    if (command.app->parsed()) return command.run();
  return kExitUsage;
}

int run_and_report(int argc, char** argv) {
  try {
    const int code = run(argc, argv);
    std::cout.flush();
    if (!std::cout) return fail("error: standard output cannot be written", kExitOutput);
    return code;
  } catch (const UsageError& e) {
    return fail(std::string("error: ") + e.what() + "\nstokes COMMAND --help lists the options", kExitUsage);
  } catch (const SceneMemoryError& e) {
    return fail(e.what(), kExitMemory);
  } catch (const SceneError& e) {
    return fail(e.what(), kExitBadInput);
  } catch (const InputError& e) {
    return fail(std::string("error: ") + e.what(), kExitBadInput);
  } catch (const KernelBuildError& e) {
    return fail(std::string("error: ") + e.what() + "\n" + e.log(), kExitDevice);
  } catch (const DeviceError& e) {
    return fail(std::string("error: ") + e.what(), e.out_of_memory() ? kExitMemory : kExitDevice);
  } catch (const OutputError& e) {
    return fail(std::string("error: ") + e.what(), kExitOutput);
  } catch (const OutOfMemory& e) {
    return fail(std::string("error: ") + e.what(), kExitMemory);
  } catch (const std::bad_alloc&) {
    return fail("error: out of memory", kExitMemory);
  } catch (const std::exception& e) {
    return fail(std::string("internal error: ") + e.what(), kExitInternal);
  }
}

}  // namespace
}  // namespace stokes

int main(int argc, char** argv) {
  // A file that grows past a limit is an output error with a message, not a signal.
  std::signal(SIGXFSZ, SIG_IGN);
  const int code = stokes::run_and_report(argc, argv);
  stokes::tell_exit_code(code);
  return code;
}
