#include <cmath>

#include <gtest/gtest.h>

#include "mechanics/certificate.h"
#include "problems/random_instants.h"
#include "tests/mechanics/instant_cases.h"
#include "tests/support/random.h"

namespace prehensile {
namespace {

using testing::Random;

/// The load decides as the search over all twists does, wherever that is not on the edge:
/// pads of few points and many, gravity from none to far beyond what they hold.
TEST(GravityLoad, DecidesAsTheSlackDoes) {
  Random random(41);
  int exceeds = 0;
  int falls = 0;
  for (int i = 0; i < 4000; ++i) {
    RandomInstant q = random_instant(42, i, {.points_per_pad = 1 << i % 6});
    q.grasp.w_g *= random.log_in(0.05, 20.0);
    const double slack = gravity_slack(q.grasp);
    for (const double least : {-1e-9, 0.0, 1e-6, 0.1, 0.4}) {
      // The slack of the search is good to 1e-3, from above.
      if (std::abs(slack - least) < 2e-3) continue;
      EXPECT_EQ(gravity_slack_exceeds(q.grasp, least), slack > least)
          << i << ' ' << slack << ' ' << least;
      (slack > least ? exceeds : falls) += 1;
    }
  }
  EXPECT_GT(exceeds, 3000);
  EXPECT_GT(falls, 3000);
}

TEST(GravityLoad, OfADiscThatTurnsAlone) {
  // The moment that points of these levers hold is the sum of what each of them does.
  PlanarGrasp grasp = testing::disc_grasp(96, 0.01, 20.0);
  double moment = 0.0;
  for (int j = 0; j < grasp.count; ++j) {
    moment += grasp.bound[j] * std::hypot(grasp.x[j], grasp.y[j]);
  }
  for (const double share : {0.0, 0.5, 0.99, 1.01, 2.0, 1e6}) {
    grasp.w_g = {0.0, 0.0, share * moment};
    EXPECT_EQ(gravity_slack_exceeds(grasp, 0.0), share < 1.0) << share;
    grasp.w_g = {0.0, -share * 20.0, 0.0};
    EXPECT_EQ(gravity_slack_exceeds(grasp, 0.0), share < 1.0) << share;
  }
}

/// Points on a line hold a moment and force in all directions; one point none.
TEST(GravityLoad, OfPadsThatHardlySpread) {
  PlanarGrasp line = testing::grasp_of({{0.0, -0.01}, {0.0, 0.01}}, 20.0);
  PlanarGrasp point = testing::grasp_of({{0.0, 0.0}}, 20.0);
  line.w_g = point.w_g = {0.0, -1.0, 0.0};
  EXPECT_TRUE(gravity_slack_exceeds(line, 0.0));
  line.w_g = point.w_g = {0.0, -1.0, 0.1};
  EXPECT_TRUE(gravity_slack_exceeds(line, 0.0));
  EXPECT_FALSE(gravity_slack_exceeds(point, 0.0));
  line.w_g = {0.0, -1.0, 0.21};
  EXPECT_FALSE(gravity_slack_exceeds(line, 0.0));
}

TEST(GravityLoad, NonsenseExceedsNothing) {
  PlanarGrasp grasp = testing::disc_grasp(16, 0.01, 20.0);
  for (const double wrong : {std::nan(""), HUGE_VAL}) {
    grasp.w_g = {0.0, wrong, 0.0};
    EXPECT_FALSE(gravity_slack_exceeds(grasp, 0.0));
    EXPECT_FALSE(gravity_slack_exceeds(grasp, -1e-9));
  }
  grasp.count = 0;
  grasp.w_g.setZero();
  EXPECT_FALSE(gravity_slack_exceeds(grasp, 0.0));
}

}  // namespace
}  // namespace prehensile
