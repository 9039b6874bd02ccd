#include "mechanics/certificate_evidence.h"

#include <algorithm>

#include <Eigen/SVD>

#include "mechanics/certificate.h"

namespace prehensile {
namespace {

constexpr double kClaimed = 1e-9;   ///< tolerance of inequalities in claims
constexpr double kAtRest = 1e-7;    ///< rates below this count as sticking, in units
constexpr double kPivots = 1e-9;    ///< the same for finger points, relative to the pads
constexpr double kPointPad = 1e-6;  ///< pads this small count as one point, in units
constexpr double kFails = 1.0;      ///< the claim is false

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

/// Forces that a given twist leaves open, driven as close to balance as they go: a finger
/// point at rest takes any force within its bound, and the pusher's cones give multiples,
/// none negative, of at most four edges. The best multiples use linearly independent
/// edges, so all small subsets of edges are tried; each is a linear least-squares
/// problem.
class Balance {
 public:
  explicit Balance(const Vec3& rest) : rest_(rest) {}

  /// `wrench` comes with a normal force of 1.
  void add_edge(const Vec3& wrench) {
    const double size = wrench.norm();
    edges_[count_] = wrench / size;
    normals_[count_++] = 1.0 / size;
  }

  /// The finger point at rest: its lever and bound. Points in the same place add up.
  void add_pivot(const Vec2& lever, double bound) {
    if (has_pivot_ && (lever - pivot_).norm() > 4.0 * kPointPad) several_ = true;
    has_pivot_ = true;
    pivot_ = lever;
    bound_ += bound;
  }

  void prescribe_normal_sum(double sum) {
    prescribed_ = true;
    normal_sum_ = sum;
  }

  double least_violation() const {
    if (several_) return kFails;  // At rest: not another motion.
    double least = violation(Eigen::Vector4d::Zero());
    for (int subset = 1; subset < (1 << count_); ++subset) {
      least = std::min(least, violation(best_multiples(subset)));
    }
    return least;
  }

 private:
  /// Rows to be made small (first) and to be met (last), as functions of the multiples:
  /// without a pivot the whole wrench is to be small; with one, its moment about the
  /// pivot is to vanish and its force to stay within the bound.
  struct Rows {
    Eigen::Matrix<double, 4, 5> values = Eigen::Matrix<double, 4, 5>::Zero();
    int small = 0;
    int exact = 0;
  };

  Rows rows() const {
    Rows rows;
    Eigen::Matrix<double, 3, 5> wrenches;
    for (int k = 0; k < 4; ++k) wrenches.col(k) = k < count_ ? edges_[k] : Vec3::Zero();
    wrenches.col(4) = rest_;
    if (has_pivot_) {  // Moments about the pivot.
      wrenches.row(2) -= pivot_.x() * wrenches.row(1) - pivot_.y() * wrenches.row(0);
    }
    rows.values.topRows<3>() = wrenches;
    rows.small = has_pivot_ ? 2 : 3;
    rows.exact = has_pivot_ ? 1 : 0;
    if (prescribed_) {
      for (int k = 0; k < count_; ++k)
        rows.values(rows.small + rows.exact, k) = normals_[k];
      rows.values(rows.small + rows.exact, 4) = -normal_sum_;
      ++rows.exact;
    }
    return rows;
  }

  /// Least squares over the edges of a subset; rows to be met weigh more.
  Eigen::Vector4d best_multiples(int subset) const {
    const Rows all = rows();
    Eigen::Matrix4d matrix = all.values.leftCols<4>();
    Eigen::Vector4d right = -all.values.col(4);
    matrix.middleRows(all.small, all.exact) *= kWeight;
    right.segment(all.small, all.exact) *= kWeight;
    for (int k = 0; k < 4; ++k) {
      if (k >= count_ || (subset >> k & 1) == 0) matrix.col(k).setZero();
    }
    const Eigen::JacobiSVD<Eigen::Matrix4d> factors(
        matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
    return Eigen::Vector4d(factors.solve(right)).cwiseMax(0.0);
  }

  double violation(const Eigen::Vector4d& multiples) const {
    const Rows all = rows();
    const Eigen::Vector4d gap = all.values.leftCols<4>() * multiples + all.values.col(4);
    const double small = gap.head(all.small).norm();
    double worst = has_pivot_ ? std::max(0.0, small - bound_) : small;
    for (int k = 0; k < all.exact; ++k)
      worst = worse(worst, std::abs(gap[all.small + k]));
    return worst;
  }

  static constexpr double kWeight = 1e4;

  Vec3 rest_;
  int count_ = 0;
  std::array<Vec3, 4> edges_;
  std::array<double, 4> normals_{};
  bool has_pivot_ = false;
  bool several_ = false;
  Vec2 pivot_ = Vec2::Zero();
  double bound_ = 0.0;
  bool prescribed_ = false;
  double normal_sum_ = 0.0;
};

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

double dynamic_violation(const PlanarGrasp& grasp, const PlanarDrive& drive,
                         const PlanarTwist& v, const CertificateUnits& units) {
  if (!v.allFinite()) return kNan;
  const double gain = grasp.w_g.dot(v) - friction_power(grasp, v);
  if (!(gain > 0.0)) return kFails;
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

/// The ends of the interval are extreme, where balance is hard to find; forces within a
/// thousandth of its length from them must occur.
double interval_violation(const PlanarGrasp& grasp, const PlanarDrive& drive,
                          const PlanarInstant& answer, const CertificateUnits& units) {
  double sum = 0.0;
  for (int i = 0; i < drive.count; ++i) sum += answer.pusher[i].normal_force;
  const double below = (answer.force_low - sum) / units.force;
  const double above = (sum - answer.force_high) / units.force;
  if (std::isnan(below) || std::isnan(above)) return kNan;
  const double inward = 1e-3 * (answer.force_high - answer.force_low);
  double worst = std::max({0.0, below, above});
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
  const double lever = is_point ? 4.0 * kPointPad / kPivots * units.length : units.lever;
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
  Balance balance(moving_wrench(grasp, V_HO, units));
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
