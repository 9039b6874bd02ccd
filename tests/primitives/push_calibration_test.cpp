#include "primitives/push_calibration.h"

#include <cmath>

#include <gtest/gtest.h>

#include "problems/random_stream.h"
#include "scene/contact_region.h"

namespace prehensile {
namespace {

Scene tip_on_box() {
  Scene scene;
  scene.object.shape = BoxShape{{0.1, 0.04, 0.025}};
  scene.object.mass = 0.1;
  scene.gripper.pad = DiscPad{0.01};
  scene.gripper.friction = {0.5, 0.4};
  scene.gripper.grip_force = 20.0;
  scene.pushers = {{.name = "tip",
                    .feature = PointFeature{},
                    .friction = 0.3,
                    .p_WP = {-0.05, 0.0},
                    .faces = {"-x", "+y", "-y"}}};
  return scene;
}

struct Truth {
  double friction = 0.22;
  double edge_load = 0.8;
  Vec2 registration{0.6e-3, -0.4e-3};
  double noise = 1e-4;  ///< [m]; angles 30 times that [rad]
  double finger_friction = 0.45;
};

/// A push against one of the three faces, as measured where nothing is known better.
MeasuredPush drawn_push(RandomStream& random) {
  const std::array<Vec2, 3> normals = {Vec2(1.0, 0.0), Vec2(0.0, 1.0), Vec2(0.0, -1.0)};
  const int face = random.below(3);
  const Vec2& n = normals[static_cast<std::size_t>(face)];
  const double along = face == 0 ? random.in(-0.015, 0.015) : random.in(-0.035, 0.035);
  const Vec2 met = Vec2(-0.05 * n.x(), -0.02 * n.y()) + along * perp(n);
  const Vec2 way = rotated(random.in(-0.8, 0.8), n);
  MeasuredPush push;
  push.X_HO_start = {random.in(-0.01, 0.01), random.in(-0.004, 0.004),
                     random.in(-0.1, 0.1)};
  push.from = transform(push.X_HO_start, met - 0.003 * way);
  push.to = transform(push.X_HO_start, met + 0.012 * way);
  return push;
}

Model true_model(const Truth& truth) {
  Scene scene = tip_on_box();
  scene.pushers[0].friction = truth.friction;
  scene.gripper.pressure.edge_load = truth.edge_load;
  scene.gripper.friction = {truth.finger_friction, truth.finger_friction * 0.8};
  return prepare(scene);
}

/// Uniform, of this standard deviation.
double scatter(RandomStream& random, double scale) {
  return scale * random.in(-1.7320508, 1.7320508);
}

SceneFitOptions quick_options() {
  SceneFitOptions options;
  options.transition = {.tolerance = 1e-5, .friction_model = FrictionModel::kEllipsoid};
  return options;
}

void make(const Model& model, const Truth& truth, RandomStream& random,
          MeasuredPush& push) {
  const PredictedPush end =
      predict(model, push, truth.registration, quick_options().transition);
  push.X_HO_end = end.X_HO_end;
  push.X_HO_end.x += scatter(random, truth.noise);
  push.X_HO_end.y += scatter(random, truth.noise);
  push.X_HO_end.theta += scatter(random, 30.0 * truth.noise);
}

std::vector<MeasuredPush> made_pushes(const Truth& truth, int count, std::uint64_t seed,
                                      bool with_force = false) {
  const Model model = true_model(truth);
  RandomStream random(seed);
  std::vector<MeasuredPush> pushes;
  for (int i = 0; i < count; ++i) {
    MeasuredPush push = drawn_push(random);
    make(model, truth, random, push);
    if (with_force) {
      const PredictedPush end =
          predict(model, push, truth.registration, quick_options().transition);
      push.push_force = end.push_force * (1.0 + scatter(random, 0.03));
    }
    pushes.push_back(push);
  }
  return pushes;
}

const CalibratedParameter& parameter(const SceneFit& fit, const Calibration& found,
                                     Target target) {
  for (std::size_t j = 0; j < fit.targets.size(); ++j) {
    if (fit.targets[j].target == target) return found.parameters[j];
  }
  ADD_FAILURE() << "not fitted";
  return found.parameters[0];
}

TEST(MeasuredPush, IsThePushThatTakesThePusherAlongItsPath) {
  const Model model = true_model({});
  RandomStream random(1);
  for (int i = 0; i < 200; ++i) {
    MeasuredPush measured = drawn_push(random);
    measured.turn = i % 2 ? 0.0 : random.in(-0.2, 0.2);
    const Vec2 off(random.in(-1e-3, 1e-3), random.in(-1e-3, 1e-3));
    const std::optional<LinearPush> push = push_of(model, measured, off);
    ASSERT_TRUE(push.has_value()) << i;
    // The tip stands on the face at the start, and on the path; it ends at its end.
    const PushContact& contact = model.contacts[push->contact];
    const Vec2 p_OTip = 0.5 * (contact.a + contact.b) + push->place * contact.t;
    const Vec2 start =
        transform(pusher_pose(*push, measured.X_HO_start, 0.0), p_OTip) - off;
    const Vec2 end =
        transform(pusher_pose(*push, measured.X_HO_start, 1.0), p_OTip) - off;
    const Vec2 way = (measured.to - measured.from).normalized();
    EXPECT_NEAR(cross(start - measured.from, way), 0.0, 1e-12) << i;
    EXPECT_LT((end - measured.to).norm(), 1e-12) << i;
    const double before = (start - measured.from).dot(way);
    EXPECT_GT(before, 0.0015) << i;  // 3 mm less the registration, along a slant
    EXPECT_LT(before, 0.0055) << i;
  }
}

TEST(MeasuredPush, APathThatMissesMovesNothing) {
  const Model model = true_model({});
  MeasuredPush measured;
  measured.from = {-0.06, 0.03};
  measured.to = {-0.02, 0.03};
  EXPECT_FALSE(push_of(model, measured, Vec2::Zero()).has_value());
  const PredictedPush end = predict(model, measured, Vec2::Zero());
  EXPECT_EQ(end.status, TransitionStatus::kNotRun);
  EXPECT_EQ(end.X_HO_end, measured.X_HO_start);
  // Another face than the one that it meets.
  measured.from = {-0.06, 0.0};
  measured.to = {-0.04, 0.0};
  ASSERT_TRUE(push_of(model, measured, Vec2::Zero()).has_value());
  measured.face = model.contacts[1].face;
  EXPECT_FALSE(push_of(model, measured, Vec2::Zero()).has_value());
}

TEST(MeasuredPush, APathThatBeginsInsideIsProlongedBackwards) {
  const Model model = true_model({});
  MeasuredPush outside, inside;
  outside.from = {-0.055, 0.003};
  inside.from = {-0.049, 0.003};
  outside.to = inside.to = {-0.04, 0.003};
  const PredictedPush a = predict(model, outside, Vec2::Zero());
  const PredictedPush b = predict(model, inside, Vec2::Zero());
  EXPECT_NEAR(a.X_HO_end.x, b.X_HO_end.x, 1e-12);
  EXPECT_NEAR(a.X_HO_end.theta, b.X_HO_end.theta, 1e-12);
  EXPECT_NEAR(a.X_HO_end.x, 0.01, 2e-3);
}

TEST(PushCalibration, RecoversWhatMadeThePushes) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const Truth truth;
    std::vector<MeasuredPush> pushes = made_pushes(truth, 24, seed, true);
    pushes[3].X_HO_end.y += 0.004;  // a slip of the camera
    const SceneFit fit = push_fit(tip_on_box(), pushes, quick_options());
    const Calibration found = calibrate(fit.problem);
    EXPECT_EQ(found.told(), 5) << seed;
    const auto value = [&](Target target) { return parameter(fit, found, target).value; };
    EXPECT_NEAR(value(Target::kPusherFriction), truth.friction, 0.01) << seed;
    EXPECT_NEAR(value(Target::kEdgeLoad), truth.edge_load, 0.2) << seed;
    EXPECT_NEAR(value(Target::kFingerFriction), 0.9 * truth.finger_friction, 0.02);
    const Vec2 registration = registration_of(fit.targets, found.fit.at);
    EXPECT_LT((registration - truth.registration).norm(), 1.5e-4) << seed;
    // The ratio of both jaws stays, and the scene holds the values.
    const Scene scene = with_values(tip_on_box(), fit.targets, found.fit.at);
    EXPECT_NEAR(scene.gripper.friction[1], 0.8 * scene.gripper.friction[0], 1e-12);
    EXPECT_EQ(scene.pushers[0].friction, value(Target::kPusherFriction));
    EXPECT_EQ(scene.gripper.pressure.edge_load, value(Target::kEdgeLoad));
  }
}

