#include "problems/random_pushes.h"

#include <cmath>

#include "problems/random_stream.h"
#include "scene/constants.h"

namespace prehensile {
namespace {

constexpr double kGravity = 9.81;

Pad draw_pad(RandomStream& stream) {
  const double size = stream.in(0.004, 0.012);
  if (stream.chance(0.5)) return DiscPad{size};
  return RectanglePad{{size, stream.in(0.004, 0.012)}};
}

PusherFeature draw_feature(RandomStream& stream) {
  switch (stream.below(3)) {
    case 0:
      return PointFeature{};
    case 1:
      return LineFeature{};
    default:
      return LineFeature{stream.in(0.01, 0.05)};
  }
}

}  // namespace

RandomPush random_push(std::uint64_t seed, std::uint64_t index) {
  RandomStream stream(RandomStream(seed).bits() ^ index);
  RandomPush drawn;
  Scene& scene = drawn.scene;
  const Vec2 half(stream.in(0.02, 0.06), stream.in(0.02, 0.06));
  scene.object.shape = BoxShape{{2.0 * half.x(), 2.0 * half.y(), 0.02}};
  scene.object.mass = stream.in(0.05, 0.5);
  scene.gripper.pad = draw_pad(stream);
  // Fingers alike leave the push in the pad plane.
  const double mu_1 = stream.in(0.3, 0.9);
  const double mu_2 = stream.in(0.3, 0.9);
  scene.gripper.friction.fill(0.5 * (mu_1 + mu_2));
  scene.gripper.grip_force = stream.in(10.0, 60.0);
  scene.overhang = stream.chance(0.5) ? Overhang::kIgnore : Overhang::kClip;
  scene.g_W = rotated(stream.in(-kPi, kPi), {kGravity, 0.0});

  Pusher pusher;
  pusher.name = "pusher";
  pusher.feature = draw_feature(stream);
  pusher.friction = stream.in(0.1, 0.9);
  pusher.normal_angle = 0.5 * kPi * stream.below(4);
  scene.pushers = {pusher};

  drawn.push.place = stream.in(-0.5, 0.5) * half.minCoeff();
  const double aside = stream.in(-kPi / 3.0, kPi / 3.0);
  drawn.push.e = rotated(pusher.normal_angle + aside, {1.0, 0.0});
  drawn.push.travel = stream.in(0.002, 0.03);
  drawn.push.turn = stream.chance(0.5) ? 0.0 : stream.in(-0.5, 0.5);
  const Vec2 p_OF(stream.in(-0.5, 0.5) * half.x(), stream.in(-0.5, 0.5) * half.y());
  scene.start.X_HO = pose_from_finger(p_OF, stream.in(-kPi, kPi));
  return drawn;
}

RandomPush random_spatial_push(std::uint64_t seed, std::uint64_t index) {
  RandomPush drawn = random_push(seed, index);
  RandomStream stream(RandomStream(seed + 1).bits() ^ index);
  Scene& scene = drawn.scene;
  auto& box = std::get<BoxShape>(scene.object.shape);
  const double thickness = stream.in(0.01, 0.04);
  box.size.z() = thickness;
  scene.gripper.friction = {stream.in(0.3, 0.9), stream.in(0.3, 0.9)};
  const double sine = stream.in(-1.0, 1.0);
  scene.g_Wz = kGravity * sine;
  scene.g_W *= std::sqrt(1.0 - sine * sine);
  scene.object.p_OCom = Vec2::Zero();
  scene.object.z_OCom = stream.in(-0.003, 0.003);

  Pusher& pusher = scene.pushers[0];
  const double width = stream.in(0.004, 0.02);
  const double length = stream.in(0.01, 0.05);
  switch (stream.below(6)) {
    case 0:
      pusher.feature = UprightFeature{width};
      break;
    case 1:
      pusher.feature = PlaneFeature{length, width};
      break;
    case 2:
      pusher.feature = PlaneFeature{{}, width};
      break;
    default:
      break;
  }
  pusher.z_WP = stream.in(-0.5, 0.5) * thickness;
  const double mode = stream.in(0.0, 1.0);
  if (mode < 0.2) {
    scene.gripper.jaw_mode = mode < 0.1 ? JawMode::kFixedJaw1 : JawMode::kFixedJaw2;
  }
  return drawn;
}

}  // namespace prehensile
