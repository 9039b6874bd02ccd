#include "mechanics/certificate.h"

#include <functional>
#include <vector>

#include <gtest/gtest.h>

#include "mechanics/planar_instant.h"
#include "problems/random_instants.h"
#include "tests/mechanics/instant_cases.h"

namespace prehensile {
namespace {

using testing::grasp_of;
using testing::line_drive;
using testing::point_drive;
using testing::square_grasp;
using testing::told;

constexpr double kAccepted = 1e-6;

/// One wrong answer made from a right one. Units: capacity, pad lever, push rate.
struct Mutation {
  std::string what;
  std::function<void(PlanarInstant&)> apply;
};

struct Units {
  double force, length, rate;
};

std::vector<Mutation> mutations(const RandomInstant& q, const PlanarInstant& a,
                                const Units& units) {
  std::vector<Mutation> all;
  const double df = 1e-3 * units.force;
  const double dv = 1e-3 * units.rate;
  const auto add = [&all](std::string what, std::function<void(PlanarInstant&)> apply) {
    all.push_back({std::move(what), std::move(apply)});
  };
  for (const double sign : {1.0, -1.0}) {
    for (int k = 0; k < 3; ++k) {
      const double twist = sign * (k < 2 ? dv : dv / units.length);
      const double wrench = sign * (k < 2 ? df : df * units.length);
      add("twist", [=](PlanarInstant& m) { m.V_HO[k] += twist; });
      add("push wrench", [=](PlanarInstant& m) { m.w_push[k] += wrench; });
    }
    add("push force", [=](PlanarInstant& m) { m.push_force += sign * df; });
    for (int i = 0; i < q.drive.count; ++i) {
      add("normal force",
          [=](PlanarInstant& m) { m.pusher[i].normal_force += sign * df; });
      add("tangential force",
          [=](PlanarInstant& m) { m.pusher[i].tangential_force += sign * df; });
      add("normal rate", [=](PlanarInstant& m) { m.pusher[i].normal_rate += sign * dv; });
      add("slip rate", [=](PlanarInstant& m) { m.pusher[i].slip_rate += sign * dv; });
    }
    for (int j = 0; j < q.grasp.count; ++j) {
      for (int k = 0; k < 2; ++k) {
        add("finger force", [=](PlanarInstant& m) { m.finger[j].force[k] += sign * df; });
      }
    }
  }
  for (int i = 0; i < q.drive.count; ++i) {
    for (const ContactMode mode : {ContactMode::kOpen, ContactMode::kStick,
                                   ContactMode::kSlipPlus, ContactMode::kSlipMinus}) {
      const PusherPoint& point = a.pusher[i];
      // A label is wrong only where forces and rates tell the modes apart.
      const bool tells = point.normal_force > df && std::abs(point.slip_rate) > dv;
      if (mode == point.mode || !(tells || mode == ContactMode::kOpen)) continue;
      if (point.normal_force <= df) continue;
      add("pusher mode", [=](PlanarInstant& m) { m.pusher[i].mode = mode; });
    }
  }
  for (int j = 0; j < q.grasp.count; ++j) {
    if (a.finger[j].mode != ContactMode::kSlip) continue;
    const Vec2 c = point_velocity(a.V_HO, {q.grasp.x[j], q.grasp.y[j]});
    if (c.norm() < dv) continue;
    add("finger mode", [=](PlanarInstant& m) { m.finger[j].mode = ContactMode::kStick; });
  }
  for (const InstantStatus status :
       {InstantStatus::kHolds, InstantStatus::kSeparated, InstantStatus::kAmbiguous,
        InstantStatus::kDynamic, InstantStatus::kJammed, InstantStatus::kNotRun,
        InstantStatus::kOutOfIterations, InstantStatus::kBadInput,
        InstantStatus::kNonuniqueForces}) {
    add("status", [=](PlanarInstant& m) { m.status = status; });
  }
  add("count", [](PlanarInstant& m) { m.pusher_count = 0; });
  add("not a number", [](PlanarInstant& m) { m.V_HO[1] = kNan; });
  return all;
}

Units units_of(const PlanarGrasp& grasp, const PlanarDrive& drive) {
  double square = 0.0;
  double rate = 0.0;
  for (int j = 0; j < grasp.count; ++j) {
    square += grasp.bound[j] * Vec2(grasp.x[j], grasp.y[j]).squaredNorm();
  }
  for (int i = 0; i < drive.count; ++i) {
    rate = std::max(rate, point_velocity(drive.V_HP, drive.p_HC[i]).norm());
  }
  return {grasp.capacity(), std::sqrt(square / grasp.capacity()), rate};
}

/// Limit analysis from both sides: the bounds meet in the answer, and any other motion
/// gives a larger upper one.
TEST(Certificate, ForceLiesBetweenItsBounds) {
  int compared = 0;
  for (int i = 0; i < 300; ++i) {
    const RandomInstant q = random_instant(22, i, {.points_per_pad = 8});
    const PlanarInstant a = solve_planar(q.grasp, q.drive);
    if (a.status != InstantStatus::kMoves) continue;
    const Certificate certificate = certify(q.grasp, q.drive, a);
    const double unit = q.grasp.capacity();
    EXPECT_NEAR(certificate.force_low, a.push_force, 1e-9 * unit) << i;
    // Where the object turns about a pad point or hardly dissipates, the bound is as good
    // as the twist.
    EXPECT_NEAR(certificate.force_high, a.push_force, 1e-6 * unit) << i;
    const PlanarWrench p = a.w_push / a.push_force;
    const PlanarTwist other = a.V_HO + 0.1 * a.V_HO.norm() * PlanarTwist(0.3, -0.5, 0.7);
    EXPECT_GE(force_upper_bound(q.grasp, p, other), a.push_force - 1e-9 * unit) << i;
    ++compared;
  }
  EXPECT_GT(compared, 150);
}

TEST(Certificate, RejectsEveryPerturbedOutput) {
  int mutants = 0;
  for (int i = 0; i < 500; ++i) {
    const int points = i % 3 == 0 ? 2 : i % 3 == 1 ? 4 : 16;
    const RandomInstant q = random_instant(21, i, {.points_per_pad = points});
    const PlanarInstant a = solve_planar(q.grasp, q.drive);
    if (a.status != InstantStatus::kMoves) continue;
    ASSERT_LE(certify(q.grasp, q.drive, a).worst, 1e-9);
    for (const Mutation& mutation : mutations(q, a, units_of(q.grasp, q.drive))) {
      PlanarInstant wrong = a;
      mutation.apply(wrong);
      ++mutants;
      const Certificate certificate = certify(q.grasp, q.drive, wrong);
      EXPECT_FALSE(certificate.holds(kAccepted))
          << i << " " << mutation.what << " " << name(wrong.status) << ": "
          << told(certificate);
    }
  }
  EXPECT_GT(mutants, 20000);
}

TEST(Certificate, TheSplitOfFrictionAlongAStickingLineIsOpen) {
  const PlanarGrasp grasp = [] {
    PlanarGrasp g = square_grasp(4, 0.006, 20.0);
    g.w_g = wrench_of({0.0, 0.0}, {0.0, -4.0});
    return g;
  }();
  const PlanarDrive drive = line_drive({-0.04, 0.0}, 0.03, {1.0, 0.0}, 0.5, {0.01, 0.0});
  PlanarInstant a = solve_planar(grasp, drive);
  a.pusher[0].tangential_force += 0.3;
  a.pusher[1].tangential_force -= 0.3;
  EXPECT_TRUE(certify(grasp, drive, a).holds(kAccepted));
  a.pusher[0].tangential_force += 8.0;  // Beyond the cone of one end.
  a.pusher[1].tangential_force -= 8.0;
  EXPECT_FALSE(certify(grasp, drive, a).holds(kAccepted));
}

TEST(Certificate, AcceptsAnyBoundedForceWhereAFingerPointRestsAndNoOther) {
  // Rotation about a pad point, driven by a sticking line.
  const PlanarGrasp grasp = grasp_of(
      {{0.0, 0.0}, {0.006, 0.0}, {-0.006, 0.0}, {0.0, 0.006}, {0.0, -0.006}}, 20.0);
  PlanarDrive drive = line_drive({-0.03, -0.02}, 0.01, {1.0, 0.0}, 0.8, {0.0, 0.0});
  drive.V_HP = {0.0, 0.0, 0.5};
  PlanarInstant a = solve_planar(grasp, drive);
  ASSERT_EQ(a.status, InstantStatus::kNonuniqueForces);
  ASSERT_TRUE(certify(grasp, drive, a).holds(kAccepted));
  PlanarInstant beyond = a;
  beyond.finger[0].force = {4.1, 0.0};
  EXPECT_GT(certify(grasp, drive, beyond).entries[Certificate::kFrictionCone].value,
            1e-3);
  PlanarInstant wide = a;
  wide.force_high += 1.0;
  EXPECT_FALSE(certify(grasp, drive, wide).holds(kAccepted));
  wide = a;
  wide.force_low = a.force_high + 1.0;
  EXPECT_FALSE(certify(grasp, drive, wide).holds(kAccepted));
}

TEST(Certificate, EvidenceOfAFallMustBeAFall) {
  int falls = 0;
  for (int i = 0; i < 3000; ++i) {
    const RandomInstant q = random_instant(22, i, {.points_per_pad = 4});
    PlanarInstant a = solve_planar(q.grasp, q.drive);
    if (a.status != InstantStatus::kDynamic) continue;
    ++falls;
    EXPECT_TRUE(certify(q.grasp, q.drive, a).holds(kAccepted));
    a.evidence = -a.evidence;
    EXPECT_FALSE(certify(q.grasp, q.drive, a).holds(kAccepted));
    a.evidence = PlanarTwist::Zero();
    EXPECT_FALSE(certify(q.grasp, q.drive, a).holds(kAccepted));
    a.evidence = PlanarTwist::Constant(kNan);
    EXPECT_FALSE(certify(q.grasp, q.drive, a).holds(kAccepted));
  }
  EXPECT_GT(falls, 50);
}

TEST(Certificate, EvidenceOfAmbiguityIsCheckedTwistByTwist) {
  int ambiguous = 0;
  for (int i = 0; i < 3000; ++i) {
    const RandomInstant q = random_instant(23, i, {.points_per_pad = 4});
    const PlanarInstant a = solve_planar(q.grasp, q.drive);
    if (a.status != InstantStatus::kAmbiguous) continue;
    ++ambiguous;
    EXPECT_TRUE(certify(q.grasp, q.drive, a).holds(kAccepted));
    PlanarInstant wrong = a;
    wrong.evidence = PlanarTwist::Constant(kNan);
    wrong.other = a.V_HO;
    EXPECT_FALSE(certify(q.grasp, q.drive, wrong).holds(kAccepted));
    wrong.other =
        a.V_HO + 1e-3 * units_of(q.grasp, q.drive).rate * PlanarTwist(0.6, 0.8, 90.0);
    EXPECT_FALSE(certify(q.grasp, q.drive, wrong).holds(kAccepted));
    wrong = a;
    wrong.evidence = -a.evidence;
    EXPECT_FALSE(certify(q.grasp, q.drive, wrong).holds(kAccepted));
  }
  EXPECT_GT(ambiguous, 50);
}

// How firmly the pads hold gravity.

TEST(GravitySlack, OfADiscIsTheDistanceFromItsLimitSurface) {
  // A force at the centre, far below the bound on torque, leaves capacity - weight.
  PlanarGrasp grasp = testing::disc_grasp(96, 0.01, 20.0);
  for (const double weight : {15.0, 19.0, 21.0, 30.0}) {
    grasp.w_g = {0.0, -weight, 0.0};
    PlanarTwist u;
    const double slack = gravity_slack(grasp, &u);
    EXPECT_NEAR(slack, (20.0 - weight) / std::max(20.0, weight), 2e-3);
    EXPECT_EQ(slack > 0.0, weight < 20.0);
  }
}

TEST(GravitySlack, GravityTooSmallForItsSquareIsNone) {
  PlanarGrasp grasp = testing::disc_grasp(96, 0.01, 20.0);
  const double without = gravity_slack(grasp);
  EXPECT_GT(without, 0.1);
  for (const double weight : {1e-30, 1e-160, 1e-200, 1e-310}) {
    grasp.w_g = {0.0, -weight, 0.0};
    EXPECT_NEAR(gravity_slack(grasp), without, 1e-12) << weight;
  }
}

TEST(GravitySlack, HasTheSignOfTheBestOfManyTwists) {
  for (int i = 0; i < 1500; ++i) {
    RandomInstant q = random_instant(24, i, {.points_per_pad = i % 2 ? 2 : 16});
    const double slack = gravity_slack(q.grasp);
    const double length = units_of(q.grasp, q.drive).length;
    double least = 1e300;
    for (int k = 0; k < 4000; ++k) {
      const double z = -1.0 + (2.0 * k + 1.0) / 4000.0;
      const double r = std::sqrt(1.0 - z * z);
      const PlanarTwist u(r * std::cos(2.399963 * k), r * std::sin(2.399963 * k),
                          z / length);
      double power = 0.0;
      for (int j = 0; j < q.grasp.count; ++j) {
        power +=
            q.grasp.bound[j] * point_velocity(u, {q.grasp.x[j], q.grasp.y[j]}).norm();
      }
      least = std::min(least, power - q.grasp.w_g.dot(u));
    }
    const double force = std::max(q.grasp.capacity(), q.grasp.w_g.head<2>().norm());
    EXPECT_LE(slack, least / force + 1e-3) << i;
    if (least < 0.0) {
      EXPECT_LT(slack, 0.0) << i;
    }
    EXPECT_GE(slack, least / force - 0.02 * (1.0 + std::abs(least / force))) << i;
  }
}

TEST(GravitySlack, WorstTwistHasThatSlack) {
  for (int i = 0; i < 500; ++i) {
    const RandomInstant q = random_instant(25, i, {.points_per_pad = 8});
    PlanarTwist u;
    const double slack = gravity_slack(q.grasp, &u);
    double power = 0.0;
    for (int j = 0; j < q.grasp.count; ++j) {
      power += q.grasp.bound[j] * point_velocity(u, {q.grasp.x[j], q.grasp.y[j]}).norm();
    }
    const double force = std::max(q.grasp.capacity(), q.grasp.w_g.head<2>().norm());
    EXPECT_NEAR((power - q.grasp.w_g.dot(u)) / force, slack, 1e-9);
  }
}

}  // namespace
}  // namespace prehensile
