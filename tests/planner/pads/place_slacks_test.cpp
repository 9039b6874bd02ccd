#include "planner/pads/place_slacks.h"

#include <cmath>

#include <gtest/gtest.h>

#include "planner/pads/ring_kappas.h"
#include "planner/steering/steering.h"
#include "tests/planner/clipped_cases.h"
#include "tests/planner/law_cases.h"

namespace prehensile {
namespace {

using testing::advance_of;
using testing::clipped_place;
using testing::clipped_square;
using testing::Random;
using testing::random_kappa;

/// What no instant does by more than this is not free, and what one does is.
constexpr double kClear = 0.05;

/// The most that random motions leave: less than what the profile says, or little more.
double most_seen(const Model& model, const Vec2& p_OF, const Vec2& d, Random& random) {
  double most = -INFINITY;
  const SpreadPads pads(model, p_OF);
  for (int i = 0; i < 400; ++i) {
    const double omega = random_kappa(random) / model.c;
    const PadDrag drag = pads.drag(-d, omega);
    for (const PushContact& contact : model.contacts) {
      if (advance_of(contact, p_OF, -d, omega) < 0.0) continue;
      const double slack =
          StickDemands(model, contact, p_OF)
              .slack({drag.force.x(), drag.force.y(), drag.moment / model.c});
      most = std::max(most, slack);
    }
  }
  return most;
}

void compare(bool clipped) {
  Scene scene = clipped_square();
  scene.g_W.setZero();
  scene.pushers.resize(2);
  const Model model = prepare(scene);
  PlaceSlacks slacks(model);
  Random random(7);
  int free = 0;
  for (int i = 0; i < 60; ++i) {
    const Vec2 p_OF = clipped ? clipped_place(model, random) : random.in_box(0.02, 0.02);
    if (depth_inside(model.pad_face, p_OF) < 2e-3) continue;
    const PlaceSlacks::Profile profile = slacks.at(p_OF);
    const int k = random.below(FreeDirections::kLookedAt);
    const Vec2 d = towards(FreeDirections::direction(k));
    const double seen = most_seen(model, p_OF, d, random);
    if (std::abs(seen) > kClear) {
      EXPECT_EQ(profile[k] > 0.0, seen > 0.0) << i;
    }
    free += profile[k] > 0.0 ? 1 : 0;
  }
  EXPECT_GT(free, 5);
}

TEST(PlaceSlacks, AreThoseOfInstantsWhereWhole) { compare(false); }

TEST(PlaceSlacks, AreThoseOfInstantsWhereClipped) { compare(true); }

TEST(PlaceSlacks, OffTheObjectNothingSticks) {
  const Model model = prepare(clipped_square());
  PlaceSlacks slacks(model);
  for (const double slack : slacks.at(Vec2(1.0, 1.0))) EXPECT_LE(slack, -0.99);
}

}  // namespace
}  // namespace prehensile
