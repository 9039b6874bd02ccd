#include "mechanics/spatial_scaled.h"

#include <algorithm>

#include <Eigen/Geometry>

namespace prehensile {
namespace {

/// Points may lie off the plane of their patch by this share of its size.
constexpr double kFlat = 1e-6;

constexpr double kUnit = 1e-9;  ///< unit vectors are unit up to this

bool is_from_zero(double x) { return std::isfinite(x) && x >= 0.0; }

bool is_jaw(ContactBody body) { return body != ContactBody::kPusher; }

/// Frames are right, points flat, numbers finite.
bool is_sane(const SpatialProblem& problem, const ContactPatch& patch) {
  if (!patch.n.allFinite() || !patch.t.allFinite()) return false;
  if (std::abs(patch.n.norm() - 1.0) > kUnit || std::abs(patch.t.norm() - 1.0) > kUnit ||
      std::abs(patch.n.dot(patch.t)) > kUnit) {
    return false;
  }
  if (!is_from_zero(patch.mu) || !is_from_zero(patch.spin_radius)) return false;
  if (patch.pressure == PressureLaw::kFoundation &&
      !(std::isfinite(patch.compliance) && patch.compliance > 0.0)) {
    return false;
  }
  if (patch.first < 0 || patch.count < 1 || patch.first + patch.count > problem.count) {
    return false;
  }
  const Vec3 origin = problem.p_HC(patch.first);
  double size = 0.0;
  double off_plane = 0.0;
  for (int i = patch.first; i < patch.first + patch.count; ++i) {
    const Vec3 p = problem.p_HC(i);
    if (!p.allFinite() || !is_from_zero(problem.preload[i])) return false;
    size = std::max({size, (p - origin).norm(), 1e-6 * p.norm()});
    off_plane = std::max(off_plane, std::abs(patch.n.dot(p - origin)));
  }
  return off_plane <= kFlat * size;
}

/// A drive whose jaws carry nothing but given loads cannot move: the loads must add up to
/// its effort.
bool given_loads_match(const SpatialProblem& problem) {
  const JawFreedoms jaws = jaw_freedoms(problem);
  for (int i = 0; i < jaws.count; ++i) {
    double sum = 0.0;
    bool all_given = true;
    for (int k = 0; k < problem.patch_count; ++k) {
      const ContactPatch& patch = problem.patch[k];
      if (!is_jaw(patch.body)) continue;
      const double share = patch.body == ContactBody::kJaw1 ? jaws.jaw1[i] : jaws.jaw2[i];
      if (share == 0.0) continue;
      all_given = all_given && patch.pressure == PressureLaw::kGiven;
      for (int j = patch.first; j < patch.first + patch.count; ++j) {
        sum += share * problem.preload[j];
      }
    }
    if (all_given && !(std::abs(sum - jaws.effort[i]) <= 1e-9 * jaws.effort[i])) {
      return false;
    }
  }
  return true;
}

Vec3 velocity(const SpatialTwist& V, const Vec3& p) {
  return V.head<3>() + V.tail<3>().cross(p);
}

double pusher_rate(const SpatialProblem& problem) {
  double rate = 0.0;
  for (int k = 0; k < problem.patch_count; ++k) {
    const ContactPatch& patch = problem.patch[k];
    if (patch.body != ContactBody::kPusher) continue;
    for (int i = patch.first; i < patch.first + patch.count; ++i) {
      rate = std::max(rate, velocity(problem.V_HP, problem.p_HC(i)).norm());
    }
  }
  return rate;
}

/// Centre of the pads (points alike), and root mean square distance from it.
void measure_pads(const SpatialProblem& problem, SpatialUnits& units) {
  int count = 0;
  units.centre.setZero();
  const auto each_pad_point = [&](auto&& use) {
    for (int k = 0; k < problem.patch_count; ++k) {
      const ContactPatch& patch = problem.patch[k];
      if (!is_jaw(patch.body)) continue;
      for (int i = patch.first; i < patch.first + patch.count; ++i) use(problem.p_HC(i));
    }
  };
  each_pad_point([&](const Vec3& p) {
    units.centre += p;
    ++count;
  });
  units.centre /= count;
  double square = 0.0;
  each_pad_point([&](const Vec3& p) { square += (p - units.centre).squaredNorm(); });
  units.length = std::sqrt(square / count);
}

double reach_of_pusher(const SpatialProblem& problem, const Vec3& centre) {
  double reach = 0.0;
  for (int k = 0; k < problem.patch_count; ++k) {
    const ContactPatch& patch = problem.patch[k];
    if (patch.body != ContactBody::kPusher) continue;
    for (int i = patch.first; i < patch.first + patch.count; ++i) {
      reach = std::max(reach, (problem.p_HC(i) - centre).norm());
    }
  }
  return reach;
}

/// Object rates about the origin of H from scaled ones: v = V0 (v' + centre x w' / L0).
Eigen::Matrix<double, 6, 6> to_hand(const SpatialUnits& units) {
  Eigen::Matrix<double, 6, 6> S = Eigen::Matrix<double, 6, 6>::Zero();
  S.topLeftCorner<3, 3>().diagonal().setConstant(units.rate);
  S.bottomRightCorner<3, 3>().diagonal().setConstant(units.rate / units.length);
  const Vec3 c = units.rate / units.length * units.centre;
  S.topRightCorner<3, 3>() << 0.0, -c.z(), c.y(), c.z(), 0.0, -c.x(), -c.y(), c.x(), 0.0;
  return S;
}

void place_patch(const SpatialProblem& problem, const ContactPatch& patch,
                 const JawFreedoms& jaws, ScaledSpatial& scaled, ScaledPatch& out) {
  const SpatialUnits& units = scaled.units;
  out.first = scaled.padded;
  out.count = patch.count;
  out.padded = (patch.count + ScaledSpatial::kLanes - 1) / ScaledSpatial::kLanes *
               ScaledSpatial::kLanes;
  out.source = patch.first;
  out.body = patch.body;
  out.given = patch.pressure == PressureLaw::kGiven;
  out.mu = patch.mu;
  out.R = patch.pressure == PressureLaw::kFoundation
              ? patch.compliance * units.force / units.rate
              : 0.0;
  out.e = patch.spin_radius / units.length;
  out.soft = out.e > 0.0;
  out.Q.col(0) = patch.n;
  out.Q.col(1) = patch.t;
  out.Q.col(2) = patch.o();
  const Vec3 origin = problem.p_HC(patch.first) - units.centre;
  const Vec3 foot = out.Q.transpose() * origin / units.length;
  out.height = foot[0];
  for (int j = 0; j < out.padded; ++j) {
    const bool real = j < patch.count;
    const int lane = out.first + j;
    const Vec3 p = problem.p_HC(patch.first + (real ? j : 0)) - units.centre;
    scaled.a[lane] = patch.t.dot(p) / units.length;
    scaled.b[lane] = out.Q.col(2).dot(p) / units.length;
    scaled.preload[lane] = real ? problem.preload[patch.first + j] / units.force : 0.0;
  }
  scaled.padded += out.padded;
  out.closing = {0.0, 0.0};
  out.prescribed.setZero();
  if (patch.body == ContactBody::kPusher) {
    out.prescribed = out.local_rates(scaled.pusher);
  } else {
    out.closing = patch.body == ContactBody::kJaw1 ? jaws.jaw1 : jaws.jaw2;
  }
}

}  // namespace

bool is_posed(const SpatialProblem& problem) noexcept {
  if (problem.patch_count < 2 || problem.patch_count > SpatialProblem::kMaxPatches ||
      problem.count < 2 || problem.count > SpatialProblem::kMaxPoints) {
    return false;
  }
  if (!is_from_zero(problem.grip_force) || !is_from_zero(problem.jaw_mass) ||
      !problem.w_g.allFinite() || !problem.V_HP.allFinite() ||
      !problem.inertia.allFinite()) {
    return false;
  }
  int next = 0;
  std::array<const ContactPatch*, 3> first_of{};
  for (int k = 0; k < problem.patch_count; ++k) {
    const ContactPatch& patch = problem.patch[k];
    if (patch.first != next || !is_sane(problem, patch)) return false;
    next += patch.count;
    const ContactPatch*& first = first_of[static_cast<int>(patch.body)];
    if (first == nullptr) first = &patch;
    if (is_jaw(patch.body) && (patch.n - first->n).norm() > kUnit) return false;
  }
  const bool has_pads = first_of[0] != nullptr || first_of[1] != nullptr;
  if (next != problem.count || !has_pads || first_of[2] == nullptr) return false;
  const double rate = pusher_rate(problem);
  return rate > 0.0 && std::isfinite(rate) && given_loads_match(problem);
}

SpatialUnits spatial_units(const SpatialProblem& problem) noexcept {
  SpatialUnits units;
  measure_pads(problem, units);
  const double reach = reach_of_pusher(problem, units.centre);
  // Pads that are all but a point: rounding would show in their torques.
  units.length = std::max(units.length, 0.01 * reach);
  if (units.length <= 0.0) units.length = 1.0;

  double mu = 1.0;
  double load = problem.grip_force;
  for (int k = 0; k < problem.patch_count; ++k) {
    const ContactPatch& patch = problem.patch[k];
    if (!is_jaw(patch.body)) continue;
    mu = std::max(mu, patch.mu);
    double sum = 0.0;
    for (int i = patch.first; i < patch.first + patch.count; ++i) {
      sum += problem.preload[i];
    }
    load = std::max(load, sum);
  }
  const double driven = (problem.inertia * problem.V_HP).head<3>().norm();
  units.force = std::max({load, problem.w_g.head<3>().norm(), driven}) * mu;
  if (units.force <= 0.0) units.force = 1.0;
  units.rate = pusher_rate(problem);
  return units;
}

void scale(const SpatialProblem& problem, ScaledSpatial& scaled) noexcept {
  scaled.units = spatial_units(problem);
  const SpatialUnits& units = scaled.units;
  const JawFreedoms jaws = jaw_freedoms(problem);
  scaled.freedoms = 6 + jaws.count;
  scaled.patch_count = problem.patch_count;
  scaled.padded = 0;
  scaled.pusher.setZero();
  scaled.pusher.head<6>() = problem.V_HP;
  scaled.pusher = scaled_rates(scaled, scaled.pusher);
  for (int k = 0; k < problem.patch_count; ++k) {
    place_patch(problem, problem.patch[k], jaws, scaled, scaled.patch[k]);
  }
  const Eigen::Matrix<double, 6, 6> S = to_hand(units);
  const double power = units.force * units.rate;
  scaled.f.setZero();
  scaled.f.head<6>() = S.transpose() * problem.w_g / power;
  for (int i = 0; i < jaws.count; ++i) scaled.f[6 + i] = jaws.effort[i] / units.force;
  scaled.has_inertia = !problem.inertia.isZero(0.0) || problem.jaw_mass > 0.0;
  scaled.M.setZero();
  if (scaled.has_inertia) {
    scaled.M.topLeftCorner<6, 6>() = S.transpose() * problem.inertia * S / power;
    const double jaw_mass = problem.jaw_mass * units.rate / units.force;
    for (int i = 0; i < jaws.count; ++i) {
      scaled.M(6 + i, 6 + i) =
          jaw_mass * (jaws.jaw1[i] * jaws.jaw1[i] + jaws.jaw2[i] * jaws.jaw2[i]);
    }
  }
}

SpatialRates rates_in_hand(const ScaledSpatial& scaled, const SpatialRates& v) noexcept {
  SpatialRates in_hand;
  in_hand.head<6>() = to_hand(scaled.units) * v.head<6>();
  in_hand.tail<2>() = scaled.units.rate * v.tail<2>();
  return in_hand;
}

SpatialRates scaled_rates(const ScaledSpatial& scaled, const SpatialRates& v) noexcept {
  const SpatialUnits& units = scaled.units;
  SpatialRates out;
  const Vec3 w = v.segment<3>(3);
  out.head<3>() = (v.head<3>() + w.cross(units.centre)) / units.rate;
  out.segment<3>(3) = w * (units.length / units.rate);
  out.tail<2>() = v.tail<2>() / units.rate;
  return out;
}

double ScaledSpatial::least_compliance() const noexcept {
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < patch_count; ++k) {
    if (patch[k].R > 0.0) least = std::min(least, patch[k].R);
  }
  return least;
}

}  // namespace prehensile
