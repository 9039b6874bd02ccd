#include <cmath>
#include <cstdio>
#include <memory>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "apps/commands.h"
#include "apps/json_number.h"
#include "apps/plan_report.h"
#include "apps/push_options.h"
#include "io/plan_file.h"
#include "planner/planner.h"
#include "planner/replay.h"

namespace prehensile::apps {
namespace {

struct Options {
  std::string file;
  bool json = false;
};

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
    std::printf("%s: the proof of infeasibility holds: %s\n", file.scene.name.c_str(),
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
  const PlanFile file = read_plan(options.file);
  const Model model = prepare(file.scene);
  if (!file.plan.usable()) return check_refusal(model, file, options.json);
  const Replay replayed = replay(model, file.plan);
  if (options.json) {
    std::printf("%s\n", to_json(replayed).dump(2).c_str());
  } else {
    std::fputs(describe(model, file.plan, replayed).c_str(), stdout);
  }
  return replayed.agrees ? kDone : kNegative;
}

}  // namespace

Command add_check(CLI::App& app) {
  auto options = std::make_shared<Options>();
  CLI::App& command = *app.add_subcommand(
      "check", "replay a plan with the exact mechanics at half the step");
  command.add_option("PLAN", options->file, "plan file (JSON)")->required();
  command.add_flag("--json", options->json,
                   "print one JSON object on stdout, nothing else");
  command.footer("Example:\n  prehensile check plan.json");
  return [options] { return run(*options); };
}

}  // namespace prehensile::apps
