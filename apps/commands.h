/// The commands of the `prehensile` program. Each adds itself to the command line and,
/// when chosen, runs and returns an exit code.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace prehensile::apps {

/// 0 done; 1 a well-posed question with a negative answer; 2 bad input; 3 internal fault.
enum ExitCode { kDone = 0, kNegative = 1, kBadInput = 2, kInternalFault = 3 };

using Command = std::function<int()>;

/// Options that several commands share.
struct SceneOptions {
  std::string file;
  std::vector<std::string> overrides;  ///< path=value
  bool json = false;
};
void add_scene_options(CLI::App& command, SceneOptions& options);

/// The line that a user would type to start this process again, for records of results.
void remember_command_line(int argc, char** argv);
const std::string& command_line();

Command add_plan(CLI::App& app);
Command add_check(CLI::App& app);
Command add_calibrate(CLI::App& app);
Command add_query_instant(CLI::App& query);
Command add_query_push(CLI::App& query);
Command add_query_sweep(CLI::App& query);
Command add_query_cone(CLI::App& query);
Command add_query_spread(CLI::App& query);
Command add_query_contact(CLI::App& query);
Command add_query_place(CLI::App& query);
Command add_inspect(CLI::App& app);
Command add_report(CLI::App& app);
Command add_benchmark(CLI::App& app);
Command add_view(CLI::App& app);
Command add_mesh(CLI::App& app);  ///< not in builds without meshes

}  // namespace prehensile::apps
