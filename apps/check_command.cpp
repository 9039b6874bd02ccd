#include <cmath>
#include <cstdio>
#include <memory>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "apps/commands.h"
#include "apps/json_number.h"
#include "apps/mujoco_output.h"
#include "apps/option_checks.h"
#include "apps/parallel.h"
#include "apps/plan_report.h"
#include "apps/plan_samples.h"
#include "apps/push_options.h"
#include "apps/uncertainty_options.h"
#include "io/plan_file.h"
#include "planner/checks/replay.h"
#include "planner/planner.h"

namespace prehensile::apps {
namespace {

struct Options {
  std::string file;
  bool json = false;
  int samples = 0;  // 0: no sampling
  std::vector<std::string> vary;
  std::uint64_t seed = 1;
  int jobs = 0;
  double at_least = 0.0;  // share of success
  std::string success = "sticks";
  MujocoCheck mujoco;
};

/// What is uncertain: as the command line says, else the scene, else the usual box.
SampleOptions sampling(const Options& options, const Model& model) {
  SampleOptions sampling;
  const auto& stated = model.scene.uncertainty;
  sampling.box = parse_box(options.vary, stated ? stated_box(model.scene) : usual_box());
  if (stated && options.vary.empty()) sampling.spread = stated->spread;
  sampling.samples = options.samples;
  sampling.seed = options.seed;
  sampling.jobs = number_of_jobs(options.jobs);
  sampling.needs_goal = options.success == "goal";
  return sampling;
}

/// A refusal is checked by its proof; an undecided plan has nothing that could hold.
int check_refusal(const Model& model, const PlanFile& file, bool json) {
  std::string why;
  const bool proved =
      file.plan.status == PlanStatus::kInfeasible && verify(model, file.plan.proof, &why);
  if (file.plan.status != PlanStatus::kInfeasible) {
    why = "the file holds no plan: " + std::string(name(file.plan.status));
  }
  if (json) {
    const nlohmann::ordered_json out = {{"agrees", proved}, {"why", why}};
    std::printf("%s\n", out.dump(2).c_str());
  } else if (proved) {
    std::printf(
        "%s: the proof of infeasibility (%s) holds; in the words of the file: %s\n",
        file.scene.name.c_str(), std::string(name(file.plan.proof.kind)).c_str(),
        file.plan.proof.text.c_str());
  } else {
    std::printf("%s: FAILED: %s\n", file.scene.name.c_str(), why.c_str());
  }
  return proved ? kDone : kNegative;
}

nlohmann::ordered_json to_json(const Replay& replay) {
  nlohmann::ordered_json out = {{"agrees", replay.agrees},
                                {"why", replay.why},
                                {"starts_right", replay.starts_right},
                                {"connected", replay.connected},
                                {"reaches_goal", replay.reaches_goal},
                                {"costs_right", replay.costs_right},
                                {"bound_right", replay.bound_right},
                                {"confinement", replay.confinement},
                                {"instants", replay.instants},
                                {"pushes", nlohmann::ordered_json::array()}};
  for (const ReplayedPush& push : replay.pushes) {
    out["pushes"].push_back({{"agrees", push.agrees},
                             {"why", push.why},
                             {"status", std::string(name(push.transition.status))},
                             {"position_error", number(push.position_error)},
                             {"angle_error", number(push.angle_error)},
                             {"force_error", number(push.force_error)},
                             {"slack", number(push.slack)},
                             {"certificate", number(push.transition.worst_certificate)}});
  }
  return out;
}

int run(const Options& options) {
  check_mujoco_options(options.mujoco);
  const PlanFile file = read_plan(options.file);
  const Model model = prepare(file.scene);
  if (!file.plan.usable()) return check_refusal(model, file, options.json);
  check_carried(options.mujoco, model, file.plan);
  const Replay replayed = replay(model, file.plan);
  nlohmann::ordered_json json = to_json(replayed);
  std::string text = describe(model, file.plan, replayed);
  bool is_reached = true;
  if (options.samples > 0) {
    const SampleOptions how = sampling(options, model);
    const SampleReport report = sample_plan(model, file.plan, how);
    // A share that is typed is the nearest number to it, as is the quotient.
    is_reached =
        static_cast<double>(report.successes) / options.samples >= options.at_least;
    json["samples"] = to_json(report, how);
    json["samples"]["at_least"] = options.at_least;
    json["samples"]["is_reached"] = is_reached;
    text += describe(report, how);
    if (!is_reached) {
      text += "below the share asked for (--at-least " +
              std::to_string(options.at_least) + ")\n";
    }
  }
  bool is_seconded = true;
  if (options.mujoco.wanted) {
    const mjcf::MujocoReplay second = second_opinion(model, file.plan, options.mujoco);
    is_seconded = agrees(second);
    json["mujoco"] = mujoco_json(file.plan, second);
    text += describe(model, file.plan, second);
  }
  if (options.json) {
    std::printf("%s\n", json.dump(2).c_str());
  } else {
    std::fputs(text.c_str(), stdout);
  }
  return replayed.agrees && is_reached && is_seconded ? kDone : kNegative;
}

}  // namespace

Command add_check(CLI::App& app) {
  auto options = std::make_shared<Options>();
  CLI::App& command = *app.add_subcommand(
      "check", "replay a plan with the exact mechanics at half the step");
  command.add_option("PLAN", options->file, "plan file (JSON)")->required();
  command.add_flag("--json", options->json,
                   "print one JSON object on stdout, nothing else");
  command
      .add_option("--samples", options->samples,
                  "also follow the plan in this many members of its uncertainty")
      ->check(CLI::Range(1, 10'000'000));
  add_vary_option(command, options->vary).needs("--samples");
  command.add_option("--seed", options->seed, "of the samples")
      ->check(is_seed())
      ->needs("--samples")
      ->capture_default_str();
  command
      .add_option("--jobs", options->jobs,
                  "threads; 0: one per core. The answer is the same for any number")
      ->check(CLI::Range(0, 1024))
      ->needs("--samples")
      ->capture_default_str();
  command
      .add_option("--at-least", options->at_least,
                  "share of success below which the exit code is 1")
      ->check(in_range(0.0, 1.0))
      ->needs("--samples");
  command
      .add_option("--success", options->success,
                  "sticks: every push is done without slip; goal: the pose at the end is "
                  "a goal, too")
      ->check(CLI::IsMember({"sticks", "goal"}))
      ->needs("--samples")
      ->capture_default_str();
  add_mujoco_options(command, options->mujoco);
  command.footer(
      "Without --vary the samples are of the scene's uncertainty, or else of the usual "
      "margin.\nExample:\n  prehensile check plan.json\n"
      "  prehensile check plan.json --samples 2000 --vary friction=0.2,grasp_mm=1 "
      "--at-least 0.95\n"
      "  prehensile check plan.json --mujoco");
  return [options] { return run(*options); };
}

}  // namespace prehensile::apps
