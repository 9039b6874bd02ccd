/// Motion cones in space.
#include "primitives/space_cone.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "primitives/push_instant.h"
#include "problems/random_pushes.h"
#include "problems/random_stream.h"

namespace prehensile {
namespace {

struct Drawn {
  double direction, omega_per_speed;
};

Drawn draw(RandomStream& stream, double c) {
  return {stream.in(-1.2, 1.2), std::tan(stream.in(-1.4, 1.4)) / c};
}

// Where the scene is symmetric the verdict is that of the planar instant.
TEST(SpaceCone, IsThatOfThePadPlaneWhereTheSceneIsSymmetric) {
  RandomStream stream(5);
  int known = 0;
  int stick = 0;
  for (int index = 0; index < 600; ++index) {
    const RandomPush c = random_push(51, index);
    const Model model = prepare(c.scene);
    const PushContact& contact = model.contacts[0];
    const Drawn motion = draw(stream, model.c);
    LinearPush push = c.push;
    push.e = rotated(motion.direction, contact.n);
    push.travel = 0.01;
    push.turn = contact.is_point ? 0.0 : 0.01 * motion.omega_per_speed;
    push.bend = 0.0;
    PushInstant flat(model, push, c.scene.start, {});
    const Seat seat = flat.geometry().first();
    const bool moves = !flat.solve(seat, 0.0, Vec2::Zero());
    const SpatialVerdict space = sticks_in_space(
        model, c.scene.start, 0, push.place, motion.direction, motion.omega_per_speed);
    if (!moves || !space.is_known) continue;
    const double margin = flat.margin(seat, Regime::kStick).least();
    if (std::abs(margin) < 1e-5) continue;
    ++known;
    stick += margin >= 0.0 ? 1 : 0;
    EXPECT_EQ(margin >= 0.0, space.margin >= 0.0) << index << " " << margin;
  }
  EXPECT_GT(known, 300);
  EXPECT_GT(stick, 60);
}

// Instants a little inside and a little outside of every edge say so.
TEST(SpaceCone, EdgesAreWhereInstantsChange) {
  int edges = 0;
  for (int index = 0; index < 40 && edges < 60; ++index) {
    const RandomPush c = random_spatial_push(52, index);
    const Model model = prepare(c.scene);
    if (!model.push_needs_space(model.contacts[0])) continue;
    const Grasp& start = c.scene.start;
    const MotionCone flat =
        motion_cone(cone_member(model, 0, c.push.place, start.X_HO), {}, 9);
    const MotionCone cone = cone_in_space(model, start, 0, c.push.place, flat);
    EXPECT_EQ(cone.slices.size(), flat.slices.size());
    const auto sticks = [&](double direction, double turn) {
      return sticks_in_space(model, start, 0, c.push.place, direction,
                             std::tan(turn) / cone.c)
                 .margin >= 0.0;
    };
    for (const DirectionRange& range : cone.nominal) {
      if (range.hi - range.lo < 1e-3) continue;
      EXPECT_TRUE(sticks(range.lo + 1e-6, 0.0)) << index;
      EXPECT_TRUE(sticks(range.hi - 1e-6, 0.0)) << index;
      EXPECT_FALSE(sticks(range.lo - 1e-6, 0.0)) << index;
      EXPECT_FALSE(sticks(range.hi + 1e-6, 0.0)) << index;
      edges += 2;
    }
    for (const ConeSlice& slice : cone.slices) {
      for (int i = 0; i < slice.nominal.count; ++i) {
        const double low = slice.nominal.intervals[i].lo;
        if (std::isinf(low)) continue;
        const double turn = std::atan(low * cone.c);
        EXPECT_TRUE(sticks(slice.direction, turn + 1e-7)) << index;
        EXPECT_FALSE(sticks(slice.direction, turn - 1e-6)) << index;
        ++edges;
      }
    }
  }
  EXPECT_GE(edges, 60);
}

// The robust part stays inside the nominal one.
TEST(SpaceCone, RobustLiesInNominal) {
  const RandomPush c = random_spatial_push(53, 2);
  const Model model = prepare(c.scene);
  const MotionCone flat =
      motion_cone(cone_member(model, 0, c.push.place, c.scene.start.X_HO), {}, 19);
  const MotionCone cone = cone_in_space(model, c.scene.start, 0, c.push.place, flat);
  for (const ConeSlice& slice : cone.slices) {
    for (int i = 0; i < slice.robust.count; ++i) {
      const KappaSet::Interval& robust = slice.robust.intervals[i];
      const double middle = std::isinf(robust.lo)   ? robust.hi
                            : std::isinf(robust.hi) ? robust.lo
                                                    : 0.5 * (robust.lo + robust.hi);
      EXPECT_TRUE(slice.nominal.contains(middle));
    }
  }
}

}  // namespace
}  // namespace prehensile
