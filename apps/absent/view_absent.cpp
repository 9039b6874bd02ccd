#include <CLI/CLI.hpp>

#include "apps/commands.h"
#include "apps/view_output.h"

namespace prehensile::apps {
namespace {

[[noreturn]] void refuse(const std::string& what) {
  throw BadInput(what +
                 ": this build has no viewer: expected one with PREHENSILE_VIEWER=ON");
}

}  // namespace

Command add_view(CLI::App& app) {
  CLI::App& command = *app.add_subcommand("view", "not in this build");
  command.allow_extras();
  return [] -> int { refuse("view"); };
}

void add_view_option(CLI::App& command, std::string& file) {
  command.add_option("--view", file, "not in this build");
}

void check_view_option(const std::string& file) {
  if (!file.empty()) refuse("--view " + file);
}

void check_view_files(const ViewFiles&) {}

bool write_view(const ViewFiles&, const std::vector<Shown>&) { return true; }

void write_refusal(const ViewFiles&, const std::string&) {}

}  // namespace prehensile::apps
