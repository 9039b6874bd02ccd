#include "planner/proofs/turn_bounder.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "optimisation/nonlinear_program.h"
#include "tests/planner/law_cases.h"

namespace prehensile {
namespace {

using testing::Random;

constexpr double kLength = 0.03;  // [m]

class Bounder : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!ipopt_is_built()) GTEST_SKIP() << "built without Ipopt";
  }

  TurnRate random_rate(Random& random) const {
    return {
        random.in_box(2.0, 2.0),
        Vec3(random.in(-1.0, 1.0), random.in(-1.0, 1.0), random.in(-1.0, 1.0)) / kLength};
  }

  /// The rate itself, at many places in directions up to 1 rad off y.
  std::vector<SeenTurn> seen_of(const TurnRate& rate, Random& random) const {
    std::vector<SeenTurn> seen;
    for (int k = 0; k < 400; ++k) {
      const Vec2 place = random.in_box(kLength, kLength);
      const Vec2 direction = rotated(random.in(-1.0, 1.0), Vec2(0.0, 1.0));
      seen.push_back({place, direction, rate.at(place).dot(direction)});
    }
    return seen;
  }

  Vec2 random_way(Random& random) const {
    return rotated(random.in(-0.9, 0.9), Vec2(0.0, random.in(0.5, 1.0) * kLength));
  }

  const TurnBounder::Stopped never_;
};

/// Of what is seen of the gradient of a quadratic function, the least bound is little
/// more than what that makes of the way that turns most.
TEST_F(Bounder, LeastIsThatOfTheGradientItself) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    Random random(seed);
    const TurnRate rate = random_rate(random);
    TurnBounder bounder(kLength, never_);
    for (const SeenTurn& one : seen_of(rate, random)) bounder.add(one);
    double most = -1.0;
    for (int k = 0; k < 5; ++k) {
      const Vec2 way = random_way(random);
      bounder.add_way(way);
      most = std::max(most, rate.along(way));
    }
    const auto least = bounder.least_along_ways();
    ASSERT_TRUE(least) << seed;
    EXPECT_GT(*least, most) << seed;
    EXPECT_LT(*least, most + 0.1 * kLength) << seed;
  }
}

/// Above all that was seen, and below what was asked over the ways; none where that is
/// less than what was seen makes.
TEST_F(Bounder, SurestIsAboveWhatWasSeen) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    Random random(seed);
    const TurnRate rate = random_rate(random);
    TurnBounder bounder(kLength, never_);
    const std::vector<SeenTurn> seen = seen_of(rate, random);
    for (const SeenTurn& one : seen) bounder.add(one);
    const Vec2 way = random_way(random);
    bounder.add_way(way);
    EXPECT_FALSE(bounder.surest(rate.along(way) - 0.01 * kLength)) << seed;
    const double asked = rate.along(way) + 0.2 * kLength;
    const auto surest = bounder.surest(asked);
    ASSERT_TRUE(surest) << seed;
    EXPECT_LE(surest->along(way), asked + 1e-6) << seed;
    double share = 1e3;
    for (const SeenTurn& one : seen) {
      const double above = surest->at(one.from_start).dot(one.direction) - one.kappa;
      share = std::min(share, above / (1.0 + std::abs(one.kappa)));
    }
    EXPECT_GT(share, 0.01) << seed;
  }
}

}  // namespace
}  // namespace prehensile
