/// Uses the library as somebody would who works with OMPL.
#include "planner/ompl_interface.h"

#include <gtest/gtest.h>
#include <ompl/control/PathControl.h>
#include <ompl/control/planners/pdst/PDST.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/util/Console.h>

#include "tests/planner/ompl_regrasps.h"

namespace prehensile {
namespace {

namespace ob = ompl::base;
using testing::kNoBudget;

class OmplInterface : public ::testing::Test {
 protected:
  OmplInterface() { ompl::msg::noOutputHandler(); }
  ~OmplInterface() override { ompl::msg::restorePreviousOutputHandler(); }
};

TEST_F(OmplInterface, APlannerThatWeDoNotKnowSolvesOurProblem) {
  const Scene scene = testing::regrasps()[0];
  const Model model = prepare(scene);
  const SearchModel search = prepare_search(model, Margin{});
  Work work{.budget = kNoBudget};
  const PushProblem problem(search, scene.start, *scene.goal, work);

  ompl::control::PDST planner(problem.space_information());
  planner.setProblemDefinition(problem.definition());
  planner.setup();
  ASSERT_EQ(planner.solve(ob::timedPlannerTerminationCondition(10.0)),
            ob::PlannerStatus::EXACT_SOLUTION);

  const ob::PathPtr path = problem.definition()->getSolutionPath();
  EXPECT_TRUE(path->check());
  const auto pushes = pushes_along(problem, *path);
  ASSERT_TRUE(pushes);
  EXPECT_TRUE(reaches(*scene.goal, pushes->back().end));
}

TEST_F(OmplInterface, OurPlannerIsOneOfTheirs) {
  for (const Scene& scene : testing::regrasps()) {
    const Model model = prepare(scene);
    const SearchModel search = prepare_search(model, Margin{});
    Work work{.budget = kNoBudget};
    const PushProblem problem(search, scene.start, *scene.goal, work);

    const auto own = std::make_shared<PushPlanner>(problem, PlanOptions{});
    const ob::PlannerPtr planner = own;
    planner->setProblemDefinition(problem.definition());
    planner->setup();
    ASSERT_EQ(planner->solve(1.0), ob::PlannerStatus::EXACT_SOLUTION);
    ASSERT_TRUE(problem.definition()->hasExactSolution());

    const ob::PathPtr path = problem.definition()->getSolutionPath();
    const auto* states = dynamic_cast<ompl::geometric::PathGeometric*>(path.get());
    ASSERT_NE(states, nullptr);
    EXPECT_EQ(states->getStateCount(), own->plan().pushes.size() + 1);
    const auto pushes = pushes_along(problem, *path);
    ASSERT_TRUE(pushes);
    const PlanarPose& planned = own->plan().pushes.back().end.X_HO;
    EXPECT_NEAR(pushes->back().end.X_HO.x, planned.x, 1e-14);
    EXPECT_NEAR(pushes->back().end.X_HO.theta, planned.theta, 1e-14);

    planner->clear();
    EXPECT_EQ(own->plan().status, PlanStatus::kNotRun);
  }
}

TEST_F(OmplInterface, OurPlannerHonoursTheTerminationCondition) {
  const Scene scene = testing::hopeless_regrasp();
  const Model model = prepare(scene);
  const SearchModel search = prepare_search(model, Margin{});
  Work work{.budget = kNoBudget};
  const PushProblem problem(search, scene.start, *scene.goal, work);
  PushPlanner planner(problem, PlanOptions{});
  planner.setProblemDefinition(problem.definition());
  planner.setup();
  EXPECT_EQ(planner.solve(ob::plannerAlwaysTerminatingCondition()),
            ob::PlannerStatus::TIMEOUT);
  EXPECT_EQ(work.stick_tests, 0);
  EXPECT_EQ(planner.solve(0.05), ob::PlannerStatus::TIMEOUT);
  EXPECT_FALSE(problem.definition()->hasSolution());
}

TEST_F(OmplInterface, GoalSamplesAreMembersAndRunOut) {
  Scene scene = testing::square_scene();
  scene.goal = Goal{.y = scene.start.X_HO.y - 0.01};
  const Model model = prepare(scene);
  const SearchModel search = prepare_search(model, Margin{});
  Work work{.budget = kNoBudget};
  const PushProblem problem(search, scene.start, *scene.goal, work);
  const PushGoal& goal = *problem.goal();
  ob::State* state = problem.space_information()->allocState();
  const unsigned count = goal.maxSampleCount();
  EXPECT_GT(count, 5U);
  for (unsigned i = 0; i < 2 * count; ++i) {
    EXPECT_EQ(goal.couldSample(), i < count);
    goal.sampleGoal(state);
    EXPECT_TRUE(goal.isSatisfied(state));
    EXPECT_NEAR(goal.distanceGoal(state), 0.0, 1e-12);
    EXPECT_TRUE(problem.space_information()->isValid(state));
  }
  problem.space_information()->freeState(state);
}

}  // namespace
}  // namespace prehensile
