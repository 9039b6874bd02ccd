#include "primitives/motion_cone.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "problems/random_pushes.h"
#include "problems/random_stream.h"

namespace prehensile {
namespace {

UncertaintyBox some_box() {
  UncertaintyBox box;
  box[Unknown::kFriction] = box[Unknown::kGripForce] = 0.2;
  box[Unknown::kTorqueRadius] = 0.1;
  box[Unknown::kPlace] = 1e-3;
  box[Unknown::kDirection] = 0.02;
  return box;
}

std::vector<ConeMember> members_of(const RandomPush& random, const UncertaintyBox& box,
                                   int count) {
  std::vector<ConeMember> members;
  for (int i = 0; i < count; ++i) {
    const CompiledMember member = cone_member(
        random.scene, random.scene.start, random.push.contact, random.push.place, box,
        random_point(1, static_cast<std::uint64_t>(i)));
    if (member.usable) members.push_back(member.member);
  }
  return members;
}

bool inside(const std::vector<DirectionRange>& ranges, double direction) {
  return std::any_of(ranges.begin(), ranges.end(), [&](const DirectionRange& r) {
    return r.lo <= direction && direction <= r.hi;
  });
}

TEST(MotionCone, AgreesWithInstants) {
  RandomStream stream(9);
  int sticking = 0, slipping = 0;
  for (int i = 0; i < 300; ++i) {
    const RandomPush random = random_push(21, static_cast<std::uint64_t>(i));
    const Model model = prepare(random.scene);
    const PlanarPose& X_HO = random.scene.start.X_HO;
    if (!(model.c > 0.0) || !pads_on_object(model, X_HO)) continue;
    const ConeMember member =
        cone_member(model, random.push.contact, random.push.place, X_HO);
    const MotionCone cone = motion_cone(member, {}, 2);
    for (int k = 0; k < 20; ++k) {
      const double direction = stream.in(-1.5, 1.5);
      PlanarDrive drive = member.drive;
      const Vec2 v = rotated(X_HO.theta + direction, member.contact.n);
      drive.V_HP = {v.x(), v.y(), 0.0};
      const PlanarInstant instant =
          solve_limit_surface(member.surface, member.w_g, drive);
      if (!usable(instant.status)) continue;
      const bool sticks_here = cone.is_point
                                   ? instant.pusher[0].mode == ContactMode::kStick
                                   : (instant.V_HO - drive.V_HP).norm() < 1e-9;
      const bool near_edge =
          std::any_of(cone.nominal.begin(), cone.nominal.end(), [&](const auto& r) {
            return std::min(std::abs(r.lo - direction), std::abs(r.hi - direction)) <
                   1e-6;
          });
      // Ranges narrower than the scan may be missed, and only those.
      const bool narrow = sticks_here && !sticks(member, direction + 0.01, 0.0) &&
                          !sticks(member, direction - 0.01, 0.0);
      if (near_edge || narrow) continue;
      EXPECT_EQ(inside(cone.nominal, direction), sticks_here) << i << ' ' << direction;
      ++(sticks_here ? sticking : slipping);
    }
  }
  EXPECT_GT(sticking, 300);
  EXPECT_GT(slipping, 300);
}

TEST(MotionCone, RobustIsInsideNominalAndSticksForEveryMember) {
  RandomStream stream(4);
  int checked = 0;
  for (int i = 0; i < 60; ++i) {
    const RandomPush random = random_push(22, static_cast<std::uint64_t>(i));
    const Model model = prepare(random.scene);
    if (!(model.c > 0.0) || !pads_on_object(model, random.scene.start.X_HO)) continue;
    const ConeMember nominal = cone_member(model, random.push.contact, random.push.place,
                                           random.scene.start.X_HO);
    const std::vector<ConeMember> members = members_of(random, some_box(), 20);
    const MotionCone cone = motion_cone(nominal, members, 61);
    for (const DirectionRange& range : cone.robust) {
      const double middle = 0.5 * (range.lo + range.hi);
      EXPECT_TRUE(inside(cone.nominal, middle));
      for (const ConeMember& member : members) EXPECT_TRUE(sticks(member, middle, 0.0));
    }
    for (const ConeSlice& slice : cone.slices) {
      for (int k = 0; k < slice.robust.count; ++k) {
        const KappaSet::Interval& interval = slice.robust.intervals[k];
        const double lo = std::max(interval.lo, -1e4);
        const double hi = std::min(interval.hi, 1e4);
        if (lo > hi) continue;  // all of it beyond what is drawn here
        const double rate = lo + stream.in(0.0, 1.0) * (hi - lo);
        EXPECT_TRUE(slice.nominal.contains(rate));
        for (const ConeMember& member : members) {
          EXPECT_TRUE(sticks(member, slice.direction, rate));
          ++checked;
        }
      }
    }
  }
  EXPECT_GT(checked, 500);
}

TEST(MotionCone, WithoutUncertaintyRobustIsNominal) {
  const RandomPush random = random_push(22, 3);
  const Model model = prepare(random.scene);
  const ConeMember nominal =
      cone_member(model, random.push.contact, random.push.place, random.scene.start.X_HO);
  const std::vector<ConeMember> members = members_of(random, UncertaintyBox{}, 3);
  ASSERT_EQ(members.size(), 3U);
  const MotionCone cone = motion_cone(nominal, members);
  ASSERT_EQ(cone.nominal.size(), cone.robust.size());
  for (std::size_t k = 0; k < cone.nominal.size(); ++k) {
    EXPECT_NEAR(cone.nominal[k].lo, cone.robust[k].lo, 1e-8);
    EXPECT_NEAR(cone.nominal[k].hi, cone.robust[k].hi, 1e-8);
  }
}

TEST(MotionCone, IntersectionOfSets) {
  KappaSet a, b;
  a.count = 2;
  a.intervals[0] = {-2.0, -1.0};
  a.intervals[1] = {1.0, 3.0};
  b.count = 1;
  b.intervals[0] = {-1.5, 2.0};
  const KappaSet both = intersection(a, b);
  ASSERT_EQ(both.count, 2);
  EXPECT_EQ(both.intervals[0].lo, -1.5);
  EXPECT_EQ(both.intervals[0].hi, -1.0);
  EXPECT_EQ(both.intervals[1].hi, 2.0);
  EXPECT_TRUE(intersection(a, KappaSet{}).empty());
}

}  // namespace
}  // namespace prehensile
