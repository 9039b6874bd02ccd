#include "primitives/roll.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "tests/support/no_heap.h"
#include "tests/support/random.h"

namespace prehensile {
namespace {

using testing::NoHeapScope;
using testing::Random;

constexpr double kRadius = 0.02;
constexpr double kLength = 0.12;

/// A cylinder lying on a sheet, loosely held, heavy enough that the fingers cannot carry
/// it.
struct Bench {
  Axis axis = Axis::kX;
  double side = 1.0;  ///< +1: the sheet supports the lower side of O, -1: the upper one
  Scene scene;

  Bench(Axis along, double supported_side) : axis(along), side(supported_side) {
    scene.object.shape = CylinderShape{kRadius, kLength, axis};
    scene.object.mass = 0.5;
    scene.gripper.pad = RectanglePad{{0.03, 0.03}};
    scene.gripper.friction = {0.4, 0.4};
    scene.gripper.grip_force = 1.0;
    const Vec2 n = side * across();
    Pusher sheet;
    sheet.name = "sheet";
    sheet.feature = LineFeature{};
    sheet.friction = 0.8;
    sheet.normal_angle = std::atan2(n.y(), n.x());
    scene.pushers = {sheet};
    scene.g_W = -9.81 * n;
  }

  Vec2 along() const { return axis == Axis::kX ? Vec2(1.0, 0.0) : Vec2(0.0, 1.0); }
  Vec2 across() const { return axis == Axis::kX ? Vec2(0.0, 1.0) : Vec2(1.0, 0.0); }
  double weight() const { return 9.81 * scene.object.mass; }

