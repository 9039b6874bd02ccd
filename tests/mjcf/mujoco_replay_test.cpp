#include "mjcf/mujoco_replay.h"

#include <cmath>
#include <cstdio>
#include <mujoco/mujoco.h>
#include <numbers>

#include <gtest/gtest.h>

#include "io/scene_file.h"
#include "mjcf/mjcf.h"
#include "planner/planner.h"
#include "primitives/transition.h"
#include "tests/io/files.h"
#include "tests/support/folder.h"

namespace prehensile::mjcf {
namespace {

using testing::kSourceTree;

constexpr double kDeg = std::numbers::pi / 180.0;
const Vec2 kX(1.0, 0.0);

/// A bar held at its middle: a wall at its end -x, a smooth pin at its side -y.
Scene bar_scene() {
  Scene scene;
  scene.object.shape = BoxShape{{0.1, 0.03, 0.04}};
  scene.object.mass = 0.1;
  scene.gripper.pad = DiscPad{0.01};
  scene.gripper.friction = {0.5, 0.5};
  scene.gripper.grip_force = 20.0;
  scene.overhang = Overhang::kIgnore;
  scene.g_W = {0.0, 0.0};
  scene.pushers.resize(2);
  scene.pushers[0] = {.name = "wall", .feature = LineFeature{}, .friction = 0.5};
  scene.pushers[0].p_WP = {-0.05, 0.0};
  scene.pushers[1] = {.name = "pin", .feature = PointFeature{}, .friction = 0.0};
  scene.pushers[1].p_WP = {0.02, -0.015};
  scene.pushers[1].normal_angle = 0.5 * std::numbers::pi;
  return scene;
}

/// A plan of one push whose outcome is that of the mechanics here.
Plan plan_of(const Model& model, const Push& push) {
  const Grasp start = model.scene.start;
  const Transition done = apply(model, start, push);
  EXPECT_TRUE(done.completed()) << name(done.status) << ' ' << done.reason;
  Plan plan;
  plan.start = start;
  plan.pushes.push_back(
      {.push = push, .start = start, .end = done.end, .push_force = done.max_push_force});
  return plan;
}

MujocoPush replayed(const Model& model, const Push& push, double speed = 2e-3) {
  const MujocoReplay replay =
      mujoco_replay(model, plan_of(model, push), {.speed = speed});
  EXPECT_EQ(replay.pushes.size(), 1u);
  EXPECT_EQ(replay.pushes[0].trouble, "");
  return replay.pushes[0];
}

TEST(MujocoReplay, SlideTakesTwiceFrictionTimesGrip) {
  for (const int points : {1, 4, 8}) {
    const Model model = prepare(bar_scene(), {.points_per_pad = points});
    const MujocoPush push = replayed(model, Slide{.e = kX, .travel = 2e-3});
    EXPECT_NEAR(push.peak_force, 20.0, 0.01 * 20.0) << points;
    EXPECT_LT(push.position_error, 3e-5);
    EXPECT_LT(push.angle_error, 0.01 * kDeg);
    EXPECT_LT(push.tilt, 0.01 * kDeg);
  }
}

TEST(MujocoReplay, SlideForceFollowsGripAndFrictions) {
  Scene scene = bar_scene();
  scene.gripper.friction = {0.9, 0.9};
  scene.gripper.grip_force = 7.0;
  const MujocoPush push =
      replayed(prepare(scene, {.points_per_pad = 4}), Slide{.e = kX, .travel = 2e-3});
  EXPECT_NEAR(push.peak_force, 2.0 * 0.9 * 7.0, 0.01 * 2.0 * 0.9 * 7.0);
}

/// Slowest way to give way to a smooth pin at lever d: least power of friction over
/// motions with v_y + d w = 1 and v_x = 0, by golden section over w.
struct LeastPower {
  double force = 0.0, turn_rate = 0.0;
};
LeastPower least_power(const Model& model, double d) {
  const ContactPoints& points = model.region.whole();
  const auto power = [&](double w) {
    double sum = 0.0;
    for (int j = 0; j < points.count; ++j) {
      sum +=
          points.weight[j] * std::hypot(-w * points.y[j], 1.0 - d * w + w * points.x[j]);
    }
    return model.F * sum;
  };
  constexpr double kGolden = 0.6180339887498949;
  double a = 0.0;
  double b = 2.0 / d;
  while (b - a > 1e-9) {
    const double c = b - kGolden * (b - a);
    const double e = a + kGolden * (b - a);
    (power(c) < power(e) ? b : a) = power(c) < power(e) ? e : c;
  }
  return {power(0.5 * (a + b)), 0.5 * (a + b)};
}

TEST(MujocoReplay, PivotByASmoothPinTakesTheLeastPower) {
  Scene scene = bar_scene();
  for (const double lever : {0.02, 0.04}) {
    scene.pushers[1].p_WP.x() = lever;
    const Model model = prepare(scene, {.points_per_pad = 8});
    constexpr double kTravel = 5e-4;  // so that the lever stays as it is
    const LinearPush push{.contact = 1,
                          .place = model.contacts[1].t.x() * lever,
                          .e = {0.0, 1.0},
                          .travel = kTravel};
    const MujocoPush seen = replayed(model, push, 1e-3);
    const LeastPower expected = least_power(model, lever);
    EXPECT_NEAR(seen.peak_force, expected.force, 0.02 * expected.force) << lever;
    const double turned = seen.end.X_HO.theta;
    EXPECT_NEAR(turned, kTravel * expected.turn_rate, 0.04 * turned) << lever;
    EXPECT_LT(seen.position_error, 2e-5);
  }
}

/// Pushes that stick under gravity, tip over an end, slip, and turn as they go: the
/// mechanics here and MuJoCo end at the same pose.
TEST(MujocoReplay, PushesOfManyKindsEndAlike) {
  Scene scene = bar_scene();
  scene.g_W = {0.0, -9.81};
  scene.pushers[1].friction = 0.3;
  const Model model = prepare(scene, {.points_per_pad = 4});
  const double side = model.contacts[1].t.x();
  const std::vector<Push> pushes{
      LinearPush{.e = rotated(0.2, kX), .travel = 4e-3, .turn = 0.1},
      LinearPush{.e = kX, .travel = 3e-3, .turn = 0.4},
      LinearPush{.e = rotated(1.2, kX), .travel = 3e-3},
      LinearPush{.contact = 1, .place = side * 0.03, .e = {0.0, 1.0}, .travel = 3e-3},
      LinearPush{.contact = 1,
                 .place = side * 0.03,
                 .e = perp(rotated(-0.6, kX)),
                 .travel = 3e-3}};
  for (std::size_t i = 0; i < pushes.size(); ++i) {
    const MujocoPush push = replayed(model, pushes[i]);
    EXPECT_LT(push.position_error, 1.5e-4) << i;
    EXPECT_LT(push.angle_error, 0.2 * kDeg) << i;
    EXPECT_LT(std::abs(push.force_error), 0.03) << i;
  }
}

/// A can rolls by travel over radius and stays where it is, whichever way the table goes;
/// the force is that of the cross-section.
/// A push that goes on from a harder one finds the pads loaded, which is not its force.
TEST(MujocoReplay, ThePushBeforeIsNotCounted) {
  const Model model = prepare(bar_scene());
  Plan plan = plan_of(model, LinearPush{.contact = 0, .e = kX, .travel = 3e-3});
  const LinearPush turning{.contact = 0, .e = kX, .travel = 2e-3, .turn = 0.5};
  const Grasp between = plan.pushes[0].end;
  const Transition done = apply(model, between, turning);
  ASSERT_TRUE(done.completed()) << name(done.status) << ' ' << done.reason;
  ASSERT_LT(done.max_push_force, 0.8 * plan.pushes[0].push_force);
  plan.pushes.push_back({.push = turning,
                         .start = between,
                         .end = done.end,
                         .push_force = done.max_push_force});
  const MujocoReplay replay = mujoco_replay(model, plan, {.speed = 2e-3});
  ASSERT_EQ(replay.pushes.size(), 2U);
  for (const MujocoPush& push : replay.pushes) EXPECT_NEAR(push.force_error, 0.0, 0.01);
}

TEST(MujocoReplay, ACanRollsByTravelOverRadius) {
  const Model model =
      prepare(read_scene(kSourceTree / "problems" / "paper/roll.yaml").scene,
              {.points_per_pad = 4});
  constexpr double kRadius = 0.02;
  for (const double travel : {0.01, -0.01}) {
    const MujocoPush push = replayed(model, Roll{.travel = travel, .grip_force = 3.9});
    EXPECT_NEAR(push.end.psi, -travel / kRadius, 0.5 * kDeg);
    EXPECT_LT(push.angle_error, 0.5 * kDeg);
    EXPECT_LT(push.position_error, 1e-4);
    EXPECT_LT(push.out_of_plane, 1e-4);
    EXPECT_LT(std::abs(push.force_error), 0.05);
  }
}

/// Where the grip is too tight the table slides by, here and there.
TEST(MujocoReplay, ATightGripDoesNotRoll) {
  const Model model = prepare(
      read_scene(kSourceTree / "problems" / "paper/roll.yaml", {"pushers.0.friction=0.3"})
          .scene,
      {.points_per_pad = 4});
  const Roll roll{.travel = 0.01, .grip_force = 4.8};
  ASSERT_FALSE(apply(model, model.scene.start, roll).completed());
  Plan plan;
  plan.start = model.scene.start;
  plan.pushes.push_back({.push = roll, .start = plan.start, .end = plan.start});
  const MujocoReplay replay = mujoco_replay(model, plan);
  EXPECT_LT(std::abs(replay.pushes[0].end.psi), 0.05 * 0.01 / 0.02);
}

/// A plan that says something else is told apart.
TEST(MujocoReplay, SeesAPlanThatIsWrong) {
  const Model model = prepare(bar_scene(), {.points_per_pad = 4});
  Plan plan = plan_of(model, Slide{.e = kX, .travel = 2e-3});
  plan.pushes[0].end.X_HO.y += 1.5e-3;
  plan.pushes[0].end.X_HO.theta += 2.0 * kDeg;
  plan.pushes[0].push_force *= 2.0;
  const MujocoReplay replay = mujoco_replay(model, plan, {.speed = 1e-2});
  EXPECT_NEAR(replay.pushes[0].position_error, 1.5e-3, 5e-5);
  EXPECT_NEAR(replay.pushes[0].angle_error, 2.0 * kDeg, 0.1 * kDeg);
  EXPECT_NEAR(replay.pushes[0].force_error, -0.5, 0.02);
}

/// The file as others run it: key frame, steps, nothing else.
TEST(MujocoReplay, TheFileAloneMakesThePush) {
  const Model model = prepare(bar_scene(), {.points_per_pad = 4});
  const Plan plan = plan_of(model, Slide{.e = kX, .travel = 4e-3});
  const std::string text = file_text(model, plan.pushes);
  const testing::Folder folder;
  const std::string file = folder.path("push.xml").string();
  std::ofstream(file) << text;
  std::array<char, 500> error{};
  mjModel* m = mj_loadXML(file.c_str(), nullptr, error.data(), error.size());
  ASSERT_NE(m, nullptr) << error.data();
  mjData* d = mj_makeData(m);
  mj_resetDataKeyframe(m, d, mj_name2id(m, mjOBJ_KEY, "push_1"));
  const int numeric = mj_name2id(m, mjOBJ_NUMERIC, "push_1_seconds");
  const double seconds = m->numeric_data[m->numeric_adr[numeric]];
  EXPECT_NEAR(seconds, 2.0, 1e-9);
  for (int i = 0; i < m->npair; ++i) m->pair_margin[i] = 1e-6;
  mj_forward(m, d);
  int touching = 0;
  for (int i = 0; i < d->ncon; ++i) {
    EXPECT_NEAR(d->contact[i].dist, 0.0, 1e-9);
    ++touching;
  }
  EXPECT_EQ(touching, 2 * 4 + 2);  // points of both pads, ends of the face
  for (int i = 0; i < m->npair; ++i) m->pair_margin[i] = 0.0;
  while (d->time < seconds) mj_step(m, d);
  const int object = mj_name2id(m, mjOBJ_BODY, "object");
  const int hand = mj_name2id(m, mjOBJ_BODY, "hand");
  EXPECT_NEAR(d->xpos[3 * object] - d->xpos[3 * hand], plan.pushes[0].end.X_HO.x, 3e-5);
  mj_deleteData(d);
  mj_deleteModel(m);
}

/// Slow: the plans of twenty published problems, and one over rectangular pads.
TEST(MujocoReplay, FullTwentyPublishedPlansEndAlike) {
  std::vector<std::string> files;
  for (const char* shape : {"square", "tee"}) {
    for (int i = 1; i <= 10; ++i) {
      std::array<char, 40> file{};
      std::snprintf(file.data(), file.size(), "published/%s_%02d.yaml", shape, i);
      files.emplace_back(file.data());
    }
  }
  files.emplace_back("ycb/box_franka.yaml");
  for (const std::string& file : files) {
    const Model model = prepare(read_scene(kSourceTree / "problems" / file).scene);
    const Plan plan = plan_regrasp(model);
    ASSERT_TRUE(plan.usable()) << file;
    const MujocoReplay replay = mujoco_replay(model, plan, {.speed = 4e-3});
    ASSERT_EQ(replay.pushes.size(), plan.pushes.size()) << file;
    double force = 0.0;
    for (const MujocoPush& push : replay.pushes) {
      EXPECT_EQ(push.trouble, "") << file;
      EXPECT_LT(push.position_error, 1e-3) << file;
      EXPECT_LT(push.angle_error, 1.0 * kDeg) << file;
      force = std::max(force, std::abs(push.force_error));
    }
    std::printf("%-24s %2zu pushes: off %6.1f um %7.4f deg, force %5.2f %%\n",
                file.c_str(), replay.pushes.size(),
                1e6 * replay.pushes.back().position_error,
                replay.pushes.back().angle_error / kDeg, 100.0 * force);
  }
}

}  // namespace
}  // namespace prehensile::mjcf
