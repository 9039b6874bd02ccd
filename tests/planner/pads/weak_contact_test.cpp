#include "planner/pads/weak_contact.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "scene/constants.h"
#include "tests/planner/law_cases.h"
#include "tests/support/random.h"

namespace prehensile {
namespace {

using testing::Random;
using testing::random_margin;

StickContact random_contact(Random& random) {
  StickContact stick;
  stick.n = random.direction();
  stick.t = perp(stick.n);
  stick.a = random.in_box(0.05, 0.05);
  stick.b = stick.a + random.log_in(1e-3, 0.1) * stick.t;
  stick.mu = random.in(0.0, 1.2);
  stick.gamma = random.in(0.0, 0.9) * random.direction();
  stick.p_OCom = random.in_box(0.05, 0.05);
  stick.c = 0.006;
  return stick;
}

/// The worst that members of the box ask is what the weak contact says, as near as they
/// are drawn.
TEST(WeakContact, AsksWhatItsWorstMemberAsks) {
  Random random(1);
  for (int i = 0; i < 300; ++i) {
    const StickContact stick = random_contact(random);
    const Margin margin = random_margin(random);
    const WeakContact weak(stick, margin, random.in_box(0.05, 0.05));
    std::array<double, 2> asked = {-kInfinity, -kInfinity}, help = {kInfinity, kInfinity};
    for (int j = 0; j < 400; ++j) {
      const double weight =
          random.chance(0.5) ? margin.least_weight() : margin.most_weight();
      const double tilt = random.chance(0.5) ? margin.tilt : -margin.tilt;
      const Vec2 gamma = weight * rotated(tilt, stick.gamma);
      const Vec2 p_OCom = stick.p_OCom + margin.centre_of_mass * random.direction();
      for (int k = 0; k < 2; ++k) {
        const double side = k == 0 ? 1.0 : -1.0;
        asked[k] = std::max(asked[k], weak.w[k].dot(gamma));
        help[k] = std::min(help[k], -side * cross(p_OCom - weak.end[k], gamma));
      }
    }
    for (int k = 0; k < 2; ++k) {
      EXPECT_NEAR(weak.most_asked_of_edge(k), asked[k], 3e-4) << i;
      EXPECT_NEAR(weak.least_help_at_end(k), help[k], 3e-5) << i;
    }
  }
}

TEST(WeakContact, HasItsFaceAndConeWithinThoseOfTheContact) {
  Random random(2);
  for (int i = 0; i < 300; ++i) {
    const StickContact stick = random_contact(random);
    const Margin margin = random_margin(random);
    const Vec2 begin = random.in_box(0.05, 0.05);
    const WeakContact weak(stick, margin, begin);
    EXPECT_LE(weak.mu, stick.mu);
    EXPECT_LE(weak.half_angle, std::max(0.0, std::atan(stick.mu) - margin.tilt) + 1e-12);
    EXPECT_LE(stick.t.dot(weak.end[0]), stick.t.dot(stick.b) + 1e-12);
    EXPECT_GE(stick.t.dot(weak.end[1]), stick.t.dot(stick.a) - 1e-12);
    // Where a motion begins over the face, its tilt moves both ends inwards by as much as
    // the finger axis is above them.
    const double above = (begin - stick.a).dot(stick.n);
    EXPECT_NEAR((weak.end[0] - weak.tilted_end[0]).dot(stick.t), margin.tilt * above,
                1e-12);
    EXPECT_NEAR((weak.tilted_end[1] - weak.end[1]).dot(stick.t), margin.tilt * above,
                1e-12);
  }
}

TEST(WeakContact, IsTheContactWhereTheMarginIsNone) {
  Random random(3);
  const StickContact stick = random_contact(random);
  const WeakContact weak(stick, Margin::none(), {0.01, 0.02});
  EXPECT_EQ(weak.mu, stick.mu);
  EXPECT_EQ(weak.end[0], stick.b);
  EXPECT_EQ(weak.tilted_end[1], stick.a);
  EXPECT_EQ(weak.stretch, (std::array{1.0, 1.0}));
}

}  // namespace
}  // namespace prehensile
