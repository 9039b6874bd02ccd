#include "mechanics/certificate_evidence.h"

#include <algorithm>

#include "mechanics/certificate.h"

namespace prehensile {
namespace {

constexpr double kClaimed = 1e-9;  ///< tolerance of inequalities in claims
constexpr double kAtRest = 1e-7;   ///< rates below this count as sticking, in units
constexpr double kFails = 1.0;     ///< the claim is false

double pad_capacity(const PlanarGrasp& grasp) {
  double sum = 0.0;
  for (int j = 0; j < grasp.count; ++j) sum += grasp.bound[j];
  return sum;
}

Vec2 velocity(const PlanarTwist& V, double x, double y) {
  return {V[0] - V[2] * y, V[1] + V[2] * x};
}

/// Sufficient for the pads to hold gravity: every point leans a share of its bound
/// against the force, and a share that grows with the lever against the moment.
bool clearly_held(const PlanarGrasp& grasp, const CertificateUnits& units) {
  double square = 0.0;
  double reach = 0.0;
  for (int j = 0; j < grasp.count; ++j) {
    const double r = (Vec2(grasp.x[j], grasp.y[j]) - units.centre).norm() / units.length;
    square += grasp.bound[j] / units.force * r * r;
    reach = std::max(reach, r);
  }
  const Vec3 w = units.scaled_wrench(grasp.w_g);
  const double force_share = w.head<2>().norm() * units.force / pad_capacity(grasp);
  return square > 0.0 && force_share + std::abs(w[2]) * reach / square < 1.0;
}

/// Least squares over friction sets by accelerated projected gradient: the wrenches that
/// a twist leaves open, driven to balance. A cold path, so simple beats fast.
class Balance {
 public:
  explicit Balance(const Vec3& rest) : rest_(rest) {}

  /// Adds a force with rows (2 x 3 wrench map) and its admissible set.
  enum class Set { kCone, kRayPlus, kRayMinus, kDisc };
  void add(const Eigen::Matrix<double, 3, 2>& map, Set set, double size) {
    if (count_ == kCapacity) return;
    forces_[count_++] = {map, set, size, Vec2::Zero(), Vec2::Zero()};
  }

  /// Prescribes the sum of the first components of the cone and ray forces.
  void prescribe_normal_sum(double sum) {
    prescribed_ = true;
    normal_sum_ = sum;
  }

  double least_violation() {
    double stiffness = prescribed_ ? count_ : 0.0;
    for (int i = 0; i < count_; ++i) stiffness += forces_[i].map.squaredNorm();
    if (count_ == 0) return violation();
    double momentum = 1.0;
    for (int step = 0; step < kSteps && violation() > kEnough; ++step) {
      const Vec3 gap = wrench(true);
      const double excess = normal_excess(true);
      const double next = 0.5 * (1.0 + std::sqrt(1.0 + 4.0 * momentum * momentum));
      const double carry = (momentum - 1.0) / next;
      double uphill = 0.0;
      for (int i = 0; i < count_; ++i) {
        Force& force = forces_[i];
        Vec2 gradient = force.map.transpose() * gap;
        if (prescribed_ && force.set != Set::kDisc) gradient.x() += excess;
        const Vec2 moved = projected(force, force.ahead - gradient / stiffness);
        uphill += (force.ahead - moved).dot(moved - force.now);
        force.ahead = moved + carry * (moved - force.now);
        force.now = moved;
      }
      momentum = next;
      if (uphill > 0.0) {  // Restart (O'Donoghue and Candes 2015).
        momentum = 1.0;
        for (int i = 0; i < count_; ++i) forces_[i].ahead = forces_[i].now;
      }
    }
    return violation();
  }

 private:
  static constexpr int kCapacity = PlanarGrasp::kCapacity + 2;
  static constexpr int kSteps = 20000;
  static constexpr double kEnough = 1e-10;

  struct Force {
    Eigen::Matrix<double, 3, 2> map;
    Set set;
    double size;  ///< friction coefficient, or radius of the disc
    Vec2 now, ahead;
  };

  static Vec2 onto_ray(const Vec2& y, const Vec2& direction) {
    return std::max(0.0, y.dot(direction)) / direction.squaredNorm() * direction;
  }

