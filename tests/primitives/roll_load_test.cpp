/// Loads of rolls against the instants of the mechanics and, as a second way that knows
/// none of them, against the balance of forces and moments on the object.
#include "primitives/roll_load.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "primitives/prism_attitudes.h"
#include "scene/constants.h"
#include "tests/support/random.h"
#include "tests/support/sections.h"

namespace prehensile {
namespace {

using testing::Random;

constexpr std::array kJawModes = {JawMode::kCoupled, JawMode::kFixedJaw1,
                                  JawMode::kFixedJaw2};

/// On a sheet that supports one of its long sides, held so that fingers cannot carry it.
Scene lying(Random& random, const Shape& shape, Axis axis) {
  Scene scene;
  scene.object.shape = shape;
  scene.object.mass = random.in(0.1, 0.5);
  scene.gripper.pad = RectanglePad{{0.03, 0.03}};
  scene.gripper.jaw_mode = kJawModes[random.below(3)];
  const double side = random.chance(0.5) ? 1.0 : -1.0;
  const Vec2 n = side * (axis == Axis::kX ? Vec2(0.0, 1.0) : Vec2(1.0, 0.0));
  Pusher sheet;
  sheet.name = "sheet";
  sheet.feature = LineFeature{};
  sheet.friction = random.in(0.6, 1.5);
  sheet.normal_angle = std::atan2(n.y(), n.x());
  scene.pushers = {sheet};
  scene.g_W = -9.81 * n;
  return scene;
}

Scene lying_cylinder(Random& random) {
  const Axis axis = random.chance(0.5) ? Axis::kX : Axis::kY;
  Scene scene = lying(random, CylinderShape{random.in(0.01, 0.04), 0.12, axis}, axis);
  scene.gripper.friction = {random.in(0.1, 0.5), random.in(0.1, 0.5)};
  scene.gripper.grip_force = random.in(0.1, 2.0);
  return scene;
}

/// On the object: along u and z of the section, by CrossSectionContact.
struct Balance {
  std::array<double, 3> u, z;
};

/// Of a cylinder whose support moves towards +z: both jaws rub against its turn with all
/// of their friction, their moment is the support's, the jaws differ by its pull, and
/// what they lift is missing on it. A support that moves the other way is its image, with
/// the jaws exchanged.
Balance balanced(const Scene& scene, double travel) {
  const Gripper& gripper = scene.gripper;
  const bool swap = travel < 0.0;
  const double mu_up = gripper.friction[swap ? 1 : 0];
  const double mu_down = gripper.friction[swap ? 0 : 1];
  const double grip = gripper.grip_force;
  const bool up_is_fixed =
      gripper.jaw_mode == (swap ? JawMode::kFixedJaw2 : JawMode::kFixedJaw1);
  double up_share = 0.5;  // of the pull that the upstream jaw loses; the rest loads
  if (gripper.jaw_mode != JawMode::kCoupled) up_share = up_is_fixed ? 1.0 : 0.0;
  // pull = mu_up (grip - up_share pull) + mu_down (grip + (1 - up_share) pull)
  const double pull =
      (mu_up + mu_down) * grip / (1.0 + up_share * mu_up - (1.0 - up_share) * mu_down);
  const double up = grip - up_share * pull;
  const double down = up + pull;
  Balance out;
  const int up_jaw = swap ? kJaw2 : kJaw1, down_jaw = swap ? kJaw1 : kJaw2;
  const double way = swap ? -1.0 : 1.0;
  out.u[up_jaw] = mu_up * up;
  out.u[down_jaw] = -mu_down * down;
  out.u[kSheet] = scene.object.mass * scene.g_W.norm() - out.u[kJaw1] - out.u[kJaw2];
  out.z[up_jaw] = way * up;
  out.z[down_jaw] = -way * down;
  out.z[kSheet] = way * pull;
  return out;
}

TEST(RollLoad, OfCylindersBalances) {
  Random random(3);
  int rolled = 0;
  for (int i = 0; i < 1000; ++i) {
    const Scene scene = lying_cylinder(random);
    const Model model = prepare(scene);
    const Roll roll{0, random.in(-0.05, 0.05)};
    std::vector<Sample> trace;
    if (!apply(model, scene.start, roll, {}, &trace).completed()) continue;
    ++rolled;
    const std::vector<RollLoad> loads = roll_loads(model, scene.start, roll);
    ASSERT_EQ(loads.size(), trace.size());
    const Balance expected = balanced(scene, roll.travel);
    for (std::size_t k = 0; k < loads.size(); ++k) {
      EXPECT_EQ(loads[k].s, trace[k].s);
      EXPECT_EQ(loads[k].normal_force, trace[k].normal_force);
      EXPECT_EQ(loads[k].tangential_force, trace[k].tangential_force);
      EXPECT_NEAR(loads[k].normal_force, expected.u[kSheet], 1e-8) << i;
      EXPECT_NEAR(loads[k].tangential_force, expected.z[kSheet], 1e-8) << i;
      EXPECT_EQ(loads[k].z_foot, 0.0);
    }
  }
  EXPECT_GT(rolled, 300);
}

/// A bar of some sides between low pads of little friction, which rolls over its edges.
Scene lying_bar(Random& random) {
  const Axis axis = random.chance(0.5) ? Axis::kX : Axis::kY;
  const double inner = random.in(0.01, 0.02);
  const auto section = testing::regular_section(3 + random.below(10), inner);
  Scene scene = lying(random, PrismShape{section, 0.1, axis}, axis);
  scene.gripper.pad = RectanglePad{{0.002, 0.002}};
  scene.gripper.friction = {random.in(0.02, 0.1), random.in(0.02, 0.1)};
  scene.gripper.grip_force = random.in(0.1, 2.0);
  const Vec2 up = -random.in(-0.1, 0.6) * inner * scene.g_W.normalized();
  scene.start.X_HO.x = -up.x();
  scene.start.X_HO.y = -up.y();
  return scene;
}

/// Support, jaws and weight about the origin of O, in units of the forces and the
/// section.
void expect_balance(const Model& model, const PrismRoll& prism, const RollLoad& load) {
  const double phi = prism.attitude(load.grasp.psi);
  const PrismLook look = prism.look(phi);
  const SectionForces& forces = look.instant.forces;
  Vec2 sum(load.tangential_force, load.normal_force);
  double moment =
      cross(Vec2(load.z_foot - load.z_HO, support_height(prism.polygon(), phi)), sum);
  for (const int jaw : {kJaw1, kJaw2}) {
    const Vec2& n = forces.direction[jaw];
    const Vec2 t = jaw == kJaw1 ? perp(n) : Vec2(-perp(n));
    const Vec2 force = forces.normal[jaw] * n + forces.tangential[jaw] * t;
    sum += force;
    moment += cross(forces.point[jaw], force);
  }
  const Vec2 weight(0.0, -model.mass * model.scene.g_W.norm());
  const Vec2 com = rotated(phi, prism.polygon().com);
  const double unit = load.normal_force + std::abs(weight.y());
  EXPECT_NEAR((sum + weight).norm(), 0.0, 1e-7 * unit);
  EXPECT_NEAR(moment + cross(com, weight), 0.0, 1e-7 * unit * prism.polygon().size);
}

/// Between two flats the foot is an edge that sticks to the support: in the hand it goes
/// as far as the support does.
TEST(RollLoad, OfPrismsBalancesOverAnEdgeThatSticks) {
  Random random(5);
  int rolled = 0, followed = 0;
  for (int i = 0; i < 400; ++i) {
    const Scene scene = lying_bar(random);
    if (!check(scene).empty()) continue;
    const Model model = prepare(scene);
    const Roll roll{0, random.in(-0.04, 0.04)};
    if (!apply(model, scene.start, roll).completed()) continue;
    ++rolled;
    const PrismRoll prism(model, scene.start, roll);
    const std::vector<RollLoad> loads = roll_loads(model, scene.start, roll);
    EXPECT_EQ(loads.front().z_HO, 0.0);
    for (std::size_t k = 0; k < loads.size(); ++k) {
      expect_balance(model, prism, loads[k]);
      if (k == 0) continue;
      const auto foot = [&](const RollLoad& load) {
        return prism.contacts(prism.attitude(load.grasp.psi)).touch[kSheet];
      };
      const SectionTouch a = foot(loads[k - 1]), b = foot(loads[k]);
      if (a.count != 1 || b.count != 1 || a.vertex[0] != b.vertex[0]) continue;
      ++followed;
      EXPECT_NEAR(loads[k].z_foot - loads[k - 1].z_foot,
                  roll.travel * (loads[k].s - loads[k - 1].s), 1e-9);
    }
  }
  EXPECT_GT(rolled, 30);
  EXPECT_GT(followed, 500);
}

/// Held anywhere along its length, with the mass off its middle.
Scene held_beside(Random& random) {
  Scene scene = lying_cylinder(random);
  const Vec2 along = perp(scene.g_W.normalized());
  const Vec2 finger = random.in(-0.045, 0.045) * along;
  scene.start.X_HO.x = -finger.x();
  scene.start.X_HO.y = -finger.y();
  scene.object.p_OCom = random.in(-0.02, 0.02) * along;
  return scene;
}

/// Where the jaws have to press so that nothing tilts or yaws while the support presses
/// here, all along t from the finger axis [m]; jaws of different friction.
Vec2 jaw_places(const Balance& forces, double support, double weight, double com) {
  const Eigen::Matrix2d A{{forces.u[kJaw1], forces.u[kJaw2]},
                          {forces.z[kJaw1], forces.z[kJaw2]}};
  return A.inverse() *
         Vec2(weight * com - forces.u[kSheet] * support, -forces.z[kSheet] * support);
}

/// The pads can balance the moments across the axis, and could for no place nearer to the
/// middle.
TEST(RollLoad, PressesAsNearToTheMiddleAsThePadsCanBalance) {
  Random random(6);
  int middle = 0, beside = 0;
  for (int i = 0; i < 6000; ++i) {
    const Scene scene = held_beside(random);
    const Model model = prepare(scene);
    const Roll roll{0, random.chance(0.5) ? 0.02 : -0.02};
    const std::vector<RollLoad> loads = roll_loads(model, scene.start, roll);
    if (loads.empty()) continue;
    const Balance forces = balanced(scene, roll.travel);
    const PushContact& contact = model.contacts[0];
    const double finger = contact.t.dot(finger_in_object(scene.start.X_HO));
    const double com = contact.t.dot(model.p_OCom) - finger;
    const ContactPoints pads = model.region.at(scene.start.X_HO);
    double half = 0.0;
    for (int j = 0; j < pads.count; ++j) {
      half = std::max(half, std::abs(contact.t.dot(Vec2(pads.x[j], pads.y[j]))));
    }
    const auto excess = [&](double place) {
      const double weight = model.mass * scene.g_W.norm();
      return jaw_places(forces, place, weight, com).cwiseAbs().maxCoeff() - half;
    };
    const double place = loads[0].along;
    EXPECT_LT(excess(place), 1e-6) << i;
    if (std::abs(place + finger) < 1e-9) {
      ++middle;
    } else {
      ++beside;
      EXPECT_GT(excess(place - std::copysign(1e-5, place + finger)), 0.0) << i;
    }
  }
  EXPECT_GT(middle, 100);
  EXPECT_GT(beside, 100);
}

/// Jaws of one friction yield along and across in proportion, so that they can balance
/// the support under the mass only.
TEST(RollLoad, PressesUnderTheMassWhereJawsAreAlike) {
  Random random(8);
  int rolled = 0;
  for (int i = 0; i < 1000; ++i) {
    Scene scene = held_beside(random);
    scene.gripper.friction[1] = scene.gripper.friction[0];
    const Model model = prepare(scene);
    const std::vector<RollLoad> loads = roll_loads(model, scene.start, Roll{0, 0.02});
    if (loads.empty()) continue;
    ++rolled;
    const Vec2 from_finger = model.p_OCom - finger_in_object(scene.start.X_HO);
    EXPECT_NEAR(loads[0].along, model.contacts[0].t.dot(from_finger), 1e-9) << i;
  }
  EXPECT_GT(rolled, 100);
}

TEST(RollLoad, IsLinearInBetween) {
  Random random(7);
  const RollLoad a{.s = 0.2, .normal_force = 1.0, .tangential_force = 4.0};
  const RollLoad b{.s = 0.6, .normal_force = 3.0, .tangential_force = 2.0, .z_foot = 1.0};
  EXPECT_EQ(roll_load_at({a, b}, 0.1).normal_force, 1.0);
  EXPECT_EQ(roll_load_at({a, b}, 0.9).normal_force, 3.0);
  for (int i = 0; i < 100; ++i) {
    const double share = random.in(0.0, 1.0);
    const RollLoad at = roll_load_at({a, b}, std::lerp(0.2, 0.6, share));
    EXPECT_NEAR(at.normal_force, 1.0 + 2.0 * share, 1e-12);
    EXPECT_NEAR(at.tangential_force, 4.0 - 2.0 * share, 1e-12);
    EXPECT_NEAR(at.z_foot, share, 1e-12);
  }
}

TEST(RollLoad, OfARefusedRollIsNone) {
  Random random(9);
  Scene scene = lying_cylinder(random);
  EXPECT_TRUE(roll_loads(prepare(scene), scene.start, Roll{0, 0.0}).empty());
}

}  // namespace
}  // namespace prehensile
