#include "planner/steering/fan.h"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "planner/steering/chain.h"
#include "tests/planner/planner_cases.h"
#include "tests/support/random.h"

namespace prehensile {
namespace {

using testing::kNoBudget;
using testing::Random;

std::vector<Generator> random_fan(int count, Random& random) {
  std::vector<Generator> fan;
  for (int i = 0; i < count; ++i) {
    const Vec2 p = random.direction();
    fan.push_back({i % 3, Vec3(p.x(), p.y(), random.in(-2.0, 2.0)).normalized()});
  }
  return fan;
}

Vec3 sum_of(const std::vector<Generator>& fan, const Combination& found) {
  Vec3 sum = Vec3::Zero();
  for (int i = 0; i < found.count; ++i) {
    sum += found.amount[i] * fan[found.generator[i]].u;
  }
  return sum;
}

double cost_of(const Combination& found) {
  double cost = 0.0;
  for (int i = 0; i < found.count; ++i) cost += found.amount[i];
  return cost;
}

/// Least cost over all triples of generators, by trying them.
double best_of_all_triples(const std::vector<Generator>& fan, const Vec3& step) {
  double best = std::numeric_limits<double>::infinity();
  const std::size_t n = fan.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      for (std::size_t k = j + 1; k < n; ++k) {
        Eigen::Matrix3d columns;
        columns << fan[i].u, fan[j].u, fan[k].u;
        if (std::abs(columns.determinant()) < 1e-9) continue;
        const Vec3 amounts = columns.inverse() * step;
        if (amounts.minCoeff() >= -1e-12) best = std::min(best, amounts.sum());
      }
    }
  }
  return best;
}

TEST(Fan, TheCombinationIsTheCheapestOfAll) {
  Random random(1);
  int reached = 0;
  for (int i = 0; i < 300; ++i) {
    const std::vector<Generator> fan = random_fan(3 + random.below(12), random);
    const Vec3 step =
        1e-2 * Vec3(random.in(-1.0, 1.0), random.in(-1.0, 1.0), random.in(-1.0, 1.0));
    const auto found = combine(fan, step);
    const double best = best_of_all_triples(fan, step);
    ASSERT_EQ(found.has_value(), std::isfinite(best)) << i;
    if (!found) continue;
    ++reached;
    EXPECT_LE((sum_of(fan, *found) - step).norm(), 1e-9 * step.norm());
    EXPECT_NEAR(cost_of(*found), best, 1e-9 * best);
    for (int k = 0; k < found->count; ++k) EXPECT_GT(found->amount[k], 0.0);
  }
  EXPECT_GE(reached, 100);
}

TEST(Fan, WhatIsRememberedIsTheSameAndCountsTheSame) {
  const Model model = prepare(testing::walled_square());
  const SearchModel search = prepare_search(model, Margin::none());
  const PadEnvelope envelope(model, search.margin);
  Fans fans(search, envelope);
  Random random(3);
  const std::vector<Vec2> places = {random.in_box(0.03, 0.03), random.in_box(0.03, 0.03)};
  for (int i = 0; i < 20; ++i) {
    const Vec2& place = places[static_cast<std::size_t>(random.below(2))];
    const double depth = random.chance(0.5) ? 0.1 : 0.3;
    Work work;
    Work work_anew;
    const std::vector<Generator>& fan = fans.at(place, depth, work);
    const std::vector<Generator> anew = fan_at(search, envelope, place, depth, work_anew);
    EXPECT_EQ(work.done(), work_anew.done());
    ASSERT_EQ(fan.size(), anew.size());
    for (std::size_t k = 0; k < fan.size(); ++k) {
      EXPECT_EQ(fan[k].contact, anew[k].contact);
      EXPECT_EQ(fan[k].u, anew[k].u);
    }
  }
}

TEST(Fan, ControllableIsWhatCombinesToEveryStep) {
  Random random(2);
  int controllable = 0;
  for (int i = 0; i < 200; ++i) {
    const std::vector<Generator> fan = random_fan(4 + random.below(8), random);
    bool all = true;
    for (int k = 0; k < 60; ++k) {
      const Vec2 p = random.direction();
      all = all && combine(fan, Vec3(p.x(), p.y(), random.in(-2.0, 2.0)));
    }
    if (is_controllable(fan)) {
      ++controllable;
      EXPECT_TRUE(all) << i;
    }
  }
  EXPECT_GE(controllable, 30);
}

TEST(Fan, FreeRotationLeavesOnlyThePlaceToBeReached) {
  std::vector<Generator> fan = {{0, Vec3(1.0, 0.0, 1.0).normalized()}};
  const Vec3 step(1e-3, 0.0, 0.0);
  EXPECT_FALSE(combine(fan, step));
  free_rotation(fan);
  const auto found = combine(fan, step);
  ASSERT_TRUE(found);
  EXPECT_LE((sum_of(fan, *found) - step).norm(), 1e-12);
}

TEST(Fan, ShortMovesAlongGeneratorsStickWithTheRealPads) {
  Scene scene = testing::walled_square();
  for (const Pad& pad : {Pad(DiscPad{0.009}), Pad(RectanglePad{{0.02, 0.01}})}) {
    scene.gripper.pad = pad;
    const Model model = prepare(scene);
    const SearchModel search = prepare_search(model, Margin{});
    const PadEnvelope envelope(model, search.margin);
    Work work{.budget = kNoBudget};
    Random random(3);
    int moves = 0, passing = 0;
    for (int i = 0; i < 20; ++i) {
      const Vec2 p_OF = random.in_box(0.035, 0.035);
      const double theta = random.in(-3.0, 3.0);
      for (const Generator& generator : fan_at(search, envelope, p_OF, 0.1, work)) {
        const Vec3 d = 2e-4 * generator.u;
        const Move move{generator.contact,
                        {p_OF, theta},
                        {p_OF + d.head<2>(), theta + d[2] / model.c}};
        ++moves;
        passing += move_passes(search, move, work);
      }
    }
    EXPECT_GE(moves, 1000);
    EXPECT_GE(passing, 0.95 * moves);
  }
}

}  // namespace
}  // namespace prehensile
