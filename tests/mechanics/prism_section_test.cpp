/// Contacts of a prism's section, laws over random sections, and the residual that judges
/// them.
#include "mechanics/prism_section.h"

#include <map>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/support/no_heap.h"
#include "tests/support/sections.h"

namespace prehensile {
namespace {

using testing::any_convex_section;
using testing::NoHeapScope;
using testing::Random;
using testing::regular_section;

constexpr double kDeg = std::numbers::pi / 180.0;
constexpr PadReach kTall{-1.0, 1.0};

SectionPolygon square() {
  return section_polygon(regular_section(4, 0.01), 1, Vec2::Zero());
}

TEST(PrismContacts, AFlatSquareBetweenTallAndLowPads) {
  const PrismContacts tall = prism_contacts(square(), 0.0, kTall);
  const PrismContacts low = prism_contacts(square(), 0.0, {-0.002, 0.004});
  for (const PrismContacts& contacts : {tall, low}) {
    ASSERT_TRUE(contacts.held());
    for (const SectionTouch& touch : contacts.touch) EXPECT_EQ(touch.count, 2);
    EXPECT_NEAR(contacts.jaw_z[0], -0.01, 1e-15);
    EXPECT_NEAR(contacts.jaw_z[1], 0.01, 1e-15);
    EXPECT_NEAR(contacts.sheet_u, -0.01, 1e-15);
  }
  EXPECT_NEAR(tall.touch[kJaw1].point[1].y(), 0.01, 1e-15);
  EXPECT_NEAR(low.touch[kJaw1].point[1].y(), 0.004, 1e-15);
  EXPECT_NEAR(low.touch[kJaw2].point[0].y(), -0.002, 1e-15);
  EXPECT_EQ(low.touch[kJaw2].vertex[0], -1);
}

TEST(PrismContacts, ATurnedSquareTouchesWithCornersOrIsTouchedByPadEnds) {
  const double roll = 20.0 * kDeg;
  const PrismContacts tall = prism_contacts(square(), roll, kTall);
  const double reach = 0.01 * (std::cos(roll) + std::sin(roll));
  EXPECT_NEAR(tall.jaw_z[1] - tall.jaw_z[0], 2.0 * reach, 1e-15);
  for (const SectionTouch& touch : tall.touch) EXPECT_EQ(touch.count, 1);
  EXPECT_NEAR(tall.touch[kJaw1].normal.x(), 1.0, 1e-15);

  // Short pads about the middle: the side leans over the upper end of pad 1.
  const PrismContacts low = prism_contacts(square(), roll, {-0.002, 0.002});
  EXPECT_EQ(low.touch[kJaw1].vertex[0], -1);
  EXPECT_NEAR(low.touch[kJaw1].point[0].y(), 0.002, 1e-15);
  EXPECT_NEAR(low.touch[kJaw2].point[0].y(), -0.002, 1e-15);
  EXPECT_NEAR((low.touch[kJaw1].normal - Vec2(std::cos(roll), std::sin(roll))).norm(),
              0.0, 1e-14);
  const double side = -0.01 / std::cos(roll) - 0.002 * std::tan(roll);
  EXPECT_NEAR(low.jaw_z[0], side, 1e-15);
}

TEST(PrismContacts, PadsBesideTheSectionTouchNothing) {
  EXPECT_FALSE(prism_contacts(square(), 0.1, {0.02, 0.03}).held());
}

TEST(PrismContacts, TheStayingPointIsTheOneThatDoesNotLiftOff) {
  const PrismContacts flat = prism_contacts(square(), 0.0, kTall);
  for (const int turn : {1, -1}) {
    const PrismContacts after = prism_contacts(square(), turn * 1e-3, kTall);
    for (int i = 0; i < 3; ++i) {
      const SectionTouch& touch = flat.touch[i];
      EXPECT_EQ(touch.vertex[staying_point(touch, turn)], after.touch[i].vertex[0]);
    }
  }
}

/// A question about a random section, lying flat or not.
struct AnyPrism {
  SectionPolygon polygon;
  double roll = 0.0;
  PadReach pads;
  PrismGrip grip;
  CrossSectionDrive drive;

