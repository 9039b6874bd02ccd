#include "planner/chains/label_search.h"

#include <gtest/gtest.h>

#include "planner/chains/lattice.h"
#include "tests/planner/planner_cases.h"
#include "tests/support/random.h"

namespace prehensile {
namespace {

using testing::goal_at;
using testing::kNoBudget;
using testing::Random;

constexpr double kNoPlan = std::numeric_limits<double>::infinity();

struct Found {
  int chains = 0;
  int long_chains = 0;  ///< of three and more legs
};

/// Searches between random places in a box, without gravity, and holds every chain found
/// to what it promises.
Found search_random(Scene scene, const Vec2& low, const Vec2& high, int runs) {
  scene.g_W.setZero();
  const Model model = prepare(scene);
  const SearchModel search = prepare_search(model, Margin{});
  const PlanOptions options;
  Random random(1);
  const auto place = [&] {
    const double x = random.in(low.x(), high.x());
    return Vec2(x, random.in(low.y(), high.y()));
  };
  Found found;
  for (int i = 0; i < runs; ++i) {
    Work work{.budget = kNoBudget};
    const Limits limits(options, work);
    const FlatState start{place(), 0.0};
    const Vec2 end = place();
    const Goal goal = goal_at(end, random.in(-3.0, 3.0));
    const GoalPlaces places = goal_places(model, goal, start);
    const auto answer = search_labels({search}, search, lattice_nodes(search, 150), start,
                                      places, kNoPlan, limits, work);
    if (!answer) continue;
    const Chain& chain = answer->chain;
    ++found.chains;
    found.long_chains += chain.count > 2;
    const GoalPlace& goal_place = places.places[answer->place];
    EXPECT_EQ(chain.legs[0].from, start.p_OF);
    EXPECT_EQ(chain.legs[chain.count - 1].to, goal_place.p_OF);
    double turn = turn_of(search, chain, 0);
    for (int k = 1; k < chain.count; ++k) {
      turn += turn_of(search, chain, k);
      EXPECT_EQ(chain.legs[k].from, chain.legs[k - 1].to);
    }
    EXPECT_NEAR(turn, goal_place.theta[answer->angle] - start.theta, 1e-9);
    EXPECT_TRUE(chain_passes(search, chain, start.theta, work));
    EXPECT_GE(answer->least, 1.0);
    EXPECT_LE(answer->least, chain.cost + 1e-5);
  }
  return found;
}

TEST(LabelSearch, FindsAChainBetweenAnyPosesOfTheSquare) {
  EXPECT_EQ(search_random(published_square(0), {-0.04, -0.04}, {0.04, 0.04}, 30).chains,
            30);
}

TEST(LabelSearch, FindsLongChainsWhereTwoPushesDoNotDo) {
  const Found found = search_random(published_tee(0), {-0.045, -0.01}, {0.02, 0.01}, 40);
  EXPECT_GE(found.chains, 12);
  EXPECT_GE(found.long_chains, 1);
}

TEST(LabelSearch, ReturnsNothingThatIsNotCheaperThanThePlanToBeat) {
  Scene scene = published_tee(0);
  scene.g_W.setZero();
  const Model model = prepare(scene);
  const SearchModel search = prepare_search(model, Margin{});
  const PlanOptions options;
  const std::vector<Vec2> nodes = lattice_nodes(search, 150);
  Random random(5);
  int found = 0;
  for (int i = 0; i < 20; ++i) {
    Work work{.budget = kNoBudget};
    const Limits limits(options, work);
    const FlatState start{random.in_box(0.02, 0.01), 0.0};
    const Goal goal = goal_at(random.in_box(0.02, 0.01), random.in(-3.0, 3.0));
    const GoalPlaces places = goal_places(model, goal, start);
    const auto search_below = [&](double cost) {
      return search_labels({search}, search, nodes, start, places, cost, limits, work);
    };
    const auto any = search_below(kNoPlan);
    if (!any) continue;
    ++found;
    EXPECT_FALSE(search_below(any->chain.cost));
    const auto cheaper = search_below(1.0001 * any->chain.cost);
    if (cheaper) {
      EXPECT_LT(cheaper->chain.cost, 1.0001 * any->chain.cost);
    }
  }
  EXPECT_GE(found, 5);
}

TEST(LabelSearch, EndsAtTheBudget) {
  const Model model = prepare(published_tee(0));
  const SearchModel search = prepare_search(model, Margin{});
  const PlanOptions options;
  Work work{.budget = 5000};
  const Limits limits(options, work);
  const FlatState start = flat_state(model.scene.start);
  const GoalPlaces places = goal_places(model, goal_at({0.0499, 0.0149}, 3.0), start);
  const std::vector<Vec2> nodes = lattice_nodes(search, 150);
  search_labels({search}, search, nodes, start, places, kNoPlan, limits, work);
  const auto one_expansion =
      static_cast<std::int64_t>((nodes.size() + 10) * search.contacts.size());
  EXPECT_GE(work.stick_tests, 5000);
  EXPECT_LE(work.stick_tests, 5000 + 2 * one_expansion);
}

}  // namespace
}  // namespace prehensile
