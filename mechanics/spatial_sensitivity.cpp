#include "mechanics/spatial_sensitivity.h"

#include <algorithm>
#include <cmath>

#include <Eigen/SVD>

#include "mechanics/spatial_scaled.h"

namespace prehensile {
namespace {

constexpr double kStill = 1e-7;      // slip this slow has no direction, in push rates
constexpr double kSingular = 1e-10;  // singular value over the largest that is zero
constexpr double kStep = 1e-6;       // of parameters, relative or in SI

}  // namespace

DifferentiatedSpatialInstant::DifferentiatedSpatialInstant(
    const SpatialProblem& problem, const SpatialInstant& answer) noexcept
    : problem_(problem), answer_(answer), jaws_(jaw_freedoms(problem)) {
  if (answer.status != InstantStatus::kMoves) return;
  const SpatialUnits units = spatial_units(problem);
  units_ = {units.centre, units.length, units.force, units.rate};
  mode_slack_ = std::numeric_limits<double>::infinity();
  fill_system();
}

/// Rows, rates and forces of a point, about the centre of the pads.
DifferentiatedSpatialInstant::Point DifferentiatedSpatialInstant::point_at(
    const ContactPatch& patch, int i) const noexcept {
  const auto& [centre, length, force, rate] = units_;
  const SpatialPoint& given = answer_.point[i];
  const bool pusher = patch.body == ContactBody::kPusher;
  const auto& closing = patch.body == ContactBody::kJaw1 ? jaws_.jaw1 : jaws_.jaw2;
  const Vec3 p = (problem_.p_HC(i) - centre) / length;
  const double e = patch.spin_radius / length;
  Point point;
  point.H.setZero();
  int row = 0;
  for (const Vec3& axis : {patch.n, patch.t, patch.o()}) {
    point.H.block<1, 3>(row, 0) = axis.transpose();
    point.H.block<1, 3>(row++, 3) = p.cross(axis).transpose();
  }
  point.H.block<1, 3>(3, 3) = e * patch.n.transpose();
  for (int k = 0; k < jaws_.count && !pusher; ++k) point.H(0, 6 + k) = -closing[k];
  point.c << given.normal_rate / rate, given.slip_rate / rate,
      e * given.spin_rate * length / rate;
  const double spin = e > 0.0 ? given.spin_moment / (patch.spin_radius * force) : 0.0;
  point.f << given.normal_force / force, given.tangential_force / force, spin;
  point.mu = patch.mu;
  point.dimensions = e > 0.0 ? 4 : 3;
  point.R = patch.compliance * force / rate;
  point.loaded = given.normal_force > 0.0;
  point.springs = point.loaded && patch.pressure == PressureLaw::kFoundation;
  point.rigid = point.loaded && patch.pressure == PressureLaw::kFree;
  const bool has_friction = point.loaded && patch.mu > 0.0;
  point.sticks = has_friction && given.mode == ContactMode::kStick;
  point.slip_speed = point.c.tail<3>().norm();
  if (has_friction && !point.sticks && point.slip_speed > kStill) {
    point.slip.tail<3>() = point.c.tail<3>() / point.slip_speed;
  }
  return point;
}

/// - d force / d rates, but for the forces that hold rates at zero.
Eigen::Matrix4d DifferentiatedSpatialInstant::stiffness_of(
    const Point& point) const noexcept {
  Eigen::Matrix4d S = Eigen::Matrix4d::Zero();
  if (point.springs) S(0, 0) = 1.0 / point.R;
  if (point.slip.isZero(0.0)) return S;
  S.col(0) -= point.mu * S(0, 0) * point.slip;
  const Vec3 u = point.slip.tail<3>();
  S.bottomRightCorner<3, 3>() = point.mu * point.f[0] / point.slip_speed *
                                (Eigen::Matrix3d::Identity() - u * u.transpose());
  return S;
}

void DifferentiatedSpatialInstant::see_mode(const Point& point) noexcept {
  const double friction = point.f.tail<3>().norm();
  double slack = point.f[0];
  if (!point.loaded) {
    slack = point.R > 0.0 ? point.c[0] / point.R : point.c[0];
  } else if (point.sticks) {
    slack = std::min(slack, point.mu * point.f[0] - friction);
  } else if (point.mu > 0.0) {
    slack = std::min(slack, point.slip_speed);
  }
  mode_slack_ = std::min(mode_slack_, std::max(0.0, slack));
}

/// The derivative of balance and of the rates that stay zero, by rates and the forces
/// that hold them.
void DifferentiatedSpatialInstant::fill_system() noexcept {
  const auto& [centre, length, force, rate] = units_;
  const int n = 6 + jaws_.count;
  System system = System::Identity();
  ScaledSpatial scaled;
  scale(problem_, scaled);
  system.topLeftCorner<kRates, kRates>() = scaled.M;
  for (int i = n; i < kRates; ++i) system(i, i) = 1.0;
  int row = kRates;
  for (int k = 0; k < problem_.patch_count; ++k) {
    const ContactPatch& patch = problem_.patch[k];
    for (int i = patch.first; i < patch.first + patch.count; ++i) {
      Point point = point_at(patch, i);
      if (!point.loaded && patch.pressure == PressureLaw::kFoundation) {
        // From where the spring would press again.
        point.c[0] -= point.R * problem_.preload[i] / force;
      }
      see_mode(point);
      if (!point.loaded) continue;
      if (point.mu > 0.0 && !point.sticks && point.slip.isZero(0.0)) return;
      system.topLeftCorner<kRates, kRates>() +=
          point.H.transpose() * stiffness_of(point) * point.H;
      const auto hold = [&](int law, const Laws& direction) {
        if (row >= kMost) return false;
        system.row(row).setZero();
        system.row(row).head<kRates>() = point.H.row(law);
        system.col(row).head<kRates>() = -point.H.transpose() * direction;
        ++row;
        return true;
      };
      if (point.rigid && !hold(0, Laws::Unit(0) - point.mu * point.slip)) return;
      for (int law = 1; point.sticks && law < point.dimensions; ++law) {
        if (!hold(law, Laws::Unit(law))) return;
      }
    }
  }
  const Eigen::JacobiSVD<System> svd(system, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const auto& values = svd.singularValues();
  Column inverses = Column::Zero();
  for (int i = 0; i < kMost; ++i) {
    if (values[i] > kSingular * values[0]) {
      inverses[i] = 1.0 / values[i];
    } else if (svd.matrixV().col(i).head(n).norm() > 1e-5) {
      return;  // The motion itself is open.
    }
  }
  inverse_ = svd.matrixV() * inverses.asDiagonal() * svd.matrixU().transpose();
  differentiable_ = inverse_.allFinite();
}

/// Change of a point's rates with the question, object and jaws keeping theirs.
DifferentiatedSpatialInstant::Laws DifferentiatedSpatialInstant::explicit_rates(
    const ContactPatch& patch, int i, const SpatialVariation& variation) const noexcept {
  const Vec3 shift(variation.x[i], variation.y[i], variation.z[i]);
  Vec3 w = answer_.V_HO.tail<3>();
  Vec3 v = Vec3::Zero();
  double spin = 0.0;
  if (patch.body == ContactBody::kPusher) {
    w -= problem_.V_HP.tail<3>();
    const Vec3 turn = variation.V_HP.tail<3>();
    v = -(variation.V_HP.head<3>() + turn.cross(problem_.p_HC(i)));
    spin = -patch.n.dot(turn);
  }
  v += w.cross(shift);
  Laws change;
  change << patch.n.dot(v), patch.t.dot(v), patch.o().dot(v), patch.spin_radius * spin;
  return change / units_.rate;
}

SpatialSensitivity DifferentiatedSpatialInstant::along(
    const SpatialVariation& variation) const noexcept {
  SpatialSensitivity change;
  if (!differentiable_) return change;
  const auto& [centre, length, force, rate] = units_;
  // Gravity and drives.
  Column right = Column::Zero();
  const Vec3 f_g = variation.w_g.head<3>();
  right.head<3>() = f_g / force;
  right.segment<3>(3) =
      (Vec3(variation.w_g.tail<3>()) - centre.cross(f_g)) / (force * length);
  SpatialProblem drive;
  drive.jaw_mode = problem_.jaw_mode;
  drive.grip_force = variation.grip_force;
  const JawFreedoms efforts = jaw_freedoms(drive);
  for (int k = 0; k < jaws_.count; ++k) right[6 + k] = efforts.effort[k] / force;

  // Of the pusher: wrench = constant part + by_unknowns x.
  Eigen::Matrix<double, kRates, kMost> by_unknowns;
  by_unknowns.setZero();
  Eigen::Matrix<double, kRates, 1> push = Eigen::Matrix<double, kRates, 1>::Zero();
  int row = kRates;
  for (int k = 0; k < problem_.patch_count; ++k) {
    const ContactPatch& patch = problem_.patch[k];
    for (int i = patch.first; i < patch.first + patch.count; ++i) {
      const Point point = point_at(patch, i);
      if (!point.loaded) continue;
      const Eigen::Matrix4d S = stiffness_of(point);
      const Laws rates = explicit_rates(patch, i, variation);
      Laws f = -S * rates;
      double normal = variation.preload[i] / force;
      if (point.springs) {
        normal +=
            point.c[0] / (point.R * point.R) * variation.compliance[k] * force / rate;
      } else if (patch.pressure == PressureLaw::kFree) {
        normal = 0.0;
      }
      f[0] += normal;
      f -= (variation.mu[k] * point.f[0] + point.mu * normal) * point.slip;
      Eigen::Matrix<double, kRates, 1> wrench = point.H.transpose() * f;
      const Vec3 carried =
          point.f[0] * patch.n + point.f[1] * patch.t + point.f[2] * patch.o();
      const Vec3 shift(variation.x[i], variation.y[i], variation.z[i]);
      wrench.segment<3>(3) += shift.cross(carried) / length;
      right.head<kRates>() += wrench;
      const bool pusher = patch.body == ContactBody::kPusher;
      if (pusher) {
        push += wrench;
        by_unknowns.leftCols<kRates>() -= point.H.transpose() * S * point.H;
      }
      const auto hold = [&](int law, const Laws& direction) {
        right[row] = -rates[law];
        if (pusher) by_unknowns.col(row) += point.H.transpose() * direction;
        ++row;
      };
      if (point.rigid) hold(0, Laws::Unit(0) - point.mu * point.slip);
      for (int law = 1; point.sticks && law < point.dimensions; ++law) {
        hold(law, Laws::Unit(law));
      }
    }
  }
  const Column x = inverse_ * right;
  const Vec3 w = rate / length * x.segment<3>(3);
  change.V_HO << rate * x.head<3>() - w.cross(centre), w;
  change.jaw_rate = {rate * x[6], rate * x[7]};
  push += by_unknowns * x;
  const Vec3 f_push = force * push.head<3>();
  change.w_push << f_push, force * length * push.segment<3>(3) + centre.cross(f_push);
  const Vec3 f = answer_.w_push.head<3>();
  change.push_force = f.squaredNorm() > 0.0 ? f.dot(f_push) / f.norm() : f_push.norm();
  return change;
}

SpatialVariation variation_between(const SpatialProblem& below,
                                   const SpatialProblem& above, double step) noexcept {
  SpatialVariation variation;
  const double per_step = 1.0 / step;
  for (int k = 0; k < above.patch_count; ++k) {
    const ContactPatch& low = below.patch[k];
    const ContactPatch& high = above.patch[k];
    variation.mu[k] = per_step * (high.mu - low.mu);
    variation.compliance[k] = per_step * (high.compliance - low.compliance);
  }
  for (int i = 0; i < above.count; ++i) {
    variation.preload[i] = per_step * (above.preload[i] - below.preload[i]);
    variation.x[i] = per_step * (above.x[i] - below.x[i]);
    variation.y[i] = per_step * (above.y[i] - below.y[i]);
    variation.z[i] = per_step * (above.z[i] - below.z[i]);
  }
  variation.grip_force = per_step * (above.grip_force - below.grip_force);
  variation.w_g = per_step * (above.w_g - below.w_g);
  variation.V_HP = per_step * (above.V_HP - below.V_HP);
  return variation;
}

SpatialVariation spatial_variation_of(const Model& model, const PushContact& contact,
                                      double place, const PlanarPose& X_HO,
                                      const SpatialTwist& V_HP,
                                      const SpatialQuestionOptions& options,
                                      InstantParameter parameter) {
  const auto question = [&](double step) {
    Model changed = model;
    PushContact pushed = contact;
    SpatialTwist V = V_HP;
    double at = place;
    Gripper& gripper = changed.scene.gripper;
    switch (parameter) {
      case InstantParameter::kFrictionJaw1:
        gripper.friction[0] += step;
        break;
      case InstantParameter::kFrictionJaw2:
        gripper.friction[1] += step;
        break;
      case InstantParameter::kGripForce:
        gripper.grip_force += step;
        break;
      case InstantParameter::kMass:
        changed.mass += step;
        break;
      case InstantParameter::kPusherFriction:
        pushed.mu += step;
        break;
      case InstantParameter::kPlace:
        at += step;
        break;
      case InstantParameter::kDirection:
        V.head<2>() = rotated(step, Vec2(V_HP.head<2>()));
        break;
      case InstantParameter::kCount:
        break;
    }
    changed.jaw_force = jaw_forces(gripper, changed.mass * changed.scene.g_Wz);
    return spatial_problem_at(changed, pushed, at, X_HO, V, options);
  };
  return variation_between(question(-kStep), question(kStep), 2.0 * kStep);
}

}  // namespace prehensile