TEST(PushCalibration, FindsTheTorqueRadiusAsWell) {
  Truth truth;
  truth.edge_load = 0.0;
  Scene scene = tip_on_box();
  scene.gripper.pad = DiscPad{0.008};  // the true pads are 1.25 times as wide
  SceneFitOptions options = quick_options();
  options.pressure = PressureFit::kTorqueRadius;
  const SceneFit fit = push_fit(scene, made_pushes(truth, 24, 5), options);
  const Calibration found = calibrate(fit.problem);
  EXPECT_NEAR(parameter(fit, found, Target::kTorqueRadius).value, 1.25, 0.05);
  const Scene after = with_values(scene, fit.targets, found.fit.at);
  EXPECT_NEAR(std::get<DiscPad>(after.gripper.pad).radius, 0.01, 4e-4);
}

/// Pushes straight through the finger axis turn nothing: neither pressure nor friction
/// nor the registration along the path's normal can be told from how the object moves.
TEST(PushCalibration, OneDirectionDoesNotTellThePressure) {
  const Truth truth{.registration = Vec2::Zero()};
  const Model model = true_model(truth);
  RandomStream random(1);
  std::vector<MeasuredPush> pushes;
  for (int i = 0; i < 24; ++i) {
    MeasuredPush push;
    push.X_HO_start = {random.in(-0.01, 0.01), 0.0, 0.0};
    push.from = {push.X_HO_start.x - 0.053, 0.0};
    push.to = {push.X_HO_start.x - 0.040, 0.0};
    make(model, truth, random, push);
    pushes.push_back(push);
  }
  const SceneFit fit = push_fit(tip_on_box(), pushes, quick_options());
  const Calibration found = calibrate(fit.problem);
  EXPECT_FALSE(parameter(fit, found, Target::kEdgeLoad).told);
  EXPECT_FALSE(parameter(fit, found, Target::kPusherFriction).told);
  EXPECT_TRUE(parameter(fit, found, Target::kRegistrationX).told);
  EXPECT_EQ(parameter(fit, found, Target::kEdgeLoad).value, 0.0);
}

