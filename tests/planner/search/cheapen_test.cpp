#include "planner/search/cheapen.h"

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <thread>

#include <gtest/gtest.h>

#include "planner/chains/chain_search.h"
#include "planner/chains/shorten.h"
#include "planner/progress.h"
#include "planner/walks/walk_lattice.h"
#include "problems/published_regrasps.h"
#include "problems/random_fixtures.h"
#include "problems/random_regrasps.h"
#include "tests/planner/planner_cases.h"
#include "tests/planner/wasteful_moves.h"

namespace prehensile {
namespace {

Scene random_scene(std::uint64_t index) {
  const FixtureRange range{.object = static_cast<FixtureObject>(index % 4),
                           .goals = GoalsFrom::kRandom};
  return random_fixture(range, 5, index)->scene;
}

GoalPlaces end_of(const std::vector<Move>& moves) {
  const FlatState& end = moves.back().to;
  GoalPlaces goals;
  goals.count = 1;
  goals.places[0] = {.p_OF = end.p_OF, .count = 1, .theta = {end.theta}};
  return goals;
}

TEST(Cheapen, DearMovesCostAFewPushes) {
  const PlanOptions options;
  double before = 0.0;
  double after = 0.0;
  for (std::uint64_t i = 0; i < 12; ++i) {
    const Model model = prepare(random_scene(i));
    const SearchModel search = prepare_search(model, Margin::none());
    const auto moves = testing::wasteful_moves(search, i, 60);
    if (moves.empty() || cost_of(search, moves) < 20.0) continue;
    Work work{.budget = 5'000'000};
    const Limits limits(options, work);
    auto cheaper = cheaper_by_pairs(search, moves, limits, work);
    const double pairs = cost_of(search, cheaper);
    EXPECT_LE(pairs, cost_of(search, moves) + 1e-9) << i;
    WalkLattices lattices;
    cheaper = cheaper_by_walk(search, moves.front().from, end_of(moves), cheaper,
                              kWorthWalk, lattices, limits, work);
    EXPECT_LE(cost_of(search, cheaper), pairs + 1e-9) << i;
    EXPECT_TRUE(testing::is_detour_of(cheaper, moves)) << i;
    EXPECT_EQ(work.budget, 5'000'000);
    for (const Move& move : cheaper) EXPECT_TRUE(move_passes(search, move, work)) << i;
    before += cost_of(search, moves);
    after += cost_of(search, cheaper);
  }
  EXPECT_GT(before, 100.0);
  EXPECT_LT(after, 0.2 * before);
}

/// What is cheap costs no work either.
TEST(Cheapen, CheapMovesStay) {
  const PlanOptions options;
  const Model model = prepare(random_scene(0));
  const SearchModel search = prepare_search(model, Margin::none());
  const auto moves = testing::wasteful_moves(search, 0, 3);
  ASSERT_LT(cost_of(search, moves), 8.0);
  Work work{.budget = testing::kNoBudget};
  const Limits limits(options, work);
  const auto by_pairs = cheaper_by_pairs(search, moves, limits, work);
  WalkLattices lattices;
  const auto by_walk = cheaper_by_walk(search, moves.front().from, end_of(moves), moves,
                                       kWorthWalk, lattices, limits, work);
  EXPECT_EQ(cost_of(search, by_pairs), cost_of(search, moves));
  EXPECT_EQ(cost_of(search, by_walk), cost_of(search, moves));
  EXPECT_EQ(work.done(), 0);
}

/// The first plan of the one winds the hand by hundreds of turns and back, that of the
/// other goes along a line in hundreds of short pushes.
TEST(Cheapen, PlansAreNotDearWithoutNeed) {
  const Scene wound = random_regrasp(RegraspFamily::kTee, 1, 195).scene;
  const Scene of_tee = random_regrasp(RegraspFamily::kTee, 1, 166).scene;
  const Scene zigzag = random_regrasp_of(of_tee, GoalsFrom::kRandom, 1, 166)->scene;
  for (const Scene& scene : {wound, zigzag}) {
    const Plan plan = plan_regrasp(prepare(scene), {.margin = Margin::none()});
    ASSERT_EQ(plan.status, PlanStatus::kReachedGoal) << scene.name;
    EXPECT_LT(plan.cost, 20.0) << scene.name;
  }
}

/// What searches for cheaper plans are asked, without a margin.
struct Question {
  explicit Question(const Scene& scene)
      : model(prepare(scene)),
        search(prepare_search(model, Margin::none())),
        start(flat_state(model.scene.start)),
        goals(goal_places(model, *model.scene.goal, start)),
        beside(tolerated_places(model, *model.scene.goal, start)) {}

