#include "problems/random_spatial.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <numbers>

#include <Eigen/Geometry>

#include "problems/gauss_product.h"
#include "problems/random_stream.h"

namespace prehensile {
namespace {

constexpr double kGravity = 9.81;

Vec3 in_plane(const Vec2& p, double z) { return {p.x(), p.y(), z}; }

/// Symmetric, about the origin of H.
Eigen::Matrix<double, 6, 6> box_inertia(double mass, const Vec3& half,
                                        const Eigen::Matrix3d& R_HO, const Vec3& p_com) {
  const Vec3 s = half.cwiseProduct(half) / 3.0;
  const Vec3 about_com = mass * Vec3(s.y() + s.z(), s.x() + s.z(), s.x() + s.y());
  Eigen::Matrix3d cross;
  cross << 0.0, -p_com.z(), p_com.y(), p_com.z(), 0.0, -p_com.x(), -p_com.y(), p_com.x(),
      0.0;
  Eigen::Matrix<double, 6, 6> inertia;
  inertia.topLeftCorner<3, 3>() = mass * Eigen::Matrix3d::Identity();
  inertia.topRightCorner<3, 3>() = -mass * cross;
  inertia.bottomLeftCorner<3, 3>() = mass * cross;
  inertia.bottomRightCorner<3, 3>() =
      R_HO * about_com.asDiagonal() * R_HO.transpose() - mass * cross * cross;
  return inertia;
}

ContactPatch& add_patch(SpatialProblem& problem, ContactBody body, const Vec3& n,
                        const Vec3& t, double mu) {
  ContactPatch& patch = problem.patch[problem.patch_count++];
  patch = ContactPatch{};
  patch.body = body;
  patch.n = n;
  patch.t = t;
  patch.mu = mu;
  patch.first = problem.count;
  return patch;
}

void add_point(SpatialProblem& problem, ContactPatch& patch, const Vec3& p,
               double preload) {
  problem.x[problem.count] = p.x();
  problem.y[problem.count] = p.y();
  problem.z[problem.count] = p.z();
  problem.preload[problem.count] = preload;
  ++problem.count;
  ++patch.count;
}

struct Pads {
  Vec2 half;
  double angle;
  double mu;
  double height;  ///< half of the object's width along z
  double compliance;
};

void add_pads(const Pads& pads, const SpatialRange& range, SpatialProblem& problem) {
  const auto [along, across] = gauss_product(range.points_per_pad);
  for (const double side : {-1.0, 1.0}) {
    const ContactBody body = side < 0.0 ? ContactBody::kJaw1 : ContactBody::kJaw2;
    const Vec3 n(0.0, 0.0, -side);
    ContactPatch& patch = add_patch(problem, body, n, Vec3::UnitX(), pads.mu);
    patch.pressure = range.pressure;
    patch.compliance = range.pressure == PressureLaw::kFoundation ? pads.compliance : 0.0;
    patch.spin_radius = range.spin_radius;
    for (int i = 0; i < along.count; ++i) {
      for (int j = 0; j < across.count; ++j) {
        const Vec2 local(pads.half.x() * along.node[i], pads.half.y() * across.node[j]);
        const double share = along.weight[i] * across.weight[j];
        const double preload =
            range.pressure == PressureLaw::kFree ? 0.0 : share * problem.grip_force;
        add_point(problem, patch,
                  in_plane(rotated(pads.angle, local), side * pads.height), preload);
      }
    }
  }
}

}  // namespace

SpatialProblem random_spatial(std::uint64_t seed, std::uint64_t index,
                              const SpatialRange& range) {
  RandomStream random(seed * 0x2545f4914f6cdd1du + index);
  const auto angle = [&random] { return random.in(-std::numbers::pi, std::numbers::pi); };

  const Vec3 half(random.in(0.015, 0.075), random.in(0.015, 0.075),
                  random.in(0.005, 0.030));
  const double mass = random.log_in(0.02, 1.0);
  const double grip_force = random.log_in(5.0, 100.0);
  const double mu_finger = random.in(range.friction_low, range.friction_high);
  const double mu_pusher =
      random.in(range.pusher_friction_low, range.pusher_friction_high);
  const Vec2 pad_half(random.in(0.003, 0.012), random.in(0.003, 0.012));
  const double pad_angle = angle();
  const Vec3 com_in_box(random.in(-0.2, 0.2) * half.x(), random.in(-0.2, 0.2) * half.y(),
                        range.out_of_plane * random.in(-0.2, 0.2) * half.z());
  const Vec2 finger_in_box(random.in(-1.0, 1.0) * std::max(0.0, half.x() - 0.012),
                           random.in(-1.0, 1.0) * std::max(0.0, half.y() - 0.012));
  const double box_angle = angle();
  const double gravity_angle = angle();

  const double face_angle = 0.5 * std::numbers::pi * random.below(4);
  const Vec2 n_box = rotated(face_angle, {1.0, 0.0});
  const double depth = std::abs(n_box.dot(half.head<2>()));
  const double half_face = std::abs(perp(n_box).dot(half.head<2>()));
  const double place = random.in(-0.9, 0.9) * half_face;
  const double off_plane = range.out_of_plane * random.in(-0.5, 0.5) * half.z();
  const double reach = random.in(0.05, 0.9) * (half_face - std::abs(place));
  const double height = random.in(0.05, 0.9) * (half.z() - std::abs(off_plane));
  const int kind = random.below(3);
  const double line_angle = range.out_of_plane * angle();
  const double push_angle = random.in(-std::numbers::pi / 3.0, std::numbers::pi / 3.0);
  const double push_side = range.out_of_plane * angle();

  const auto in_hand = [&](const Vec2& p) {
    return rotated(box_angle, p - finger_in_box);
  };
  SpatialProblem problem;
  problem.jaw_mode = range.jaw_mode;
  problem.grip_force = grip_force;
  const double rate = range.acceleration > 0.0 ? range.acceleration : 0.01;
  const double force = std::max(grip_force, mass * kGravity) * std::max(1.0, mu_finger);
  const double compliance = range.compliance * rate / force;
  add_pads({pad_half, pad_angle, mu_finger, half.z(), compliance}, range, problem);

  const Vec2 com = in_hand(com_in_box.head<2>());
  const Vec3 p_com = in_plane(com, com_in_box.z());
  const Vec3 weight = in_plane(mass * kGravity * rotated(gravity_angle, {1.0, 0.0}), 0.0);
  problem.w_g << weight, p_com.cross(weight);
  if (range.acceleration > 0.0) {
    const Eigen::Matrix3d R_HO =
        Eigen::AngleAxisd(box_angle, Vec3::UnitZ()).toRotationMatrix();
    problem.inertia = box_inertia(mass, half, R_HO, p_com);
    problem.jaw_mass = 0.1;
  }

  const Vec3 n = in_plane(rotated(box_angle, n_box), 0.0);
  const Vec3 t = in_plane(perp(n.head<2>()), 0.0);
  const Vec3 o = n.cross(t);
  ContactPatch& pusher = add_patch(problem, ContactBody::kPusher, n, t, mu_pusher);
  const int points =
      range.pusher_points > 0 ? range.pusher_points : std::array{1, 2, 4}[kind];
  const Vec3 centre = in_plane(in_hand(-depth * n_box + place * perp(n_box)), off_plane);
  if (points == 1) {
    add_point(problem, pusher, centre, 0.0);
  } else if (points == 2) {
    // The longest line in this direction that the rectangle contains.
    const double c = std::abs(std::cos(line_angle));
    const double s = std::abs(std::sin(line_angle));
    const double length =
        std::min(c > 1e-9 ? reach / c : 1e9, s > 1e-9 ? height / s : 1e9);
    const Vec3 along = std::cos(line_angle) * t + std::sin(line_angle) * o;
    add_point(problem, pusher, centre - length * along, 0.0);
    add_point(problem, pusher, centre + length * along, 0.0);
  } else {
    assert(points == 4);
    pusher.pressure = PressureLaw::kFoundation;
    pusher.compliance = compliance;
    for (const double i : {-1.0, 1.0}) {
      for (const double j : {-1.0, 1.0}) {
        add_point(problem, pusher, centre + i * reach * t + j * height * o, 0.0);
      }
    }
  }
  const Vec3 side = std::cos(push_side) * t + std::sin(push_side) * o;
  const Vec3 v = rate * (std::cos(push_angle) * n + std::sin(push_angle) * side);
  problem.V_HP << v, Vec3::Zero();
  return problem;
}

PlanarEquivalent planar_equivalent(const SpatialProblem& problem) {
  PlanarEquivalent planar;
  const ContactPatch& pad = problem.patch[0];
  for (int i = 0; i < pad.count; ++i) {
    planar.grasp.x[i] = problem.x[i];
    planar.grasp.y[i] = problem.y[i];
    planar.grasp.bound[i] = 2.0 * pad.mu * problem.preload[i];
  }
  planar.grasp.count = pad.count;
  const auto flat = [](const auto& v) { return Vec3(v[0], v[1], v[5]); };
  planar.grasp.w_g = flat(problem.w_g);
  const std::array<int, 3> keep = {0, 1, 5};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      planar.grasp.inertia(i, j) = problem.inertia(keep[i], keep[j]);
    }
  }
  const ContactPatch& pusher = problem.patch[2];
  planar.drive.count = pusher.count;
  for (int i = 0; i < pusher.count; ++i) {
    planar.drive.p_HC[i] = problem.p_HC(pusher.first + i).head<2>();
  }
  planar.drive.n_H = pusher.n.head<2>();
  planar.drive.mu = pusher.mu;
  planar.drive.V_HP = flat(problem.V_HP);
  return planar;
}

}  // namespace prehensile