  explicit AnyPrism(Random& random) {
    const Vec2 com(random.in(-0.002, 0.002), random.in(-0.002, 0.002));
    polygon =
        section_polygon(any_convex_section(random), random.chance(0.5) ? 1 : -1, com);
    roll = random.in(-3.0, 3.0);
    if (random.chance(0.3)) {  // a side on the support, or at a jaw
      const Vec2 d = polygon.vertex[1] - polygon.vertex[0];
      roll = -std::atan2(d.y(), d.x()) + 0.5 * std::numbers::pi * random.below(4);
    }
    const double low = support_height(polygon, roll);
    const double finger = low + random.in(0.2, 1.5) * -low;
    const double half = random.log_in(1e-3, 0.05);
    pads = {finger - half, finger + half};
    grip.grip_force = random.log_in(0.1, 20.0);
    grip.friction = {random.in(0.0, 1.2), random.in(0.0, 1.2)};
    grip.jaw_mode = std::array{JawMode::kCoupled, JawMode::kFixedJaw1,
                               JawMode::kFixedJaw2}[random.below(3)];
    drive.mu = random.in(0.0, 2.0);
    drive.sheet_rate = random.in(0.01, 0.1) * (random.chance(0.5) ? 1.0 : -1.0);
    drive.weight = random.log_in(0.1, 20.0) * (random.chance(0.1) ? -1.0 : 1.0);
  }

