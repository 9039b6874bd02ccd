#include "benchmarks/baseline_runs.h"

#include <array>
#include <numbers>

#include "benchmarks/measure.h"
#include "planner/baselines/baselines.h"
#include "planner/bounds/bounds.h"
#include "planner/checks/exact_check.h"
#include "planner/checks/replay.h"
#include "planner/costs.h"
#include "planner/search/frame.h"
#include "planner/search/push_search.h"
#include "primitives/uncertainty.h"
#include "problems/published_regrasps.h"

namespace prehensile::benchmarks {
namespace {

/// The walls as they stand where gravity is to act along -y of W in this attitude; each
/// still touches the face that it touched.
void set_gravity(Scene& scene, int attitude) {
  constexpr double kQuarter = 0.5 * std::numbers::pi;
  constexpr std::array<const char*, 3> kFaces{"-x", "-y", "+y"};
  if (attitude == 0) scene.g_W = Vec2::Zero();
  if (attitude < 2) return;
  for (std::size_t i = 0; i < scene.pushers.size(); ++i) {
    scene.pushers[i].faces = {kFaces[i]};
    scene.pushers[i].normal_angle = attitude == 2 ? 0.0 : kQuarter;
  }
}

}  // namespace

std::vector<Problem> published_problems(int count) {
  std::vector<Problem> problems;
  for (int gravity = 0; gravity < 4; ++gravity) {
    for (const bool square : {true, false}) {
      for (int i = 0; i < count; ++i) {
        Problem problem{(square ? "square g" : "T g") + std::to_string(gravity),
                        square ? published_square(i) : published_tee(i)};
        set_gravity(problem.scene, gravity);
        problems.push_back(std::move(problem));
      }
    }
  }
  return problems;
}

std::vector<Problem> wide_problems(int count, std::uint64_t seed) {
  std::vector<Problem> problems;
  for (const bool gravity : {true, false}) {
    for (int i = 0; i < count; ++i) {
      problems.push_back({gravity ? "wide T g1" : "wide T g0",
                          random_among_walls(false, RegraspRange::kWide, gravity, seed,
                                             static_cast<std::uint64_t>(i))});
    }
  }
  return problems;
}

std::vector<Problem> tuning_problems(int count, std::uint64_t seed) {
  std::vector<Problem> problems;
  problems.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    problems.push_back(
        {"tuning", random_among_walls(i % 4 == 3, RegraspRange::kWide, i % 2 == 0, seed,
                                      static_cast<std::uint64_t>(i))});
  }
  return problems;
}

namespace {

Plan search(const SearchModel& model, const PlanOptions& options) {
  const Scene& scene = model.model->scene;
  Work work{.budget = options.budget};
  const PlannerFamily family = find_planner(options.planner)->family;
  if (family == PlannerFamily::kOwn) {
    return search_pushes(model, scene.start, *scene.goal, options, work);
  }
  if (family == PlannerFamily::kBaseline) {
    return search_by_baseline(model, scene.start, *scene.goal, options, work);
  }
  return solve_in_frame(model, scene.start, *scene.goal, options, work);
}

bool passes(const Model& model, const PlanOptions& options, Plan& plan) {
  if (plan.status != PlanStatus::kReachedGoal ||
      !check_exactly(model, options.transition, plan, nullptr) ||
      !reaches(*model.scene.goal, plan.goal)) {
    return false;
  }
  account(model, plan);
  const LowerBound bound = lower_bound(model, model.scene.start, *model.scene.goal,
                                       plan.cost, {.margin = plan.margin});
  plan.lower_bound = bound.value;
  plan.bound_is_trivial = bound.is_trivial;
  plan.bound_nodes = bound.nodes;
  return replay(model, plan).agrees;
}

}  // namespace

Run run_planner(const Problem& problem, const PlanOptions& options, bool robust) {
  const Model model = prepare(problem.scene);
  const Margin margin = robust ? usual_margin(model) : Margin::none();
  const SearchModel search_model = prepare_search(model, margin);
  Run run{problem.kind, problem.scene.name, options.planner, options.seed, {}};
  run.us = search_time_us([&] { run.plan = search(search_model, options); });
  run.plan.promise = robust ? Promise::kMargin : Promise::kNominal;
  run.solved = passes(model, options, run.plan);
  return run;
}

}  // namespace prehensile::benchmarks