  Model model;
  SearchModel search;
  FlatState start;
  GoalPlaces goals, beside;
};

/// Pushes by one contact that gravity helps, which the ellipsoid hides: they turn the
/// object a lot, or end beside the goal.
TEST(Cheapen, RealPadsKnowCheaperPairs) {
  const PlanOptions options;
  int cheaper = 0;
  for (std::uint64_t i = 0; i < 60; ++i) {
    const FixtureRange range{.object = static_cast<FixtureObject>(i % 4)};
    const Question question(random_fixture(range, 5, i)->scene);
    const auto& [model, search, start, goals, beside] = question;
    Work work{.budget = testing::kNoBudget};
    const Limits limits(options, work);
    BestMoves best(search);
    const auto found = search_chains(search, start, goals, 0.0, limits, work);
    if (!found) continue;
    best.offer(moves_of(search, start, found->chain));
    const double before = best.cost();
    cheaper_with_real_pads(start, goals, beside, limits, work, best);
    EXPECT_LE(best.cost(), before) << i;
    cheaper += best.cost() < 0.9 * before;
    const auto moves = best.take();
    for (const Move& move : *moves) EXPECT_TRUE(move_passes(search, move, work)) << i;
    const Grasp end = grasp_of(moves->back().to, model.scene.start.psi);
    EXPECT_TRUE(reaches(*model.scene.goal, end)) << i;
  }
  std::printf("%d of 60 cheaper by a tenth and more\n", cheaper);
  EXPECT_GT(cheaper, 3);
}

/// The first stages know all about them: the pads themselves tell of nothing that is
/// cheaper by more than what lattices differ by, and nothing is looked for.
TEST(Cheapen, SoftPointsHideNothing) {
  const PlanOptions options;
  int asked = 0;
  for (int i = 0; i < kPublishedRegrasps; ++i) {
    for (const Scene& scene : {published_square(i), published_tee(i)}) {
      const Question question(with_soft_points(scene));
      const auto& [model, search, start, goals, beside] = question;
      Work work{.budget = testing::kNoBudget};
      const Limits limits(options, work);
      const auto found = search_chains(search, start, goals, 0.0, limits, work);
      if (!found) continue;
      ++asked;
      const PadEnvelope pads(model, search.margin);
      EXPECT_FALSE(search_chains_of_real_pads(search, start, goals, &pads,
                                              0.98 * found->chain.cost, limits, work))
          << scene.name;
      BestMoves best(search);
      best.offer(moves_of(search, start, found->chain));
      const std::int64_t before = work.done();
      cheaper_with_real_pads(start, goals, beside, limits, work, best);
      EXPECT_EQ(work.done(), before) << scene.name;
    }
  }
  EXPECT_GT(asked, 50);
}

/// One contact does what two do for much more, with many turns.
TEST(Cheapen, ImprovedPlansUseOneContactWhereItDoes) {
  const FixtureRange range{.object = FixtureObject::kConvex};
  const Model model = prepare(random_fixture(range, 1, 44)->scene);
  PlanOptions options{.margin = Margin::none()};
  const Plan first = plan_regrasp(model, options);
  options.improve = true;
  const Plan improved = plan_regrasp(model, options);
  ASSERT_EQ(improved.status, PlanStatus::kReachedGoal);
  EXPECT_GT(first.cost, 2.0);
  EXPECT_LT(improved.cost, 1.5);
}

/// What is found between two states of a plan is no plan: what is reported afterwards is
/// the cost of all pushes.
TEST(Cheapen, PairsReportWholePlans) {
  const PlanOptions options;
  int cheapened = 0;
  for (std::uint64_t i = 0; i < 12; ++i) {
    const Model model = prepare(random_scene(i));
    const SearchModel search = prepare_search(model, Margin::none());
    const auto moves = testing::wasteful_moves(search, i, 60);
    if (moves.empty() || cost_of(search, moves) < 20.0) continue;
    double reported = 0.0;
    const ProgressCallback callback = [&](const SearchProgress& progress) {
      reported = progress.best_cost;
    };
    ProgressMeter meter(callback);
    Work work{.budget = 5'000'000};
    work.meter = &meter;
    const auto cheaper = cheaper_by_pairs(search, moves, Limits(options, work), work);
    std::this_thread::sleep_for(std::chrono::duration<double>(kProgressInterval));
    for (int tick = 0; tick < 64; ++tick) meter.tick(0);
    EXPECT_EQ(reported, cost_of(search, cheaper)) << i;
    ++cheapened;
  }
  EXPECT_GT(cheapened, 3);
}

TEST(Cheapen, ProgressTellsCostsOfWholePlans) {
  int calls = 0;
  for (const std::uint64_t problem : {194, 82}) {
    const Scene of_tee = random_regrasp(RegraspFamily::kTee, 1, problem).scene;
    const Model model =
        prepare(random_regrasp_of(of_tee, GoalsFrom::kRandom, 1, problem)->scene);
    double least = std::numeric_limits<double>::infinity();
    PlanOptions options;
    options.margin = Margin::none();  // one search: others find other plans
    options.progress = [&](const SearchProgress& progress) {
      ++calls;
      if (progress.best_cost < least) least = progress.best_cost;
    };
    const Plan plan = plan_regrasp(model, options);
    EXPECT_TRUE(plan.usable());
    EXPECT_GE(least, plan.cost - 0.5);  // polish comes after the search
  }
  EXPECT_GT(calls, 0);
}

}  // namespace
}  // namespace prehensile