  Transition roll(double travel, std::vector<Sample>* trace = nullptr) const {
    const Model model = prepare(scene);
    return apply(model, scene.start, Roll{0, travel}, {}, trace);
  }
};

Eigen::Vector3d in_space(const Vec2& v) { return {v.x(), v.y(), 0.0}; }

TEST(Roll, TurnsTheTouchingSurfaceWithTheSupport) {
  for (const Axis axis : {Axis::kX, Axis::kY}) {
    for (const double side : {1.0, -1.0}) {
      for (const double travel : {0.013, -0.05}) {
        const Bench bench(axis, side);
        const Transition rolled = bench.roll(travel);
        ASSERT_EQ(rolled.status, TransitionStatus::kCompleted) << rolled.reason;
        EXPECT_EQ(rolled.end.X_HO, bench.scene.start.X_HO);
        // Rigid body: the surface that touches moves as the turn about the axis says.
        const Eigen::Vector3d turn = rolled.end.psi * in_space(bench.along());
        const Eigen::Vector3d arm = -kRadius * side * in_space(bench.across());
        const Eigen::Vector3d moved = turn.cross(arm);
        EXPECT_NEAR((moved - Eigen::Vector3d(0.0, 0.0, travel)).norm(), 0.0, 1e-15);
      }
    }
  }
}

TEST(Roll, PsiFollowsTheSignOfTheContactsTangent) {
  for (const Axis axis : {Axis::kX, Axis::kY}) {
    for (const double side : {1.0, -1.0}) {
      const Bench bench(axis, side);
      const Model model = prepare(bench.scene);
      const RollSection section = roll_section(model, 0, bench.scene.start);
      ASSERT_TRUE(section.possible) << section.reason;
      const double sign = model.contacts[0].t.dot(bench.along());
      EXPECT_NEAR(section.psi_per_travel, sign / kRadius, 1e-12);
      EXPECT_NEAR(section.weight, bench.weight(), 1e-12);
    }
  }
}

TEST(Roll, ForcesOfTheClosedForm) {
  const Bench bench(Axis::kX, 1.0);
  std::vector<Sample> trace;
  const Transition rolled = bench.roll(0.04, &trace);
  ASSERT_EQ(rolled.status, TransitionStatus::kCompleted) << rolled.reason;
  const double traction = 2.0 * 0.4 * 1.0;
  const double load = bench.weight() + 0.4 * traction;
  EXPECT_NEAR(rolled.max_push_force, std::hypot(traction, load), 1e-9);
  EXPECT_EQ(rolled.max_push_force, rolled.min_push_force);
  EXPECT_LE(rolled.worst_certificate, 1e-9);
  EXPECT_EQ(rolled.done, 1.0);
  EXPECT_EQ(rolled.slipped, 0.0);
  EXPECT_EQ(rolled.error_estimate, 0.0);
  EXPECT_EQ(rolled.instants, 1);

  ASSERT_EQ(trace.size(), 21u);  // spacing 0.05
  for (const Sample& sample : trace) {
    EXPECT_NEAR(sample.grasp.psi, sample.s * rolled.end.psi, 1e-15);
    EXPECT_NEAR(sample.normal_force, load, 1e-9);
    EXPECT_NEAR(sample.tangential_force, traction, 1e-9);
    EXPECT_NEAR(sample.slip_rate, 0.0, 1e-12);
    EXPECT_EQ(sample.status, InstantStatus::kMoves);
  }
  EXPECT_EQ(trace.back().grasp, rolled.end);
}

TEST(Roll, TurnsAddUpAndGoBack) {
  const Bench bench(Axis::kY, -1.0);
  const Model model = prepare(bench.scene);
  const Grasp there = apply(model, bench.scene.start, Roll{0, 0.03}).end;
  const Grasp further = apply(model, there, Roll{0, 0.05}).end;
  const Grasp at_once = apply(model, bench.scene.start, Roll{0, 0.08}).end;
  const Grasp back = apply(model, further, Roll{0, -0.08}).end;
  EXPECT_NEAR(further.psi, at_once.psi, 1e-12);
  EXPECT_NEAR(back.psi, bench.scene.start.psi, 1e-12);
}

void expect_stop(const Bench& bench, TransitionStatus status, std::string_view reason,
                 double travel = 0.01) {
  const Transition out = bench.roll(travel);
  EXPECT_EQ(out.status, status) << out.reason;
  EXPECT_NE(out.reason.find(reason), std::string_view::npos) << out.reason;
  EXPECT_EQ(out.end, bench.scene.start);
  EXPECT_EQ(out.done, 0.0);
}

TEST(Roll, SlidesWithATightGripOrASmoothSheet) {
  Bench bench(Axis::kX, 1.0);
  bench.scene.pushers[0].friction = 0.1;
  expect_stop(bench, TransitionStatus::kLeftGuard, "slides");
  EXPECT_EQ(bench.roll(0.01).events[0].kind, EventKind::kGuard);
  bench.scene.pushers[0].friction = 0.7;
  EXPECT_TRUE(bench.roll(0.01).completed());
  bench.scene.gripper.grip_force = 6.1;  // 2 mu N just below the weight
  expect_stop(bench, TransitionStatus::kLeftGuard, "slides");
}

TEST(Roll, JawsThatLockAreDraggedAlong) {
  Bench bench(Axis::kX, 1.0);
  bench.scene.gripper.friction = {1.3, 1.3};
  bench.scene.gripper.grip_force = 0.5;
  expect_stop(bench, TransitionStatus::kLeftGuard, "drags");
}

TEST(Roll, WedgedAgainstTheFixedJaw) {
  Bench bench(Axis::kX, 1.0);
  bench.scene.gripper.friction = {1.3, 1.3};
  bench.scene.gripper.jaw_mode = JawMode::kFixedJaw2;
  bench.scene.pushers[0].friction = 1.5;
  expect_stop(bench, TransitionStatus::kJammed, "wedges");
}

TEST(Roll, AmbiguousWhereTheFingersCanCarryTheObject) {
  Bench bench(Axis::kX, 1.0);
  bench.scene.gripper.grip_force = 10.0;
  bench.scene.pushers[0].friction = 5.0;
  expect_stop(bench, TransitionStatus::kAmbiguous, "two motions");
}

TEST(Roll, FallsOffASheetAboveIt) {
  Bench bench(Axis::kX, 1.0);
  bench.scene.g_W *= -1.0;
  expect_stop(bench, TransitionStatus::kFalls, "gravity");
  EXPECT_EQ(bench.roll(0.01).events[0].kind, EventKind::kGravityLost);
}

TEST(Roll, RefusesWhatCannotRoll) {
  using enum TransitionStatus;
  Bench bench(Axis::kX, 1.0);
  expect_stop(bench, kRefused, "does not move", 0.0);
  expect_stop(bench, kRefused, "not finite", kNan);

  Bench sideways = bench;
  sideways.scene.pushers[0].normal_angle = 0.0;  // on a flat end
  expect_stop(sideways, kRefused, "long sides");

  Bench point = bench;
  point.scene.pushers[0].feature = PointFeature{};
  expect_stop(point, kRefused, "point");

  Bench eccentric = bench;
  eccentric.scene.object.p_OCom = Vec2(0.0, 1e-3);
  expect_stop(eccentric, kRefused, "centre of mass");

  const Model model = prepare(bench.scene);
  for (const int contact : {-1, 1})
    EXPECT_EQ(apply(model, bench.scene.start, Roll{contact, 0.01}).status, kRefused);
  TransitionOptions options;
  options.max_step = 0.0;
  EXPECT_EQ(apply(model, bench.scene.start, Roll{0, 0.01}, options).status, kRefused);
  Grasp off = bench.scene.start;
  off.X_HO.x = kLength;
  EXPECT_EQ(apply(model, off, Roll{0, 0.01}).status, kRefused);

  Scene box = bench.scene;
  box.object.shape = BoxShape{{kLength, 0.04, 0.04}};
  const Transition out = apply(prepare(box), box.start, Roll{0, 0.01});
  EXPECT_EQ(out.status, kRefused);
  EXPECT_NE(out.reason.find("cylinder"), std::string_view::npos);
}

/// An object that rolls slips at both pads: any weight along its axis would make it
/// creep.
TEST(Roll, RefusesWeightAlongTheAxis) {
  Bench bench(Axis::kX, 1.0);
  const double capacity = 0.8 * bench.scene.gripper.grip_force;
  for (const double share : {0.5e-6, 2e-6}) {
    Bench tilted = bench;
    const double angle = std::asin(share * capacity / bench.weight());
    tilted.scene.g_W = rotated(angle, bench.scene.g_W);
    if (share < 1e-6) {
      EXPECT_TRUE(tilted.roll(0.01).completed());
    } else {
      expect_stop(tilted, TransitionStatus::kRefused, "along the object's axis");
    }
  }
}

/// Places of the resultants found by a scan over the place on jaw 1: tilt and yaw then
/// give the other two. Independent of the linear programme.
bool lines_suffice_by_scan(const Bench& bench, double finger, double pad_half,
                           double support_half) {
  const double N = bench.scene.gripper.grip_force;
  const double mu = bench.scene.gripper.friction[0];
  const double traction = 2.0 * mu * N;
  const double l1 = N - 0.5 * traction;
  const double l2 = N + 0.5 * traction;
  const double load = bench.weight() + mu * traction;
  const int steps = 4000;
  for (int i = 0; i <= steps; ++i) {
    // Moments about the finger axis; jaw 1 slips up, jaw 2 down.
    const double a1 = pad_half * (2.0 * i / steps - 1.0);
    // mu l1 a1 - mu l2 a2 + load s = W (-finger);  l1 a1 - l2 a2 + traction s = 0
    const double right = -bench.weight() * finger;
    const double s = right / (load - mu * traction);
    const double a2 = (l1 * a1 + traction * s) / l2;
    if (std::abs(a2) <= pad_half && std::abs(s + finger) <= support_half) return true;
  }
  return false;
}

TEST(Roll, PadsAndSupportMustBeLongEnough) {
  Random random(3);
  int rolled = 0;
  int refused = 0;
  for (int trial = 0; trial < 300; ++trial) {
    Bench bench(Axis::kX, 1.0);
    const double finger = random.in(-0.9, 0.9) * 0.5 * kLength;
    const double support = random.log_in(1e-3, kLength);
    const double pad = random.log_in(1e-3, 2.0 * (0.5 * kLength - std::abs(finger)));
    bench.scene.gripper.pad = RectanglePad{{pad, 0.01}};
    bench.scene.pushers[0].feature = LineFeature{support};
    bench.scene.start.X_HO.x = -finger;
    const Model model = prepare(bench.scene);
    const ContactPoints points = model.region.at(bench.scene.start.X_HO);
    const double pad_half =
        *std::max_element(points.x.begin(), points.x.begin() + points.count);
    const bool holds = lines_suffice_by_scan(bench, finger, pad_half, 0.5 * support);
    const Transition out = apply(model, bench.scene.start, Roll{0, 0.01});
    EXPECT_EQ(out.status,
              holds ? TransitionStatus::kCompleted : TransitionStatus::kRefused)
        << trial << " finger " << finger << " pad " << pad << " support " << support;
    ++(holds ? rolled : refused);
  }
  EXPECT_GT(rolled, 50);
  EXPECT_GT(refused, 50);
}

TEST(Roll, NoHeapWithoutATrace) {
  const Bench bench(Axis::kX, 1.0);
  const Model model = prepare(bench.scene);
  const Push push = Roll{0, 0.04};
  const NoHeapScope scope;
  const Transition out = apply(model, bench.scene.start, push);
  EXPECT_LE(scope.allocations(), 0);
  EXPECT_TRUE(out.completed());
}

}  // namespace
}  // namespace prehensile
