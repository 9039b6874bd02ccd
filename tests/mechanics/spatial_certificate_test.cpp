#include "mechanics/spatial_certificate.h"

#include <functional>
#include <iostream>

#include <gtest/gtest.h>

#include "problems/random_spatial.h"
#include "tests/mechanics/spatial_cases.h"

namespace prehensile {
namespace {

using testing::grasp_of;
using testing::push;
using testing::square_points;
using testing::told;

constexpr std::array kJawModes = {JawMode::kCoupled, JawMode::kFixedJaw1,
                                  JawMode::kFixedJaw2, JawMode::kIndependent,
                                  JawMode::kLocked};

/// Units of the tests, without friction in the force.
struct Units {
  double force, rate, length;
};

Units units_of(const SpatialProblem& problem) {
  return {std::max(problem.grip_force, problem.w_g.head<3>().norm()),
          problem.V_HP.head<3>().norm(), 0.01};
}

using Mutation = std::function<void(SpatialInstant&)>;

/// Every number of an answer with a motion, moved by `by` of its unit.
std::vector<std::pair<std::string, Mutation>> mutations(const SpatialProblem& problem,
                                                        double by) {
  const Units unit = units_of(problem);
  std::vector<std::pair<std::string, Mutation>> all;
  const auto add = [&all](std::string what, Mutation apply) {
    all.emplace_back(std::move(what), std::move(apply));
  };
  for (int i = 0; i < 6; ++i) {
    const double rate = by * (i < 3 ? unit.rate : unit.rate / unit.length);
    const double force = by * (i < 3 ? unit.force : unit.force * unit.length);
    add("twist " + std::to_string(i), [=](SpatialInstant& a) { a.V_HO[i] += rate; });
    add("push " + std::to_string(i), [=](SpatialInstant& a) { a.w_push[i] += force; });
  }
  const double force = by * unit.force;
  const double rate = by * unit.rate;
  for (int i = 0; i < jaw_freedoms(problem).count; ++i) {
    add("jaw rate", [=](SpatialInstant& a) { a.jaw_rate[i] += rate; });
  }
  add("push force", [=](SpatialInstant& a) { a.push_force += force; });
  for (int j = 0; j < problem.count; ++j) {
    const std::string at = " of point " + std::to_string(j);
    add("normal force" + at,
        [=](SpatialInstant& a) { a.point[j].normal_force += force; });
    add("normal rate" + at, [=](SpatialInstant& a) { a.point[j].normal_rate += rate; });
    for (int i = 0; i < 2; ++i) {
      add("friction" + at,
          [=](SpatialInstant& a) { a.point[j].tangential_force[i] += force; });
      add("slip" + at, [=](SpatialInstant& a) { a.point[j].slip_rate[i] += rate; });
    }
    add("spin moment" + at,
        [=](SpatialInstant& a) { a.point[j].spin_moment += force * unit.length; });
    add("spin rate" + at,
        [=](SpatialInstant& a) { a.point[j].spin_rate += rate / unit.length; });
  }
  return all;
}

TEST(SpatialCertificate, RejectsEveryNumberMoved) {
  int tried = 0;
  for (int i = 0; i < 120; ++i) {
    const SpatialProblem problem =
        random_spatial(101, i,
                       {.points_per_pad = std::array{1, 2, 4, 8}[i % 4],
                        .jaw_mode = kJawModes[i % 5],
                        .acceleration = i % 3 == 0 ? 1.0 : 0.0,
                        .spin_radius = i % 2 == 0 ? 0.0 : 0.003});
    const SpatialInstant answer = solve_spatial(problem);
    if (answer.status != InstantStatus::kMoves &&
        answer.status != InstantStatus::kAmbiguous) {
      continue;
    }
    ASSERT_TRUE(certify(problem, answer).holds()) << told(certify(problem, answer));
    for (const double by : {1e-3, -1e-3}) {
      for (const auto& [what, apply] : mutations(problem, by)) {
        SpatialInstant moved = answer;
        apply(moved);
        EXPECT_FALSE(certify(problem, moved).holds()) << i << " " << what;
        ++tried;
      }
    }
  }
  EXPECT_GT(tried, 10000);
}

TEST(SpatialCertificate, RejectsFalseModes) {
  for (int i = 0; i < 60; ++i) {
    const SpatialProblem problem = random_spatial(103, i, {.points_per_pad = 4});
    const SpatialInstant answer = solve_spatial(problem);
    if (answer.status != InstantStatus::kMoves) continue;
    for (int j = 0; j < answer.count; ++j) {
      SpatialInstant moved = answer;
      ContactMode& mode = moved.point[j].mode;
      if (mode == ContactMode::kSlip) {
        mode = ContactMode::kStick;
      } else if (mode == ContactMode::kStick) {
        mode = ContactMode::kOpen;
      } else {
        mode = ContactMode::kSlipPlus;
      }
      EXPECT_FALSE(certify(problem, moved).holds()) << i << " " << j;
    }
  }
}

TEST(SpatialCertificate, RejectsFalseStatuses) {
  int statuses_seen = 0;
  std::array<bool, 10> seen{};
  for (int i = 0; i < 200; ++i) {
    const SpatialProblem problem = random_spatial(107, i);
    const SpatialInstant answer = solve_spatial(problem);
    if (!seen[static_cast<std::size_t>(answer.status)]) ++statuses_seen;
    seen[static_cast<std::size_t>(answer.status)] = true;
    for (int s = 0; s < 10; ++s) {
      SpatialInstant claimed = answer;
      claimed.status = static_cast<InstantStatus>(s);
      if (claimed.status == answer.status) continue;
      EXPECT_FALSE(certify(problem, claimed).holds())
          << i << " " << name(answer.status) << " as " << name(claimed.status);
    }
  }
  EXPECT_GE(statuses_seen, 3);
}

TEST(SpatialCertificate, RejectsFallsThatDoNotFall) {
  int falls = 0;
  for (int i = 0; i < 200; ++i) {
    const SpatialProblem problem = random_spatial(109, i, {.points_per_pad = 4});
    const SpatialInstant answer = solve_spatial(problem);
    if (answer.status != InstantStatus::kDynamic) continue;
    ++falls;
    SpatialInstant upward = answer;
    upward.evidence = -answer.evidence;
    EXPECT_FALSE(certify(problem, upward).holds()) << i;
    SpatialInstant slow = answer;
    slow.evidence *= 1e-6;
    EXPECT_FALSE(certify(problem, slow).holds()) << i;
    SpatialProblem light = problem;
    light.w_g.setZero();
    EXPECT_FALSE(certify(light, answer).holds()) << i;
  }
  EXPECT_GT(falls, 5);
}

TEST(SpatialCertificate, RejectsJamsThatDoNotJam) {
  SpatialProblem problem = grasp_of(square_points(2, 0.004), 0.01, 20.0, {.mu = 0.5});
  problem.jaw_mode = JawMode::kFixedJaw1;
  push(problem, {{0.0, 0.0, 0.01}}, -Vec3::UnitZ(), 0.3, {0.0, 0.0, -0.01});
  const SpatialInstant answer = solve_spatial(problem);
  ASSERT_EQ(answer.status, InstantStatus::kJammed);
  EXPECT_TRUE(certify(problem, answer).holds());
  SpatialProblem receding = problem;
  receding.V_HP = -problem.V_HP;
  EXPECT_FALSE(certify(receding, answer).holds());
  SpatialProblem coupled = problem;
  coupled.jaw_mode = JawMode::kCoupled;
  EXPECT_FALSE(certify(coupled, answer).holds());
  for (int j = 0; j < answer.count; ++j) {
    SpatialInstant moved = answer;
    moved.point[j].normal_force += 1e-3;
    EXPECT_FALSE(certify(problem, moved).holds()) << j;
  }
}

TEST(SpatialCertificate, AcceptsTheSplitThatALineLeavesOpen) {
  // Two points that stick share the force along their line as they like.
  SpatialProblem problem = grasp_of(square_points(4, 0.006), 0.01, 20.0, {.mu = 0.5});
  push(problem, {{-0.04, -0.03, 0.0}, {-0.04, 0.03, 0.0}}, Vec3::UnitX(), 0.5,
       {0.01, 0.0, 0.0});
  SpatialInstant answer = solve_spatial(problem);
  ASSERT_TRUE(certify(problem, answer).holds());
  const int first = problem.patch[2].first;
  const Vec3 along = Vec3::UnitY();
  const Vec2 shift(problem.patch[2].t.dot(along), problem.patch[2].o().dot(along));
  answer.point[first].tangential_force += shift;
  answer.point[first + 1].tangential_force -= shift;
  EXPECT_TRUE(certify(problem, answer).holds()) << told(certify(problem, answer));
  answer.point[first].tangential_force += 10.0 * shift;
  answer.point[first + 1].tangential_force -= 10.0 * shift;
  EXPECT_FALSE(certify(problem, answer).holds());
}

}  // namespace
}  // namespace prehensile
