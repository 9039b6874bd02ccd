/// The command line: parses, dispatches, and turns every failure into one message and an
/// exit code.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include "apps/commands.h"
#include "apps/option_checks.h"
#include "apps/version.h"
#include "io/scene_file.h"

namespace prehensile::apps {

void add_scene_options(CLI::App& command, SceneOptions& options) {
  command.add_option("SCENE", options.file, "scene file (YAML)")->required();
  command
      .add_option("--set", options.overrides,
                  "override a field of the scene: gripper.grip_force=30 (repeatable)")
      ->allow_extra_args(false);
  command.add_flag("--json", options.json,
                   "print one JSON object on stdout, nothing else");
}

namespace {

std::string remembered_line;

/// A word in place of a command that is none; CLI11 says only that one is required.
void refuse_unknown_command(const CLI::App& parent, const char* word) {
  if (!word || *word == '-') return;
  std::string known;
  for (const CLI::App* command :
       parent.get_subcommands([](const CLI::App*) { return true; })) {
    if (command->get_name() == word) return;
    known += (known.empty() ? "" : ", ") + command->get_name();
  }
  throw BadInput(std::string(word) + ": no such command: expected one of " + known);
}

/// The first word of the command line that the command does not know; CLI11 names them
/// last to first.
std::string unknown_word(const CLI::App& app, int argc, char** argv) {
  const CLI::App* command = &app;
  std::string name;
  while (!command->get_subcommands().empty()) {
    command = command->get_subcommands().front();
    name += command->get_name() + ' ';
  }
  const std::vector<std::string> unknown = app.remaining(true);
  for (int i = 1; i < argc; ++i) {
    if (std::find(unknown.begin(), unknown.end(), argv[i]) == unknown.end()) continue;
    return std::string(argv[i]) + ": not expected here: expected what `prehensile " +
           name + "--help` lists";
  }
  return name + ": a word that is not expected";
}

int run(int argc, char** argv) {
  CLI::App app{
      "Plans how a robot re-grips what it holds by pushing it against its surroundings"};
  app.set_version_flag("--version", version());
  app.require_subcommand(1);
  app.footer(
      "Example:\n  prehensile plan problems/published/square_01.yaml -o plan.json\n"
      "Exit code: 0 done, 1 negative answer, 2 bad input, 3 internal fault.");
  CLI::App& query = *app.add_subcommand("query", "ask the mechanics or a single push");
  query.require_subcommand(1);

  const Command plan = add_plan(app);
  const Command check = add_check(app);
  const Command calibrate = add_calibrate(app);
  const Command instant = add_query_instant(query);
  const Command push = add_query_push(query);
  const Command sweep = add_query_sweep(query);
  const Command cone = add_query_cone(query);
  const Command spread = add_query_spread(query);
  const Command contact = add_query_contact(query);
  const Command place = add_query_place(query);
  const Command inspect = add_inspect(app);
  const Command report = add_report(app);
  const Command benchmark = add_benchmark(app);
  const Command view = add_view(app);
  std::vector<std::pair<CLI::App*, Command>> commands = {
      {app.get_subcommand("plan"), plan},
      {app.get_subcommand("check"), check},
      {app.get_subcommand("calibrate"), calibrate},
      {query.get_subcommand("instant"), instant},
      {query.get_subcommand("push"), push},
      {query.get_subcommand("sweep"), sweep},
      {query.get_subcommand("cone"), cone},
      {query.get_subcommand("spread"), spread},
      {query.get_subcommand("contact"), contact},
      {query.get_subcommand("place"), place},
      {app.get_subcommand("inspect"), inspect},
      {app.get_subcommand("report"), report},
      {app.get_subcommand("benchmark"), benchmark},
      {app.get_subcommand("view"), view}};
#ifdef PREHENSILE_HAS_MESHES
  const Command mesh = add_mesh(app);
  commands.emplace_back(app.get_subcommand("mesh"), mesh);
#endif
  if (argc > 1) refuse_unknown_command(app, argv[1]);
  if (argc > 2 && argv[1] == query.get_name()) refuse_unknown_command(query, argv[2]);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ExtrasError&) {
    throw BadInput(unknown_word(app, argc, argv));
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kDone : kBadInput;
  }
  for (const auto& [subcommand, command] : commands) {
    if (!subcommand->parsed()) continue;
    check_outputs(*subcommand);
    return command();
  }
  return kInternalFault;
}

}  // namespace

void remember_command_line(int argc, char** argv) {
  remembered_line.clear();
  for (int i = 0; i < argc; ++i) {
    remembered_line += (i > 0 ? " " : "") + std::string(argv[i]);
  }
}

const std::string& command_line() { return remembered_line; }

}  // namespace prehensile::apps

int main(int argc, char** argv) {
  using namespace prehensile::apps;
  try {
    remember_command_line(argc, argv);
    const int code = run(argc, argv);
    // Also what failed in an earlier flush, after which this one has nothing to do.
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
      std::fprintf(stderr, "prehensile: cannot write the output\n");
      return kInternalFault;
    }
    return code;
  } catch (const prehensile::BadInput& bad) {
    std::fprintf(stderr, "%s\n", bad.what());
    return kBadInput;
  } catch (const std::exception& fault) {
    std::fprintf(stderr, "prehensile: internal fault: %s\n", fault.what());
    return kInternalFault;
  }
}
