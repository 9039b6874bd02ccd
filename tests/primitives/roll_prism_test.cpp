#include "primitives/roll_prism.h"

#include <gtest/gtest.h>

#include "mechanics/prism_section.h"
#include "scene/constants.h"
#include "tests/support/no_heap.h"
#include "tests/support/sections.h"

namespace prehensile {
namespace {

using testing::NoHeapScope;
using testing::Random;
using testing::regular_section;

constexpr double kGravity = 9.81;

/// A prism on a sheet below it.
struct Bench {
  Scene scene;

  explicit Bench(std::vector<Vec2> section) {
    scene.object.shape = PrismShape{std::move(section), 0.1, Axis::kX};
    scene.object.mass = 0.15;
    scene.gripper.pad = RectanglePad{{0.03, 0.004}};
    scene.gripper.friction = {0.05, 0.05};
    scene.gripper.grip_force = 1.0;
    Pusher sheet;
    sheet.name = "sheet";
    sheet.feature = PlaneFeature{};
    sheet.friction = 1.5;
    sheet.normal_angle = 0.5 * kPi;
    scene.pushers = {sheet};
    scene.g_W = {0.0, -kGravity};
  }

  Transition roll(double travel, std::vector<Sample>* trace = nullptr) const {
    return apply(prepare(scene), scene.start, Roll{0, travel}, {}, trace);
  }
};

/// Held 12 mm above its middle: rolls over its edges.
Bench square_bar() {
  Bench bench(regular_section(4, 0.015));
  bench.scene.start.X_HO.y = -0.012;
  return bench;
}

TEST(RollPrism, ASquareRollsOverItsEdges) {
  const Bench bench = square_bar();
  std::vector<Sample> trace;
  const Transition out = bench.roll(0.06, &trace);
  ASSERT_TRUE(out.completed()) << out.reason;
  // Two sides of 30 mm: half a turn. The support's normal is +y and t is -x.
  EXPECT_NEAR(out.end.psi, -kPi, 1e-9);
  EXPECT_NEAR(out.end.X_HO.y, bench.scene.start.X_HO.y, 1e-9);
  ASSERT_EQ(out.event_count, 2);
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(out.events[i].kind, EventKind::kOverEdge);
    EXPECT_NEAR(out.events[i].s, 0.5 * (i + 1), 1e-9);
  }
  EXPECT_LE(out.worst_certificate, 1e-8);
  double widest = 0.0;
  for (const Sample& sample : trace) {
    widest = std::max(widest, sample.opening);
    EXPECT_NEAR(sample.slip_rate, 0.0, 1e-9);
    // The lowest corner stays on the support, 27 mm below the finger axis.
    const double a = std::fmod(-sample.grasp.psi, 0.5 * kPi);
    const double height = 0.015 * (std::cos(a) + std::sin(a));
    EXPECT_NEAR(sample.grasp.X_HO.y, height - 0.027, 1e-9);
  }
  EXPECT_NEAR(trace.front().opening, 0.03, 1e-12);
  EXPECT_GT(widest, 0.035);
}

TEST(RollPrism, ComesBackWhenTheSupportReturns) {
  Random random(41);
  int whole = 0;
  for (int trial = 0; trial < 20; ++trial) {
    Bench bench(regular_section(4 * (1 + random.below(5)), 0.015));
    bench.scene.start.X_HO.y = -0.001;
    bench.scene.gripper.grip_force = random.in(0.3, 1.5);
    const Model model = prepare(bench.scene);
    const double travel = random.in(-0.03, 0.03);
    const Transition there = apply(model, bench.scene.start, Roll{0, travel});
    if (there.done < 1e-3) continue;
    const Transition back = apply(model, there.end, Roll{0, -travel * there.done});
    ASSERT_TRUE(back.completed()) << trial << back.reason;
    EXPECT_NEAR(back.end.psi, 0.0, 1e-7);
    EXPECT_NEAR(back.end.X_HO.y, bench.scene.start.X_HO.y, 1e-9);
    whole += there.completed();
  }
  EXPECT_GT(whole, 5);
}

// Where a roll ends does not depend on how closely it is looked at.
TEST(RollPrism, TheStepMakesNoDifference) {
  Random random(44);
  int stopped = 0;
  for (int trial = 0; trial < 60; ++trial) {
    Bench bench(regular_section(4 * (1 + random.below(3)), 0.015));
    bench.scene.start.X_HO.y = trial % 2 == 0 ? random.in(-0.003, 0.003) : 0.0;
    if (bench.scene.object.shape.index() == 2 && trial % 3 == 0) {
      bench = square_bar();
      bench.scene.start.X_HO.y = random.in(-0.013, 0.0);
    }
    bench.scene.gripper.pad = RectanglePad{{0.03, random.log_in(0.001, 0.03)}};
    bench.scene.gripper.grip_force = random.in(0.3, 3.0);
    bench.scene.object.mass = random.in(0.1, 0.3);
    const Model model = prepare(bench.scene);
    const Roll roll{0, random.chance(0.5) ? 0.04 : -0.04};
    const Transition coarse = apply(model, bench.scene.start, roll);
    const Transition fine =
        apply(model, bench.scene.start, roll, {.max_step = 2e-3, .max_steps = 20000});
    EXPECT_EQ(coarse.status, fine.status) << trial << coarse.reason << fine.reason;
    EXPECT_NEAR(coarse.end.psi, fine.end.psi, 1e-6) << trial;
    stopped += !fine.completed() && fine.done > 0.01;
  }
  EXPECT_GT(stopped, 5);
}

// The attitude is geometry; the instants' roll rates, integrated, lead to the same.
TEST(RollPrism, GeometryAgreesWithTheIntegratedRollRates) {
  Random random(42);
  int compared = 0;
  for (int trial = 0; trial < 12; ++trial) {
    Bench bench(regular_section(4 * (1 + random.below(4)), 0.015));
    bench.scene.start.X_HO.y = -0.001;
    const bool box = trial % 3 == 0;
    if (box) bench = square_bar();
    bench.scene.gripper.jaw_mode = std::array{JawMode::kCoupled, JawMode::kFixedJaw1,
                                              JawMode::kFixedJaw2}[random.below(3)];
    const Model model = prepare(bench.scene);
    const double travel = 0.013;
    std::vector<Sample> trace;
    const Transition out = apply(model, bench.scene.start, Roll{0, travel}, {}, &trace);
    if (!out.completed()) continue;
    const SectionPolygon polygon = section_polygon(model.prism->section, 1, Vec2::Zero());
    const PrismGrip grip{1.0, {0.05, 0.05}, bench.scene.gripper.jaw_mode};
    const CrossSectionDrive drive{1.5, travel, 0.15 * kGravity};
    const double height = -bench.scene.start.X_HO.y - support_height(polygon, 0.0);
    const auto rate = [&](double phi) {
      const double finger = height + support_height(polygon, phi);
      return solve_prism(polygon, phi,
                         prism_contacts(polygon, phi, {finger - 0.002, finger + 0.002}),
                         grip, drive)
          .motion.roll_rate;
    };
    double phi = 0.0;
    const int steps = 4000;
    for (int i = 0; i < steps; ++i) {
      const double h = 1.0 / steps;
      phi += h * rate(phi + 0.5 * h * rate(phi));
    }
    EXPECT_NEAR(-out.end.psi, phi, 2e-4) << trial;
    ++compared;
  }
  EXPECT_GT(compared, 5);
}

TEST(RollPrism, ManySidesRollLikeACylinder) {
  const double radius = 0.015;
  Bench round(regular_section(4, radius));
  round.scene.object.shape = CylinderShape{radius, 0.1, Axis::kX};
  const Transition limit = round.roll(0.04);
  ASSERT_TRUE(limit.completed()) << limit.reason;
  double last = 1.0;
  for (const int sides : {20, 40, 80, 160}) {
    Bench bench(regular_section(sides, radius));
    bench.scene.gripper.pad = RectanglePad{{0.03, 0.04}};
    const Transition out = bench.roll(0.04);
    ASSERT_TRUE(out.completed()) << sides << out.reason;
    const double error = std::abs(out.end.psi - limit.end.psi);
    EXPECT_LE(error, 6.0 / sides);
    EXPECT_NEAR(out.max_push_force, limit.max_push_force,
                10.0 / sides * limit.max_push_force);
    last = std::abs(out.max_push_force - limit.max_push_force);
  }
  EXPECT_LE(last, 0.05 * limit.max_push_force);
}

// Jaws as tall as the box hold it upright whatever the friction of the sheet: about the
// edge on the sheet every other force turns it back.
TEST(RollPrism, TallJawsHoldABoxUpright) {
  Bench bench(regular_section(4, 0.015));
  bench.scene.gripper.pad = RectanglePad{{0.03, 0.2}};
  for (const double mu : {0.5, 2.0, 50.0}) {
    bench.scene.pushers[0].friction = mu;
    const Transition out = bench.roll(0.01);
    EXPECT_FALSE(out.completed());
    EXPECT_EQ(out.done, 0.0) << mu;
  }
}

void expect_stop(const Bench& bench, TransitionStatus status, std::string_view reason,
                 double travel = 0.03) {
  const Transition out = bench.roll(travel);
  EXPECT_EQ(out.status, status) << out.reason;
  EXPECT_NE(out.reason.find(reason), std::string_view::npos) << out.reason;
}

TEST(RollPrism, JawsThatCannotOpenJam) {
  Bench bench = square_bar();
  bench.scene.gripper.jaw_mode = JawMode::kLocked;
  expect_stop(bench, TransitionStatus::kJammed, "push them apart");
  bench.scene.gripper.jaw_mode = JawMode::kIndependent;
  expect_stop(bench, TransitionStatus::kRefused, "independent");
  for (const JawMode mode : {JawMode::kFixedJaw1, JawMode::kFixedJaw2}) {
    bench.scene.gripper.jaw_mode = mode;
    bench.scene.gripper.grip_force = 2.0;
    EXPECT_GT(std::abs(bench.roll(0.03).end.psi), 0.1) << static_cast<int>(mode);
  }
}

TEST(RollPrism, SlidesOnASmoothSheetAndStallsHalfWay) {
  Bench bench = square_bar();
  bench.scene.pushers[0].friction = 0.2;
  expect_stop(bench, TransitionStatus::kLeftGuard, "slides");
  EXPECT_EQ(bench.roll(0.03).done, 0.0);
  Bench octagon(regular_section(8, 0.015));
  octagon.scene.gripper.pad = RectanglePad{{0.03, 0.002}};
  octagon.scene.gripper.grip_force = 3.0;
  const Transition partial = octagon.roll(0.06);
  EXPECT_EQ(partial.status, TransitionStatus::kLeftGuard) << partial.reason;
  EXPECT_NE(partial.reason.find("slides"), std::string_view::npos);
  EXPECT_GT(std::abs(partial.end.psi), 0.1);
  EXPECT_LT(std::abs(partial.end.psi), 0.5);
}

TEST(RollPrism, AmbiguousWhereTheFingersCanCarryIt) {
  Bench bench = square_bar();
  bench.scene.gripper.friction = {0.5, 0.5};
  bench.scene.gripper.grip_force = 4.0;
  bench.scene.pushers[0].friction = 8.0;
  expect_stop(bench, TransitionStatus::kAmbiguous, "two motions");
}

TEST(RollPrism, RefusesWhatItDoesNotKnow) {
  using enum TransitionStatus;
  const Bench bench = square_bar();
  expect_stop(bench, kRefused, "does not move", 0.0);
  expect_stop(bench, kRefused, "not finite", kNan);
  Bench disc = bench;
  disc.scene.gripper.pad = DiscPad{0.002};
  expect_stop(disc, kRefused, "rectangular");
  Bench askew = bench;
  askew.scene.start.X_HO = {0.0, -0.012, 0.3};
  expect_stop(askew, kRefused, "rectangular");
  Bench end = bench;
  end.scene.pushers[0].normal_angle = 0.0;
  expect_stop(end, kRefused, "long sides");
  Bench point = bench;
  point.scene.pushers[0].feature = PointFeature{};
  expect_stop(point, kRefused, "point");
  Bench closing = bench;
  closing.scene.g_Wz = 1.0;
  expect_stop(closing, kRefused, "closing direction");
  Bench along = bench;
  along.scene.g_W = {1.0, -9.0};
  expect_stop(along, kRefused, "along the object's axis");
  Bench narrow = bench;
  narrow.scene.start.X_HO.x = 0.049;
  narrow.scene.pushers[0].feature = PlaneFeature{0.002, std::nullopt};
  EXPECT_NE(narrow.roll(0.01).reason.find("too short"), std::string_view::npos);
}

TEST(RollPrism, OtherPushesNeedAnAttitudeThatLooksTheSame) {
  const Bench bench = square_bar();
  const Model model = prepare(bench.scene);
  Grasp grasp = bench.scene.start;
  grasp.psi = -0.5 * kPi;
  EXPECT_NE(apply(model, grasp, LinearPush{0, 0.0, {0.0, 1.0}, 1e-3}).status,
            TransitionStatus::kRefused);
  grasp.psi = -0.3;
  EXPECT_EQ(apply(model, grasp, LinearPush{0, 0.0, {0.0, 1.0}, 1e-3}).status,
            TransitionStatus::kRefused);
}

// Along y, and from the other side: the same roll in other axes.
TEST(RollPrism, AxesAndSidesDoNotMatter) {
  const Transition one = square_bar().roll(0.04);
  ASSERT_TRUE(one.completed()) << one.reason;
  for (const Axis axis : {Axis::kX, Axis::kY}) {
    for (const double side : {1.0, -1.0}) {
      Bench bench = square_bar();
      std::get<PrismShape>(bench.scene.object.shape).axis = axis;
      const Vec2 n = axis == Axis::kX ? Vec2(0.0, side) : Vec2(side, 0.0);
      bench.scene.pushers[0].normal_angle = std::atan2(n.y(), n.x());
      bench.scene.g_W = -kGravity * n;
      bench.scene.start.X_HO = {-0.012 * n.x(), -0.012 * n.y(), 0.0};
      if (axis == Axis::kY) bench.scene.gripper.pad = RectanglePad{{0.004, 0.03}};
      const Transition out = bench.roll(0.04);
      ASSERT_TRUE(out.completed()) << out.reason;
      EXPECT_NEAR(std::abs(out.end.psi), std::abs(one.end.psi), 1e-9);
      EXPECT_NEAR(out.max_push_force, one.max_push_force, 1e-9);
      // By the right hand: the surface on the support moves along +z with it.
      const double lever = axis == Axis::kX ? -side : side;
      EXPECT_GT(out.end.psi * lever, 0.0);
    }
  }
}

TEST(RollPrism, NoHeapWithoutATrace) {
  const Bench bench = square_bar();
  const Model model = prepare(bench.scene);
  const Push push = Roll{0, 0.02};
  const NoHeapScope scope;
  const Transition out = apply(model, bench.scene.start, push);
  EXPECT_LE(scope.allocations(), 0);
  EXPECT_TRUE(out.completed());
}

// The number of steps is one for every turn: a long roll ends by its travel.
TEST(RollPrism, RollsAsFarAsTheSupportTravels) {
  const Bench bench = square_bar();
  const Transition out = bench.roll(5.04);
  ASSERT_TRUE(out.completed()) << out.reason;
  EXPECT_NEAR(out.end.psi, -42.0 * 2.0 * kPi, 1e-7);
  EXPECT_EQ(out.event_count + out.more_events, 4 * 42);
  const Roll roll{0, 5.04};
  const Transition short_of_steps =
      apply(prepare(bench.scene), bench.scene.start, roll, {.max_steps = 50});
  EXPECT_EQ(short_of_steps.status, TransitionStatus::kIterationLimit);
  EXPECT_LT(short_of_steps.done, 0.01);
}

}  // namespace
}  // namespace prehensile
