/// Scenes and random pushes for the tests of the transition function.
#pragma once

#include <cstdint>
#include <numbers>

#include "primitives/transition.h"

namespace prehensile::testing {

/// SplitMix64 (Steele, Lea, Flood 2014) with our own mapping to [low, high).
class Stream {
 public:
  explicit Stream(std::uint64_t seed) : state_(seed) {}
  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(next() >> 11) * 0x1p-53;
  }
  int below(int count) { return static_cast<int>(next() % static_cast<unsigned>(count)); }

 private:
  std::uint64_t next() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15ULL);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31);
  }
  std::uint64_t state_;
};

/// A square of 100 mm pushed at its face -x: contact 0 by a wall, contact 1 by a point;
/// contact 2 is a wall at -y.
inline Scene square_scene() {
  Scene scene;
  scene.object.shape = BoxShape{{0.1, 0.1, 0.03}};
  scene.object.mass = 0.5;
  scene.gripper.pad = DiscPad{0.009};
  scene.gripper.friction = {0.5, 0.5};
  scene.gripper.grip_force = 40.0;
  scene.overhang = Overhang::kIgnore;
  scene.pushers.resize(3);
  scene.pushers[0] = {.name = "wall", .feature = LineFeature{}, .friction = 0.5};
  scene.pushers[1] = {.name = "pin", .feature = PointFeature{}, .friction = 0.5};
  scene.pushers[2] = {.name = "floor", .feature = LineFeature{}, .friction = 0.5};
  scene.pushers[2].normal_angle = 0.5 * std::numbers::pi;
  return scene;
}

struct PushCase {
  Scene scene;
  Grasp start;
  LinearPush push;
};

/// A box in any attitude to gravity, held off its centre and pushed at one face by a
/// point, a short line or a wall, within 60 degrees of the normal.
inline PushCase random_case(std::uint64_t seed) {
  Stream stream(seed);
  PushCase c;
  const Vec2 half(stream.uniform(0.02, 0.06), stream.uniform(0.02, 0.06));
  c.scene.object.shape = BoxShape{{2.0 * half.x(), 2.0 * half.y(), 0.02}};
  c.scene.object.mass = stream.uniform(0.05, 0.5);
  const double radius = stream.uniform(0.004, 0.012);
  if (stream.below(2) == 0) {
    c.scene.gripper.pad = DiscPad{radius};
  } else {
    c.scene.gripper.pad = RectanglePad{{radius, 2.0 * radius}};
  }
  c.scene.gripper.friction = {stream.uniform(0.3, 0.9), stream.uniform(0.3, 0.9)};
  c.scene.gripper.grip_force = stream.uniform(10.0, 60.0);
  c.scene.overhang = stream.below(2) == 0 ? Overhang::kIgnore : Overhang::kClip;
  c.scene.g_W = rotated(stream.uniform(-3.2, 3.2), Vec2(9.81, 0.0));
  Pusher pusher;
  pusher.name = "pusher";
  const int kind = stream.below(3);
  if (kind == 0) pusher.feature = PointFeature{};
  if (kind == 1) pusher.feature = LineFeature{};
  if (kind == 2) pusher.feature = LineFeature{stream.uniform(0.01, 0.05)};
  pusher.friction = stream.uniform(0.1, 0.9);
  pusher.normal_angle = 0.5 * std::numbers::pi * stream.below(4);
  c.scene.pushers = {pusher};
  c.push.place = stream.uniform(-0.5, 0.5) * half.minCoeff();
  c.push.e = rotated(pusher.normal_angle + stream.uniform(-1.0, 1.0), Vec2(1.0, 0.0));
  c.push.travel = stream.uniform(0.002, 0.03);
  c.push.turn = stream.below(2) == 0 ? 0.0 : stream.uniform(-0.5, 0.5);
  const Vec2 p_OF(stream.uniform(-0.5, 0.5) * half.x(),
                  stream.uniform(-0.5, 0.5) * half.y());
  c.start.X_HO = pose_from_finger(p_OF, stream.uniform(-3.0, 3.0));
  c.scene.start = c.start;
  return c;
}

}  // namespace prehensile::testing
