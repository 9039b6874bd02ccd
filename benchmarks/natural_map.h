/// One measure for all solvers: how far rates and forces are from the laws on circular
/// cones, whoever made them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Geometry>

#include "mechanics/spatial_problem.h"

namespace prehensile::benchmarks {

/// What a solver answered, in SI along (n, t, o) of each point's patch. Hard points only.
struct SpatialAnswer {
  bool given = false;  ///< the solver calls it an answer
  SpatialTwist V_HO = SpatialTwist::Zero();
  std::array<double, 2> jaw_rate{0.0, 0.0};
  std::vector<Vec3> force;
};

struct SpatialScales {
  double length = 1.0, force = 1.0, rate = 1.0;
};

/// Nearest point of the cone |f_t| <= mu f_n.
inline Vec3 projected_on_cone(const Vec3& f, double mu) {
  const double t = f.tail<2>().norm();
  if (t <= mu * f[0]) return f;
  if (mu * t <= -f[0]) return Vec3::Zero();
  const double n = (f[0] + mu * t) / (1.0 + mu * mu);
  return {n, mu * n * f[1] / t, mu * n * f[2] / t};
}

/// |L - P(L - (c + Gamma))|, Gamma = mu |c_t| along n, of the worst point, and the
/// largest imbalance of eq. (8) about the origin and of the jaws' drive; in units.
inline double natural_residual(const SpatialProblem& q, const SpatialAnswer& answer,
                               const SpatialScales& units) {
  if (!answer.given) return std::numeric_limits<double>::quiet_NaN();
  const JawFreedoms jaws = jaw_freedoms(q);
  SpatialWrench w = q.w_g - q.inertia * answer.V_HO;
  std::array<double, 2> drive = jaws.effort;
  double worst = 0.0;
  for (int k = 0; k < jaws.count; ++k) {
    for (int i = 0; i < jaws.count; ++i) {
      const double share = jaws.jaw1[k] * jaws.jaw1[i] + jaws.jaw2[k] * jaws.jaw2[i];
      drive[k] -= q.jaw_mass * share * answer.jaw_rate[i];
    }
  }
  for (int k = 0; k < q.patch_count; ++k) {
    const ContactPatch& patch = q.patch[k];
    const bool pusher = patch.body == ContactBody::kPusher;
    const auto& jaw = patch.body == ContactBody::kJaw1 ? jaws.jaw1 : jaws.jaw2;
    const SpatialTwist V = pusher ? SpatialTwist(answer.V_HO - q.V_HP) : answer.V_HO;
    for (int i = patch.first; i < patch.first + patch.count; ++i) {
      const Vec3& f = answer.force[i];
      const Vec3 v = V.head<3>() + V.tail<3>().cross(q.p_HC(i));
      Vec3 c(patch.n.dot(v), patch.t.dot(v), patch.o().dot(v));
      for (int j = 0; j < jaws.count && !pusher; ++j) {
        c[0] -= jaw[j] * answer.jaw_rate[j];
        drive[j] -= jaw[j] * f[0];
      }
      if (patch.pressure == PressureLaw::kFoundation) {
        c[0] += patch.compliance * (f[0] - q.preload[i]);
      }
      c[0] += patch.mu * c.tail<2>().norm();
      const Vec3 unit_f = f / units.force;
      worst = std::max(
          worst, (unit_f - projected_on_cone(unit_f - c / units.rate, patch.mu)).norm());
      const Vec3 on_object = f[0] * patch.n + f[1] * patch.t + f[2] * patch.o();
      w.head<3>() += on_object;
      w.tail<3>() += q.p_HC(i).cross(on_object);
    }
  }
  for (int k = 0; k < jaws.count; ++k) {
    worst = std::max(worst, std::abs(drive[k]) / units.force);
  }
  worst = std::max({worst, w.head<3>().norm() / units.force,
                    w.tail<3>().norm() / (units.force * units.length)});
  return std::isfinite(worst) ? worst : std::numeric_limits<double>::infinity();
}

}  // namespace prehensile::benchmarks
