#include "problems/extreme_regrasps.h"

#include <cmath>
#include <sstream>

#include "mechanics/model.h"
#include "problems/random_fixtures.h"
#include "scene/constants.h"

namespace prehensile {
namespace {

constexpr double kDenormal = 1e-310;

std::string number(double x) {
  std::ostringstream text;
  text << x;
  return text.str();
}

bool has_gravity(const Scene& scene) { return scene.g_W.norm() > 0.0; }

Outlook falls_if_heavy(const Scene& scene) {
  return has_gravity(scene) ? Outlook::kHasNone : Outlook::kUnknown;
}

/// Weight that the fingers could carry at the centre of mass over the weight.
double strength(const Scene& scene) {
  const Gripper& hand = scene.gripper;
  return (hand.friction[0] + hand.friction[1]) * hand.grip_force /
         (scene.object.mass * scene.g_W.norm());
}

void set_pusher_friction(Scene& scene, double friction) {
  for (Pusher& pusher : scene.pushers) pusher.friction = friction;
}

/// Another friction of the fingers, and the grip that makes up for it.
void set_finger_friction(Scene& scene, double friction) {
  Gripper& hand = scene.gripper;
  hand.grip_force *= hand.friction[0] / friction;
  hand.friction = {friction, friction};
}

void scale_shape(Shape& shape, double factor) {
  if (auto* box = std::get_if<BoxShape>(&shape)) box->size *= factor;
  if (auto* prism = std::get_if<PrismShape>(&shape)) {
    for (Vec2& vertex : prism->outline) vertex *= factor;
    prism->thickness *= factor;
  }
}

/// All lengths; forces stay.
void scale_size(Scene& scene, double factor) {
  scale_shape(scene.object.shape, factor);
  scene.gripper.pad = resized(scene.gripper.pad, factor);
  for (Pusher& pusher : scene.pushers) pusher.p_WP *= factor;
  scene.start.X_HO.x *= factor;
  scene.start.X_HO.y *= factor;
  Goal& goal = *scene.goal;
  *goal.x *= factor;
  *goal.y *= factor;
  goal.position_tolerance *= factor;
  goal.characteristic_length *= factor;
}

/// The pushers again and again, up to a number of them.
void repeat_pushers(Scene& scene, std::size_t count) {
  const std::size_t own = scene.pushers.size();
  while (scene.pushers.size() < count) {
    Pusher pusher = scene.pushers[scene.pushers.size() % own];
    pusher.name = "pusher" + std::to_string(scene.pushers.size());
    scene.pushers.push_back(pusher);
  }
}

/// Points on one face after the other, up to a number of pushers.
void add_points(Scene& scene, std::size_t count) {
  const std::vector<Face> faces = faces_of(scene.object.shape);
  for (std::size_t i = 0; scene.pushers.size() < count; ++i) {
    const Face& face = faces[i % faces.size()];
    scene.pushers.push_back({.name = "point" + std::to_string(i),
                             .feature = PointFeature{},
                             .friction = 0.5,
                             .normal_angle = std::atan2(face.n.y(), face.n.x()),
                             .faces = {face.name}});
  }
}

/// Another object among four walls, to be moved from one place of the finger axis to
/// another; without gravity, which would have the last word on most of them.
Outlook set_object(Scene& scene, const Shape& shape, const Vec2& from, const Vec2& to) {
  scene.object.shape = shape;
  scene.object.p_OCom.reset();
  scene.g_W.setZero();
  const double friction = scene.pushers.front().friction;
  scene.pushers.clear();
  for (const double angle : {0.0, 0.5 * kPi, kPi, -0.5 * kPi}) {
    scene.pushers.push_back({.name = "wall" + std::to_string(scene.pushers.size()),
                             .feature = LineFeature{},
                             .friction = friction,
                             .normal_angle = angle});
  }
  scene.start = {pose_from_finger(from, 0.0), 0.0};
  const PlanarPose end = pose_from_finger(to, 0.3);
  scene.goal->x = end.x;
  scene.goal->y = end.y;
  scene.goal->theta = end.theta;
  return Outlook::kUnknown;
}

/// On a circle of 5 cm radius.
PrismShape round_prism(int vertices) {
  PrismShape shape{{}, 0.03};
  for (int i = 0; i < vertices; ++i) {
    shape.outline.push_back(rotated(2.0 * kPi * i / vertices, Vec2(0.05, 0.0)));
  }
  return shape;
}

/// A square of 10 cm with a notch that almost cuts it in two.
PrismShape notched_square(double left) {
  const double h = 0.05;
  return {{{-h, -h}, {h, -h}, {h, h}, {1e-4, h}, {0.0, left - h}, {-1e-4, h}, {-h, h}},
          0.03};
}

/// Whole pads, the centre of mass at the finger axis, and a grip of so much times what
/// holds the weight there.
void grip_with_strength(Scene& scene, double wanted) {
  scene.overhang = Overhang::kIgnore;
  scene.object.p_OCom = finger_in_object(scene.start.X_HO);
  if (has_gravity(scene)) scene.gripper.grip_force *= wanted / strength(scene);
}

void put_goal(Scene& scene, double dx, double dtheta) {
  Goal& goal = *scene.goal;
  goal.x = scene.start.X_HO.x + dx;
  goal.y = scene.start.X_HO.y;
  goal.theta = scene.start.X_HO.theta + dtheta;
}

void add_tolerances(std::vector<RegraspExtreme>& all) {
  for (const double tolerance : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6}) {
    all.push_back({"tolerance", "tolerance " + number(tolerance), [=](Scene& scene) {
                     scene.goal->position_tolerance = tolerance;
                     scene.goal->angle_tolerance = 20.0 * tolerance;
                     return Outlook::kHasPlan;
                   }});
  }
}

void add_frictions(std::vector<RegraspExtreme>& all) {
  for (const double friction : {0.0, 1e-6, 1e-2}) {
    all.push_back(
        {"friction", "pushers with friction " + number(friction), [=](Scene& scene) {
           set_pusher_friction(scene, friction);
           return Outlook::kUnknown;
         }});
  }
  all.push_back({"friction", "pushers without friction, no gravity", [](Scene& scene) {
                   set_pusher_friction(scene, 0.0);
                   scene.g_W.setZero();
                   return Outlook::kUnknown;
                 }});
  for (const double friction : {10.0, 1000.0}) {
    all.push_back(
        {"friction", "pushers with friction " + number(friction), [=](Scene& scene) {
           set_pusher_friction(scene, friction);
           return Outlook::kHasPlan;
         }});
  }
  for (const double friction : {1e-3, 10.0, 1000.0}) {
    all.push_back(
        {"friction", "fingers with friction " + number(friction), [=](Scene& scene) {
           set_finger_friction(scene, friction);
           return Outlook::kHasPlan;
         }});
  }
  all.push_back({"friction", "fingers without friction", [](Scene& scene) {
                   scene.gripper.friction = {0.0, 0.0};
                   return falls_if_heavy(scene);
                 }});
}

void add_forces(std::vector<RegraspExtreme>& all) {
  for (const double factor : {1e-4, 1e3}) {
    all.push_back({"force", "mass and grip times " + number(factor), [=](Scene& scene) {
                     scene.object.mass *= factor;
                     scene.gripper.grip_force *= factor;
                     return Outlook::kHasPlan;
                   }});
  }
  all.push_back({"force", "next to no mass", [](Scene& scene) {
                   scene.object.mass = 1e-9;
                   return Outlook::kUnknown;
                 }});
  all.push_back({"force", "mass times 100", [](Scene& scene) {
                   scene.object.mass *= 100.0;
                   return falls_if_heavy(scene);
                 }});
  all.push_back({"force", "grip times 1e6", [](Scene& scene) {
                   scene.gripper.grip_force *= 1e6;
                   return Outlook::kUnknown;
                 }});
  all.push_back({"force", "no grip", [](Scene& scene) {
                   scene.gripper.grip_force = 0.0;
                   return falls_if_heavy(scene);
                 }});
  for (const double beyond : {-1e-2, -1e-6, 1e-6, 1e-2}) {
    all.push_back(
        {"force", "holds 1 + " + number(beyond) + " times the weight", [=](Scene& scene) {
           grip_with_strength(scene, 1.0 + beyond);
           return beyond < 0.0 ? falls_if_heavy(scene) : Outlook::kUnknown;
         }});
  }
  for (const double gravity : {1e-9, kDenormal}) {
    all.push_back({"force", "gravity " + number(gravity), [=](Scene& scene) {
                     scene.g_W = {0.0, -gravity};
                     return Outlook::kUnknown;
                   }});
  }
}

void add_pushers(std::vector<RegraspExtreme>& all) {
  all.push_back({"pushers", "none", [](Scene& scene) {
                   scene.pushers.clear();
                   return Outlook::kHasNone;
                 }});
  all.push_back({"pushers", "one", [](Scene& scene) {
                   scene.pushers.resize(1);
                   return Outlook::kUnknown;
                 }});
  for (const std::size_t count : {20, 64}) {
    all.push_back({"pushers", std::to_string(count) + ", repeated", [=](Scene& scene) {
                     repeat_pushers(scene, count);
                     return Outlook::kHasPlan;
                   }});
  }
  for (const std::size_t count : {10, 20}) {
    all.push_back(
        {"pushers", std::to_string(count) + ", points added", [=](Scene& scene) {
           add_points(scene, count);
           return Outlook::kHasPlan;
         }});
  }
  all.push_back({"pushers", "1 micrometre long", [](Scene& scene) {
                   for (Pusher& pusher : scene.pushers) {
                     pusher.feature = LineFeature{.length = 1e-6};
                   }
                   return Outlook::kUnknown;
                 }});
}

void add_outlines(std::vector<RegraspExtreme>& all) {
  const auto add = [&all](const char* name, const Shape& shape, const Vec2& from,
                          const Vec2& to) {
    all.push_back({"outline", name,
                   [=](Scene& scene) { return set_object(scene, shape, from, to); }});
  };
  add("sliver of 1 mm", BoxShape{{0.15, 0.001, 0.03}}, {-0.05, 0.0}, {0.05, 0.0});
  add("sliver of 1 micrometre", BoxShape{{0.15, 1e-6, 0.03}}, {-0.05, 0.0}, {0.05, 0.0});
  add("needle", PrismShape{{{-0.07, -0.01}, {0.07, 0.0}, {-0.07, 0.01}}, 0.03},
      {-0.05, 0.0}, {0.06, 0.0});
  add("200 vertices", round_prism(200), {-0.02, 0.01}, {0.02, -0.01});
  add("two vertices 2 micrometres apart",
      PrismShape{
          {{-0.05, -0.05}, {0.05, -0.05}, {0.05, 0.05}, {0.049998, 0.05}, {-0.05, 0.05}},
          0.03},
      {-0.03, 0.01}, {0.03, -0.01});
  add("almost cut in two", notched_square(1e-4), {-0.03, 0.01}, {0.03, -0.01});
  add("10 m", BoxShape{{10.0, 10.0, 0.03}}, {-4.0, 1.0}, {4.0, -1.0});
}

void add_pads(std::vector<RegraspExtreme>& all) {
  for (const double radius : {1e-6, 1e-4, 0.05, 1.0}) {
    all.push_back({"pads", "discs of radius " + number(radius), [=](Scene& scene) {
                     scene.gripper.pad = DiscPad{radius};
                     scene.g_W.setZero();
                     return Outlook::kUnknown;
                   }});
  }
  for (const double ratio : {1e-2, 1e-4}) {
    all.push_back({"pads", "sides 1 to " + number(ratio), [=](Scene& scene) {
                     scene.gripper.pad = RectanglePad{{0.02, 0.02 * ratio}};
                     scene.g_W.setZero();
                     return Outlook::kUnknown;
                   }});
  }
}

void add_sizes(std::vector<RegraspExtreme>& all) {
  for (const double factor : {1e-3, 1e-2, 10.0}) {
    all.push_back({"size", "size times " + number(factor), [=](Scene& scene) {
                     scale_size(scene, factor);
                     return Outlook::kHasPlan;
                   }});
  }
}

void add_goals(std::vector<RegraspExtreme>& all) {
  all.push_back({"goal", "the start", [](Scene& scene) {
                   put_goal(scene, 0.0, 0.0);
                   return Outlook::kIsThere;
                 }});
  for (const double beyond : {-1e-6, 1e-6}) {
    all.push_back(
        {"goal", "1 + " + number(beyond) + " tolerances off", [=](Scene& scene) {
           const double tolerance = scene.goal->position_tolerance;
           put_goal(scene, (1.0 + beyond) * tolerance, 0.0);
           return beyond < 0.0 ? Outlook::kIsThere : Outlook::kUnknown;
         }});
  }
  all.push_back({"goal", "1 m away", [](Scene& scene) {
                   put_goal(scene, 1.0, 0.0);
                   return Outlook::kHasNone;
                 }});
  for (const double turns : {3.0, 12.0}) {
    all.push_back({"goal", number(turns) + " turns off", [=](Scene& scene) {
                     *scene.goal->theta += 2.0 * kPi * turns;
                     return Outlook::kHasPlan;
                   }});
    all.push_back({"goal", number(turns) + " turns to be made", [=](Scene& scene) {
                     *scene.goal->theta += 2.0 * kPi * turns;
                     scene.goal->theta_is = ThetaMeaning::kNumber;
                     return Outlook::kUnknown;
                   }});
  }
  all.push_back({"goal", "half a turn off", [](Scene& scene) {
                   put_goal(scene, 0.0, kPi);
                   return Outlook::kUnknown;
                 }});
}

/// Pushes by walls among four kinds of objects, and by points.
Scene made_by_pushes(std::uint64_t seed, std::uint64_t index) {
  constexpr std::uint64_t kKinds = 5;
  FixtureRange range;
  switch (index % kKinds) {
    case 0:
      return random_regrasp(RegraspFamily::kBox, seed, index).scene;
    case 1:
      return random_regrasp(RegraspFamily::kTee, seed, index).scene;
    case 2:
      range.object = FixtureObject::kConvex;
      break;
    case 3:
      range.object = FixtureObject::kConcave;
      break;
    default:
      range.pushers = FixturePushers::kPoints;
  }
  return random_fixture(range, seed, index).value().scene;
}

}  // namespace

std::vector<RegraspExtreme> regrasp_extremes() {
  std::vector<RegraspExtreme> all;
  add_tolerances(all);
  add_frictions(all);
  add_forces(all);
  add_pushers(all);
  add_outlines(all);
  add_pads(all);
  add_sizes(all);
  add_goals(all);
  return all;
}

ExtremeRegrasp extreme_regrasp(const RegraspExtreme& extreme, std::uint64_t seed,
                               std::uint64_t index) {
  ExtremeRegrasp problem{.scene = made_by_pushes(seed, index)};
  problem.outlook = extreme.apply(problem.scene);
  problem.scene.name = extreme.name + ", " + std::to_string(index);
  return problem;
}

}  // namespace prehensile