TEST(PushCalibration, MirroredPushesGiveMirroredRegistration) {
  const std::vector<MeasuredPush> pushes = made_pushes({}, 20, 7);
  std::vector<MeasuredPush> mirrored = pushes;
  for (MeasuredPush& push : mirrored) {
    for (PlanarPose* pose : {&push.X_HO_start, &push.X_HO_end}) {
      pose->y = -pose->y;
      pose->theta = -pose->theta;
    }
    for (Vec2* p : {&push.from, &push.to}) p->y() = -p->y();
  }
  const SceneFit a = push_fit(tip_on_box(), pushes, quick_options());
  Scene other_way_up = tip_on_box();
  other_way_up.g_W = -other_way_up.g_W;
  const SceneFit b = push_fit(other_way_up, mirrored, quick_options());
  const Calibration of_a = calibrate(a.problem);
  const Calibration of_b = calibrate(b.problem);
  const auto compare = [&](Target target, double sign, double tolerance) {
    EXPECT_NEAR(parameter(a, of_a, target).value, sign * parameter(b, of_b, target).value,
                tolerance);
    EXPECT_NEAR(parameter(a, of_a, target).profile.interval.half_width(),
                parameter(b, of_b, target).profile.interval.half_width(),
                2.0 * tolerance);
  };
  compare(Target::kPusherFriction, 1.0, 2e-3);
  compare(Target::kEdgeLoad, 1.0, 0.02);
  compare(Target::kRegistrationX, 1.0, 1e-5);
  compare(Target::kRegistrationY, -1.0, 1e-5);
}

