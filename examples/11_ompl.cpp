/// A regrasp for a planner of OMPL's that is used as OMPL's users do: the problem is made
/// here, the planner is theirs, and what it finds becomes pushes again.
#include <cstdio>
#include <exception>
#include <numbers>

#include <ompl/control/planners/pdst/PDST.h>
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include "planner/checks/replay.h"
#include "planner/ompl_interface.h"

using namespace prehensile;

namespace {

Scene square_between_walls() {
  constexpr double kQuarter = 0.5 * std::numbers::pi;
  Scene scene;
  scene.object.shape = BoxShape{{0.1, 0.1, 0.03}};
  scene.object.mass = 0.5;
  scene.gripper.pad = DiscPad{.radius = 0.009};
  scene.gripper.friction = {0.9, 0.9};
  scene.gripper.grip_force = 25.0;
  scene.overhang = Overhang::kIgnore;
  scene.pushers = {{.name = "wall", .feature = LineFeature{}, .friction = 0.9},
                   {.name = "floor",
                    .feature = LineFeature{},
                    .friction = 0.9,
                    .normal_angle = kQuarter}};
  scene.goal = Goal{.x = 0.015, .y = 0.012, .theta = 0.1};
  return scene;
}

}  // namespace

int main() try {
  ompl::msg::noOutputHandler();
  ompl::RNG::setSeed(7);
  const Model model = prepare(square_between_walls());
  const SearchModel search = prepare_search(model, Margin::none());
  Work work{.budget = 100'000};
  const PushProblem problem(search, model.scene.start, *model.scene.goal, work);

  ompl::control::PDST planner(problem.space_information());
  planner.setProblemDefinition(problem.definition());
  planner.setup();
  planner.solve(ompl::base::timedPlannerTerminationCondition(10.0));
  if (!problem.definition()->hasExactSolution()) {
    std::printf("no plan\n");
    return 1;
  }
  const auto pushes = pushes_along(problem, *problem.definition()->getSolutionPath());
  if (!pushes) return 1;

  // Any pushes can be replayed with the exact mechanics, whoever found them.
  Plan plan;
  plan.start = model.scene.start;
  plan.margin = Margin::none();
  plan.pushes = *pushes;
  plan.goal = pushes->back().end;
  const Replay replayed = replay(model, plan);
  const bool done = replayed.connected && replayed.reaches_goal;
  std::printf("%s: %s\n", planner.getName().c_str(),
              done ? "its pushes end at the goal" : "its pushes miss the goal");
  return done ? 0 : 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
