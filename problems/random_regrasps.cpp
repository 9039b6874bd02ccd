#include "problems/random_regrasps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>

#include "mechanics/sticking.h"
#include "primitives/roll.h"
#include "problems/random_stream.h"

namespace prehensile {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kMostMoves = 5;
constexpr double kShortestMove = 5e-3;  // [m]
constexpr double kLongestMove = 40e-3;  // [m]
constexpr double kLargestTurn = 2.0;    // [rad]
constexpr int kTriesPerMove = 400;

PrismShape random_tee(RandomStream& random) {
  const double width = random.in(0.06, 0.14);
  const double bar = random.in(0.25, 0.4) * width;
  const double length = random.in(0.7, 1.2) * width;
  const double stem = 0.5 * random.in(0.25, 0.45) * width;
  const double left = -0.4 * length;
  const double step = left + bar;
  const double right = left + length;
  const double half = 0.5 * width;
  return {{{left, -half},
           {step, -half},
           {step, -stem},
           {right, -stem},
           {right, stem},
           {step, stem},
           {step, half},
           {left, half}},
          0.03};
}

Shape random_shape(RegraspFamily family, RandomStream& random) {
  switch (family) {
    case RegraspFamily::kBox:
      return BoxShape{{random.in(0.04, 0.15), random.in(0.04, 0.15), 0.03}};
    case RegraspFamily::kTee:
      return random_tee(random);
    case RegraspFamily::kCylinder:
      break;
  }
  return CylinderShape{.radius = random.in(0.02, 0.045),
                       .length = random.in(0.06, 0.15),
                       .axis = random.chance(0.5) ? Axis::kX : Axis::kY};
}

/// Angles of the pushers' normals in W: 2 to 4 of the four sides, a can with a long one.
std::vector<double> random_normals(const Shape& shape, RandomStream& random) {
  std::array<double, 4> sides = {0.0, 0.5 * kPi, -0.5 * kPi, kPi};
  for (int i = 3; i > 0; --i) std::swap(sides[i], sides[random.below(i + 1)]);
  const auto* can = std::get_if<CylinderShape>(&shape);
  const double support = can && can->axis == Axis::kY ? 0.0 : 0.5 * kPi;
  if (can) std::swap(sides[0], *std::find(sides.begin(), sides.end(), support));
  return {sides.begin(), sides.begin() + 2 + random.below(3)};
}

Vec2 random_gravity(const Scene& scene, RandomStream& random) {
  const bool can = can_roll(scene.object);
  if (can) return rotated(scene.pushers[0].normal_angle, {-9.81, 0.0});
  if (random.chance(0.1)) return Vec2::Zero();
  return rotated(random.in(-kPi, kPi), {9.81, 0.0});
}

Scene random_scene(RegraspFamily family, RandomStream& random) {
  Scene scene;
  scene.origin = "random pushes, feasible by construction";
  scene.object.shape = random_shape(family, random);
  scene.object.mass = random.log_in(0.05, 0.6);
  const double radius = random.in(0.005, 0.012);
  scene.gripper.pad = DiscPad{radius};
  if (family == RegraspFamily::kCylinder && random.chance(0.5)) {
    scene.gripper.pad = RectanglePad{{2.0 * radius, 2.0 * radius}};
  }
  const double friction = random.in(0.3, 1.0);
  scene.gripper.friction = {friction, friction};
  const double weight = 9.81 * scene.object.mass;
  scene.gripper.grip_force = random.log_in(1.5, 10.0) * weight / (2.0 * friction);
  if (random.chance(0.5)) scene.overhang = Overhang::kIgnore;
  const double pusher_friction = random.in(0.3, 1.0);
  for (const double angle : random_normals(scene.object.shape, random)) {
    scene.pushers.push_back({.name = "wall" + std::to_string(scene.pushers.size()),
                             .feature = LineFeature{},
                             .friction = pusher_friction,
                             .normal_angle = angle});
  }
  scene.g_W = random_gravity(scene, random);
  return scene;
}

bool held(const Model& model, const PushContact& contact, const Vec2& p_OF) {
  return holding_slack(model, p_OF, contact.g_O, Margin{}) > 0.0;
}

/// A place on the object that every contact leaves held.
bool find_start(const std::vector<Vec2>& outline, const Model& model,
                RandomStream& random, PlanarPose& start) {
  for (int i = 0; i < 200; ++i) {
    const Vec2 p_OF{random.in(-0.1, 0.1), random.in(-0.1, 0.1)};
    const bool good = depth_inside(outline, p_OF) > 2e-3 &&
                      std::all_of(model.contacts.begin(), model.contacts.end(),
                                  [&](const PushContact& contact) {
                                    return held(model, contact, p_OF);
                                  });
    start = pose_from_finger(p_OF, random.in(-kPi, kPi));
    if (good) return true;
  }
  return false;
}

/// The push sticks with the exact pads over the default margin, at points every 2 mm and
/// 0.1 rad, stays on the object, ends where gravity is held, and is certified.
bool sticks(const Model& model, const PlanarPose& X_HO, const LinearPush& push) {
  const PushContact& contact = model.contacts[push.contact];
  const Vec2 p_OF = finger_in_object(X_HO);
  if (!held(model, contact, p_OF) || !held(model, contact, p_OF - push.travel * push.e)) {
    return false;
  }
  const int parts =
      1 + static_cast<int>(std::max(push.travel / 2e-3, std::abs(push.turn) / 0.1));
  for (int i = 0; i <= parts; ++i) {
    const double s = static_cast<double>(i) / parts;
    const Vec2 p = p_OF - s * push.travel * push.e;
    if (depth_inside(model.outline, p) < 1e-3) return false;
    const PlanarPose pose = pose_from_finger(p, X_HO.theta + s * push.turn);
    const StickTest test = exact_stick_test(model, contact, push.place, pose, push.e,
                                            push.travel, push.turn, Margin{});
    if (!(test.slack >= 0.0)) return false;
  }
  const Transition done = apply(model, {X_HO, 0.0}, push);
  return done.completed() && done.slipped == 0.0;
}

std::optional<LinearPush> random_move(const Model& model, const PlanarPose& X_HO,
                                      int avoided, RandomStream& random) {
  for (int i = 0; i < kTriesPerMove; ++i) {
    LinearPush push;
    push.contact = random.below(static_cast<int>(model.contacts.size()));
    const PushContact& contact = model.contacts[push.contact];
    const double cone = std::atan(contact.mu);
    push.e = rotated(random.in(-cone, cone), contact.n);
    push.travel = random.in(kShortestMove, kLongestMove);
    const double kappa = std::tan(random.in(-1.5, 1.5));
    push.turn = kappa * push.travel / model.c;
    if (push.contact == avoided || std::abs(push.turn) > kLargestTurn) continue;
    if (sticks(model, X_HO, push)) return push;
  }
  return std::nullopt;
}

/// A roll by a random angle on a grip that the support makes unique, where it is
/// possible.
std::optional<Roll> random_roll(const Model& model, const Grasp& grasp,
                                RandomStream& random) {
  const double dpsi = random.in(-kPi, kPi);
  for (std::size_t i = 0; i < model.contacts.size(); ++i) {
    const RollSection section = roll_section(model, static_cast<int>(i), grasp);
    if (!section.possible || !(section.weight > 0.0)) continue;
    const auto& friction = model.scene.gripper.friction;
    const Roll roll{.contact = static_cast<int>(i),
                    .travel = dpsi / section.psi_per_travel,
                    .grip_force = 0.05 * section.weight / (friction[0] + friction[1])};
    if (apply(model, grasp, roll).completed()) return roll;
  }
  return std::nullopt;
}

/// Draws pushes from the start of the model's scene; false if too few were found.
bool draw_pushes(const Model& model, bool two_pushers, bool rolls, RandomStream& random,
                 RandomRegrasp& problem) {
  Grasp grasp = model.scene.start;
  const int wanted = (two_pushers ? 2 : 1) + random.below(kMostMoves - two_pushers);
  std::set<int> pushers;
  for (int i = 0; i < wanted; ++i) {
    const bool must_change = two_pushers && pushers.size() == 1 && i + 1 == wanted;
    const auto move =
        random_move(model, grasp.X_HO, must_change ? *pushers.begin() : -1, random);
    if (!move) return false;
    problem.pushes.push_back(*move);
    pushers.insert(model.contacts[move->contact].pusher);
    const Vec2 p_OF = finger_in_object(grasp.X_HO) - move->travel * move->e;
    grasp.X_HO = pose_from_finger(p_OF, grasp.X_HO.theta + move->turn);
  }
  if (rolls) {
    const auto roll = random_roll(model, grasp, random);
    if (!roll) return false;
    problem.pushes.push_back(*roll);
    grasp = apply(model, grasp, *roll).end;
  }
  problem.pushers = static_cast<int>(pushers.size());
  Goal& goal = problem.scene.goal.emplace();
  goal.x = grasp.X_HO.x;
  goal.y = grasp.X_HO.y;
  goal.theta = wrapped(grasp.X_HO.theta);
  if (rolls) goal.psi = wrapped(grasp.psi);
  return true;
}

}  // namespace

RandomRegrasp random_regrasp(RegraspFamily family, std::uint64_t seed,
                             std::uint64_t index) {
  RandomStream random(RandomStream(seed).bits() ^ (1000003 * index) ^
                      (static_cast<std::uint64_t>(family) << 56));
  const bool two_pushers = index % 2 == 0;
  const bool rolls = family == RegraspFamily::kCylinder && index % 3 != 0;
  for (;;) {
    RandomRegrasp problem;
    problem.scene = random_scene(family, random);
    problem.scene.name = "random regrasp " + std::to_string(index);
    PlanarPose& start = problem.scene.start.X_HO;
    if (!find_start(outline_of(problem.scene.object.shape), prepare(problem.scene),
                    random, start)) {
      continue;
    }
    if (!check(problem.scene).empty()) continue;
    const Model model = prepare(problem.scene);
    if (draw_pushes(model, two_pushers, rolls, random, problem)) return problem;
  }
}

}  // namespace prehensile
