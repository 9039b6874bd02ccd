#include "mechanics/pad_envelope.h"

#include <numbers>

#include <gtest/gtest.h>

#include "problems/published_regrasps.h"
#include "tests/support/no_heap.h"
#include "tests/support/random.h"

namespace prehensile {
namespace {

using testing::Random;

/// Least slack with the real pads over angles of the object and places along a move.
double dense_slack(const Model& model, const PushContact& contact, const Vec2& from,
                   const Vec2& to, double kappa, const Margin& margin) {
  constexpr int kAngles = 17;
  constexpr int kPlaces = 4;
  double slack = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kAngles; ++i) {
    for (int j = 0; j < kPlaces; ++j) {
      const double theta = 2.0 * std::numbers::pi * i / kAngles;
      const Vec2 p_OF = from + j * (to - from) / (kPlaces - 1);
      const StickTest test = exact_stick_test(
          model, contact, 0.0, pose_from_finger(p_OF, theta), (from - to).normalized(),
          (from - to).norm(), kappa / model.c * (from - to).norm(), margin);
      slack = std::min(slack, test.slack);
    }
  }
  return slack;
}

struct Tally {
  int moves = 0;   ///< random moves with an interval
  int inside = 0;  ///< kappas inside the intervals, and those that stick
  int inside_sticks = 0;
  int outside = 0;  ///< kappas beyond the ends, and those that stick all the same
  int outside_sticks = 0;
};

Tally compare(const Pad& pad, const Margin& margin, std::uint64_t seed, int runs) {
  Scene scene = published_square(0);
  scene.gripper.pad = pad;
  Random random(seed);
  Tally tally;
  for (int i = 0; i < runs; ++i) {
    scene.g_W = random.chance(0.3) ? Vec2(0.0, 0.0) : Vec2(random.in_disc(15.0));
    scene.pushers[0].friction = random.in(0.1, 1.2);
    const Model model = prepare(scene);
    const PadEnvelope envelope(model, margin);
    const PushContact& contact =
        model.contacts[random.below(static_cast<int>(model.contacts.size()))];
    const StickContact stick = stick_contact(model, contact, 0.0);
    const Vec2 from = random.in_box(0.03, 0.03);
    const Vec2 to = from + random.in_disc(0.02);
    const KappaSet set = envelope.kappas(stick, from, to);
    if (set.empty()) continue;
    ++tally.moves;
    for (int k = 0; k < set.count; ++k) {
      const auto [lo, hi] = set.intervals[k];
      EXPECT_LE(lo, hi);
      for (const double share : {0.1, 0.5, 0.9}) {
        ++tally.inside;
        tally.inside_sticks += dense_slack(model, contact, from, to,
                                           std::lerp(lo, hi, share), margin) >= -1e-3;
      }
    }
    const double above = set.intervals[set.count - 1].hi;
    if (above > 40.0) continue;
    ++tally.outside;
    const double kappa = above + 0.3 + 0.1 * std::abs(above);
    tally.outside_sticks += dense_slack(model, contact, from, to, kappa, margin) >= 0.0;
  }
  return tally;
}

void expect_sound(const Tally& tally) {
  EXPECT_GE(tally.moves, 12);
  EXPECT_GE(tally.inside_sticks, 0.99 * tally.inside);
}

TEST(PadEnvelope, IsTheLimitSurfaceOfADisc) {
  for (const Margin& margin : {Margin::none(), Margin{}}) {
    const Tally tally = compare(DiscPad{0.009}, margin, 1, 150);
    expect_sound(tally);
    EXPECT_LE(tally.outside_sticks, 0.05 * tally.outside);
  }
}

TEST(PadEnvelope, HoldsAtEveryAngleOfOtherPads) {
  for (const Pad& pad : {Pad(RectanglePad{{0.02, 0.02}}), Pad(RectanglePad{{0.02, 0.01}}),
                         Pad(RectanglePad{{0.024, 0.006}}), Pad(LinePad{0.02})}) {
    expect_sound(compare(pad, Margin::none(), 2, 80));
    expect_sound(compare(pad, Margin{}, 3, 80));
  }
}

TEST(PadEnvelope, ShrinksWithTheMargin) {
  const Model model = prepare(published_tee(0));
  const PadEnvelope nominal(model, Margin::none());
  const PadEnvelope robust(model, Margin{});
  Random random(4);
  for (int i = 0; i < 500; ++i) {
    const PushContact& contact = model.contacts[random.below(3)];
    const StickContact stick = stick_contact(model, contact, 0.0);
    const Vec2 from = random.in_box(0.04, 0.04);
    const Vec2 to = from + random.in_disc(0.02);
    const KappaSet inner = robust.kappas(stick, from, to);
    const KappaSet outer = nominal.kappas(stick, from, to);
    for (int k = 0; k < inner.count; ++k) {
      const auto [lo, hi] = inner.intervals[k];
      EXPECT_TRUE(outer.contains(0.5 * (lo + hi))) << i;
    }
  }
}

TEST(PadEnvelope, UsesNoHeap) {
  const Model model = prepare(published_tee(0));
  const PadEnvelope envelope(model, Margin{});
  const StickContact stick = stick_contact(model, model.contacts[0], 0.0);
  const testing::NoHeapScope scope;
  const KappaSet set = envelope.kappas(stick, {0.01, 0.0}, {0.0, 0.001});
  if (testing::heap_is_counted()) {
    EXPECT_EQ(scope.allocations(), 0);
  }
  EXPECT_FALSE(set.empty());
}

}  // namespace
}  // namespace prehensile
