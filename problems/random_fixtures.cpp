#include "problems/random_fixtures.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "mechanics/certificate.h"
#include "mechanics/model.h"
#include "problems/push_chain.h"
#include "problems/tee_prism.h"
#include "scene/constants.h"

namespace prehensile {
namespace {

constexpr int kScenes = 200;  // drawn before giving up
constexpr int kStarts = 30;   // drawn in one scene

double drawn(const Range& range, RandomStream& random) {
  return random.in(range[0], range[1]);
}

PrismShape random_tee(double size, RandomStream& random) {
  const double width = random.in(0.7, 1.0) * size;
  const double bar = random.in(0.25, 0.4) * size;
  const double stem = 0.5 * random.in(0.25, 0.45) * width;
  return tee_prism(size, width, bar, stem);
}

/// Ascending angles of corners around the middle, none next to each other.
std::vector<double> corner_angles(int corners, RandomStream& random) {
  const double step = 2.0 * kPi / corners;
  const double first = random.in(-kPi, kPi);
  std::vector<double> angles;
  angles.reserve(static_cast<std::size_t>(corners));
  for (int i = 0; i < corners; ++i) {
    angles.push_back(first + step * (i + random.in(-0.3, 0.3)));
  }
  return angles;
}

PrismShape random_convex(double size, RandomStream& random) {
  const double ratio = random.in(0.5, 1.0);
  PrismShape shape{{}, 0.03};
  for (const double angle : corner_angles(5 + random.below(4), random)) {
    shape.outline.emplace_back(0.5 * size * std::cos(angle),
                               0.5 * ratio * size * std::sin(angle));
  }
  return shape;
}

bool is_convex(const std::vector<Vec2>& outline) {
  const std::size_t n = outline.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 before = outline[(i + 1) % n] - outline[i];
    const Vec2 after = outline[(i + 2) % n] - outline[(i + 1) % n];
    if (before.x() * after.y() - before.y() * after.x() < 0.0) return false;
  }
  return true;
}

PrismShape random_concave(double size, RandomStream& random) {
  for (;;) {
    PrismShape shape{{}, 0.03};
    for (const double angle : corner_angles(6 + random.below(4), random)) {
      const double radius = 0.5 * size * random.in(0.4, 1.0);
      shape.outline.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    }
    if (!is_convex(shape.outline)) return shape;
  }
}

Shape random_shape(const FixtureRange& range, RandomStream& random) {
  const double size = drawn(range.size, random);
  switch (range.object) {
    case FixtureObject::kBox:
      return BoxShape{{size, drawn(range.size, random), 0.03}};
    case FixtureObject::kTee:
      return random_tee(size, random);
    case FixtureObject::kConvex:
      return random_convex(size, random);
    case FixtureObject::kConcave:
      break;
  }
  return random_concave(size, random);
}

/// Faces in random order: those on the hull first where lines push.
std::vector<int> faces_in_order(const std::vector<Face>& faces, bool hull_first,
                                RandomStream& random) {
  std::vector<int> order(faces.size());
  std::iota(order.begin(), order.end(), 0);
  for (int i = static_cast<int>(order.size()) - 1; i > 0; --i) {
    std::swap(order[i], order[random.below(i + 1)]);
  }
  if (hull_first) {
    std::stable_partition(order.begin(), order.end(),
                          [&](int face) { return faces[face].on_hull; });
  }
  return order;
}

void add_pushers(const FixtureRange& range, RandomStream& random, Scene& scene) {
  const std::vector<Face> faces = faces_of(scene.object.shape);
  const bool lines = range.pushers == FixturePushers::kLines;
  const std::vector<int> order = faces_in_order(faces, lines, random);
  const int least = static_cast<int>(range.count[0]);
  const int count = least + random.below(static_cast<int>(range.count[1]) - least + 1);
  for (int i = 0; i < count; ++i) {
    const Face& face = faces[order[static_cast<std::size_t>(i) % order.size()]];
    const bool is_line =
        lines && face.on_hull && static_cast<std::size_t>(i) < order.size();
    Pusher pusher;
    pusher.name = (is_line ? "wall" : "tip") + std::to_string(i);
    pusher.feature = PointFeature{};
    if (is_line) pusher.feature = LineFeature{};
    pusher.friction = drawn(range.pusher_friction, random);
    pusher.normal_angle = std::atan2(face.n.y(), face.n.x());
    pusher.faces = {face.name};
    scene.pushers.push_back(pusher);
  }
}

Scene random_scene(const FixtureRange& range, RandomStream& random) {
  Scene scene;
  scene.object.shape = random_shape(range, random);
  scene.object.mass = random.log_in(range.mass[0], range.mass[1]);
  const double pad = drawn(range.pad_size, random);
  if (range.pad == FixturePad::kDisc) {
    scene.gripper.pad = DiscPad{0.5 * pad};
  } else {
    Vec2 size{pad, pad * drawn(range.pad_aspect, random)};
    if (random.chance(0.5)) std::swap(size.x(), size.y());
    scene.gripper.pad = RectanglePad{size};
  }
  const double friction = drawn(range.finger_friction, random);
  scene.gripper.friction = {friction, friction};
  const double weight = 9.81 * scene.object.mass;
  const double strength = random.log_in(range.strength[0], range.strength[1]);
  scene.gripper.grip_force = strength * weight / (2.0 * friction);
  if (random.chance(0.5)) scene.overhang = Overhang::kIgnore;
  add_pushers(range, random, scene);
  scene.g_W = random.chance(range.weightless)
                  ? Vec2(Vec2::Zero())
                  : rotated(random.in(-kPi, kPi), {9.81, 0.0});
  Goal& goal = scene.goal.emplace();
  goal.position_tolerance = range.position_tolerance;
  goal.angle_tolerance = range.angle_tolerance;
  return scene;
}

/// By the pads as they lie there: `held_by_all` knows them whole only.
bool held_by_pads(const Model& model, const PlanarPose& X_HO) {
  return std::all_of(model.contacts.begin(), model.contacts.end(),
                     [&](const PushContact& contact) {
                       const PlanarGrasp grasp = grasp_at(model, X_HO, contact.g_O);
                       return grasp.count > 0 && gravity_slack(grasp) > 0.0;
                     });
}

/// A place for the pads that every contact leaves held, at any angle.
std::optional<PlanarPose> held_place(const Model& model, RandomStream& random) {
  const std::vector<Vec2>& face = model.pad_face;
  Vec2 low = face.front();
  Vec2 high = face.front();
  for (const Vec2& corner : face) {
    low = low.cwiseMin(corner);
    high = high.cwiseMax(corner);
  }
  for (int i = 0; i < 200; ++i) {
    const Vec2 p_OF{random.in(low.x(), high.x()), random.in(low.y(), high.y())};
    const double theta = random.in(-kPi, kPi);
    const PlanarPose X_HO = pose_from_finger(p_OF, theta);
    if (depth_inside(face, p_OF) > 2e-3 && held_by_all(model, p_OF) &&
        held_by_pads(model, X_HO)) {
      return X_HO;
    }
  }
  return std::nullopt;
}

/// A start for the scene that can be prepared with it.
bool put_start(Scene& scene, RandomStream& random) {
  // Where a scene's own start is not on the object, its middle may be.
  for (const PlanarPose& first : {scene.start.X_HO, PlanarPose{}}) {
    scene.start.X_HO = first;
    if (!check(scene).empty()) continue;
    const Model model = prepare(scene);
    if (model.contacts.empty()) return false;
    const auto place = held_place(model, random);
    if (!place) return false;
    scene.start = {*place, 0.0};
    return check(scene).empty();
  }
  return false;
}

/// A scene without a goal's coordinates gets start and goal.
std::optional<RandomRegrasp> with_regrasp(const Scene& scene, GoalsFrom goals,
                                          std::uint64_t index, RandomStream& random) {
  RandomRegrasp problem;
  problem.scene = scene;
  problem.scene.goal.reset();  // its tolerances come back with a pose
  if (!put_start(problem.scene, random)) return std::nullopt;
  const Model model = prepare(problem.scene);
  problem.scene.goal = scene.goal;
  if (goals == GoalsFrom::kPushes) {
    const bool two_pushers = index % 2 == 0 && model.scene.pushers.size() > 1;
    const ChainRange range{.least = two_pushers ? 2 : 1,
                           .two_pushers = two_pushers,
                           .rolls = can_roll(scene.object) && index % 3 != 0};
    if (!append_chain(model, range, random, problem)) return std::nullopt;
    return problem;
  }
  const auto place = held_place(model, random);
  if (!place) return std::nullopt;
  Goal& goal = *problem.scene.goal;
  goal.x = place->x;
  goal.y = place->y;
  goal.theta = place->theta;
  goal.psi.reset();
  if (can_roll(scene.object) && random.chance(0.5)) goal.psi = random.in(-kPi, kPi);
  return problem;
}

RandomStream stream_of(std::uint64_t seed, std::uint64_t index) {
  return RandomStream(RandomStream(seed).bits() ^ (1000003 * index));
}

}  // namespace

std::optional<RandomRegrasp> random_fixture(const FixtureRange& range, std::uint64_t seed,
                                            std::uint64_t index) {
  RandomStream random = stream_of(seed, index);
  for (int i = 0; i < kScenes; ++i) {
    const Scene scene = random_scene(range, random);
    auto problem = with_regrasp(scene, range.goals, index, random);
    if (!problem) continue;
    problem->scene.origin = range.goals == GoalsFrom::kPushes
                                ? "random pushes, feasible by construction"
                                : "random start and goal";
    return problem;
  }
  return std::nullopt;
}

std::optional<RandomRegrasp> random_regrasp_of(const Scene& scene, GoalsFrom goals,
                                               std::uint64_t seed, std::uint64_t index) {
  RandomStream random = stream_of(seed, index);
  Scene blank = scene;
  if (!blank.goal) blank.goal.emplace();
  for (int i = 0; i < kStarts; ++i) {
    if (auto problem = with_regrasp(blank, goals, index, random)) return problem;
  }
  return std::nullopt;
}

}  // namespace prehensile
