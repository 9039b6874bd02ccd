#include <cmath>
#include <cstdio>

#include <gtest/gtest.h>
#include <ompl/base/PlannerData.h>
#include <ompl/base/ScopedState.h>
#include <ompl/control/planners/kpiece/KPIECE1.h>
#include <ompl/control/planners/rrt/RRT.h>
#include <ompl/control/planners/sst/SST.h>
#include <ompl/util/Console.h>

#include "planner/ompl_interface.h"
#include "planner/steering/chain.h"
#include "planner/steering/holding.h"
#include "tests/planner/ompl_regrasps.h"
#include "tests/support/random.h"

namespace prehensile {
namespace {

namespace ob = ompl::base;
namespace oc = ompl::control;
using testing::kNoBudget;
using testing::Random;

/// A problem with everything that it refers to.
struct Regrasp {
  explicit Regrasp(const Scene& scene, std::int64_t budget = kNoBudget)
      : model(prepare(scene)),
        search(prepare_search(model, Margin{})),
        work{.budget = budget},
        problem(search, scene.start, *scene.goal, work) {
    ompl::msg::noOutputHandler();
  }

  Model model;
  SearchModel search;
  Work work;
  PushProblem problem;
};

PushState random_state(Random& random) {
  return {{random.in_box(0.05, 0.05), random.in(-3.0, 3.0)}, 0.0};
}

PushState near(const PushState& from, Random& random) {
  const double turn = (random.chance(0.5) ? 1.0 : -1.0) * random.log_in(1e-3, 3.0);
  return {{from.flat.p_OF + random.in_disc(0.02), from.flat.theta + turn}, 0.0};
}

TEST(OmplSteps, StatesSurviveTheSpace) {
  Regrasp regrasp(testing::regrasps()[0]);
  const PushSpace& space = regrasp.problem.space();
  ob::ScopedState<> state(regrasp.problem.space_information());
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const PushState wanted = random_state(random);
    space.write(wanted, state.get());
    const PushState got = space.read(state.get());
    EXPECT_EQ(got.flat.p_OF, wanted.flat.p_OF);
    EXPECT_NEAR(got.flat.theta, wanted.flat.theta, 1e-15);
    space.write(got, state.get());
    EXPECT_EQ(space.read(state.get()).flat.theta, got.flat.theta);
  }
}

TEST(OmplSteps, DistanceIsTheTravelOfThePlanCost) {
  Regrasp regrasp(testing::regrasps()[0]);
  const auto& si = regrasp.problem.space_information();
  ob::ScopedState<> a(si), b(si);
  Random random(2);
  for (int i = 0; i < 100; ++i) {
    const PushState from = random_state(random);
    const PushState to = random_state(random);
    regrasp.problem.space().write(from, a.get());
    regrasp.problem.space().write(to, b.get());
    const double travel = std::hypot((to.flat.p_OF - from.flat.p_OF).norm(),
                                     regrasp.model.c * (to.flat.theta - from.flat.theta));
    EXPECT_NEAR(si->distance(a.get(), b.get()), travel, 1e-15);
  }
}

TEST(OmplSteps, ValidatorAgreesWithTheSticking) {
  Regrasp regrasp(testing::regrasps()[0]);
  const auto& si = regrasp.problem.space_information();
  ob::ScopedState<> a(si), b(si);
  Work uncounted{.budget = kNoBudget};
  Random random(3);
  int valid = 0;
  int one_way = 0;
  for (int i = 0; i < 20'000; ++i) {
    const PushState from = random_state(random);
    regrasp.problem.space().write(from, a.get());
    regrasp.problem.space().write(near(from, random), b.get());
    const FlatState start = regrasp.problem.space().read(a.get()).flat;
    const FlatState end = regrasp.problem.space().read(b.get()).flat;
    bool sticks = false;
    for (int contact = 0; contact < static_cast<int>(regrasp.search.contacts.size());
         ++contact) {
      const Move move{contact, start, end};
      sticks =
          sticks || (move_sticks(regrasp.search, contact, start, end, uncounted) &&
                     exact_slack(regrasp.search, move, uncounted) >= -kStickTolerance &&
                     pads_hold_gravity(regrasp.search, move, uncounted));
    }
    ASSERT_EQ(si->checkMotion(a.get(), b.get()), sticks);
    valid += sticks;
    one_way += sticks && !si->checkMotion(b.get(), a.get());
  }
  EXPECT_GT(valid, 2000);
  EXPECT_LT(valid, 18'000);
  EXPECT_GT(one_way, 1000);  // pushes cannot be undone by pushing back
}

TEST(OmplSteps, LastValidStateIsReachableAndTheNextIsNot) {
  Regrasp regrasp(testing::regrasps()[3]);
  const auto& si = regrasp.problem.space_information();
  ob::ScopedState<> a(si), b(si), last(si), beyond(si);
  Random random(4);
  int cut = 0;
  for (int i = 0; i < 3000; ++i) {
    const PushState from = random_state(random);
    regrasp.problem.space().write(from, a.get());
    regrasp.problem.space().write(random_state(random), b.get());
    if (!si->isValid(a.get())) continue;
    std::pair<ob::State*, double> last_valid{last.get(), -1.0};
    if (si->checkMotion(a.get(), b.get(), last_valid)) {
      EXPECT_EQ(last_valid.second, -1.0);  // OMPL: untouched where the motion is valid
      continue;
    }
    ASSERT_GE(last_valid.second, 0.0);
    ASSERT_LT(last_valid.second, 1.0);
    EXPECT_TRUE(si->isValid(last.get()));
    if (last_valid.second == 0.0) continue;
    ++cut;
    EXPECT_TRUE(si->checkMotion(a.get(), last.get()));
    si->getStateSpace()->interpolate(
        a.get(), b.get(), std::min(1.0, last_valid.second + 2e-3), beyond.get());
    EXPECT_FALSE(si->checkMotion(a.get(), beyond.get()));
  }
  EXPECT_GT(cut, 50);
}

TEST(OmplSteps, ControlsReproduceTheStepTheyStandFor) {
  Regrasp regrasp(testing::regrasps()[0]);
  PushSteps& steps = *regrasp.problem.steps();
  Random random(5);
  int steered = 0;
  for (int i = 0; i < 20'000; ++i) {
    const PushState from = random_state(random);
    const auto step = steps.join(from, near(from, random));
    if (!step) continue;
    ++steered;
    const auto again = steps.follow(from, steps.control_for(from, *step));
    ASSERT_TRUE(again);
    EXPECT_EQ(again->move_contact, step->move_contact);
    EXPECT_LT((again->to.flat.p_OF - step->to.flat.p_OF).norm(), 1e-9);
    EXPECT_NEAR(again->to.flat.theta, step->to.flat.theta, 1e-6);
  }
  EXPECT_GT(steered, 2000);
}

TEST(OmplSteps, ApproachKeepsThePlaceAndSticks) {
  Regrasp regrasp(testing::regrasps()[0]);
  PushSteps& steps = *regrasp.problem.steps();
  Work uncounted{.budget = kNoBudget};
  Random random(6);
  int clipped = 0;
  for (int i = 0; i < 5000; ++i) {
    const PushState from = random_state(random);
    const PushState to = near(from, random);
    for (int contact = 0; contact < steps.finish_letter(); ++contact) {
      const auto step = steps.approach(from, to, contact);
      if (!step) continue;
      EXPECT_EQ(step->to.flat.p_OF, to.flat.p_OF);
      EXPECT_TRUE(
          move_sticks(regrasp.search, contact, from.flat, step->to.flat, uncounted));
      clipped += std::abs(step->to.flat.theta - to.flat.theta) > 1e-6;
    }
  }
  EXPECT_GT(clipped, 1000);
}

TEST(OmplSteps, RefusedControlsGiveStatesThatNothingAccepts) {
  Regrasp regrasp(testing::regrasps()[0]);
  const auto& si = regrasp.problem.space_information();
  const auto sampler = si->allocControlSampler();
  ob::ScopedState<> from(si), to(si);
  regrasp.problem.space().write(state_of(regrasp.problem.start()), from.get());
  oc::Control* control = si->allocControl();
  int refused = 0;
  for (int i = 0; i < 2000; ++i) {
    sampler->sample(control);
    si->getStatePropagator()->propagate(from.get(), control, 1.0, to.get());
    const bool was_refused =
        std::isnan(regrasp.problem.space().read(to.get()).flat.theta);
    refused += was_refused;
    if (was_refused) {
      EXPECT_FALSE(si->isValid(to.get()));
      EXPECT_EQ(si->propagateWhileValid(from.get(), control, 1, to.get()), 0U);
    }
  }
  si->freeControl(control);
  EXPECT_GT(refused, 200);
  EXPECT_LT(refused, 1800);
}

/// Every node of a tree is a valid state that one push reaches from its parent.
void expect_tree_of_pushes(Regrasp& regrasp, const ob::PlannerPtr& planner) {
  planner->setProblemDefinition(regrasp.problem.definition());
  planner->setup();
  planner->solve(ob::PlannerTerminationCondition([&] { return regrasp.work.spent(); }));
  EXPECT_EQ(regrasp.work.propagations, regrasp.work.budget);

  ob::PlannerData data(regrasp.problem.space_information());
  planner->getPlannerData(data);
  const std::int64_t propagations = std::exchange(regrasp.work.propagations, 0);
  EXPECT_GT(data.numVertices(), 100U);
  EXPECT_LT(data.numVertices(), propagations);  // refusals made no nodes
  for (unsigned v = 0; v < data.numVertices(); ++v) {
    const ob::State* state = data.getVertex(v).getState();
    ASSERT_TRUE(regrasp.problem.space_information()->isValid(state));
    std::vector<unsigned> children;
    data.getEdges(v, children);
    for (const unsigned child : children) {
      ASSERT_TRUE(regrasp.problem.space_information()->checkMotion(
          state, data.getVertex(child).getState()));
    }
  }
  EXPECT_FALSE(regrasp.problem.definition()->hasExactSolution());
  EXPECT_TRUE(regrasp.problem.definition()->hasApproximateSolution());
}

TEST(OmplSteps, TreesHoldPushesOnly) {
  Regrasp rrt(testing::hopeless_regrasp(), 5000);
  expect_tree_of_pushes(rrt, std::make_shared<oc::RRT>(rrt.problem.space_information()));
  Regrasp kpiece(testing::hopeless_regrasp(), 5000);
  expect_tree_of_pushes(
      kpiece, std::make_shared<oc::KPIECE1>(kpiece.problem.space_information()));
}

}  // namespace
}  // namespace prehensile