/// 90 % intervals over many draws of the data: three standard deviations of so many
/// draws are 12 %.
TEST(PushCalibration, FullIntervalsCoverAtTheNominalRate) {
  const int draws = 60;
  std::array<int, 4> covered{};
  const Truth truth;
  for (int draw = 0; draw < draws; ++draw) {
    const SceneFit fit = push_fit(
        tip_on_box(), made_pushes(truth, 24, 1000 + static_cast<std::uint64_t>(draw)),
        quick_options());
    const Calibration found = calibrate(fit.problem);
    const std::array<double, 4> values = {truth.friction, truth.edge_load,
                                          truth.registration.x(), truth.registration.y()};
    ASSERT_EQ(found.parameters.size(), values.size());
    for (std::size_t j = 0; j < values.size(); ++j) {
      const FitInterval& interval = found.parameters[j].profile.interval;
      covered[j] += interval.low <= values[j] && values[j] <= interval.high;
    }
  }
  int all = 0;
  for (std::size_t j = 0; j < covered.size(); ++j) {
    EXPECT_GE(covered[j], 0.78 * draws) << j;
    all += covered[j];
    std::printf("parameter %zu: %d of %d\n", j, covered[j], draws);
  }
  EXPECT_GE(all, 0.84 * draws * static_cast<int>(covered.size()));
  EXPECT_LE(all, 0.96 * draws * static_cast<int>(covered.size()));
}

std::vector<SlipReading> made_readings(const std::vector<double>& grips, double mu,
                                       double bias, double c, std::uint64_t seed) {
  RandomStream random(seed);
  std::vector<SlipReading> readings;
  for (const double grip : grips) {
    const double slip = 2.0 * mu * grip;
    readings.push_back({grip, (slip + bias) * (1.0 + scatter(random, 0.02)),
                        slip * c * (1.0 + scatter(random, 0.02))});
  }
  return readings;
}

TEST(SlipCalibration, TellsFrictionTorqueRadiusAndBias) {
  const Scene scene = tip_on_box();
  const double c = ContactRegion(scene, 64).torque_radius();
  std::vector<double> grips;
  grips.reserve(24);
  for (int i = 0; i < 24; ++i) grips.push_back(4.0 * (1 + i % 6));
  const SceneFit fit = slip_fit(scene, made_readings(grips, 0.55, 0.8, 1.2 * c, 1));
  const Calibration found = calibrate(fit.problem);
  EXPECT_EQ(found.told(), 3);
  EXPECT_NEAR(parameter(fit, found, Target::kFingerFriction).value, 0.55, 0.01);
  EXPECT_NEAR(parameter(fit, found, Target::kTorqueRadius).value, 1.2, 0.03);
  EXPECT_NEAR(parameter(fit, found, Target::kForceBias).value, 0.8, 0.2);
}

TEST(SlipCalibration, OneGripForceDoesNotTellFrictionFromBias) {
  const Scene scene = tip_on_box();
  std::vector<SlipReading> readings =
      made_readings(std::vector<double>(24, 12.0), 0.55, 0.8, 0.01, 1);
  for (SlipReading& reading : readings) reading.slip_torque.reset();
  const SceneFit fit = slip_fit(scene, readings);
  const Calibration found = calibrate(fit.problem);
  EXPECT_EQ(found.told(), 1);
  EXPECT_GE(
      std::max(found.parameters[0].confused_with, found.parameters[1].confused_with), 0);
}

}  // namespace
}  // namespace prehensile
