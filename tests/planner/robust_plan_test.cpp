/// Plans survive the box that they were planned for.
#include <cmath>
#include <cstdio>
#include <map>
#include <string>

#include <gtest/gtest.h>

#include "planner/bounds/bounds.h"
#include "planner/checks/plan_trial.h"
#include "planner/checks/replay.h"
#include "tests/planner/planner_cases.h"

namespace prehensile {
namespace {

struct Tally {
  int plans = 0, less = 0, trials = 0, slips = 0, falls = 0;
  double cost_ratio = 0.0;  ///< sum over plans, against the nominal plan
  double worst_ratio = 0.0;
  int above = 0;  ///< plans whose cost is more than 1.1 times that of the nominal one

  void print(const char* what) const {
    std::printf(
        "%s: %d plans (%d with less), cost %.3f x nominal, worst %.2f x, %d "
        "above 1.1 x; %d draws, %d slip, %d fall\n",
        what, plans, less, cost_ratio / plans, worst_ratio, above, trials, slips, falls);
  }
};

/// Corners of the box and points inside it by turns.
BoxPoint draw(const UncertaintyBox& box, std::uint64_t seed, int i) {
  const auto index = static_cast<std::uint64_t>(i);
  if (i % 2 == 0) return random_point(seed, index);
  const BoxPoint bits = random_point(seed + 1, index);
  BoxPoint out{};
  for (const Unknown unknown : box.active()) {
    const auto k = static_cast<std::size_t>(unknown);
    out[k] = bits[k] > 0.0 ? 1.0 : -1.0;
  }
  return out;
}

void add(const Scene& scene, const UncertaintyBox& box, int draws, Tally& tally) {
  const Model model = prepare(scene);
  PlanOptions options;
  options.margin = margin_of(model, box);
  const Plan plan = plan_regrasp(model, options);
  ASSERT_TRUE(plan.usable()) << scene.name;
  EXPECT_TRUE(replay(model, plan).agrees) << scene.name;
  ++tally.plans;
  if (plan.promise != Promise::kMargin) {
    ++tally.less;
    return;
  }
  options.margin = Margin::none();
  const double ratio = plan.cost / plan_regrasp(model, options).cost;
  tally.cost_ratio += ratio;
  tally.worst_ratio = std::max(tally.worst_ratio, ratio);
  tally.above += ratio > 1.1;
  for (int i = 0; i < draws; ++i) {
    const PlanTrial trial = try_plan(model, plan, box, draw(box, 5, i));
    ++tally.trials;
    if (trial.sticks) continue;
    // Start and goal are not the planner's choice: held nominally, they may not be held
    // everywhere in the box.
    const bool falls = trial.status == TransitionStatus::kFalls;
    tally.falls += falls;
    tally.slips += !falls;
    if (!falls) {
      ADD_FAILURE() << scene.name << ", draw " << i << ": push " << trial.failed_push + 1
                    << " of " << plan.pushes.size() << ' ' << name(trial.status)
                    << ", slipped " << trial.slipped;
    }
  }
}

Tally published(const UncertaintyBox& box, int step, int draws) {
  Tally tally;
  for (int i = 0; i < kPublishedRegrasps; i += step) {
    add(published_square(i), box, draws, tally);
    add(published_tee(i), box, draws, tally);
  }
  return tally;
}

TEST(RobustPlan, SticksEverywhereInTheUsualBox) {
  const Tally tally = published(usual_box(), 5, 40);
  tally.print("published, usual box");
  EXPECT_EQ(tally.slips, 0);
  EXPECT_EQ(tally.less, 0);
}

TEST(RobustPlan, FullSticksEverywhereInTheUsualBox) {
  const Tally tally = published(usual_box(), 1, 1000);
  tally.print("published, usual box");
  EXPECT_EQ(tally.slips, 0);
  EXPECT_EQ(tally.less, 0);
  EXPECT_GE(tally.trials, 100'000);
  EXPECT_LE(tally.cost_ratio / tally.plans, 1.1);
}

/// Twice the usual box, and pushes of several kinds.
TEST(RobustPlan, FullSticksEverywhereInAWiderBox) {
  UncertaintyBox box = usual_box();
  for (double& width : box.half_width) width *= 2.0;
  Tally tally = published(box, 2, 200);
  tally.print("published, twice the usual box");
  EXPECT_EQ(tally.slips, 0);
  Tally random;
  for (int i = 0; i < 60; ++i) {
    add(random_regrasp(RegraspFamily::kBox, 21, i).scene, usual_box(), 200, random);
    add(random_regrasp(RegraspFamily::kTee, 21, i).scene, usual_box(), 200, random);
  }
  random.print("random, usual box");
  EXPECT_EQ(random.slips, 0);
}

/// Plans made over the ellipsoid, done by discs of the same torque radius that so many
/// points stand for that they are even.
void do_by_discs(RegraspRange range, int problems, double at_least) {
  int plans = 0;
  int done = 0;
  for (int i = 0; i < problems; ++i) {
    const auto index = static_cast<std::uint64_t>(i / 4);
    const Scene discs = random_among_walls(i % 2 == 0, range, i % 4 < 2, 1, index);
    PlanOptions options;
    options.nominal_if_needed = false;
    const Plan plan = plan_regrasp(prepare(with_soft_points(discs)), options);
    if (!plan.usable()) continue;
    ++plans;
    const Model model = prepare(discs, {.points_per_pad = 64});
    Grasp grasp = plan.start;
    bool sticks = true;
    for (const PlannedPush& push : plan.pushes) {
      const Transition moved = apply(model, grasp, push.push);
      sticks = sticks && moved.completed() && moved.slipped <= 1e-5;
      grasp = moved.end;
    }
    done += sticks && reaches(*discs.goal, grasp) ? 1 : 0;
  }
  std::printf("%d plans over soft points, %d done by discs\n", plans, done);
  EXPECT_GE(plans, 3 * problems / 4);
  EXPECT_GE(done, at_least * plans);
}

TEST(RobustPlan, MadeOverSoftPointsHoldsOverDiscs) {
  do_by_discs(RegraspRange::kPublished, 60, 1.0);
}

TEST(RobustPlan, FullMadeOverSoftPointsHoldsOverDiscs) {
  do_by_discs(RegraspRange::kPublished, 600, 0.99);
  do_by_discs(RegraspRange::kWide, 400, 0.99);
}

/// A tilt carries the finger axis off: later pushes of a long plan must know.
TEST(RobustPlan, CountsTheDriftOfEarlierPushes) {
  const Margin margin{.grasp = 1e-3, .tilt = 0.01};
  EXPECT_DOUBLE_EQ(carried(margin, 0.1).grasp, 2e-3);
  const Model model = prepare(published_square(0));
  SearchModel search = prepare_search(model, margin);
  const Vec2 away = search.p_OF_start + Vec2(0.03, 0.04);
  EXPECT_DOUBLE_EQ(search.margin_from(away).grasp, 1e-3 + 0.01 * 0.05);
  EXPECT_EQ(search.margin_from(search.p_OF_start).grasp, 1e-3);
}

/// What a plan has of a margin that no plan survives: none, or the greatest of the parts
/// that are tried, and says so.
TEST(RobustPlan, SaysSoWhereNoPlanSurvivesTheMargin) {
  std::map<int, int> quarters;
  for (int i = 0; i < 20; ++i) {
    const Model model = prepare(published_tee(i / 2));
    PlanOptions options;
    options.budget = 200'000;
    Margin asked = Margin{}.scaled(4.0);
    asked.tilt = i % 2 == 0 ? 0.2 : 2.0;
    asked.grasp = 0.01;
    options.margin = asked;
    const Plan plan = plan_regrasp(model, options);
    ASSERT_TRUE(plan.usable());
    EXPECT_TRUE(replay(model, plan).agrees);
    const double share = plan.margin.friction / asked.friction;
    EXPECT_NEAR(plan.margin.tilt, share * asked.tilt, 1e-12);
    ++quarters[static_cast<int>(std::lround(4.0 * share))];
    if (plan.promise == Promise::kMargin) continue;
    EXPECT_EQ(plan.promise,
              share == 0.0 ? Promise::kNominalOnly : Promise::kPartOfMargin);
    const std::string said =
        share == 0.0 ? "is nominal"
                     : std::to_string(std::lround(100.0 * share)) + " % of it";
    EXPECT_NE(plan.message.find(said), std::string::npos) << plan.message;
    options.nominal_if_needed = false;
    options.margin = asked.scaled(share + 0.25);
    EXPECT_FALSE(plan_regrasp(model, options).usable());
  }
  EXPECT_GT(quarters[0], 0);
  EXPECT_GT(quarters[1] + quarters[2] + quarters[3], 0);
}

/// Work told of while a plan with the margin is looked for, of a regrasp for which none
/// is found.
std::int64_t work_with_margin(Promise promise) {
  const Model model =
      prepare(random_among_walls(false, RegraspRange::kWide, false, 1, 37));
  std::int64_t most = 0;
  PlanOptions options;
  options.budget = 10'000'000;
  options.promise = promise;
  bool falls_back = false;
  options.progress = [&](const SearchProgress& progress) {
    falls_back = falls_back || progress.stage == "search without margin";
    if (!falls_back) most = std::max(most, progress.tests);
  };
  EXPECT_NE(plan_regrasp(model, options).promise, promise);
  EXPECT_TRUE(falls_back);
  return most;
}

/// Five million go into the usual margin; a box that was stated has the whole budget.
TEST(RobustPlan, ANominalPlanNeedNotWaitForTheWholeBudget) {
  EXPECT_LT(work_with_margin(Promise::kMargin), 5'100'000);
  EXPECT_GT(work_with_margin(Promise::kScene), 7'000'000);
}

/// Not beside it at the border of its tolerances, though that saves placements.
TEST(RobustPlan, EndsAtTheGoalInMostDraws) {
  constexpr int kDraws = 60;
  int plans = 0, reached = 0;
  for (int i = 0; i < 60; ++i) {
    const Model model =
        prepare(random_among_walls(false, RegraspRange::kPublished, true, 1, i));
    const Plan plan = plan_regrasp(model);
    ASSERT_TRUE(plan.usable()) << i;
    if (plan.promise != Promise::kMargin) continue;
    ++plans;
    for (int k = 0; k < kDraws; ++k) {
      reached += try_plan(model, plan, usual_box(), random_point(7, k)).reaches;
    }
  }
  std::printf("%d plans end at the goal in %.1f %% of their draws\n", plans,
              100.0 * reached / (kDraws * plans));
  EXPECT_GT(plans, 50);
  EXPECT_GT(reached, 0.95 * kDraws * plans);
}

/// Beside it where asked to, for less; where not, a bound of its own says what an end at
/// the goal itself must cost.
TEST(RobustPlan, EndsBesideTheGoalWhereAskedTo) {
  int cheaper = 0, bounded = 0, near = 0;
  for (int i = 0; i < 60; ++i) {
    const Model model =
        prepare(random_among_walls(false, RegraspRange::kPublished, true, 1, i));
    const Goal itself = goal_itself(*model.scene.goal);
    const Plan at = plan_regrasp(model);
    const Plan beside = plan_regrasp(model, {.beside_goal = true});
    ASSERT_TRUE(at.usable() && beside.usable()) << i;
    EXPECT_LE(beside.cost, 1.02 * at.cost) << i;
    EXPECT_TRUE(replay(model, beside).agrees) << i;
    if (beside.cost < 0.95 * at.cost) {
      ++cheaper;
      EXPECT_FALSE(reaches(itself, beside.goal)) << i;
      EXPECT_FALSE(beside.bound_at_goal) << i;
      Plan claims = beside;
      claims.bound_at_goal = 0.5 * claims.cost;
      EXPECT_FALSE(replay(model, claims).agrees) << i;
    }
    if (!at.bound_at_goal) continue;
    ++bounded;
    near += at.cost <= 1.1 * *at.bound_at_goal;
    EXPECT_TRUE(reaches(itself, at.goal)) << i;
    EXPECT_GT(*at.bound_at_goal, at.lower_bound) << i;
    EXPECT_LE(*at.bound_at_goal, at.cost) << i;
    EXPECT_TRUE(replay(model, at).agrees) << i;
    Plan claims = at;
    claims.bound_at_goal = 1.03 * at.cost;
    EXPECT_FALSE(replay(model, claims).agrees) << i;
  }
  std::printf(
      "%d of 60 plans cheaper beside the goal; %d bounds of plans to the goal "
      "itself, %d of them within 10 %%\n",
      cheaper, bounded, near);
  EXPECT_GT(cheaper, 0);
  EXPECT_GT(near, 0);
}

TEST(PlanTrial, TheMiddleOfTheBoxIsThePlan) {
  for (int i = 0; i < 10; ++i) {
    const Model model = prepare(published_tee(i));
    const Plan plan = plan_regrasp(model);
    const PlanTrial trial = try_plan(model, plan, usual_box(), BoxPoint{});
    EXPECT_TRUE(trial.sticks && trial.reaches) << i;
    EXPECT_EQ(trial.failed_push, -1);
    EXPECT_NEAR(trial.end.X_HO.x, plan.goal.X_HO.x, 1e-6);
    EXPECT_NEAR(trial.end.X_HO.theta, plan.goal.X_HO.theta, 1e-6);
  }
}

/// Without a push the object stays as it is held, which may be beside the goal, or fall.
TEST(PlanTrial, NothingToDoMayBeWrong) {
  Scene scene = published_tee(20);
  scene.goal->x = scene.start.X_HO.x;
  scene.goal->y = scene.start.X_HO.y;
  scene.goal->theta = scene.start.X_HO.theta;
  const Model model = prepare(scene);
  const Plan plan = plan_regrasp(model);
  ASSERT_EQ(plan.status, PlanStatus::kNothingToDo);
  EXPECT_TRUE(try_plan(model, plan, usual_box(), BoxPoint{}).reaches);
  UncertaintyBox box;
  box[Unknown::kGraspX] = 0.02;
  int held = 0, reached = 0;
  for (int i = 0; i < 100; ++i) {
    const PlanTrial trial = try_plan(model, plan, box, random_point(1, i));
    held += trial.sticks;
    reached += trial.reaches;
  }
  EXPECT_EQ(held, 100);
  EXPECT_LT(reached, 20);
  box = {};
  box[Unknown::kGripForce] = 0.95;
  BoxPoint weak{};
  weak[static_cast<std::size_t>(Unknown::kGripForce)] = -1.0;
  EXPECT_FALSE(try_plan(model, plan, box, weak).sticks);
}

TEST(PlanTrial, SaysWhichPushFails) {
  const Model model = prepare(published_tee(0));
  PlanOptions options;
  options.margin = Margin::none();
  const Plan plan = plan_regrasp(model, options);
  UncertaintyBox box;
  box[Unknown::kFriction] = 0.99;
  BoxPoint slippery{};
  slippery[static_cast<std::size_t>(Unknown::kFriction)] = -1.0;
  const PlanTrial trial = try_plan(model, plan, box, slippery);
  EXPECT_FALSE(trial.sticks);
  EXPECT_FALSE(trial.reaches);
  EXPECT_GE(trial.failed_push, 0);
}

TEST(PlanTrial, AnImpossibleMemberIsNoScene) {
  const Model model = prepare(published_tee(0));
  const Plan plan = plan_regrasp(model);
  UncertaintyBox box;
  box[Unknown::kGraspX] = 1.0;  // [m]: off the object
  BoxPoint off{};
  off[static_cast<std::size_t>(Unknown::kGraspX)] = 1.0;
  const PlanTrial trial = try_plan(model, plan, box, off);
  EXPECT_FALSE(trial.is_scene);
  EXPECT_FALSE(trial.sticks);
}

}  // namespace
}  // namespace prehensile
