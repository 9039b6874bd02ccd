#include <cstdio>
#include <memory>

#include <CLI/CLI.hpp>

#include "apps/arm_options.h"
#include "apps/commands.h"
#include "apps/interrupt.h"
#include "apps/option_checks.h"
#include "apps/plan_report.h"
#include "apps/planner_options.h"
#include "apps/progress_line.h"
#include "apps/push_options.h"
#include "apps/table.h"
#include "apps/view_output.h"
#include "io/object_surface.h"
#include "io/plan_file.h"
#include "io/scene_file.h"
#include "planner/advice.h"
#include "planner/planner.h"
#include "primitives/uncertainty.h"

namespace prehensile::apps {
namespace {

struct Options {
  SceneOptions scene;
  PlanOptions plan;
  PlannerChoice planner;
  ArmOptions arm;
  std::string output = "plan.json";
  std::string view;
  double margin = 1.0;
  bool weightless = false;
  double progress_seconds = 1.0;
  bool nominal = false, robust = false, no_polish = false, no_advice = false;
};

/// The box that the plan is to survive, as the options say.
void set_margin(const Options& options, const Model& model, PlanOptions& plan) {
  if (options.nominal) {
    plan.margin = Margin::none();
  } else if (options.robust) {
    plan.margin = margin_of(model, box_of(model.scene));
    plan.promise = Promise::kScene;
  } else {
    plan.margin = usual_margin(model).scaled(options.margin);
  }
  plan.margin->weightless = options.weightless;
}

bool has_less_than_asked(const Plan& plan) {
  return plan.promise == Promise::kNominalOnly || plan.promise == Promise::kPartOfMargin;
}

/// Plans; where that fails, or nothing survives the margin, says what would help.
Plan planned(const Options& options, const Model& model) {
  ProgressLine line(options.progress_seconds);
  PlanOptions plan_options = options.plan;
  set_planner(options.planner, plan_options);
  set_margin(options, model, plan_options);
  plan_options.polish = !options.no_polish;
  plan_options.stop = &stop_on_signals();
  plan_options.progress = [&line](const SearchProgress& p) { line.show(p); };
  Plan plan = plan_regrasp(model, plan_options);
  const bool needs_advice = !plan.usable() || has_less_than_asked(plan);
  const bool has_answer = plan.status != PlanStatus::kStopped &&
                          plan.status != PlanStatus::kUnsupported && !plan.stopped_early;
  if (needs_advice && has_answer && !options.no_advice) {
    plan.explanation = explain(model, plan, plan_options);
  }
  return plan;
}

int run(const Options& options) {
  check_view_option(options.view);
  const SceneFile file = read_scene(options.scene.file, options.scene.overrides);
  if (!file.scene.goal) {
    throw BadInput(options.scene.file + ": goal: missing: expected the wanted pose");
  }
  if (options.robust && box_of(file.scene).active().empty()) {
    throw BadInput(options.scene.file + ": uncertainty: " +
                   (file.scene.uncertainty ? "all widths are 0" : "missing") +
                   ": expected with --robust, as in "
                   "uncertainty: {friction: 0.2, start_position: 0.001}");
  }

  check_arm_options(options.arm, file.scene);
  const Model model = prepare(file.scene);
  note_pad_plane(model, "searched in the pad plane; every push is then checked in space");
  const PlanFile written{file.scene, file.digest, planned(options, model)};
  const Plan& plan = written.plan;
  const std::string json = plan_to_json(written);
  const ArmTexts arm =
      arm_texts(options.arm, model, written);  // first, for it may refuse
  write_atomically(options.output, json);
  for (const ArmTexts::File& one : arm.files) write_atomically(one.name, one.text);
  if (!options.view.empty())
    write_view({.page = options.view},
               {{model,
                 plan,
                 true,
                 {},
                 read_object_surface(options.scene.file, options.scene.overrides)}});
  if (options.scene.json) {
    std::fputs(json.c_str(), stdout);
    std::fputs(arm.report.c_str(), stderr);
  } else {
    std::fputs(describe(model, plan).c_str(), stdout);
    std::printf("plan file: %s\n", options.output.c_str());
    std::fputs(arm.report.c_str(), stdout);
    if (!options.view.empty()) std::printf("page: %s\n", options.view.c_str());
  }
  const bool is_answer = plan.usable() && !(options.robust && has_less_than_asked(plan));
  return is_answer ? kDone : kNegative;
}

}  // namespace

Command add_plan(CLI::App& app) {
  auto options = std::make_shared<Options>();
  CLI::App& command =
      *app.add_subcommand("plan", "plan a regrasp and write it to a file");
  add_scene_options(command, options->scene);
  command.add_option("-o,--output", options->output, "plan file to write")
      ->check(is_output())
      ->capture_default_str();
  add_planner_options(command, options->planner);
  command.add_option("--seed", options->plan.seed, "of every random choice")
      ->check(is_seed())
      ->capture_default_str();
  command
      .add_option("--budget", options->plan.budget,
                  "work: stick tests, and propagations of the other planners")
      ->check(CLI::Range(std::int64_t{1}, std::int64_t{1'000'000'000'000}))
      ->capture_default_str();
  command
      .add_option(
          "--time", options->plan.time_limit,
          "time limit in seconds; 0: none. The answer then depends on the machine")
      ->check(in_range(0.0, 1e6));
  CLI::Option* const margin =
      command
          .add_option("--margin", options->margin,
                      "factor on the usual margin: frictions of pushers 10 % and fingers "
                      "5 %, grip force 3 %, mass 1 %, torque radius 10 %, centre of mass "
                      "0.7 mm, start in the hand 0.5 mm, pusher 1 mm and 0.5 deg")
          ->check(in_range(0.0, 5.0))
          ->capture_default_str();
  CLI::Option* const nominal = command.add_flag(
      "--nominal", options->nominal, "plan for the values of the scene only: no margin");
  CLI::Option* const robust =
      command.add_flag("--robust", options->robust,
                       "plan for the uncertainty that the scene states; exit code 1 if "
                       "only a nominal plan is found");
  margin->excludes(nominal)->excludes(robust);
  nominal->excludes(robust);
  command.add_flag("--no-help-of-gravity", options->weightless,
                   "plan pushes that stick without gravity as well");
  command.add_flag("--improve", options->plan.improve,
                   "search on for cheaper plans after the first one, until the budget, "
                   "the time or Ctrl-C ends it");
  command
      .add_option("--progress-s", options->progress_seconds,
                  "seconds between lines of progress, and before the first")
      ->check(in_range(0.0, 1e6))
      ->capture_default_str();
  command
      .add_option(
          "--ease", options->plan.ease,
          "share of its cost that a plan with a margin may cost more to slip less "
          "easily beyond it; 0: the cheapest")
      ->check(in_range(0.0, 1.0))
      ->capture_default_str();
  command.add_flag(
      "--beside-goal", options->plan.beside_goal,
      "with a margin: end beside the goal, within its tolerances, where that "
      "is cheaper, though less of the margin then ends at the goal");
  command.add_flag("--no-polish", options->no_polish,
                   "keep the plan as the search found it");
  command.add_flag("--no-advice", options->no_advice,
                   "where there is no plan, do not look for changes that would help");
  add_arm_options(command, options->arm);
  add_view_option(command, options->view);
  command.footer(
      "Where no plan survives the margin, a nominal one is looked for, then one that "
      "survives a\npart of it, and marked as such.\n"
      "Ctrl-C keeps the best plan found so far and writes it: exit code 0 if there is "
      "one,\n1 if there is none; a second Ctrl-C ends the program.\n"
      "Example:\n  prehensile plan problems/published/tee_21.yaml -o plan.json --seed 7\n"
      "  prehensile plan problems/published/tee_21.yaml --arm arm.csv --arm arm.tum");
  return [options] { return run(*options); };
}

}  // namespace prehensile::apps
