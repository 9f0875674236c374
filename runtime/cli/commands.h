// The subcommands: each adds itself to the command line and says what to run. Knows nothing of what they do.
#pragma once
#include <functional>
#include <stdexcept>
#include <string>

namespace CLI {
class App;
}

namespace stokes {

struct Command {
  CLI::App* app;
  std::function<int()> run;  ///< returns an ExitCode; called after parsing when `app` was given
};

/// The command line is wrong in a way that only the command itself can see. Exit code 64.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

Command add_render(CLI::App& root);
Command add_check(CLI::App& root);
Command add_devices(CLI::App& root);
Command add_compare(CLI::App& root);
Command add_parity(CLI::App& root);
Command add_bench(CLI::App& root);
Command add_plot(CLI::App& root);
Command add_merge(CLI::App& root);
Command add_info(CLI::App& root);
Command add_new(CLI::App& root);
Command add_view(CLI::App& root);
Command add_distribute(CLI::App& root);
Command add_status(CLI::App& root);

}  // namespace stokes
