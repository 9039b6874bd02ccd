#include "planner/pads/spread_pads.h"

#include <cmath>

#include <gtest/gtest.h>

#include "planner/pads/ring_pads.h"
#include "scene/constants.h"
#include "tests/planner/clipped_cases.h"
#include "tests/support/no_heap.h"

namespace prehensile {
namespace {

using testing::clipped_place;
using testing::clipped_square;
using testing::Random;

struct Twist {
  Vec2 velocity;
  double omega;
};

Twist random_twist(double c, Random& random) {
  const double angle = random.in(-0.5, 0.5) * kPi;
  return {std::cos(angle) * random.direction(), std::sin(angle) / c};
}

TEST(SpreadPads, AreOfDiscsThatTheFaceClips) {
  Scene scene = clipped_square();
  EXPECT_TRUE(has_clipped_discs(prepare(scene)));
  scene.overhang = Overhang::kIgnore;
  EXPECT_FALSE(has_clipped_discs(prepare(scene)));
  EXPECT_TRUE(has_ring_pads(prepare(scene)));
  scene = clipped_square();
  scene.gripper.pad = RectanglePad{{0.016, 0.016}};
  EXPECT_FALSE(has_clipped_discs(prepare(scene)));
  scene = clipped_square();
  scene.gripper.grip_force = 0.0;
  EXPECT_FALSE(has_clipped_discs(prepare(scene)));
}

/// Where the discs are whole their points, spread, are the rings that have a closed form.
TEST(SpreadPads, AreRingsWhereWhole) {
  const Model model = prepare(clipped_square());
  const SpreadPads pads(model, Vec2(0.002, -0.003));
  Random random(1);
  for (int i = 0; i < 500; ++i) {
    const double angle = random.in(0.0, 0.5) * kPi;
    const Vec2 e = random.direction();
    const PadDrag drag = pads.drag(std::cos(angle) * e, std::sin(angle) / model.c);
    const RingFriction ring = ring_friction(model.region.whole(), model.c, angle);
    EXPECT_NEAR(drag.force.dot(e), ring.along, 0.01) << angle;
    EXPECT_NEAR(cross(e, drag.force), 0.0, 0.01) << angle;
    EXPECT_NEAR(drag.moment / model.c, ring.moment / model.c, 0.01) << angle;
  }
}

/// Over more angles they are hardly different: the angles do not matter.
TEST(SpreadPads, HaveNoAngle) {
  const Model model = prepare(clipped_square());
  Random random(2);
  double sum = 0.0;
  constexpr int kCases = 400;
  for (int i = 0; i < kCases; ++i) {
    const Vec2 p_OF = clipped_place(model, random);
    const Twist twist = random_twist(model.c, random);
    const PadDrag some = SpreadPads(model, p_OF).drag(twist.velocity, twist.omega);
    const PadDrag fewer = SpreadPads(model, p_OF, 7).drag(twist.velocity, twist.omega);
    const double off = std::hypot((some.force - fewer.force).norm(),
                                  (some.moment - fewer.moment) / model.c);
    EXPECT_LT(off, 0.05);
    sum += off;
  }
  EXPECT_LT(sum / kCases, 0.005);
}

/// The power is convex, homogeneous, and friction is its derivative: what the laws of
/// clipped discs rest on.
TEST(SpreadPads, FrictionIsTheDerivativeOfAConvexPower) {
  const Model model = prepare(clipped_square());
  Random random(3);
  for (int i = 0; i < 300; ++i) {
    const SpreadPads pads(model, clipped_place(model, random));
    const Twist at = random_twist(model.c, random);
    const PadDrag drag = pads.drag(at.velocity, at.omega);
    const double power = pads.power(at.velocity, at.omega);
    EXPECT_NEAR(drag.force.dot(at.velocity) + drag.moment * at.omega, power, 1e-12);
    EXPECT_NEAR(pads.power(3.0 * at.velocity, 3.0 * at.omega), 3.0 * power, 1e-12);
    const Twist other = random_twist(model.c, random);
    EXPECT_LE(drag.force.dot(other.velocity) + drag.moment * other.omega,
              pads.power(other.velocity, other.omega) + 1e-12);
  }
}

TEST(SpreadPads, QuickOnesAreTheSameToAFewDigits) {
  const Model model = prepare(clipped_square());
  Random random(6);
  for (int i = 0; i < 500; ++i) {
    const Vec2 p_OF = clipped_place(model, random);
    const SpreadPads pads(model, p_OF, 5);
    const QuickSpreadPads quick(model, p_OF, 5);
    if (pads.are_lost()) {
      EXPECT_TRUE(quick.are_lost());
      continue;
    }
    const auto [velocity, omega] = random_twist(model.c, random);
    const PadDrag drag = pads.drag(velocity, omega);
    const PadDrag other = quick.drag(velocity, omega);
    EXPECT_LT((drag.force - other.force).norm(), 1e-4);
    EXPECT_NEAR(drag.moment, other.moment, 1e-4 * model.c);
    EXPECT_NEAR(pads.power(velocity, omega), quick.power(velocity, omega), 1e-5);
  }
}

TEST(SpreadPads, SlackAlongIsTheLeastOfItsPlaces) {
  const Model model = prepare(clipped_square());
  Random random(4);
  int clipped_places = 0;
  for (int i = 0; i < 300; ++i) {
    const PushContact& contact = model.contacts[i % model.contacts.size()];
    const Vec2 from = clipped_place(model, random);
    const Vec2 e = rotated(random.in(-0.4, 0.4), contact.n);
    const double travel = random.log_in(1e-4, 5e-3);
    const double turn = random.in(-1.0, 1.0) * travel / model.c;
    int clipped = 0;
    const double slack =
        spread_slack_along(model, contact, from, e, travel, turn, 100, &clipped);
    clipped_places += clipped;
    EXPECT_LE(slack, spread_slack(model, contact, from, travel * e, turn) + 1e-12);
  }
  EXPECT_GT(clipped_places, 300);
}

TEST(SpreadPads, LostPadsHaveNoSlack) {
  const Model model = prepare(clipped_square());
  const Vec2 away(1.0, 0.0);
  EXPECT_TRUE(SpreadPads(model, away).are_lost());
  EXPECT_TRUE(SpreadPads().are_lost());
  EXPECT_EQ(spread_slack(model, model.contacts[0], away, Vec2(1.0, 0.0), 0.0), -INFINITY);
  EXPECT_TRUE(std::isnan(
      spread_slack(model, model.contacts[0], Vec2(0.0, 0.0), Vec2(0.0, 0.0), 0.0)));
}

TEST(SpreadPads, NeedNoHeap) {
  const Model model = prepare(clipped_square());
  Random random(5);
  const Vec2 p_OF = clipped_place(model, random);
  const testing::NoHeapScope scope;
  const double slack = spread_slack_along(model, model.contacts[0], p_OF,
                                          model.contacts[0].n, 1e-3, 0.1, 10);
  EXPECT_EQ(scope.allocations(), testing::heap_is_counted() ? 0 : -1);
  EXPECT_FALSE(std::isnan(slack));
}

}  // namespace
}  // namespace prehensile
