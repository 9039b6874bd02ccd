#include "problems/published_regrasps.h"

#include <array>
#include <numbers>

#include "mechanics/sticking.h"
#include "problems/random_stream.h"

namespace prehensile {
namespace {

/// (x, y) of the finger axis in the object [m] and angle of the finger in the object
/// [rad].
struct FingerInObject {
  double x, y, angle;
};

struct Pair {
  FingerInObject start, goal;
};

// clang-format off
constexpr std::array<Pair, kPublishedRegrasps> kPairs = {{
    {{0.00354, -0.0008, 0.11399}, {-0.03332, 0.01118, -0.03042}},
    {{0.00606, -0.00065, -0.0488}, {-0.04347, 0.01851, 0.15712}},
    {{0.02478, 0.00069, -0.0654}, {-0.04244, 0.01289, 0.03485}},
    {{0.00379, 0.00448, 0.16064}, {-0.03326, -0.00674, 0.1513}},
    {{0.01961, -0.0013, -0.18161}, {-0.02505, -0.00619, -0.11622}},
    {{0.00151, 0.00329, -0.09482}, {-0.0409, -0.02405, -0.11008}},
    {{0.02546, -0.00158, 0.1766}, {-0.0367, 0.01827, -0.1416}},
    {{0.00847, -0.00249, -0.02729}, {-0.04464, -0.02754, -0.04877}},
    {{0.01244, 0.00186, -0.12144}, {-0.03863, 0.0118, 0.17052}},
    {{0.00684, 0.00171, 0.11424}, {-0.03181, 0.00709, -0.04567}},
    {{0.01264, 0.00321, 0.13303}, {-0.04148, -0.03607, 0.07997}},
    {{0.02805, 0.00338, -0.03483}, {-0.0259, -0.0194, -0.11542}},
    {{0.01162, -0.00246, 0.07126}, {-0.03728, -0.00701, 0.13324}},
    {{0.0239, 0.00125, -0.00406}, {-0.03776, -0.00651, 0.15553}},
    {{0.00594, 0.00355, -0.09147}, {-0.03617, -0.0121, -0.15577}},
    {{0.02443, 0.00239, -0.08872}, {-0.04234, -0.0345, 0.00217}},
    {{0.01364, 0.00057, 0.19039}, {-0.04083, 0.00033, -0.05466}},
    {{0.01593, -0.00153, 0.01263}, {-0.02703, -0.00179, 0.18279}},
    {{0.01726, -0.00386, -0.01164}, {-0.03796, 0.00473, -0.19468}},
    {{0.00961, 0.00033, 0.096}, {-0.04109, 0.01326, -0.16709}},
    {{0.00689, -0.00349, 0.06641}, {-0.02825, -0.02224, -0.06868}},
    {{0.00302, 0.00041, 0.09105}, {-0.02978, -0.00407, -0.07388}},
    {{0.02906, -0.00353, -0.13124}, {-0.02902, -0.03407, 0.07988}},
    {{0.00662, -0.00337, 0.07091}, {-0.04129, -0.00637, 0.03386}},
    {{0.01896, 0.00399, 0.15468}, {-0.03761, -0.01255, -0.07041}},
    {{0.00085, 0.00483, -0.13319}, {-0.0337, 0.0075, -0.02988}},
    {{0.02746, -0.00107, -0.09438}, {-0.03167, -0.02144, 0.04706}},
    {{0.00228, -0.00216, -0.0562}, {-0.0361, 0.01884, -0.03425}},
    {{0.0092, 0.00173, -0.11274}, {-0.03606, -0.02333, -0.01575}},
    {{0.02319, 0.0009, 0.16951}, {-0.03272, -0.03077, 0.05443}},
    {{0.00488, 0.00394, 0.03542}, {-0.03418, -0.03493, 0.06308}},
    {{0.02078, -0.00064, 0.09078}, {-0.02801, 0.00357, 0.17574}},
    {{0.02666, 0.00409, 0.10552}, {-0.03454, -0.02937, -0.19144}},
    {{0.00157, -0.00029, 0.17742}, {-0.03129, -0.0217, 0.1663}},
    {{0.02217, 0.00492, -0.16549}, {-0.0266, 0.01329, 0.00381}},
    {{0.0245, 0.00354, 0.13937}, {-0.04393, -0.02241, 0.1885}},
    {{0.02305, -0.00178, 0.10812}, {-0.043, -0.03872, -0.10533}},
    {{0.00179, -0.00017, -0.09109}, {-0.04465, 0.00658, -0.01679}},
    {{0.00392, -0.00019, 0.08978}, {-0.03289, -0.01561, -0.15437}},
    {{0.01663, 0.00456, 0.03424}, {-0.0352, -0.00138, 0.05833}},
    {{0.00509, 0.00437, 0.19753}, {-0.03926, -0.01497, -0.11047}},
    {{0.00721, 1e-05, -0.06897}, {-0.02528, 0.01093, 0.00729}},
    {{0.0178, 0.00241, -0.05721}, {-0.03821, 0.00775, -0.09793}},
    {{0.00848, -0.0023, 0.17304}, {-0.04463, 0.01025, 0.09563}},
    {{0.00125, 0.0036, 0.14931}, {-0.03431, -0.01447, -0.04605}},
    {{0.02573, 0.00135, -0.13135}, {-0.03186, 0.00935, -0.07825}},
    {{0.02229, -0.00346, -0.01084}, {-0.04074, -0.02591, -0.06682}},
    {{0.00553, 0.00426, -0.01992}, {-0.02974, 0.01818, -0.04273}},
    {{0.01794, -0.00391, 0.18582}, {-0.03152, 0.01464, 0.16446}},
    {{0.02786, 0.0044, -0.15228}, {-0.03949, -0.02094, 0.0482}},
}};
// clang-format on

/// The pose of the object in the hand is the inverse of the finger's in the object.
PlanarPose pose_of(const FingerInObject& finger) {
  return pose_from_finger({finger.x, finger.y}, -finger.angle);
}

Scene among_walls(const Shape& shape, const std::string& name, std::uint64_t index,
                  const Pair& pair) {
  Scene scene;
  scene.name = name + " " + std::to_string(index + 1);
  scene.origin = "ranges of Perugini et al. (RA-L 2025)";
  scene.object.shape = shape;
  scene.object.mass = 0.5;
  scene.gripper.pad = DiscPad{0.009};
  scene.gripper.friction = {0.9, 0.9};
  scene.gripper.grip_force = 25.0;
  scene.overhang = Overhang::kIgnore;
  scene.start.X_HO = pose_of(pair.start);
  const PlanarPose X_HO = pose_of(pair.goal);
  scene.goal = Goal{.x = X_HO.x,
                    .y = X_HO.y,
                    .theta = X_HO.theta,
                    .position_tolerance = 1e-3,
                    .characteristic_length = 0.01,
                    .test = GoalTest::kWeightedSum};
  struct Wall {
    const char* name;
    double normal_angle;
  };
  for (const Wall& wall : {Wall{"wall", 0.0}, Wall{"floor", 0.5 * std::numbers::pi},
                           Wall{"ceiling", -0.5 * std::numbers::pi}}) {
    scene.pushers.push_back({.name = wall.name,
                             .feature = LineFeature{},
                             .friction = 0.9,
                             .normal_angle = wall.normal_angle});
  }
  return scene;
}

Shape square() { return BoxShape{{0.1, 0.1, 0.03}}; }

Shape tee() {
  return PrismShape{{{-0.05, -0.05},
                     {-0.02, -0.05},
                     {-0.02, -0.015},
                     {0.05, -0.015},
                     {0.05, 0.015},
                     {-0.02, 0.015},
                     {-0.02, 0.05},
                     {-0.05, 0.05}},
                    0.03};
}

/// A place on the object where the pads hold gravity, at any angle.
FingerInObject anywhere(const Model& model, RandomStream& random) {
  constexpr double kHalf = 0.05;
  for (;;) {
    const FingerInObject finger{random.in(-kHalf, kHalf), random.in(-kHalf, kHalf),
                                random.in(-std::numbers::pi, std::numbers::pi)};
    const Vec2 p_OF(finger.x, finger.y);
    if (depth_inside(model.outline, p_OF) <= 0.0) continue;
    const Vec2& g_O = model.contacts.front().g_O;
    if (holding_slack(model, p_OF, g_O, Margin{}) > 0.0) return finger;
  }
}

Pair published_pair(RandomStream& random) {
  constexpr double kAngle = 0.2;
  return {
      {random.in(0.0, 0.03), random.in(-0.005, 0.005), random.in(-kAngle, kAngle)},
      {random.in(-0.045, -0.025), random.in(-0.04, 0.02), random.in(-kAngle, kAngle)}};
}

}  // namespace

Scene published_square(int index) {
  return among_walls(square(), "published square", index, kPairs.at(index));
}

Scene published_tee(int index) {
  return among_walls(tee(), "published T", index, kPairs.at(index));
}

Scene with_soft_points(Scene scene) {
  if (const auto* disc = std::get_if<DiscPad>(&scene.gripper.pad)) {
    scene.gripper.pad = PointPad{.spin_radius = 2.0 / 3.0 * disc->radius};
  }
  return scene;
}

Scene random_among_walls(bool is_square, RegraspRange range, bool gravity,
                         std::uint64_t seed, std::uint64_t index) {
  RandomStream random(RandomStream(seed).bits() ^ (1000003 * index));
  const Shape shape = is_square ? square() : tee();
  const std::string name = is_square ? "square" : "T";
  const auto scene_of = [&](const Pair& pair) {
    Scene scene = among_walls(shape, name, index, pair);
    if (!gravity) scene.g_W = Vec2::Zero();
    return scene;
  };
  if (range == RegraspRange::kPublished) return scene_of(published_pair(random));
  const Model model = prepare(scene_of(kPairs[0]));
  const FingerInObject start = anywhere(model, random);
  return scene_of({start, anywhere(model, random)});
}

}  // namespace prehensile
