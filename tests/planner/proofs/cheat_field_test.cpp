#include "planner/proofs/cheat_field.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "problems/published_regrasps.h"
#include "scene/constants.h"

namespace prehensile {
namespace {

const CheatField::Stopped kNever = [] { return false; };

/// The finger axis may go by up to half a right angle to both sides of +x.
FreeDirections quarter(const Vec2& /*place*/) {
  return FreeDirections::where(
      [](double angle) { return std::cos(angle) >= std::sqrt(0.5) - 1e-9; });
}

double cost_of(CheatField& field, const Vec2& start, const Vec2& goal, Judged judged) {
  double cost = 0.0;
  field.costs(start, {goal}, judged, 0.0, &cost);
  return cost;
}

TEST(CheatField, CostsWhatLiesAcrossTheFreeDirections) {
  const Model model = prepare(published_square(0));
  CheatField field(model, 48, quarter, kNever);
  const double off = field.grid().spacing;
  for (const Judged judged :
       {Judged::kWhereItBegins, Judged::kAtBothEnds, Judged::kAllAlong}) {
    const Vec2 start(-0.02, 0.0);
    for (const double angle : {0.0, 0.6, -0.6}) {
      const Vec2 goal = start + 0.02 * towards(angle);
      EXPECT_NEAR(cost_of(field, start, goal, judged), 0.0, 0.1 * off) << angle;
    }
    for (const double angle : {0.25 * kPi + 0.3, -0.25 * kPi - 0.5}) {
      const Vec2 goal = start + 0.02 * towards(angle);
      const double across = 0.02 * std::sin(std::abs(angle) - 0.25 * kPi);
      EXPECT_NEAR(cost_of(field, start, goal, judged), across, 0.1 * off) << angle;
    }
  }
}

TEST(CheatField, KeepsNoMoreThanTheCostOfTheGoal) {
  const Model model = prepare(published_square(0));
  CheatField field(model, 48, quarter, kNever);
  double of_goal = 0.0;
  const auto costs = field.costs({0.0, 0.0}, {{-0.01, 0.0}, {-0.02, 0.0}},
                                 Judged::kWhereItBegins, 0.0, &of_goal);
  EXPECT_NEAR(of_goal, 0.01, 1e-3);  // straight back, to the nearer of two
  double most = 0.0;
  for (const double cost : costs) most = std::max(most, cost);
  EXPECT_EQ(most, of_goal);
}

TEST(CheatField, SaysNothingWhenItIsStopped) {
  const Model model = prepare(published_square(0));
  int asked = 0;
  const CheatField::Stopped soon = [&] { return ++asked > 20; };
  CheatField field(model, 48, quarter, soon);
  double of_goal = 0.0;
  field.costs({0.0, 0.0}, {{-0.02, 0.0}}, Judged::kAtBothEnds, 0.0, &of_goal);
  EXPECT_EQ(of_goal, std::numeric_limits<double>::infinity());
  EXPECT_EQ(asked, 21);
}

}  // namespace
}  // namespace prehensile
