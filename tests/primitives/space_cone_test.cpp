/// Motion cones in space.
#include "primitives/space_cone.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>
#include <utility>

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
void look_beside_the_edges(int scenes) {
  int edges = 0;
  for (int index = 0; index < 40 && edges < 60 && index < scenes; ++index) {
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
  EXPECT_GE(edges, std::min(60, 2 * scenes));
}

TEST(SpaceCone, EdgesAreWhereInstantsChange) { look_beside_the_edges(3); }

TEST(SpaceCone, FullEdgesAreWhereInstantsChange) { look_beside_the_edges(40); }

// A scan a hundred times as dense finds no range and no gap of a degree or more that the
// slices lack, where these have room for all ranges.
void scan_densely(int scenes) {
  constexpr int kPlaces = 4000;
  constexpr int kDegree = kPlaces / 180;
  int slices = 0;
  int full = 0;
  int narrow = 0;
  for (int index = 0; slices < 6 * scenes; ++index) {
    const RandomPush c = random_spatial_push(55, index);
    const Model model = prepare(c.scene);
    const Grasp& start = c.scene.start;
    if (model.contacts[0].is_point || !model.push_needs_space(model.contacts[0]))
      continue;
    const MotionCone flat =
        motion_cone(cone_member(model, 0, c.push.place, start.X_HO), {}, 25);
    const MotionCone cone = cone_in_space(model, start, 0, c.push.place, flat);
    for (const ConeSlice& slice : cone.slices) {
      if (slice.nominal.count == 0) continue;
      ++slices;
      if (slice.nominal.count == static_cast<int>(slice.nominal.intervals.size())) {
        ++full;
        continue;
      }
      int wrong = 0;
      int longest = 0;
      for (int k = 1; k < kPlaces; ++k) {
        const double rate =
            std::tan(0.498 * std::numbers::pi * (2.0 * k / kPlaces - 1.0)) / cone.c;
        const SpatialVerdict verdict =
            sticks_in_space(model, start, 0, c.push.place, slice.direction, rate);
        const bool differs =
            verdict.is_known && (verdict.margin >= 0.0) != slice.nominal.contains(rate);
        wrong = differs ? wrong + 1 : 0;
        longest = std::max(longest, wrong);
      }
      EXPECT_LT(longest, kDegree) << index << " " << slice.direction;
      narrow += longest > 0 ? 1 : 0;
    }
  }
  std::printf(
      "of %d slices %d have all ranges they have room for, and %d lack one or a "
      "gap of less than a degree\n",
      slices, full, narrow);
  EXPECT_LE(full, slices / 10);
  EXPECT_LE(narrow, 2 + slices / 10);
}

TEST(SpaceCone, HasWhatADenseScanFinds) { scan_densely(1); }

TEST(SpaceCone, FullHasWhatADenseScanFinds) { scan_densely(20); }

std::vector<SpaceMember> corners_of(const Model& model, const Grasp& start,
                                    double place) {
  UncertaintyBox box;
  box[Unknown::kFriction] = box[Unknown::kGripForce] = 0.1;
  box[Unknown::kPlace] = 1e-3;
  std::vector<SpaceMember> members;
  for (std::uint64_t i = 0; i < 8; ++i) {
    std::optional<SpaceMember> member =
        space_member(model, start, 0, place, box, corner(box, i));
    if (member) members.push_back(std::move(*member));
  }
  return members;
}

// A motion in the robust cone sticks in the scene and in every member; beyond an edge
// that is not nominal, some member slips.
void look_beside_the_robust_edges(int scenes) {
  int edges = 0;
  int narrower = 0;
  for (int index = 0; index < scenes; ++index) {
    const RandomPush c = random_spatial_push(53, index);
    const Model model = prepare(c.scene);
    const Grasp& start = c.scene.start;
    const double place = c.push.place;
    const MotionCone flat = motion_cone(cone_member(model, 0, place, start.X_HO), {}, 13);
    const std::vector<SpaceMember> members = corners_of(model, start, place);
    const MotionCone cone = cone_in_space(model, start, 0, place, flat, members);
    EXPECT_EQ(cone.members, static_cast<int>(members.size()));
    const auto all_stick = [&](double direction, double rate) {
      return std::all_of(members.begin(), members.end(), [&](const SpaceMember& member) {
        return sticks_in_space(member, 0, direction, rate).margin >= 0.0;
      });
    };
    for (const ConeSlice& slice : cone.slices) {
      for (int i = 0; i < slice.robust.count; ++i) {
        const KappaSet::Interval& robust = slice.robust.intervals[i];
        for (const double edge : {robust.lo, robust.hi}) {
          if (std::isinf(edge)) continue;
          ++edges;
          EXPECT_TRUE(slice.nominal.contains(edge)) << index;
          EXPECT_TRUE(all_stick(slice.direction, edge)) << index;
          const double beyond =
              std::tan(std::atan(cone.c * edge) + (edge == robust.lo ? -1e-4 : 1e-4)) /
              cone.c;
          if (!slice.nominal.contains(beyond)) continue;
          ++narrower;
          EXPECT_FALSE(all_stick(slice.direction, beyond)) << index;
        }
      }
    }
    for (const DirectionRange& range : cone.robust) {
      EXPECT_TRUE(all_stick(range.lo, 0.0) && all_stick(range.hi, 0.0)) << index;
    }
  }
  EXPECT_GT(4 * edges, 5 * scenes);
  EXPECT_GT(6 * narrower, 5 * scenes);
}

TEST(SpaceCone, RobustEdgesAreWhereAMemberSlips) { look_beside_the_robust_edges(2); }

TEST(SpaceCone, FullRobustEdgesAreWhereAMemberSlips) { look_beside_the_robust_edges(24); }

// Where the scene is symmetric a robust motion sticks in every member as the pad plane
// has it.
void compare_with_members_in_the_pad_plane(int scenes) {
  int asked = 0;
  for (int index = 0; index < scenes; ++index) {
    const RandomPush c = random_push(54, index);
    const Model model = prepare(c.scene);
    if (model.contacts[0].is_point) continue;
    const Grasp& start = c.scene.start;
    const double place = c.push.place;
    const MotionCone flat = motion_cone(cone_member(model, 0, place, start.X_HO), {}, 13);
    const std::vector<SpaceMember> members = corners_of(model, start, place);
    const MotionCone cone = cone_in_space(model, start, 0, place, flat, members);
    // By the planar instants of the members.
    const auto all_stick = [&](double direction, double turn) {
      return std::all_of(members.begin(), members.end(), [&](const SpaceMember& member) {
        const LinearPush push{.place = member.place,
                              .e = rotated(direction, member.model.contacts[0].n),
                              .travel = 0.01,
                              .turn = 0.01 * std::tan(turn) / cone.c};
        PushInstant planar(member.model, push, member.grasp, {});
        const Seat seat = planar.geometry().first();
        return !planar.solve(seat, 0.0, Vec2::Zero()) &&
               planar.margin(seat, Regime::kStick).least() >= 0.0;
      });
    };
    for (const ConeSlice& slice : cone.slices) {
      for (int i = 0; i < slice.robust.count; ++i) {
        const KappaSet::Interval& robust = slice.robust.intervals[i];
        if (std::isinf(robust.lo) || std::isinf(robust.hi)) continue;
        const double low = std::atan(cone.c * robust.lo);
        const double high = std::atan(cone.c * robust.hi);
        if (high - low < 1e-3) continue;
        ++asked;
        EXPECT_TRUE(all_stick(slice.direction, low + 1e-4)) << index;
        EXPECT_TRUE(all_stick(slice.direction, high - 1e-4)) << index;
        const double beyond = std::tan(high + 1e-4) / cone.c;
        if (slice.nominal.contains(beyond)) {
          EXPECT_FALSE(all_stick(slice.direction, high + 1e-4)) << index;
        }
      }
    }
  }
  EXPECT_GT(3 * asked, 2 * scenes);
}

TEST(SpaceCone, RobustIsThatOfThePadPlaneWhereTheSceneIsSymmetric) {
  compare_with_members_in_the_pad_plane(8);
}

TEST(SpaceCone, FullRobustIsThatOfThePadPlaneWhereTheSceneIsSymmetric) {
  compare_with_members_in_the_pad_plane(30);
}

TEST(SpaceCone, WithoutMembersRobustIsNominal) {
  const RandomPush c = random_spatial_push(53, 2);
  const Model model = prepare(c.scene);
  const MotionCone flat =
      motion_cone(cone_member(model, 0, c.push.place, c.scene.start.X_HO), {}, 7);
  const MotionCone cone = cone_in_space(model, c.scene.start, 0, c.push.place, flat);
  for (const ConeSlice& slice : cone.slices) {
    ASSERT_EQ(slice.robust.count, slice.nominal.count);
    for (int i = 0; i < slice.robust.count; ++i) {
      EXPECT_NEAR(std::atan(cone.c * slice.robust.intervals[i].lo),
                  std::atan(cone.c * slice.nominal.intervals[i].lo), 1e-9);
    }
  }
}

}  // namespace
}  // namespace prehensile
