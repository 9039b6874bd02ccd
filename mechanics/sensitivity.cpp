#include "mechanics/sensitivity.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

namespace prehensile {
namespace {

constexpr double kTurnsAbout = 1e-7;  // a finger point this slow sticks: no derivative
constexpr double kSingular = 1e-11;   // pivot over the largest that counts as zero
constexpr double kPlaceStep = 1e-6;   // [m]

/// Friction of a finger point on the object, and its derivative by the twist.
void add_friction(const PlanarGrasp& grasp, int j, const PlanarTwist& u,
                  Eigen::Matrix3d& by_twist) {
  const Vec2 p(grasp.x[j], grasp.y[j]);
  const Vec2 c = point_velocity(u, p);
  const double speed = c.norm();
  const Vec2 across = perp(c / speed);
  const PlanarWrench w = wrench_of(p, across);  // also the rate along `across` by twist
  by_twist -= grasp.bound[j] / speed * w * w.transpose();
}

double push_rate(const PlanarDrive& drive) {
  double rate = 0.0;
  for (int i = 0; i < drive.count; ++i) {
    rate = std::max(rate, point_velocity(drive.V_HP, drive.p_HC[i]).norm());
  }
  return rate;
}

/// The greatest distance of a contact point from the finger axis [m].
double lever_of(const PlanarGrasp& grasp, const PlanarDrive& drive) {
  double lever = 0.0;
  for (int j = 0; j < grasp.count; ++j) {
    lever = std::max(lever, std::hypot(grasp.x[j], grasp.y[j]));
  }
  for (int i = 0; i < drive.count; ++i) lever = std::max(lever, drive.p_HC[i].norm());
  return lever;
}

}  // namespace

DifferentiatedInstant::DifferentiatedInstant(const PlanarGrasp& grasp,
                                             const PlanarDrive& drive,
                                             const PlanarInstant& answer) noexcept
    : grasp_(grasp), drive_(drive) {
  if (answer.status != InstantStatus::kMoves) return;
  u_ = answer.V_HO;
  w_push_ = answer.w_push;
  pusher_ = answer.pusher;
  const double slowest = kTurnsAbout * push_rate(drive);
  for (int j = 0; j < grasp.count; ++j) {
    if (!(point_velocity(u_, {grasp.x[j], grasp.y[j]}).norm() > slowest)) return;
  }
  add_rows();
  fill_system();
  mode_slack_ = nearest_mode_change();
}

/// Closed points keep their normal rate at zero, sticking ones their slip too. The slip
/// rates of both ends of a line are one number, and so are their forces' wrenches.
void DifferentiatedInstant::add_rows() noexcept {
  const Vec2 n = drive_.n_H;
  const Vec2 t = drive_.t_H();
  bool has_tangent = false;
  for (int i = 0; i < drive_.count; ++i) {
    const PusherPoint& point = pusher_[i];
    if (point.mode == ContactMode::kOpen) continue;
    const bool sticks = point.mode == ContactMode::kStick;
    const double ratio = sticks                                 ? 0.0
                         : point.mode == ContactMode::kSlipPlus ? -drive_.mu
                                                                : drive_.mu;
    rows_[row_count_] = {i, n};
    columns_[row_count_++] = wrench_of(drive_.p_HC[i], n + ratio * t);
    if (!sticks || has_tangent) continue;
    has_tangent = true;
    rows_[row_count_] = {i, t};
    columns_[row_count_++] = wrench_of(drive_.p_HC[i], t);
  }
}

/// The derivative of balance (3 rows) and of the rates that stay zero, by twist and
/// forces.
void DifferentiatedInstant::fill_system() noexcept {
  const int size = 3 + row_count_;
  System system = System::Identity();
  Eigen::Matrix3d by_twist = -grasp_.inertia;
  for (int j = 0; j < grasp_.count; ++j) add_friction(grasp_, j, u_, by_twist);
  system.topLeftCorner<3, 3>() = by_twist;
  for (int k = 0; k < row_count_; ++k) {
    system.block<3, 1>(0, 3 + k) = columns_[k];
    system.block<1, 3>(3 + k, 0) =
        wrench_of(drive_.p_HC[rows_[k].point], rows_[k].direction).transpose();
    system(3 + k, 3 + k) = 0.0;
  }
  // Forces and rates differ by orders: in units of the problem they do not.
  const double F0 = grasp_.capacity();
  const double V0 = push_rate(drive_);
  const double L0 = lever_of(grasp_, drive_);
  Column unknowns = Column::Ones();
  Column equations = Column::Ones();
  unknowns.head(size).setConstant(F0);
  unknowns.head<3>() << V0, V0, V0 / L0;
  equations.head(size).setConstant(1.0 / V0);
  equations.head<3>() << 1.0 / F0, 1.0 / F0, 1.0 / (F0 * L0);
  const System scaled = equations.asDiagonal() * system * unknowns.asDiagonal();
  const Eigen::FullPivLU<System> lu(scaled);
  const auto pivots = lu.matrixLU().diagonal().cwiseAbs();
  if (!(pivots.minCoeff() > kSingular * pivots.maxCoeff())) return;
  inverse_ = unknowns.asDiagonal() * lu.inverse() * equations.asDiagonal();
  differentiable_ = inverse_.allFinite();
}

double DifferentiatedInstant::nearest_mode_change() const noexcept {
  const double F0 = grasp_.capacity();
  const double V0 = push_rate(drive_);
  double slack = std::numeric_limits<double>::infinity();
  double normal = 0.0;
  double tangential = 0.0;
  bool sticks = false;
  for (int i = 0; i < drive_.count; ++i) {
    const PusherPoint& point = pusher_[i];
    if (point.mode == ContactMode::kOpen) {
      slack = std::min(slack, point.normal_rate / V0);
      continue;
    }
    slack = std::min(slack, point.normal_force / F0);
    normal += point.normal_force;
    tangential += point.tangential_force;
    sticks = sticks || point.mode == ContactMode::kStick;
    if (point.mode != ContactMode::kStick) {
      slack = std::min(slack, std::abs(point.slip_rate) / V0);
    }
  }
  if (sticks) slack = std::min(slack, (drive_.mu * normal - std::abs(tangential)) / F0);
  return slack;
}

PlanarSensitivity DifferentiatedInstant::along(
    const PlanarVariation& variation) const noexcept {
  PlanarSensitivity change;
  if (!differentiable_) return change;
  const Vec2 n = drive_.n_H;
  const Vec2 t = drive_.t_H();
  Column right = Column::Zero();  // minus the explicit change of every equation
  right.head<3>() = -variation.w_g;
  for (int j = 0; j < grasp_.count; ++j) {
    const Vec2 p(grasp_.x[j], grasp_.y[j]);
    const Vec2 c = point_velocity(u_, p);
    right.head<3>() += wrench_of(p, variation.bound[j] / c.norm() * c);
  }
  PlanarWrench explicit_push = PlanarWrench::Zero();
  for (int i = 0; i < drive_.count; ++i) {
    const PusherPoint& point = pusher_[i];
    const Vec2 f = point.normal_force * n + point.tangential_force * t;
    explicit_push[2] += cross(variation.p_HC[i], f);
    const double slip_sign = point.mode == ContactMode::kSlipPlus    ? -1.0
                             : point.mode == ContactMode::kSlipMinus ? 1.0
                                                                     : 0.0;
    explicit_push +=
        wrench_of(drive_.p_HC[i], slip_sign * variation.mu * point.normal_force * t);
  }
  right.head<3>() -= explicit_push;
  for (int k = 0; k < row_count_; ++k) {
    const int i = rows_[k].point;
    const Vec2 moved = (u_[2] - drive_.V_HP[2]) * perp(variation.p_HC[i]);
    right[3 + k] =
        rows_[k].direction.dot(point_velocity(variation.V_HP, drive_.p_HC[i]) - moved);
  }
  const Column x = inverse_ * right;
  change.V_HO = x.head<3>();
  change.w_push = explicit_push;
  for (int k = 0; k < row_count_; ++k) change.w_push += x[3 + k] * columns_[k];
  const Vec2 f = w_push_.head<2>();
  const Vec2 f_change = change.w_push.head<2>();
  change.push_force =
      f.squaredNorm() > 0.0 ? f.dot(f_change) / f.norm() : f_change.norm();
  return change;
}

std::string_view name(InstantParameter parameter) {
  switch (parameter) {
    case InstantParameter::kFrictionJaw1:
      return "friction of jaw 1";
    case InstantParameter::kFrictionJaw2:
      return "friction of jaw 2";
    case InstantParameter::kGripForce:
      return "grip force";
    case InstantParameter::kMass:
      return "mass";
    case InstantParameter::kPusherFriction:
      return "friction of the pusher";
    case InstantParameter::kPlace:
      return "place of the pusher";
    case InstantParameter::kDirection:
      return "direction of the push";
    case InstantParameter::kCount:
      break;
  }
  return "unknown";
}

std::string_view unit(InstantParameter parameter) {
  switch (parameter) {
    case InstantParameter::kGripForce:
      return "N";
    case InstantParameter::kMass:
      return "kg";
    case InstantParameter::kPlace:
      return "m";
    case InstantParameter::kDirection:
      return "rad";
    default:
      return "1";
  }
}

PlanarVariation variation_of(const Model& model, const PushContact& contact, double place,
                             const PlanarPose& X_HO, const PlanarTwist& V_HP,
                             InstantParameter parameter) noexcept {
  const PlanarGrasp grasp = grasp_at(model, X_HO, contact.g_O);
  const Gripper& gripper = model.scene.gripper;
  PlanarVariation variation;
  double bound_share = 0.0;
  switch (parameter) {
    case InstantParameter::kFrictionJaw1:
    case InstantParameter::kFrictionJaw2:
      bound_share = 1.0 / (gripper.friction[0] + gripper.friction[1]);
      break;
    case InstantParameter::kGripForce:
      bound_share = 1.0 / gripper.grip_force;
      break;
    case InstantParameter::kMass:
      variation.w_g = grasp.w_g / model.mass;
      break;
    case InstantParameter::kPusherFriction:
      variation.mu = 1.0;
      break;
    case InstantParameter::kPlace: {
      const PlanarDrive above = drive_at(contact, place + kPlaceStep, X_HO, V_HP);
      const PlanarDrive below = drive_at(contact, place - kPlaceStep, X_HO, V_HP);
      for (int i = 0; i < above.count; ++i) {
        variation.p_HC[i] = (above.p_HC[i] - below.p_HC[i]) / (2.0 * kPlaceStep);
      }
      break;
    }
    case InstantParameter::kDirection:
      variation.V_HP << perp(V_HP.head<2>()), 0.0;
      break;
    case InstantParameter::kCount:
      break;
  }
  for (int j = 0; j < grasp.count; ++j) variation.bound[j] = bound_share * grasp.bound[j];
  return variation;
}

}  // namespace prehensile
