#include <atomic>
#include <csignal>
#include <cstdio>
#include <memory>

#include <CLI/CLI.hpp>

#include "apps/commands.h"
#include "apps/plan_report.h"
#include "apps/push_options.h"
#include "apps/table.h"
#include "io/plan_file.h"
#include "io/scene_file.h"
#include "planner/planner.h"

namespace prehensile::apps {
namespace {

std::atomic<bool> stop_requested{false};

/// The first signal asks the search to stop; a second one ends the program.
void request_stop(int signal) {
  stop_requested.store(true);
  std::signal(signal, SIG_DFL);
}

struct Options {
  SceneOptions scene;
  PlanOptions plan;
  std::string output = "plan.json";
  double margin = 1.0;
  bool no_polish = false;
};

int run(const Options& options) {
  const SceneFile file = read_scene(options.scene.file, options.scene.overrides);
  if (!file.scene.goal) {
    throw BadInput(options.scene.file + ": goal: missing: expected the wanted pose");
  }
  PlanOptions plan_options = options.plan;
  plan_options.margin = Margin{}.scaled(options.margin);
  plan_options.polish = !options.no_polish;
  plan_options.stop = &stop_requested;
  std::signal(SIGINT, request_stop);
  std::signal(SIGTERM, request_stop);

  const Model model = prepare(file.scene);
  note_pad_plane(model, "searched in the pad plane; every push is then checked in space");
  const Plan plan = plan_regrasp(model, plan_options);
  const std::string json = plan_to_json({file.scene, file.digest, plan});
  write_atomically(options.output, json);
  if (options.scene.json) {
    std::fputs(json.c_str(), stdout);
  } else {
    std::fputs(describe(model, plan).c_str(), stdout);
    std::printf("plan file: %s\n", options.output.c_str());
  }
  return plan.usable() ? kDone : kNegative;
}

}  // namespace

Command add_plan(CLI::App& app) {
  auto options = std::make_shared<Options>();
  CLI::App& command =
      *app.add_subcommand("plan", "plan a regrasp and write it to a file");
  add_scene_options(command, options->scene);
  command.add_option("-o,--output", options->output, "plan file to write")
      ->capture_default_str();
  command.add_option("--planner", options->plan.planner, "which planner searches")
      ->check(CLI::IsMember(planner_names()))
      ->capture_default_str();
  command.add_option("--seed", options->plan.seed, "of every random choice")
      ->capture_default_str();
  command
      .add_option("--budget", options->plan.budget,
                  "work: stick tests (own planner) or propagations (OMPL's)")
      ->check(CLI::Range(std::int64_t{1}, std::int64_t{1'000'000'000'000}))
      ->capture_default_str();
  command
      .add_option(
          "--time", options->plan.time_limit,
          "time limit in seconds; 0: none. The answer then depends on the machine")
      ->check(CLI::Range(0.0, 1e6));
  command
      .add_option(
          "--margin", options->margin,
          "factor on the default margin (10 % on friction, forces and torque radius, "
          "1 mm on places)")
      ->check(CLI::Range(0.0, 5.0))
      ->capture_default_str();
  command.add_flag("--no-polish", options->no_polish,
                   "keep the plan as the search found it");
  command.footer(
      "Example:\n  prehensile plan problems/published/tee_21.yaml -o plan.json --seed 7");
  return [options] { return run(*options); };
}

}  // namespace prehensile::apps