  static Vec2 projected(const Force& force, const Vec2& y) {
    switch (force.set) {
      case Set::kCone:
        if (std::abs(y.y()) <= force.size * y.x()) return y;
        return onto_ray(y, {1.0, std::copysign(force.size, y.y())});
      case Set::kRayPlus:
        return onto_ray(y, {1.0, force.size});
      case Set::kRayMinus:
        return onto_ray(y, {1.0, -force.size});
      case Set::kDisc:
        break;
    }
    const double length = y.norm();
    return length > force.size ? Vec2(force.size / length * y) : y;
  }

  Vec3 wrench(bool ahead) const {
    Vec3 sum = rest_;
    for (int i = 0; i < count_; ++i) {
      sum += forces_[i].map * (ahead ? forces_[i].ahead : forces_[i].now);
    }
    return sum;
  }

  double normal_excess(bool ahead) const {
    if (!prescribed_) return 0.0;
    double sum = -normal_sum_;
    for (int i = 0; i < count_; ++i) {
      if (forces_[i].set == Set::kDisc) continue;
      sum += ahead ? forces_[i].ahead.x() : forces_[i].now.x();
    }
    return sum;
  }

  double violation() const {
    return worse(wrench(false).norm(), std::abs(normal_excess(false)));
  }

  Vec3 rest_;
  int count_ = 0;
  std::array<Force, kCapacity> forces_;
  bool prescribed_ = false;
  double normal_sum_ = 0.0;
};

/// Wrench of a unit force along each of two directions at p.
Eigen::Matrix<double, 3, 2> force_map(const CertificateUnits& units, const Vec2& p,
                                      const Vec2& first, const Vec2& second) {
  const Vec2 r = (p - units.centre) / units.length;
  Eigen::Matrix<double, 3, 2> map;
  map << first.x(), second.x(),  //
      first.y(), second.y(),     //
      r.x() * first.y() - r.y() * first.x(), r.x() * second.y() - r.y() * second.x();
  return map;
}

bool parts_or_is_at_right_angles(const PlanarDrive& drive, const PlanarTwist& v,
                                 double mu) {
  for (int i = 0; i < drive.count; ++i) {
    const Vec2 rate = velocity(v, drive.p_HC[i].x(), drive.p_HC[i].y());
    const double opening = drive.n_H.dot(rate);
    const double slip = drive.t_H().dot(rate);
    const double size = v.head<2>().norm() + std::abs(v[2]) * drive.p_HC[i].norm();
    const double scale = size * std::sqrt(1.0 + mu * mu);
    if (opening - mu * std::abs(slip) < -kClaimed * scale) return false;
  }
  return true;
}

double dynamic_violation(const PlanarGrasp& grasp, const PlanarDrive& drive,
                         const PlanarTwist& v) {
  if (!v.allFinite()) return kNan;
  const double gain = grasp.w_g.dot(v) - friction_power(grasp, v);
  if (!(gain > 0.0)) return kFails;
  const bool cannot_be_held = parts_or_is_at_right_angles(drive, v, drive.mu);
  const bool falls_away = parts_or_is_at_right_angles(drive, v, 0.0);
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
    const PlanarTwist& v = answer.evidence;
    const double scale = units.force * units.rate * units.scaled_twist(v).norm();
    const double slack = friction_power(grasp, v) - grasp.w_g.dot(v);
    worst = worse(worst, slack / scale);
    shown = shown || scale > 0.0;
  }
  return shown ? worst : kFails;
}

double rest_violation(const PlanarDrive& drive, const PlanarInstant& answer,
                      const CertificateUnits& units) {
  double worst = units.scaled_twist(answer.V_HO).norm();
  const bool separated = answer.status == InstantStatus::kSeparated;
  for (int i = 0; i < drive.count; ++i) {
    const double load = answer.pusher[i].normal_force / units.force;
    if (separated) worst = worse(worst, std::abs(load));
  }
  return worst;
}

double interval_violation(const PlanarGrasp& grasp, const PlanarDrive& drive,
                          const PlanarInstant& answer, const CertificateUnits& units) {
  double sum = 0.0;
  for (int i = 0; i < drive.count; ++i) sum += answer.pusher[i].normal_force;
  const double below = (answer.force_low - sum) / units.force;
  const double above = (sum - answer.force_high) / units.force;
  const double low =
      motion_violation(grasp, drive, answer.V_HO, units, std::max(0.0, answer.force_low));
  const double high = motion_violation(grasp, drive, answer.V_HO, units,
                                       std::max(0.0, answer.force_high));
  return worse(worse(worse(below, above), worse(low, high)), 0.0);
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
  const bool is_point = grasp.count == 1 || units.length <= 1e-12 * distance;
  units.length = std::max(is_point ? 0.0 : units.length, 1e-3 * distance);
  if (units.length == 0.0) units.length = 1.0;
  units.sane = std::isfinite(units.rate) && units.rate > 0.0;
  return units;
}

double friction_power(const PlanarGrasp& grasp, const PlanarTwist& u) {
  double sum = 0.0;
  for (int j = 0; j < grasp.count; ++j) {
    sum += grasp.bound[j] * velocity(u, grasp.x[j], grasp.y[j]).norm();
  }
  return sum;
}

double motion_violation(const PlanarGrasp& grasp, const PlanarDrive& drive,
                        const PlanarTwist& V_HO, const CertificateUnits& units,
                        double normal_sum) {
  Balance balance(units.scaled_wrench(grasp.w_g - grasp.inertia * V_HO) + [&] {
    Vec3 fingers = Vec3::Zero();
    for (int j = 0; j < grasp.count; ++j) {
      const Vec2 rate = velocity(V_HO, grasp.x[j], grasp.y[j]);
      if (rate.norm() <= kAtRest * units.rate) continue;
      const Vec2 f = -grasp.bound[j] / (rate.norm() * units.force) * rate;
      fingers += force_map(units, {grasp.x[j], grasp.y[j]}, {1.0, 0.0}, {0.0, 1.0}) * f;
    }
    return fingers;
  }());
  double penetration = 0.0;
  for (int i = 0; i < drive.count; ++i) {
    const Vec2& p = drive.p_HC[i];
    const Vec2 rate = velocity(V_HO - drive.V_HP, p.x(), p.y()) / units.rate;
    const double opening = drive.n_H.dot(rate);
    const double slip = drive.t_H().dot(rate);
    penetration = worse(penetration, -opening);
    if (opening > kAtRest) continue;
    const Balance::Set set = std::abs(slip) <= kAtRest ? Balance::Set::kCone
                             : slip > 0.0              ? Balance::Set::kRayMinus
                                                       : Balance::Set::kRayPlus;
    balance.add(force_map(units, p, drive.n_H, drive.t_H()), set, drive.mu);
  }
  for (int j = 0; j < grasp.count; ++j) {
    const Vec2 rate = velocity(V_HO, grasp.x[j], grasp.y[j]);
    if (rate.norm() > kAtRest * units.rate) continue;
    balance.add(force_map(units, {grasp.x[j], grasp.y[j]}, {1.0, 0.0}, {0.0, 1.0}),
                Balance::Set::kDisc, grasp.bound[j] / units.force);
  }
  if (normal_sum >= 0.0) balance.prescribe_normal_sum(normal_sum / units.force);
  return worse(penetration, balance.least_violation());
}

double evidence_violation(const PlanarGrasp& grasp, const PlanarDrive& drive,
                          const PlanarInstant& answer, const CertificateUnits& units) {
  const auto held = [&] {
    if (!grasp.inertia.isZero(0.0) || clearly_held(grasp, units)) return 0.0;
    return gravity_slack(grasp) < -kClaimed ? kFails : 0.0;
  };
  switch (answer.status) {
    case InstantStatus::kMoves:
      return held();
    case InstantStatus::kHolds:
    case InstantStatus::kSeparated:
      return worse(held(), rest_violation(drive, answer, units));
    case InstantStatus::kNonuniqueForces:
      return worse(held(), interval_violation(grasp, drive, answer, units));
    case InstantStatus::kAmbiguous:
      return ambiguous_violation(grasp, drive, answer, units);
    case InstantStatus::kDynamic:
      return dynamic_violation(grasp, drive, answer.evidence);
    case InstantStatus::kJammed:  // Pads and one flat pusher cannot wedge an object.
    case InstantStatus::kNotRun:
    case InstantStatus::kOutOfIterations:
    case InstantStatus::kBadInput:
      break;
  }
  return kFails;
}

}  // namespace prehensile