  PrismContacts contacts() const { return prism_contacts(polygon, roll, pads); }
  PrismInstant solve() const {
    return solve_prism(polygon, roll, contacts(), grip, drive);
  }
  double residual(const PrismInstant& answer) const {
    return prism_residual(polygon, roll, pads, grip, drive, answer);
  }
};

void expect_all_verified(std::uint64_t seed, int trials, double tolerance) {
  Random random(seed);
  std::map<InstantStatus, int> seen;
  for (int trial = 0; trial < trials; ++trial) {
    const AnyPrism prism(random);
    if (!prism.contacts().held()) continue;
    const PrismInstant now = prism.solve();
    ++seen[now.status];
    if (now.status == InstantStatus::kOutOfIterations) {
      EXPECT_TRUE(now.exhausted) << trial;
      continue;
    }
    ASSERT_LE(prism.residual(now), tolerance) << trial << ": " << name(now.status);
  }
  for (const auto& [status, count] : seen)
    ::testing::Test::RecordProperty(std::string(name(status)), count);
  for (const InstantStatus status :
       {InstantStatus::kMoves, InstantStatus::kNonuniqueForces, InstantStatus::kAmbiguous,
        InstantStatus::kDynamic, InstantStatus::kJammed}) {
    EXPECT_GT(seen[status], trials / 1000) << name(status);
  }
  // Friction as high as here can leave no quasi-static motion at all.
  EXPECT_LT(seen[InstantStatus::kOutOfIterations], trials / 30);
}

TEST(PrismSection, EveryRandomSectionEndsVerified) {
  expect_all_verified(31, 8000, 1e-8);
}

TEST(PrismSection, EveryRandomSectionEndsVerifiedFull) {
  expect_all_verified(32, 300000, 1e-7);
}

TEST(PrismSection, AnAnswerThatIsAlteredFails) {
  Random random(33);
  int altered = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const AnyPrism prism(random);
    const PrismInstant now = prism.solve();
    if (now.status != InstantStatus::kMoves || prism.grip.friction[0] < 0.05) continue;
    const double rate = std::abs(prism.drive.sheet_rate);
    const double force =
        std::max(2.0 * prism.grip.grip_force, std::abs(prism.drive.weight));
    const auto spoilt = [&](auto&& alter) {
      PrismInstant other = now;
      alter(other);
      EXPECT_GT(prism.residual(other), 1e-6) << trial;
      ++altered;
    };
    spoilt([&](PrismInstant& a) { a.motion.v_z += 1e-3 * rate; });
    spoilt([&](PrismInstant& a) { a.motion.roll_rate += 1e-3 * rate / 0.02; });
    spoilt([&](PrismInstant& a) { a.forces.normal[kSheet] += 1e-3 * force; });
    spoilt([&](PrismInstant& a) { a.forces.tangential[kSheet] -= 1e-3 * force; });
    spoilt([&](PrismInstant& a) { a.push_force += 1e-3 * force; });
    if (now.forces.normal[kJaw1] > 0.01 * force)
      spoilt([&](PrismInstant& a) { a.forces.point[kJaw1].y() += 1e-3; });
  }
  EXPECT_GT(altered, 500);
}

// Numbers that are none, and a wedge so small that it balances in units of the grip.
TEST(PrismSection, AnAnswerThatIsForgedFails) {
  Random random(38);
  std::map<InstantStatus, int> forged;
  for (int trial = 0; trial < 2000; ++trial) {
    const AnyPrism prism(random);
    if (!prism.contacts().held()) continue;
    const PrismInstant now = prism.solve();
    if (now.status == InstantStatus::kOutOfIterations) continue;
    const auto forge = [&](const char* what, auto&& alter) {
      PrismInstant other = now;
      alter(other);
      EXPECT_FALSE(prism.residual(other) <= 1e-6)
          << trial << ", " << name(now.status) << ": " << what;
      ++forged[now.status];
    };
    const auto forge_motion = [&](CrossSectionMotion PrismInstant::*motion) {
      for (double CrossSectionMotion::*rate :
           {&CrossSectionMotion::v_z, &CrossSectionMotion::v_u,
            &CrossSectionMotion::roll_rate, &CrossSectionMotion::jaw_rate}) {
        forge("a rate NaN", [&](PrismInstant& a) { a.*motion.*rate = kNan; });
      }
    };
    const auto forge_forces = [&](SectionForces PrismInstant::*forces) {
      for (int i = 0; i < 3; ++i) {
        forge("a load NaN", [&](PrismInstant& a) { (a.*forces).normal[i] = kNan; });
        forge("friction NaN", [&](PrismInstant& a) { (a.*forces).tangential[i] = kNan; });
      }
    };
    if (now.status == InstantStatus::kDynamic) {
      forge_motion(&PrismInstant::evidence);
    } else if (now.status == InstantStatus::kJammed) {
      forge_forces(&PrismInstant::evidence_forces);
    } else {
      forge_motion(&PrismInstant::motion);
      for (const auto forces :
           {&PrismInstant::forces, &PrismInstant::least, &PrismInstant::greatest}) {
        forge_forces(forces);
      }
      forge("push force NaN", [](PrismInstant& a) { a.push_force = kNan; });
      forge("a tiny wedge", [&](PrismInstant& a) {
        a.status = InstantStatus::kJammed;
        a.evidence_forces = now.forces;
        a.evidence_forces.normal = {0.0, 0.0, 1e-12 * prism.drive.weight};
        a.evidence_forces.tangential = {
            0.0, 0.0, 1e-13 * std::copysign(prism.drive.weight, prism.drive.sheet_rate)};
      });
    }
  }
  EXPECT_GE(forged.size(), 5u);
}

// The same section seen from behind: z turned round, jaws exchanged.
TEST(PrismSection, TheMirrorImageMovesAsTheMirrorImage) {
  Random random(34);
  int compared = 0;
  for (int trial = 0; trial < 500; ++trial) {
    const AnyPrism prism(random);
    const PrismInstant now = prism.solve();
    AnyPrism image = prism;
    for (int i = 0; i < prism.polygon.count; ++i) {
      const Vec2& v = prism.polygon.vertex[prism.polygon.count - 1 - i];
      image.polygon.vertex[i] = {-v.x(), v.y()};
    }
    image.polygon.com.x() *= -1.0;
    image.roll = -prism.roll;
    std::swap(image.grip.friction[0], image.grip.friction[1]);
    if (prism.grip.jaw_mode != JawMode::kCoupled)
      image.grip.jaw_mode = prism.grip.jaw_mode == JawMode::kFixedJaw1
                                ? JawMode::kFixedJaw2
                                : JawMode::kFixedJaw1;
    image.drive.sheet_rate *= -1.0;
    const PrismInstant seen = image.solve();
    ASSERT_EQ(now.status, seen.status) << trial;
    if (now.status != InstantStatus::kMoves) continue;
    const double rate = std::abs(prism.drive.sheet_rate);
    EXPECT_NEAR(seen.motion.v_z, -now.motion.v_z, 1e-9 * rate);
    EXPECT_NEAR(seen.motion.v_u, now.motion.v_u, 1e-9 * rate);
    EXPECT_NEAR(seen.motion.roll_rate, -now.motion.roll_rate, 1e-6 * rate);
    EXPECT_NEAR(seen.push_force, now.push_force, 1e-6 * (1.0 + now.push_force));
    ++compared;
  }
  EXPECT_GT(compared, 100);
}

// More and more sides: the rolling cylinder.
TEST(PrismSection, ManySidesAreACylinder) {
  Random random(35);
  int compared = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const double radius = 0.02;
    AnyPrism prism(random);
    prism.grip.friction = {random.in(0.3, 0.5), random.in(0.3, 0.5)};
    prism.grip.grip_force = random.in(0.5, 2.0);
    prism.drive.weight = random.in(4.5, 6.0);
    const CrossSectionModel round{.radius = radius,
                                  .mass = prism.drive.weight / 9.81,
                                  .grip_force = prism.grip.grip_force,
                                  .friction = prism.grip.friction,
                                  .jaw_mode = prism.grip.jaw_mode};
    const double threshold =
        rolling_threshold(round, prism.drive.sheet_rate, prism.drive.weight);
    prism.drive.mu = 3.0 * threshold;
    const CrossSectionInstant limit = solve_cross_section(round, prism.drive);
    if (limit.status != InstantStatus::kMoves) continue;
    const double roll = random.in(0.0, 1.0);
    for (const int sides : {100, 200}) {
      prism.polygon = section_polygon(regular_section(sides, radius), 1, Vec2::Zero());
      prism.roll = roll;
      prism.pads = kTall;
      const PrismInstant now = prism.solve();
      ASSERT_EQ(now.status, limit.status) << sides;
      EXPECT_NEAR(now.motion.roll_rate / limit.roll_rate, 1.0, 4.0 / sides);
      EXPECT_NEAR(now.push_force / limit.push_force, 1.0, 10.0 / sides);
    }
    ++compared;
  }
  EXPECT_GT(compared, 20);
}

