/// Sound scenes and plans with every kind of part, drawn at random.
#pragma once

#include <string>

#include "mechanics/model.h"
#include "planner/plan.h"
#include "tests/support/random.h"

namespace prehensile::testing {

inline Shape random_shape(Random& random) {
  switch (random.below(3)) {
    case 0:
      return BoxShape{{random.in(0.02, 0.2), random.in(0.02, 0.2), random.in(0.01, 0.1)}};
    case 1:
      return CylinderShape{random.in(0.01, 0.05), random.in(0.05, 0.2),
                           static_cast<Axis>(random.below(3))};
    default: {
      PrismShape prism;
      const int count = 4 + random.below(5);
      for (int i = 0; i < count; ++i) {
        const double angle = 6.283 * (i + random.in(0.0, 0.8)) / count;
        prism.outline.push_back(rotated(angle, {random.in(0.03, 0.06), 0.0}));
      }
      prism.thickness = random.in(0.01, 0.1);
      return prism;
    }
  }
}

inline Pad random_pad(Random& random, bool thin_ones_too) {
  switch (random.below(thin_ones_too ? 5 : 2)) {
    case 0:
      return DiscPad{random.in(0.002, 0.02)};
    case 1:
      return RectanglePad{{random.in(0.002, 0.04), random.in(0.002, 0.04)}};
    case 2:
      return LinePad{random.in(0.002, 0.04), random.in(-1.0, 1.0)};
    case 3:
      return PolygonPad{{{-0.01, -0.01}, {random.in(0.005, 0.02), -0.01}, {0.0, 0.01}}};
    default:
      return random.chance(0.5) ? PointPad{} : PointPad{random.in(1e-3, 1e-2)};
  }
}

inline Goal random_goal(Random& random, bool rolls) {
  Goal goal;
  goal.x = random.in(-0.05, 0.05);
  if (random.chance(0.5)) goal.y = random.in(-0.05, 0.05);
  if (random.chance(0.5)) goal.theta = random.in(-3.0, 3.0);
  if (rolls) goal.psi = random.in(-3.0, 3.0);
  goal.position_tolerance = random.log_in(1e-5, 1e-2);
  goal.angle_tolerance = random.log_in(1e-4, 1e-1);
  goal.characteristic_length = random.in(0.001, 0.1);
  goal.test = static_cast<GoalTest>(random.below(2));
  return goal;
}

inline Pusher random_pusher(Random& random, int number) {
  Pusher pusher;
  pusher.name = "pusher \"" + std::to_string(number) + "\" # \\ \xc3\xa4";
  const auto length = [&random]() -> std::optional<double> {
    if (random.chance(0.5)) return std::nullopt;
    return random.in(0.001, 0.2);
  };
  switch (random.below(5)) {
    case 0:
      pusher.feature = PointFeature{};
      break;
    case 1:
      pusher.feature = UprightFeature{length()};
      break;
    case 2:
      pusher.feature = PlaneFeature{length(), length()};
      break;
    default:
      pusher.feature = LineFeature{length()};
  }
  if (random.chance(0.3)) pusher.z_WP = random.in(-0.005, 0.005);
  pusher.friction = random.in(0.0, 1.0);
  pusher.p_WP = random.in_box(1.0, 1.0);
  pusher.normal_angle = random.in(-3.0, 3.0);
  return pusher;
}

inline Uncertainty random_uncertainty(Random& random) {
  Uncertainty u;
  u.spread = random.chance(0.5) ? Spread::kBox : Spread::kNormal;
  u.sigmas = random.in(0.1, 10.0);
  for (double* share :
       {&u.friction, &u.finger_friction, &u.grip_force, &u.mass, &u.torque_radius}) {
    *share = random.in(0.0, 0.9);
  }
  for (double* width : {&u.centre_of_mass, &u.start_position, &u.pusher_place,
                        &u.start_angle, &u.pusher_tilt}) {
    *width = random.in(0.0, 1.0);
  }
  return u;
}

/// Limits that admit this start.
inline GraspLimits random_limits(Random& random, const Grasp& start) {
  GraspLimits limits;
  const Vec2 p_OF = finger_in_object(start.X_HO);
  if (random.chance(0.5)) limits.theta_low = start.X_HO.theta - random.in(0.0, 4.0);
  if (random.chance(0.5)) limits.theta_high = start.X_HO.theta + random.in(0.0, 4.0);
  if (random.chance(0.5)) limits.finger_low = p_OF - Vec2::Constant(random.in(0.0, 0.1));
  if (random.chance(0.5)) limits.finger_high = p_OF + Vec2::Constant(random.in(0.0, 0.1));
  if (random.chance(0.5)) limits.hand_low = Vec2(-1.0, random.in(-1.0, 0.0));
  if (random.chance(0.5)) limits.hand_high = Vec2(1.0, random.in(0.0, 1.0));
  if (random.chance(0.5)) {
    limits.hand_angle_low = random.in(-3.0, 0.0);
    limits.hand_angle_high = random.in(0.0, 3.0);
  }
  return limits;
}

inline ConvexBody random_body(Random& random, bool in_hand, int number) {
  ConvexBody body;
  body.name = "body " + std::to_string(number);
  switch (random.below(in_hand ? 5 : 6)) {
    case 0:
      body.shape = BoxShape{{random.in(0.01, 0.1), 0.02, 0.03}};
      break;
    case 1:
      body.shape = SphereShape{random.in(0.01, 0.1)};
      break;
    case 2:
      body.shape = CylinderShape{0.01, random.in(0.01, 0.1), Axis::kY};
      break;
    case 3:
      body.shape = CapsuleShape{0.01, random.in(0.01, 0.1), Axis::kX};
      break;
    case 4:
      body.shape = PrismShape{{{0.0, 0.0}, {0.1, 0.0}, {0.0, random.in(0.01, 0.1)}},
                              0.02,
                              static_cast<Axis>(random.below(3))};
      break;
    default: {
      const double angle = random.in(-3.0, 3.0);
      body.shape = HalfSpaceShape{{std::cos(angle), std::sin(angle), 0.0}};
    }
  }
  body.position = {random.in(-1.0, 1.0), random.in(-1.0, 1.0), random.in(-1.0, 1.0)};
  const double half = random.in(-3.0, 3.0);
  if (random.chance(0.5)) body.quaternion = {0.0, std::sin(half), 0.0, std::cos(half)};
  if (random.chance(0.5)) body.turn = random.in(-3.0, 3.0);
  return body;
}

inline Obstacles random_obstacles(Random& random) {
  Obstacles obstacles;
  obstacles.clearance = random.in(0.0, 0.01);
  obstacles.approach = random.in(0.01, 0.1);
  for (int i = random.below(3); i > 0; --i) {
    obstacles.fixture.push_back(random_body(random, false, i));
    obstacles.hand.push_back(random_body(random, true, i));
  }
  return obstacles;
}

/// A scene that `check` accepts.
inline Scene random_scene(Random& random) {
  Scene scene;
  scene.name =
      random.chance(0.2) ? "5" : "a name: with \"quotes\",\nlines and \xe2\x82\xac";
  scene.origin = random.chance(0.5) ? "" : "- nowhere\t# really";
  scene.object.shape = random_shape(random);
  scene.object.mass = random.log_in(1e-3, 10.0);
  const bool rolls = can_roll(scene.object);
  if (random.chance(0.3)) {
    scene.object.p_OCom = random.in_disc(0.01);
    if (!rolls && random.chance(0.5)) scene.object.z_OCom = random.in(-0.005, 0.005);
  }
  if (random.chance(0.3)) scene.object.inertia = random.log_in(1e-8, 1e-2);
  if (random.chance(0.3)) scene.uncertainty = random_uncertainty(random);
  scene.gripper.name = "null";
  scene.gripper.pad = random_pad(random, !rolls);
  scene.gripper.friction = {random.in(0.0, 1.0), random.in(0.0, 1.0)};
  scene.gripper.grip_force = random.in(0.0, 100.0);
  scene.gripper.jaw_mode = static_cast<JawMode>(random.below(3));
  if (random.chance(0.3)) {
    scene.gripper.pressure = {
        .law = static_cast<PressureLaw>(random.below(3)),
        .compliance = random.log_in(1e-6, 1.0),
        .profile = std::holds_alternative<PolygonPad>(scene.gripper.pad)
                       ? PressureProfile::kUniform
                       : static_cast<PressureProfile>(random.below(2)),
        .edge_load = random.in(-0.5, 1.0)};
  }
  const double half = random.in(-3.0, 3.0);
  scene.gripper.tool.p_HT = {random.in(-0.1, 0.1), random.in(-0.1, 0.1), 1e-17};
  scene.gripper.tool.q_HT = {std::sin(half), 0.0, 0.0, std::cos(half)};
  const int pushers = random.below(4);
  for (int i = 0; i < pushers; ++i) scene.pushers.push_back(random_pusher(random, i));
  scene.g_W = random.in_box(10.0, 10.0);
  if (!rolls && random.chance(0.3)) scene.g_Wz = random.in(-10.0, 10.0);
  scene.overhang = static_cast<Overhang>(random.below(2));
  scene.start.X_HO = {random.in(-0.002, 0.002), random.in(-0.002, 0.002),
                      random.chance(0.5)
                          ? random.in(-3.0, 3.0)
                          : random.below(360) * (std::numbers::pi / 180.0)};
  if (rolls) scene.start.psi = random.in(-3.0, 3.0);
  if (random.chance(0.8)) scene.goal = random_goal(random, rolls);
  Random of_space(static_cast<std::uint64_t>(1e9 * scene.object.mass));
  if (scene.goal) scene.goal->theta_is = static_cast<ThetaMeaning>(of_space.below(2));
  if (of_space.chance(0.3)) scene.limits = random_limits(of_space, scene.start);
  if (of_space.chance(0.3)) scene.obstacles = random_obstacles(of_space);
  if (scene.g_Wz == 0.0 && of_space.chance(0.3)) {
    const double least = of_space.log_in(0.1, 50.0);
    scene.gripper.grip_range = Vec2(least, of_space.in(1.0, 5.0) * least);
  }
  if (of_space.chance(0.3)) {
    scene.cost = {of_space.log_in(0.01, 100.0), of_space.in(0.0, 1e4),
                  of_space.in(0.0, 100.0)};
  }
  return scene;
}

inline Grasp random_grasp(Random& random) {
  return {{random.in(-0.1, 0.1), random.in(-0.1, 0.1), random.in(-7.0, 7.0)},
          random.in(-1.0, 1.0)};
}

inline Push random_push(Random& random, const Model& model) {
  int contact = random.below(static_cast<int>(model.contacts.size()));
  const double place = random.in(-0.05, 0.05);
  const double travel = random.in(0.001, 0.1);
  const double turn = random.in(-1.0, 1.0);
  switch (random.below(model.cross_section ? 4 : 3)) {
    case 0:
      return LinearPush{contact, place, random.direction(), travel, turn};
    case 1:
      return Slide{contact, place, random.direction(), travel, random.in(0.01, 0.1)};
    case 2:
      return Pivot{contact, place, turn, random.in(1e-4, 1e-2)};
    default:
      if (model.contacts[contact].grip_share != 1.0) contact = 0;
      return Roll{contact, turn, random.chance(0.5) ? 0.0 : random.in(0.1, 10.0)};
  }
}

/// A plan as a file may hold it; its numbers mean nothing.
inline Plan random_plan(Random& random, const Model& model) {
  Plan plan;
  plan.planner = "push";
  plan.seed = random.bits() >> 1;
  plan.message = "some words";
  plan.start = model.scene.start;
  plan.goal = random_grasp(random);
  plan.stick_tests = static_cast<std::int64_t>(random.bits() >> 1);
  plan.seconds = random.log_in(1e-6, 1e3);
  plan.margin = Margin{}.scaled(random.in(0.0, 2.0));
  if (model.contacts.empty() || random.chance(0.3)) {
    plan.status = PlanStatus::kInfeasible;
    plan.proof.kind = Proof::Kind::kStartFalls;
    plan.proof.twist = {random.in(-1.0, 1.0), random.in(-1.0, 1.0), random.in(-9.0, 9.0)};
    plan.proof.text = "it falls";
    return plan;
  }
  plan.status = PlanStatus::kReachedGoal;
  plan.cost = random.in(1.0, 5.0);
  plan.placements = 1.0;
  plan.lower_bound = random.in(0.5, 1.0);
  plan.travel = random.in(0.0, 1.0);
  if (model.scene.cost) {
    plan.work = random.in(0.0, 10.0);
    plan.grip_changes = random.below(5);
  }
  const int pushes = 1 + random.below(5);
  for (int i = 0; i < pushes; ++i) {
    PlannedPush planned;
    planned.push = random_push(random, model);
    planned.start = random_grasp(random);
    planned.end = random_grasp(random);
    if (random.chance(0.7)) planned.push_force = random.log_in(1e-3, 1e3);
    if (random.chance(0.7)) planned.slack = random.in(0.0, 1.0);
    if (random.chance(0.7)) planned.certificate = random.log_in(1e-17, 1e-6);
    plan.pushes.push_back(planned);
  }
  return plan;
}

}  // namespace prehensile::testing
