#include <algorithm>
#include <array>

#include <gtest/gtest.h>
#include <ompl/util/Console.h>

#include "planner/checks/exact_check.h"
#include "planner/costs.h"
#include "planner/ompl/stock_planners.h"
#include "planner/search/frame.h"
#include "problems/published_regrasps.h"
#include "tests/planner/executed_pushes.h"
#include "tests/planner/ompl_regrasps.h"

namespace prehensile {
namespace {

using testing::kNoBudget;

std::vector<PlannerKind> stock_kinds() {
  std::vector<PlannerKind> kinds = planner_catalogue();
  std::erase_if(kinds, [](const PlannerKind& kind) { return !kind.needs_ompl(); });
  return kinds;
}

/// Random wide Ts and squares, with gravity and without.
std::vector<Scene> random_scenes(int count) {
  std::vector<Scene> scenes;
  scenes.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    scenes.push_back(random_among_walls(i % 4 == 1, RegraspRange::kWide, i % 2 == 0, 9,
                                        static_cast<std::uint64_t>(i)));
  }
  return scenes;
}

/// The law of every planner here: no plan has a push that must be done backwards.
void expect_directed(int scenes, std::int64_t least, std::uint64_t seeds) {
  for (const PlannerKind& kind : stock_kinds()) {
    // FMT* draws all its states before its first push.
    const std::int64_t budget = kind.algorithm == "FMT" ? 10 * least : least;
    testing::Directions directions;
    int solved = 0;
    for (const Scene& scene : random_scenes(scenes)) {
      const Model model = prepare(scene);
      const SearchModel search = prepare_search(model, Margin::none());
      for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        Work work{.budget = budget};
        const Plan plan =
            solve_in_frame(search, scene.start, *scene.goal,
                           {.planner = kind.name, .seed = seed, .budget = budget}, work);
        EXPECT_EQ(plan.message.find("second look"), std::string::npos)
            << kind.name << ": OMPL returned a reversed motion";
        if (plan.status != PlanStatus::kReachedGoal) continue;
        ++solved;
        testing::expect_executable(model, plan, directions);
      }
    }
    std::printf("%-28s solved %2d of %2d, %3d pushes, %d also backwards\n",
                kind.name.c_str(), solved, scenes * static_cast<int>(seeds),
                directions.pushes, directions.reversible);
    if (kind.family != PlannerFamily::kBlind) {
      EXPECT_GT(solved, 0) << kind.name;
    }
    EXPECT_LE(4 * directions.reversible, directions.pushes) << kind.name;
  }
}

TEST(OmplStockPlanners, EveryPushIsDoneInItsDirection) { expect_directed(4, 600, 1); }

TEST(OmplStockPlanners, FullEveryPushIsDoneInItsDirection) {
  expect_directed(30, 1000, 2);
}

TEST(OmplStockPlanners, OptionsOfTheCatalogueAreParametersOfOmpl) {
  ompl::msg::noOutputHandler();
  constexpr std::array<const char*, 2> kOurs{"tries", "cells"};
  const Scene scene = testing::regrasps()[0];
  const Model model = prepare(scene);
  const SearchModel search = prepare_search(model, Margin{});
  for (const PlannerKind& kind : stock_kinds()) {
    Work work{.budget = kNoBudget};
    const PushProblem problem(search, scene.start, *scene.goal, work,
                              meaning_for(kind.family));
    for (const PlannerOption& option : kind.options) {
      const bool is_ours =
          std::ranges::find(kOurs, std::string_view(option.name)) != kOurs.end();
      for (const double value : {option.value, option.most}) {
        const auto planner = make_stock_planner(kind, {{option.name, value}}, problem);
        ASSERT_TRUE(planner) << kind.name;
        EXPECT_EQ(planner->params().hasParam(option.name), !is_ours)
            << kind.name << " " << option.name;
        if (is_ours) continue;
        std::string text;
        ASSERT_TRUE(planner->params().getParam(option.name, text));
        EXPECT_NEAR(std::stod(text), value * (option.in_L ? model.L : 1.0), 1e-6 * value)
            << kind.name << " " << option.name;
      }
    }
  }
  ompl::msg::restorePreviousOutputHandler();
}

TEST(OmplStockPlanners, BlindControlsNeedMoreWorkThanSteering) {
  std::int64_t blind = 0;
  std::int64_t steered = 0;
  for (const Scene& scene : testing::regrasps()) {
    const Model model = prepare(scene);
    const SearchModel search = prepare_search(model, Margin::none());
    for (const bool is_blind : {true, false}) {
      Work work{.budget = 100'000};
      solve_in_frame(search, scene.start, *scene.goal,
                     {.planner = is_blind ? "blind::RRT" : "control::RRT"}, work);
      (is_blind ? blind : steered) += work.propagations;
    }
  }
  EXPECT_GT(blind, 20 * steered);
}

/// BIT* goes on after its first plan, and longer if asked to.
TEST(OmplStockPlanners, ImprovingPlannersSpendWhatTheyAreGiven) {
  const Scene scene = testing::regrasps()[3];
  const Model model = prepare(scene);
  const SearchModel search = prepare_search(model, Margin::none());
  for (const std::string planner : {"geometric::BITstar"}) {
    std::array<Plan, 2> plans;
    std::array<std::int64_t, 2> spent{};
    for (const bool improve : {false, true}) {
      Work work{.budget = 10'000};
      plans[improve] = solve_in_frame(search, scene.start, *scene.goal,
                                      {.planner = planner, .improve = improve}, work);
      spent[improve] = work.propagations;
      ASSERT_EQ(plans[improve].status, PlanStatus::kReachedGoal);
      account(model, plans[improve]);
    }
    EXPECT_LT(spent[0], spent[1]) << planner;
    EXPECT_LE(plans[1].cost, plans[0].cost + 1e-9) << planner;
  }
}

}  // namespace
}  // namespace prehensile
