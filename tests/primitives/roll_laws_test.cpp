/// Closed forms and laws of rolling, through the transition.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "primitives/roll.h"
#include "tests/support/random.h"

namespace prehensile {
namespace {

using testing::Random;

constexpr double kGravity = 9.81;

/// A cylinder on a sheet below it, held between two jaws of equal friction.
struct RollCase {
  double mu = 0.4;        // of the jaws
  double mu_sheet = 0.8;  // of the sheet
  double grip = 1.0;      // [N]
  double weight = 5.0;    // [N]
  JawMode jaw_mode = JawMode::kCoupled;

  Model model() const {
    Scene scene;
    scene.object.shape = CylinderShape{0.02, 0.12, Axis::kX};
    scene.object.mass = weight / kGravity;
    scene.gripper.pad = RectanglePad{{0.03, 0.03}};
    scene.gripper.friction = {mu, mu};
    scene.gripper.grip_force = grip;
    scene.gripper.jaw_mode = jaw_mode;
    Pusher sheet;
    sheet.name = "sheet";
    sheet.feature = LineFeature{};
    sheet.friction = mu_sheet;
    sheet.normal_angle = 0.5 * std::numbers::pi;
    scene.pushers = {sheet};
    scene.g_W = {0.0, -kGravity};
    return prepare(scene);
  }

