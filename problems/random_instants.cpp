#include "problems/random_instants.h"

#include <algorithm>
#include <array>
#include <numbers>

#include "problems/gauss_product.h"
#include "problems/random_stream.h"

namespace prehensile {
namespace {

constexpr double kGravity = 9.81;

void place_pad(int points, double angle, const Vec2& half, double capacity,
               PlanarGrasp& grasp) {
  const auto [along, across] = gauss_product(points);
  grasp.count = 0;
  for (int i = 0; i < along.count; ++i) {
    for (int j = 0; j < across.count; ++j) {
      const Vec2 local(half.x() * along.node[i], half.y() * across.node[j]);
      const Vec2 p = rotated(angle, local);
      grasp.x[grasp.count] = p.x();
      grasp.y[grasp.count] = p.y();
      grasp.bound[grasp.count] = capacity * along.weight[i] * across.weight[j];
      ++grasp.count;
    }
  }
}

/// Rectangle, uniform mass: inertia about the origin of H.
Eigen::Matrix3d box_inertia(double mass, const Vec2& half, const Vec2& p_com) {
  const double about_com = mass * half.squaredNorm() / 3.0;
  Eigen::Matrix3d inertia;
  inertia << mass, 0.0, -mass * p_com.y(),  //
      0.0, mass, mass * p_com.x(),          //
      -mass * p_com.y(), mass * p_com.x(), about_com + mass * p_com.squaredNorm();
  return inertia;
}

}  // namespace

RandomInstant random_instant(std::uint64_t seed, std::uint64_t index,
                             const InstantRange& range) {
  RandomStream random(seed * 0x2545f4914f6cdd1du + index);
  const auto angle = [&random] { return random.in(-std::numbers::pi, std::numbers::pi); };

  const Vec2 half(random.in(0.015, 0.075), random.in(0.015, 0.075));
  const double mass = random.log_in(0.02, 1.0);
  const double grip_force = random.log_in(5.0, 100.0);
  const double mu_finger = random.in(0.2, 1.0);
  const double mu_pusher = random.in(0.1, 0.9);
  const Vec2 pad_half(random.in(0.003, 0.012), random.in(0.003, 0.012));
  const double pad_angle = angle();
  const Vec2 com_in_box(random.in(-0.2, 0.2) * half.x(), random.in(-0.2, 0.2) * half.y());
  const Vec2 finger_in_box(random.in(-1.0, 1.0) * std::max(0.0, half.x() - 0.012),
                           random.in(-1.0, 1.0) * std::max(0.0, half.y() - 0.012));
  const double box_angle = angle();
  const double gravity_angle = angle();

  // Face in the box frame, then everything turned into H, whose origin is the finger.
  const double face_angle = 0.5 * std::numbers::pi * random.below(4);
  const Vec2 n_box = rotated(face_angle, {1.0, 0.0});
  const double depth = std::abs(n_box.dot(half));
  const double half_face = std::abs(perp(n_box).dot(half));
  const double place = random.in(-0.9, 0.9) * half_face;
  const double reach = random.in(0.05, 0.9) * (half_face - std::abs(place));
  const bool line = random.chance(0.5);
  const double push_angle = random.in(-std::numbers::pi / 3.0, std::numbers::pi / 3.0);
  const bool turns = random.chance(range.turning_share);
  const double turn = random.in(-20.0, 20.0);

  const auto in_hand = [&](const Vec2& p) {
    return rotated(box_angle, p - finger_in_box);
  };
  RandomInstant instant;
  PlanarGrasp& grasp = instant.grasp;
  place_pad(range.points_per_pad, pad_angle, pad_half, 2.0 * mu_finger * grip_force,
            grasp);
  grasp.w_g = wrench_of(in_hand(com_in_box),
                        mass * kGravity * rotated(gravity_angle, {1.0, 0.0}));
  if (range.inertia > 0.0) grasp.inertia = box_inertia(mass, half, in_hand(com_in_box));

  PlanarDrive& drive = instant.drive;
  drive.count = range.pusher_points == 0 ? (line ? 2 : 1) : range.pusher_points;
  drive.n_H = rotated(box_angle, n_box);
  drive.mu = mu_pusher;
  const Vec2 centre = -depth * n_box + place * perp(n_box);
  if (drive.count == 1) {
    drive.p_HC = {in_hand(centre), in_hand(centre)};
  } else {
    drive.p_HC = {in_hand(centre - reach * perp(n_box)),
                  in_hand(centre + reach * perp(n_box))};
  }
  const double rate = range.inertia > 0.0 ? range.inertia : 0.01;
  const Vec2 v = rate * rotated(push_angle, drive.n_H);
  const double omega = turns ? rate * turn : 0.0;
  const Vec2 p = in_hand(centre);
  drive.V_HP = {v.x() + omega * p.y(), v.y() - omega * p.x(), omega};
  return instant;
}

}  // namespace prehensile
