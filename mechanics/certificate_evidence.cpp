#include "mechanics/certificate_evidence.h"

#include <algorithm>
#include <limits>

#include "mechanics/certificate.h"
#include "mechanics/cone_balance.h"

namespace prehensile {
namespace {

constexpr double kGains = 1e-12;     ///< gains of power below this are rounding, relative
constexpr double kAdvances = 5e-14;  ///< the same for rates of the pusher
constexpr double kRounding = 4e-15;  ///< of a velocity, relative to its summands
constexpr double kPivots = 1e-9;     ///< the same for finger points, relative to the pads
constexpr double kPointPad = 1e-6;   ///< pads this small count as one point, in units

double pad_capacity(const PlanarGrasp& grasp) {
  double sum = 0.0;
  for (int j = 0; j < grasp.count; ++j) sum += grasp.bound[j];
  return sum;
}

Vec2 velocity(const PlanarTwist& V, double x, double y) {
  return {V[0] - V[2] * y, V[1] + V[2] * x};
}

/// Wrench of a force at p.
Vec3 wrench_at(const CertificateUnits& units, const Vec2& p, const Vec2& f) {
  const Vec2 r = (p - units.centre) / units.length;
  return {f.x(), f.y(), r.x() * f.y() - r.y() * f.x()};
}

/// No force of a pusher with friction mu works against v.
bool is_unopposed(const PlanarDrive& drive, const PlanarTwist& v, double mu,
                  const CertificateUnits& units) {
  for (int i = 0; i < drive.count; ++i) {
    const Vec2 rate = velocity(v, drive.p_HC[i].x(), drive.p_HC[i].y());
    const double opening = drive.n_H.dot(rate);
    const double slip = drive.t_H().dot(rate);
    const double lever = units.length + (drive.p_HC[i] - units.centre).norm();
    const double size =
        velocity(v, units.centre.x(), units.centre.y()).norm() + std::abs(v[2]) * lever;
    const double scale = size * std::sqrt(1.0 + mu * mu);
    if (opening - mu * std::abs(slip) < -kClaimed * scale) return false;
  }
  return true;
}

/// The twist at unit size: squares of tiny rates would vanish. NaN if it has none.
Vec3 unit_twist(const PlanarTwist& v, const CertificateUnits& units) {
  const Vec3 scaled = units.scaled_twist(v);
  return (scaled / scaled.cwiseAbs().maxCoeff()).normalized();
}

/// Power that gravity gains over the pads by this twist of unit size, in units.
double gain_of(const PlanarGrasp& grasp, const Vec3& v, const CertificateUnits& units) {
  const double taken = friction_power(grasp, units.twist(v)) / (units.force * units.rate);
  return units.scaled_wrench(grasp.w_g).dot(v) - taken;
}

double dynamic_violation(const PlanarGrasp& grasp, const PlanarDrive& drive,
                         const PlanarTwist& evidence, const CertificateUnits& units) {
  if (!evidence.allFinite()) return kNan;
  const Vec3 unit = unit_twist(evidence, units);
  const double least = kGains * units.scaled_wrench(grasp.w_g).norm();
  if (!(gain_of(grasp, unit, units) > least)) return kFails;
  const PlanarTwist v = units.twist(unit);
  const bool cannot_be_held = is_unopposed(drive, v, drive.mu, units);
  const bool falls_away = is_unopposed(drive, v, 0.0, units);
  return cannot_be_held || falls_away ? 0.0 : kFails;
}

double ambiguous_violation(const PlanarGrasp& grasp, const PlanarDrive& drive,
                           const PlanarInstant& answer, const CertificateUnits& units) {
  double worst = 0.0;
  bool shown = false;
  if (answer.other.allFinite()) {
    const double distance = units.scaled_twist(answer.other - answer.V_HO).norm();
    shown = distance > 1e-8 * (1.0 + units.scaled_twist(answer.V_HO).norm());
    worst = motion_violation(grasp, drive, answer.other, units);
  }
  if (answer.evidence.allFinite()) {
    worst = worse(worst, -gain_of(grasp, unit_twist(answer.evidence, units), units));
    shown = true;
  }
  return shown ? worst : kFails;
}

/// The ends of the interval are extreme, where balance is hard to find; forces within a
/// thousandth of its length from them must occur.
double interval_violation(const PlanarGrasp& grasp, const PlanarDrive& drive,
                          const PlanarInstant& answer, const CertificateUnits& units) {
  double sum = 0.0;
  for (int i = 0; i < drive.count; ++i) sum += answer.pusher[i].normal_force;
  const double below = (answer.force_low - sum) / units.force;
  const double above = (sum - answer.force_high) / units.force;
  const double inward = 1e-3 * (answer.force_high - answer.force_low);
  double worst = worst_of({below, above});
  for (const double end : {answer.force_low + inward, answer.force_high - inward}) {
    worst = worse(worst, -end / units.force);
    worst = worse(worst,
                  motion_violation(grasp, drive, answer.V_HO, units, std::max(0.0, end)));
  }
  return worst;
}

}  // namespace

Vec3 CertificateUnits::scaled_wrench(const PlanarWrench& w) const {
  const double about_centre = w[2] - (centre.x() * w[1] - centre.y() * w[0]);
  return {w[0] / force, w[1] / force, about_centre / (force * length)};
}

Vec3 CertificateUnits::scaled_twist(const PlanarTwist& V) const {
  const Vec2 v = velocity(V, centre.x(), centre.y()) / rate;
  return {v.x(), v.y(), V[2] * length / rate};
}

PlanarTwist CertificateUnits::twist(const Vec3& scaled) const {
  const double omega = scaled[2] * rate / length;
  return {scaled[0] * rate + omega * centre.y(), scaled[1] * rate - omega * centre.x(),
          omega};
}

CertificateUnits pad_units(const PlanarGrasp& grasp) {
  CertificateUnits units;
  const bool filled = grasp.count > 0 && grasp.count <= PlanarGrasp::kCapacity;
  const double capacity = filled ? pad_capacity(grasp) : 0.0;
  if (!(capacity > 0.0) || !grasp.w_g.allFinite()) return units;
  for (int j = 0; j < grasp.count; ++j) {
    units.centre += grasp.bound[j] / capacity * Vec2(grasp.x[j], grasp.y[j]);
  }
  double square = 0.0;
  for (int j = 0; j < grasp.count; ++j) {
    const Vec2 r = Vec2(grasp.x[j], grasp.y[j]) - units.centre;
    units.lever += grasp.bound[j] / capacity * r.norm();
    square += grasp.bound[j] / capacity * r.squaredNorm();
  }
  units.force = std::max(capacity, grasp.w_g.head<2>().norm());
  units.length = square > 0.0 ? std::sqrt(square) : 1.0;
  units.rate = 1.0;
  units.sane = std::isfinite(units.force) && std::isfinite(units.length);
  return units;
}

CertificateUnits certificate_units(const PlanarGrasp& grasp, const PlanarDrive& drive) {
  CertificateUnits units = pad_units(grasp);
  units.sane = units.sane && drive.count >= 1 && drive.count <= 2 && drive.mu >= 0.0;
  if (!units.sane) return units;
  const PlanarWrench driven = grasp.inertia * drive.V_HP;
  units.force = std::max(units.force, driven.head<2>().norm());
  units.rate = 0.0;
  double distance = 0.0;
  for (int i = 0; i < drive.count; ++i) {
    const Vec2& p = drive.p_HC[i];
    distance = std::max(distance, (p - units.centre).norm());
    units.rate = std::max(units.rate, velocity(drive.V_HP, p.x(), p.y()).norm());
  }
  const bool is_point = units.lever <= 1e-12 * distance;
  units.length = std::max(is_point ? 0.0 : units.length, 1e-3 * distance);
  if (units.length == 0.0) units.length = 1.0;
  units.sane = std::isfinite(units.rate) && units.rate > 0.0;
  return units;
}

double motion_claim_violation(const PlanarDrive& drive, const PlanarInstant& answer,
                              double size, double force, double rate) {
  double advance = -std::numeric_limits<double>::infinity();
  double summands = 0.0;
  double load = 0.0;
  for (int i = 0; i < drive.count; ++i) {
    const Vec2& p = drive.p_HC[i];
    const double turning = std::abs(drive.V_HP[2]) * p.norm();
    summands = worse(summands, (drive.V_HP.head<2>().norm() + turning) / rate);
    const Vec2 v = velocity(drive.V_HP, p.x(), p.y());
    advance = worse(advance, drive.n_H.dot(v) / rate);
    load = worse(load, std::abs(answer.pusher[i].normal_force) / force);
  }
  switch (answer.status) {
    case InstantStatus::kHolds:  // The pusher slides along the object.
      return worse(size, std::abs(advance));
    case InstantStatus::kSeparated:
      return worse(size, load);
    default:
      break;
  }
  // What moves is pushed: it would rest if the pusher did not advance.
  const bool moves = size > kClaimed || advance > kAdvances - kRounding * summands;
  return moves && advance >= -kClaimed ? 0.0 : kFails;
}

double mislabelled(const PusherPoint& point, double normal, double opening, double slip) {
  switch (point.mode) {
    case ContactMode::kOpen:
      return std::abs(normal);
    case ContactMode::kStick:
      return worse(std::abs(opening), std::abs(slip));
    case ContactMode::kSlipPlus:
      return worse(std::abs(opening), -slip);
    case ContactMode::kSlipMinus:
      return worse(std::abs(opening), slip);
    case ContactMode::kSlip:
      break;
  }
  return kFails;
}

double friction_power(const PlanarGrasp& grasp, const PlanarTwist& u) {
  double sum = 0.0;
  for (int j = 0; j < grasp.count; ++j) {
    sum += grasp.bound[j] * velocity(u, grasp.x[j], grasp.y[j]).norm();
  }
  return sum;
}

namespace {

/// Speed below which a finger point is the centre of rotation.
double pivot_speed(const PlanarTwist& V_HO, const CertificateUnits& units) {
  const Vec2 v = velocity(V_HO, units.centre.x(), units.centre.y());
  const bool is_point = units.lever <= kPointPad * units.length;
  const double lever =
      is_point ? ConeBalance::kOnePoint / kPivots * units.length : units.lever;
  return kPivots * (v.norm() + std::abs(V_HO[2]) * lever);
}

/// Gravity, inertia, and friction of the finger points that move.
Vec3 moving_wrench(const PlanarGrasp& grasp, const PlanarTwist& V_HO,
                   const CertificateUnits& units) {
  Vec3 sum = units.scaled_wrench(grasp.w_g - grasp.inertia * V_HO);
  for (int j = 0; j < grasp.count; ++j) {
    const Vec2 rate = velocity(V_HO, grasp.x[j], grasp.y[j]);
    const double speed = rate.norm();
    if (speed <= pivot_speed(V_HO, units)) continue;
    const Vec2 f = -grasp.bound[j] / (speed * units.force) * rate;
    sum += wrench_at(units, {grasp.x[j], grasp.y[j]}, f);
  }
  return sum;
}

}  // namespace

double motion_violation(const PlanarGrasp& grasp, const PlanarDrive& drive,
                        const PlanarTwist& V_HO, const CertificateUnits& units,
                        double normal_sum) {
  ConeBalance balance(moving_wrench(grasp, V_HO, units));
  double penetration = 0.0;
  for (int i = 0; i < drive.count; ++i) {
    const Vec2& p = drive.p_HC[i];
    const Vec2 rate = velocity(V_HO - drive.V_HP, p.x(), p.y()) / units.rate;
    const double opening = drive.n_H.dot(rate);
    const double slip = drive.t_H().dot(rate);
    penetration = worse(penetration, -opening);
    if (opening > kAtRest) continue;
    for (const double side : {1.0, -1.0}) {  // Friction along -t and along +t.
      if (slip * side < -kAtRest) continue;
      const Vec2 f = drive.n_H - side * drive.mu * drive.t_H();
      balance.add_edge(wrench_at(units, p, f));
    }
  }
  for (int j = 0; j < grasp.count; ++j) {
    const Vec2 p(grasp.x[j], grasp.y[j]);
    if (velocity(V_HO, p.x(), p.y()).norm() > pivot_speed(V_HO, units)) continue;
    balance.add_pivot((p - units.centre) / units.length, grasp.bound[j] / units.force);
  }
  if (normal_sum >= 0.0) balance.prescribe_normal_sum(normal_sum / units.force);
  return worse(penetration, balance.least_violation());
}

double evidence_violation(const PlanarGrasp& grasp, const PlanarDrive& drive,
                          const PlanarInstant& answer, const CertificateUnits& units) {
  const auto held_and_claimed = [&] {
    if (!grasp.inertia.isZero(0.0)) return 0.0;
    if (!gravity_slack_exceeds(grasp, -kClaimed)) return kFails;
    const double size = units.scaled_twist(answer.V_HO).norm();
    return motion_claim_violation(drive, answer, size, units.force, units.rate);
  };
  switch (answer.status) {
    case InstantStatus::kMoves:
    case InstantStatus::kHolds:
    case InstantStatus::kSeparated:
      return held_and_claimed();
    case InstantStatus::kNonuniqueForces:
      return worse(held_and_claimed(), interval_violation(grasp, drive, answer, units));
    case InstantStatus::kAmbiguous:
      return ambiguous_violation(grasp, drive, answer, units);
    case InstantStatus::kDynamic:
      return dynamic_violation(grasp, drive, answer.evidence, units);
    case InstantStatus::kJammed:  // Pads and one flat pusher cannot wedge an object.
    case InstantStatus::kNotRun:
    case InstantStatus::kOutOfIterations:
    case InstantStatus::kBadInput:
      break;
  }
  return kFails;
}

}  // namespace prehensile