  /// Traction of both jaws on an object that rolls (MECHANICS 8 D); `downstream_fixed`:
  /// the jaw that the sheet moves towards is held in place.
  double traction(bool downstream_fixed) const {
    if (jaw_mode == JawMode::kCoupled) return 2.0 * mu * grip;
    return 2.0 * mu * grip / (downstream_fixed ? 1.0 - mu : 1.0 + mu);
  }
};

// D: rolls iff the sheet's friction carries the traction of the jaws.
TEST(RollLaw, ThresholdOfTheClosedFormInEveryJawMode) {
  Random random(21);
  int rolled = 0;
  int slid = 0;
  for (int trial = 0; trial < 300; ++trial) {
    RollCase c;
    c.mu = random.in(0.05, 0.6);
    c.grip = random.in(0.2, 3.0);
    c.jaw_mode = std::array{JawMode::kCoupled, JawMode::kFixedJaw1,
                            JawMode::kFixedJaw2}[random.below(3)];
    const double travel = random.chance(0.5) ? 0.01 : -0.01;
    // The sheet drags towards jaw 2 if it moves along +z.
    const JawMode downstream = travel > 0.0 ? JawMode::kFixedJaw2 : JawMode::kFixedJaw1;
    const double traction = c.traction(c.jaw_mode == downstream);
    // Heavier than what the fingers could carry: unique.
    c.weight = random.in(1.2, 5.0) * std::max(traction, 2.0 * c.mu * c.grip);
    const double threshold = traction / (c.weight + c.mu * traction);
    const double side = random.chance(0.5) ? 1.0 : -1.0;
    c.mu_sheet = threshold * (1.0 + side * random.log_in(1e-6, 0.5));
    const Transition out = apply(c.model(), {}, Roll{0, travel});
    if (side > 0.0) {
      EXPECT_EQ(out.status, TransitionStatus::kCompleted) << trial << " " << out.reason;
      EXPECT_NEAR(out.max_push_force, std::hypot(traction, c.weight + c.mu * traction),
                  1e-9 * c.weight);
      ++rolled;
    } else {
      EXPECT_EQ(out.status, TransitionStatus::kLeftGuard) << trial << " " << out.reason;
      EXPECT_NE(out.reason.find("slides"), std::string_view::npos) << out.reason;
      EXPECT_EQ(out.end, Grasp());
      ++slid;
    }
  }
  EXPECT_GT(rolled, 100);
  EXPECT_GT(slid, 100);
}

// E: below the threshold the load on the sheet is not determined; the sample that the
// roll leaves behind has one of the possible values, on the sliding edge of the cone.
TEST(RollLaw, SlidingLoadIsWithinTheClosedFormInterval) {
  Random random(22);
  int checked = 0;
  for (int trial = 0; trial < 200; ++trial) {
    RollCase c;
    c.mu = random.in(0.05, 0.9);
    c.grip = random.in(0.2, 3.0);
    const double carried = 2.0 * c.mu * c.grip;
    c.weight = random.in(0.2, 4.0) * carried;
    const double threshold = carried / (c.weight + c.mu * carried);
    c.mu_sheet = random.in(0.05, 0.95) * threshold;
    if (c.mu_sheet * (1.0 + c.mu) >= 1.0) continue;
    std::vector<Sample> trace;
    const Transition out = apply(c.model(), {}, Roll{0, 0.01}, {}, &trace);
    if (out.status == TransitionStatus::kAmbiguous) continue;  // fingers may carry it
    ASSERT_EQ(out.status, TransitionStatus::kLeftGuard) << trial << " " << out.reason;
    ASSERT_FALSE(trace.empty());
    const double low =
        std::max(0.0, (c.weight - carried) / (1.0 - c.mu_sheet * (1.0 + c.mu)));
    const double high = (c.weight + carried) / (1.0 + c.mu_sheet * (1.0 - c.mu));
    const double load = trace.front().normal_force;
    EXPECT_GE(load, low - 1e-9 * c.weight) << trial;
    EXPECT_LE(load, high + 1e-9 * c.weight) << trial;
    EXPECT_NEAR(trace.front().tangential_force, c.mu_sheet * load, 1e-9 * c.weight);
    ++checked;
  }
  EXPECT_GT(checked, 80);
}

// Fingers that can carry the object may do so whatever the sheet does: where the sheet
// could roll it, both happen to be possible, and the roll says so instead of choosing.
TEST(RollLaw, FingersThatCarryTheObjectAreNamedAsTheSecondMotion) {
  Random random(23);
  for (int trial = 0; trial < 100; ++trial) {
    RollCase c;
    c.mu = random.in(0.05, 0.6);
    c.grip = random.in(0.2, 3.0);
    const double carried = 2.0 * c.mu * c.grip;
    c.weight = random.in(0.1, 0.95) * carried;
    c.mu_sheet = carried / (c.weight + c.mu * carried) * random.in(1.05, 3.0);
    const Transition out = apply(c.model(), {}, Roll{0, 0.01});
    EXPECT_EQ(out.status, TransitionStatus::kAmbiguous) << trial << " " << out.reason;
    EXPECT_NE(out.reason.find("fingers alone can carry"), std::string_view::npos);
    // A grip so loose that they cannot leaves one motion.
    const double loose = 0.9 * c.weight / (2.0 * c.mu);
    const double needed = 2.0 * c.mu * loose / (c.weight * (1.0 + 0.9 * c.mu));
    if (c.mu_sheet < 1.01 * needed) continue;
    EXPECT_TRUE(apply(c.model(), {}, Roll{0, 0.01, loose}).completed()) << trial;
  }
}

// Slow rolling is all or nothing: the axis rests, and the object rolls with the sheet or
// not at all. Where a motion is unique, none is in between.
TEST(RollLaw, NoObjectRollsInPart) {
  Random random(24);
  int rolled = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    CrossSectionModel model;
    model.radius = 0.02;
    model.mass = 0.3;
    model.grip_force = random.log_in(0.1, 30.0);
    model.friction = {random.in(0.0, 1.5), random.in(0.0, 1.5)};
    model.jaw_mode = std::array{JawMode::kCoupled, JawMode::kFixedJaw1,
                                JawMode::kFixedJaw2}[random.below(3)];
    const CrossSectionDrive drive{random.in(0.0, 2.0), random.chance(0.5) ? 0.01 : -0.01,
                                  random.in(-1.0, 10.0)};
    const CrossSectionInstant instant = solve_cross_section(model, drive);
    if (!usable(instant.status)) continue;
    const double share = instant.roll_rate * model.radius / drive.sheet_rate;
    EXPECT_LT(std::min(std::abs(share), std::abs(share - 1.0)), 1e-6) << trial;
    rolled += share > 0.5 ? 1 : 0;
  }
  EXPECT_GT(rolled, 500);
}

// A roll without slip is a position, not a history: there and back in any steps.
TEST(RollLaw, ReturnsWhenTheSheetReturns) {
  Random random(25);
  for (int trial = 0; trial < 50; ++trial) {
    const RollCase c;
    const Model model = c.model();
    Grasp grasp;
    grasp.psi = random.in(-3.0, 3.0);
    const Grasp start = grasp;
    double place = 0.0;
    for (int step = 0; step < 6; ++step) {
      const double next = step == 5 ? 0.0 : random.in(-0.1, 0.1);
      const Transition out = apply(model, grasp, Roll{0, next - place});
      ASSERT_TRUE(out.completed()) << out.reason;
      EXPECT_EQ(out.slipped, 0.0);
      grasp = out.end;
      place = next;
    }
    EXPECT_EQ(grasp.X_HO, start.X_HO);
    EXPECT_NEAR(grasp.psi, start.psi, 1e-13);
  }
}

}  // namespace
}  // namespace prehensile
