/// In builds without benchmark suites: the command says so.
#include <CLI/CLI.hpp>

#include "apps/commands.h"
#include "io/scene_file.h"

namespace prehensile::apps {

Command add_benchmark(CLI::App& app) {
  CLI::App& command =
      *app.add_subcommand("benchmark", "run a suite of problems (not in this build)");
  command.allow_extras();
  return []() -> int {
    throw BadInput(
        "benchmark: this build is without suites (PREHENSILE_SUITE=OFF): build with "
        "-DPREHENSILE_SUITE=ON, which needs SQLite (Debian: libsqlite3-dev)");
  };
}

}  // namespace prehensile::apps
