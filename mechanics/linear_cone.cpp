#include "mechanics/linear_cone.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

namespace prehensile {
namespace {

using Column = LinearConeContact::Column;

constexpr double kUnit = 1e-9;  // unit vectors are unit up to this

bool is_jaw(const ContactPatch& patch) { return patch.body != ContactBody::kPusher; }

Vec3 velocity_at(const SpatialTwist& V, const Vec3& p) {
  return V.head<3>() + V.tail<3>().cross(p);
}

bool is_from_zero(double x) { return std::isfinite(x) && x >= 0.0; }

bool is_sound(const SpatialProblem& q, const ContactPatch& patch) {
  const bool frame = std::abs(patch.n.norm() - 1.0) <= kUnit &&
                     std::abs(patch.t.norm() - 1.0) <= kUnit &&
                     std::abs(patch.n.dot(patch.t)) <= kUnit;
  const bool range = patch.first >= 0 && patch.count >= 1 &&
                     patch.first + patch.count <= q.count &&
                     q.count <= SpatialProblem::kMaxPoints;
  if (!frame || !range || !is_from_zero(patch.mu) || !is_from_zero(patch.spin_radius)) {
    return false;
  }
  if (patch.pressure == PressureLaw::kFoundation &&
      !(std::isfinite(patch.compliance) && patch.compliance > 0.0)) {
    return false;
  }
  for (int i = patch.first; i < patch.first + patch.count; ++i) {
    if (!q.p_HC(i).allFinite() || !is_from_zero(q.preload[i])) return false;
  }
  return true;
}

bool is_sound(const SpatialProblem& q) {
  if (q.patch_count < 1 || q.patch_count > SpatialProblem::kMaxPatches) return false;
  bool jaws = false;
  bool pusher = false;
  for (int k = 0; k < q.patch_count; ++k) {
    if (!is_sound(q, q.patch[k])) return false;
    (is_jaw(q.patch[k]) ? jaws : pusher) = true;
  }
  return jaws && pusher && is_from_zero(q.grip_force) && is_from_zero(q.jaw_mass) &&
         q.w_g.allFinite() && q.V_HP.allFinite() && q.inertia.allFinite();
}

/// Length: root mean square distance of the pads' points from their centre, or, for pads
/// that are next to a point, a share of the way to the pusher. Force: grip or weight,
/// times friction above 1. Rate: the fastest pusher point.
void set_units(const SpatialProblem& q, LinearCone& cone) {
  int count = 0;
  double mu = 1.0;
  double preload = 0.0;
  const auto each = [&q](bool jaws, auto&& use) {
    for (int k = 0; k < q.patch_count; ++k) {
      const ContactPatch& patch = q.patch[k];
      if (is_jaw(patch) != jaws) continue;
      for (int i = patch.first; i < patch.first + patch.count; ++i) use(patch, i);
    }
  };
  each(true, [&](const ContactPatch& patch, int i) {
    cone.centre += q.p_HC(i);
    mu = std::max(mu, patch.mu);
    preload += 0.5 * q.preload[i];
    ++count;
  });
  cone.centre /= count;
  double square = 0.0;
  each(true, [&](const ContactPatch&, int i) {
    square += (q.p_HC(i) - cone.centre).squaredNorm();
  });
  double reach = 0.0;
  cone.rate = 0.0;
  each(false, [&](const ContactPatch&, int i) {
    reach = std::max(reach, (q.p_HC(i) - cone.centre).norm());
    cone.rate = std::max(cone.rate, velocity_at(q.V_HP, q.p_HC(i)).norm());
  });
  cone.length = std::max(std::sqrt(square / count), 0.01 * reach);
  if (!(cone.length > 0.0)) cone.length = 1.0;
  cone.force = mu * std::max({q.grip_force, preload, q.w_g.head<3>().norm()});
  if (!(cone.force > 0.0)) cone.force = 1.0;
}

/// Rate along e of the body point at p, and, for a soft point, of turning about `spin`
/// [per e]: the row that takes scaled object rates to it.
Column row_of(const LinearCone& cone, const Vec3& p, const Vec3& e, const Vec3& spin) {
  Column row = Column::Zero();
  row.head<3>() = e;
  row.segment<3>(3) = ((p - cone.centre) / cone.length).cross(e) + spin / cone.length;
  return row;
}

LinearConeContact contact_of(const SpatialProblem& q, const ContactPatch& patch,
                             const JawFreedoms& jaws, int generators, int i,
                             const LinearCone& cone) {
  LinearConeContact contact;
  const Vec3 p = q.p_HC(i);
  const bool pusher = !is_jaw(patch);
  const SpatialTwist drive = pusher ? q.V_HP : SpatialTwist::Zero();
  contact.n = row_of(cone, p, patch.n, Vec3::Zero());
  contact.n_drive = patch.n.dot(velocity_at(drive, p)) / cone.rate;
  for (int k = 0; k < jaws.count && !pusher; ++k) {
    contact.n[6 + k] = -(patch.body == ContactBody::kJaw1 ? jaws.jaw1[k] : jaws.jaw2[k]);
  }
  contact.mu = patch.mu;
  contact.given = patch.pressure == PressureLaw::kGiven;
  contact.preload = q.preload[i] / cone.force;
  if (patch.pressure == PressureLaw::kFoundation) {
    contact.compliance = patch.compliance * cone.force / cone.rate;
  } else if (patch.pressure == PressureLaw::kFree) {
    contact.preload = 0.0;
  }
  if (!(patch.mu > 0.0)) return contact;
  const Eigen::Matrix3Xd d = friction_generators(generators, patch.spin_radius > 0.0);
  contact.D.resize(8, d.cols());
  contact.D_drive.resize(d.cols());
  for (Eigen::Index k = 0; k < d.cols(); ++k) {
    const Vec3 e = d(0, k) * patch.t + d(1, k) * patch.o();
    const Vec3 spin = d(2, k) * patch.spin_radius * patch.n;
    contact.D.col(k) = row_of(cone, p, e, spin);
    contact.D_drive[k] =
        (e.dot(velocity_at(drive, p)) + spin.dot(drive.tail<3>())) / cone.rate;
  }
  return contact;
}

/// Twist about the centre, in units, to the twist about the origin of H.
Eigen::Matrix<double, 6, 6> to_hand(const LinearCone& cone) {
  Eigen::Matrix<double, 6, 6> T = Eigen::Matrix<double, 6, 6>::Zero();
  for (int k = 0; k < 3; ++k) {
    const Vec3 axis = Vec3::Unit(k);
    T.col(k).head<3>() = cone.rate * axis;
    T.col(3 + k).head<3>() = cone.rate / cone.length * cone.centre.cross(axis);
    T.col(3 + k).tail<3>() = cone.rate / cone.length * axis;
  }
  return T;
}

void set_dynamics(const SpatialProblem& q, const JawFreedoms& jaws, LinearCone& cone) {
  const Eigen::Matrix<double, 6, 6> T = to_hand(cone);
  cone.freedoms = 6 + jaws.count;
  cone.inertia.topLeftCorner<6, 6>() =
      T.transpose() * q.inertia * T / (cone.force * cone.rate);
  cone.load.head<6>() = T.transpose() * q.w_g / (cone.force * cone.rate);
  for (int i = 0; i < jaws.count; ++i) {
    cone.load[6 + i] = jaws.effort[i] / cone.force;
    for (int k = 0; k < jaws.count; ++k) {
      const double mass =
          q.jaw_mass * (jaws.jaw1[i] * jaws.jaw1[k] + jaws.jaw2[i] * jaws.jaw2[k]);
      cone.inertia(6 + i, 6 + k) = mass * cone.rate / cone.force;
    }
  }
}

void number_unknowns(LinearCone& cone) {
  int next = cone.freedoms;
  for (LinearConeContact& contact : cone.contact) {
    if (!contact.given) contact.lambda_n = next++;
    if (!(contact.mu > 0.0)) continue;
    contact.beta = next;
    next += static_cast<int>(contact.D.cols());
    contact.xi = next++;
  }
  cone.unknowns = next;
}

void add_column(const LinearCone& cone, int unknown, const Column& column,
                ComplementarityProblem& problem) {
  for (int i = 0; i < cone.freedoms; ++i) problem.add(i, unknown, column[i]);
}

void add_rates(const LinearCone& cone, int row, const Column& column,
               ComplementarityProblem& problem) {
  for (int i = 0; i < cone.freedoms; ++i) problem.add(row, i, column[i]);
}

void add_contact(const LinearCone& cone, const LinearConeContact& contact,
                 ComplementarityProblem& problem) {
  if (contact.given) {
    for (int i = 0; i < cone.freedoms; ++i) {
      problem.constant[i] += contact.preload * contact.n[i];
    }
  } else {
    add_column(cone, contact.lambda_n, contact.n, problem);
    const int gap = problem.add_row(
        contact.lambda_n, -contact.n_drive - contact.compliance * contact.preload);
    add_rates(cone, gap, contact.n, problem);
    problem.add(gap, contact.lambda_n, contact.compliance);
  }
  if (contact.xi < 0) return;
  const int friction =
      problem.add_row(contact.xi, contact.given ? contact.mu * contact.preload : 0.0);
  if (!contact.given) problem.add(friction, contact.lambda_n, contact.mu);
  for (int k = 0; k < contact.D.cols(); ++k) {
    add_column(cone, contact.beta + k, contact.D.col(k), problem);
    problem.add(friction, contact.beta + k, -1.0);
    const int slip = problem.add_row(contact.beta + k, -contact.D_drive[k]);
    add_rates(cone, slip, contact.D.col(k), problem);
    problem.add(slip, contact.xi, 1.0);
  }
}

}  // namespace

Eigen::Matrix3Xd friction_generators(int g, bool soft) {
  const double step = 2.0 * std::numbers::pi / g;
  const int circles = soft ? g / 2 - 1 : 1;  // at latitudes a step apart, between poles
  Eigen::Matrix3Xd d(3, circles * g + (soft ? 2 : 0));
  for (int circle = 0; circle < circles; ++circle) {
    const double latitude = soft ? step * (circle + 1) - std::numbers::pi / 2.0 : 0.0;
    for (int k = 0; k < g; ++k) {
      d.col(circle * g + k) << std::cos(latitude) * std::cos(step * k),
          std::cos(latitude) * std::sin(step * k), std::sin(latitude);
    }
  }
  if (soft) {
    d.col(circles * g) = Vec3::UnitZ();
    d.col(circles * g + 1) = -Vec3::UnitZ();
  }
  return d;
}

bool pose_linear_cone(const SpatialProblem& problem, int generators, LinearCone& cone) {
  if (generators < 4 || generators > 64 || generators % 2 != 0) return false;
  if (!is_sound(problem)) return false;
  cone = LinearCone{};
  set_units(problem, cone);
  if (!(cone.rate > 0.0)) return false;
  const JawFreedoms jaws = jaw_freedoms(problem);
  set_dynamics(problem, jaws, cone);
  for (int k = 0; k < problem.patch_count; ++k) {
    const ContactPatch& patch = problem.patch[k];
    for (int i = patch.first; i < patch.first + patch.count; ++i) {
      cone.contact.push_back(contact_of(problem, patch, jaws, generators, i, cone));
    }
  }
  number_unknowns(cone);
  return true;
}

ComplementarityProblem complementarity_of(const LinearCone& cone) {
  ComplementarityProblem problem;
  problem.variables = cone.unknowns;
  for (int i = 0; i < cone.freedoms; ++i) {
    const int row = problem.add_row(ComplementarityProblem::kEquality, cone.load[i]);
    for (int k = 0; k < cone.freedoms; ++k) problem.add(row, k, -cone.inertia(i, k));
  }
  for (const LinearConeContact& contact : cone.contact) {
    add_contact(cone, contact, problem);
  }
  return problem;
}

LinearConeForces forces_of(const SpatialProblem& problem, const LinearCone& cone,
                           int generators, std::span<const double> z) {
  LinearConeForces answer;
  const Eigen::Map<const Eigen::VectorXd> rates(z.data(), cone.freedoms);
  answer.V_HO = to_hand(cone) * rates.head<6>();
  for (int i = 6; i < cone.freedoms; ++i) answer.jaw_rate[i - 6] = cone.rate * rates[i];
  answer.point.resize(problem.count);
  std::size_t next = 0;
  for (int k = 0; k < problem.patch_count; ++k) {
    const ContactPatch& patch = problem.patch[k];
    const Eigen::Matrix3Xd d = friction_generators(generators, patch.spin_radius > 0.0);
    for (int i = patch.first; i < patch.first + patch.count; ++i) {
      const LinearConeContact& contact = cone.contact[next++];
      LinearConePoint& point = answer.point[i];
      point.normal_force =
          cone.force * (contact.given ? contact.preload : z[contact.lambda_n]);
      for (int j = 0; j < contact.D.cols(); ++j) {
        const double beta = cone.force * z[contact.beta + j];
        point.beta.push_back(beta);
        point.tangential_force += beta * d.col(j).head<2>();
        point.spin_moment += beta * d(2, j) * patch.spin_radius;
      }
      if (is_jaw(patch)) continue;
      const Vec3 f = point.normal_force * patch.n + point.tangential_force.x() * patch.t +
                     point.tangential_force.y() * patch.o();
      answer.w_push.head<3>() += f;
      answer.w_push.tail<3>() += problem.p_HC(i).cross(f) + point.spin_moment * patch.n;
    }
  }
  return answer;
}

}  // namespace prehensile
