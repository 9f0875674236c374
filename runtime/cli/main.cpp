// The executable's entry: the command line to a subcommand, and every error to a message and an exit code. The one catch is here.
#include <fcntl.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <iostream>
#include <new>
#include <sstream>
#include <vector>

#include "cli/commands.h"
#include "cli/exit_codes.h"
#include "cli/import.h"
#include "cli/supervisor.h"
#include "cli/version.h"
#include "device/error.h"
#include "image/error.h"
#include "input/limits.h"
#include "input/text.h"
#include "scene/memory_error.h"

namespace stokes {
namespace {

/// A file that is opened while one of the standard streams is closed would take its number, and messages would go into it: the picture. Writing to
/// what stands there instead fails, as to a closed stream.
void keep_standard_streams() {
  for (const int stream : {0, 1, 2})
    if (fcntl(stream, F_GETFD) == -1 && open("/dev/null", stream == 0 ? O_WRONLY : O_RDONLY) != stream) std::_Exit(kExitInternal);
}

/// What CLI11 lets pass: empty values (a shell's variable that is not set), NaN, and numbers with a leading 0, which it takes for octal.
void require_plain_values(const CLI::App& command) {
  for (const CLI::Option* option : command.get_options())
    for (const std::string& value : option->results()) {
      const std::string name = option->get_name(), type = option->get_type_name();
      if (value.empty()) throw UsageError(name + ": is empty");
      if (type.starts_with("FLOAT") && !std::isfinite(std::strtod(value.c_str(), nullptr))) throw UsageError(name + ": '" + value + "' is not a finite number");
      const std::size_t first = value.find_first_not_of("+-");
      const bool octal = first + 1 < value.size() && value[first] == '0' && std::isdigit(static_cast<unsigned char>(value[first + 1]));
      if (octal && (type.starts_with("INT") || type.starts_with("UINT"))) throw UsageError(name + ": '" + value + "' begins with 0; write it without");
    }
}

/// CLI11's own exit codes would collide with ours: help and version are successes, all else is a bad command line.
int exit_of_parse(const CLI::App& app, const CLI::ParseError& error) {
  std::ostringstream message;
  const int code = app.exit(error, std::cout, message);
  std::cerr << visible_text(message.str());
  return code == 0 ? kExitDone : kExitUsage;
}

int fail(const std::string& message, int code) {
  std::cerr << visible_text(message) << "\n";
  return code;
}

/// Of errors that are one line, whatever stands in the names that they quote.
int fail_in_a_line(const char* message, int code) { return fail(std::string("error: ") + visible_line(message), code); }

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
  } catch (const CLI::RequiredError& error) {
    // CLI11 does not say which word it is that names no command.
    const std::vector<std::string> words = app.remaining();
    if (!app.get_subcommands().empty() || words.empty()) return exit_of_parse(app, error);
    throw UsageError("there is no command called '" + words.front() + "'; stokes --help lists them");
  } catch (const CLI::ParseError& error) {
    return exit_of_parse(app, error);
  }
  for (const Command& command : commands)
    if (command.app->parsed()) {
      require_plain_values(*command.app);
      return command.run();
    }
  return kExitUsage;
}

int run_and_report(int argc, char** argv) {
  try {
    const int code = run(argc, argv);
    std::cout.flush();
    if (!std::cout) return fail("error: standard output cannot be written", kExitOutput);
    return code;
  } catch (const UsageError& e) {
    fail_in_a_line(e.what(), kExitUsage);
    return fail("stokes COMMAND --help lists the options", kExitUsage);
  } catch (const SceneMemoryError& e) {
    return fail(e.what(), kExitMemory);
  } catch (const SceneError& e) {
    return fail(e.what(), kExitBadInput);
  } catch (const InputError& e) {
    return fail_in_a_line(e.what(), kExitBadInput);
  } catch (const KernelBuildError& e) {
    return fail(std::string("error: ") + e.what() + "\n" + e.log(), kExitDevice);
  } catch (const DeviceError& e) {
    return fail(std::string("error: ") + e.what(), e.out_of_memory() ? kExitMemory : kExitDevice);
  } catch (const OutputError& e) {
    return fail_in_a_line(e.what(), kExitOutput);
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
  stokes::keep_standard_streams();
  const int code = stokes::run_and_report(argc, argv);
  stokes::tell_exit_code(code);
  return code;
}