// A box a wide and b high, pads from h - e to h + e above the sheet, coupled jaws. About
// the edge on the sheet, jaw 1 pushes with the upper end of its pad and jaw 2, which
// slips up, with the lower one:
//   -(h + e)(N - T / 2) + (h - e - mu a)(N + T / 2) = W a / 2
// and just after it has begun, jaw 1 slips down, so that the sheet carries W + mu T.
TEST(PrismSection, ABoxTipsAtTheThresholdOfItsClosedForm) {
  Random random(43);
  int tipped = 0;
  int stood = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const double a = random.in(0.015, 0.025);
    const double b = random.in(0.03, 0.05);
    const double mu = random.in(0.02, 0.15);
    const double N = random.in(0.5, 3.0);
    const double e = random.in(0.0005, 0.002);
    const double h = random.in(0.55, 0.9) * b;
    const double W = random.in(1.05, 3.0) * 2.0 * mu * N;
    const double T = (2.0 * N * (2.0 * e + mu * a) + W * a) / (2.0 * h - mu * a);
    if (T > 1.95 * N) continue;  // jaw 1 would have to pull
    const double threshold = T / (W + mu * T);
    const std::vector<Vec2> box = {{-0.5 * b, -0.5 * a},
                                   {0.5 * b, -0.5 * a},
                                   {0.5 * b, 0.5 * a},
                                   {-0.5 * b, 0.5 * a}};
    const double way = random.chance(0.5) ? 1.0 : -1.0;
    AnyPrism prism(random);
    prism.polygon = section_polygon(box, 1, Vec2::Zero());
    prism.roll = way * 1e-5;
    const double finger = support_height(prism.polygon, prism.roll) + h;
    prism.pads = {finger - e, finger + e};
    prism.grip = {N, {mu, mu}, JawMode::kCoupled};
    const bool above = trial % 2 == 0;
    prism.drive = {threshold * (above ? 1.001 : 0.999), way * 0.01, W};
    const PrismInstant now = prism.solve();
    EXPECT_LE(prism.residual(now), 1e-9) << trial;
    // The solution that turns most comes first.
    EXPECT_EQ(way * now.motion.roll_rate > 0.0, above) << trial;
    if (above) {
      EXPECT_NEAR(std::abs(now.forces.tangential[kSheet]), T, 1e-3 * T) << trial;
      EXPECT_NEAR(way * now.motion.roll_rate, 0.01 / h, 1e-4 * 0.01 / h) << trial;
    }
    ++(above ? tipped : stood);
  }
  EXPECT_GT(tipped, 80);
  EXPECT_GT(stood, 80);
}

TEST(PrismSection, RefusesJawsWithoutOneRate) {
  Random random(36);
  AnyPrism prism(random);
  for (const JawMode mode : {JawMode::kLocked, JawMode::kIndependent}) {
    prism.grip.jaw_mode = mode;
    EXPECT_EQ(prism.solve().status, InstantStatus::kBadInput);
  }
}

TEST(PrismSection, NoHeap) {
  Random random(37);
  const AnyPrism prism(random);
  const NoHeapScope scope;
  const PrismInstant now = prism.solve();
  const double residual = prism.residual(now);
  EXPECT_LE(scope.allocations(), 0);
  EXPECT_LE(residual, 1e-8);
}

}  // namespace
}  // namespace prehensile
