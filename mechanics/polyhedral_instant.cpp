#include "mechanics/polyhedral_instant.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/LU>

namespace prehensile {
namespace {

constexpr double kSides[2] = {1.0, -1.0};  // generators of a pusher point: +t and -t

Vec2 centre_of(const PlanarGrasp& grasp) {
  Vec2 sum = Vec2::Zero();
  for (int j = 0; j < grasp.count; ++j) {
    sum += grasp.bound[j] * Vec2(grasp.x[j], grasp.y[j]);
  }
  return sum / grasp.capacity();
}

/// Length: root mean square lever of the friction bounds about their centre; for a pad
/// that is one point, the distance to the pusher. Rate: the faster pusher point.
PlanarUnits units_of(const PlanarGrasp& grasp, const PlanarDrive& drive,
                     const Vec2& centre) {
  PlanarUnits units;
  double moment = 0.0;
  for (int j = 0; j < grasp.count; ++j) {
    moment += grasp.bound[j] * (Vec2(grasp.x[j], grasp.y[j]) - centre).squaredNorm();
  }
  double reach = 0.0;
  for (int i = 0; i < drive.count; ++i) {
    reach = std::max(reach, (drive.p_HC[i] - centre).norm());
    units.rate = std::max(units.rate, point_velocity(drive.V_HP, drive.p_HC[i]).norm());
  }
  const double lever = std::sqrt(moment / grasp.capacity());
  units.length = lever > 1e-9 * reach ? lever : reach;
  units.force = std::max(grasp.capacity(), grasp.w_g.head<2>().norm());
  return units;
}

/// Moves the reference point of a twist or a wrench by `by`: to the body point there.
PlanarTwist twist_at(const PlanarTwist& V, const Vec2& by) {
  const Vec2 v = point_velocity(V, by);
  return {v.x(), v.y(), V[2]};
}

PlanarWrench wrench_at(const PlanarWrench& w, const Vec2& by) {
  return {w[0], w[1], w[2] - cross(by, w.head<2>())};
}

bool allows_answer(const PlanarGrasp& grasp, const PlanarDrive& drive) {
  bool finite = grasp.w_g.allFinite() && grasp.inertia.allFinite() &&
                drive.V_HP.allFinite() && drive.n_H.allFinite() &&
                std::isfinite(drive.mu) && std::isfinite(grasp.capacity());
  for (int i = 0; i < drive.count; ++i) finite = finite && drive.p_HC[i].allFinite();
  for (int j = 0; j < grasp.count; ++j) {
    finite = finite && std::isfinite(grasp.x[j]) && std::isfinite(grasp.y[j]);
  }
  return finite && grasp.capacity() > 0.0 && drive.mu >= 0.0;
}

bool is_finite(const PolyhedralAnswer& a) {
  return a.u.allFinite() && std::isfinite(a.lambda_n[0] + a.lambda_n[1]) &&
         std::isfinite(a.lambda_t[0] + a.lambda_t[1]) &&
         std::all_of(a.f.begin(), a.f.end(), [](const Vec2& f) { return f.allFinite(); });
}

double imbalance(const PolyhedralInstant& q, const PolyhedralAnswer& a) {
  PlanarWrench w = q.w_g - q.inertia * a.u;
  for (std::size_t j = 0; j < q.r.size(); ++j) w += wrench_of(q.r[j], a.f[j]);
  for (int i = 0; i < q.pushers; ++i) {
    w += wrench_of(q.p[i], a.lambda_n[i] * q.n + a.lambda_t[i] * q.t);
  }
  return w.cwiseAbs().maxCoeff();
}

/// The two generators between which f points and their shares: the betas of least sum.
struct Betas {
  std::array<int, 2> k;
  std::array<double, 2> beta;
};

Betas betas_of(const PolyhedralInstant& q, const Vec2& f) {
  const int g = static_cast<int>(q.d.size());
  const double turn = std::atan2(f.y(), f.x()) * g / (2.0 * std::numbers::pi);
  const int k = (static_cast<int>(std::floor(turn)) + g) % g;
  const int next = (k + 1) % g;
  const double area = cross(q.d[k], q.d[next]);
  return {{k, next}, {cross(f, q.d[next]) / area, cross(q.d[k], f) / area}};
}

double finger_residual(const PolyhedralInstant& q, const PolyhedralAnswer& a, int j) {
  const Vec2 c = point_velocity(a.u, q.r[j]);
  const double xi = q.gauge(c);
  const Betas betas = betas_of(q, a.f[j]);
  double worst = std::abs(std::min(xi, q.bound[j] - betas.beta[0] - betas.beta[1]));
  for (int side = 0; side < 2; ++side) {
    const double slack = xi + q.d[betas.k[side]].dot(c);
    worst = std::max(worst, std::abs(std::min(betas.beta[side], slack)));
  }
  return worst;
}

double pusher_residual(const PolyhedralInstant& q, const PolyhedralAnswer& a, int i) {
  const Vec2 rate = q.pusher_rate(i, a.u);
  const double xi = std::abs(rate.y());
  const double cone = q.mu * a.lambda_n[i] - std::abs(a.lambda_t[i]);
  double worst =
      std::max(std::abs(std::min(a.lambda_n[i], rate.x())),
               q.mu > 0.0 ? std::abs(std::min(xi, cone)) : std::abs(a.lambda_t[i]));
  for (const double side : kSides) {
    const double beta = std::max(0.0, side * a.lambda_t[i]);
    worst = std::max(worst, std::min(beta, xi + side * rate.y()));
  }
  return worst;
}

/// Adds factor * (velocity of the point at r along e) to a row.
void add_velocity(int row, const Vec2& r, const Vec2& e,
                  ComplementarityProblem& problem) {
  problem.add(row, 0, e.x());
  problem.add(row, 1, e.y());
  problem.add(row, 2, cross(r, e));
}

/// Adds the wrench of a unit force e at r, times an unknown, to the rows of eq. (8).
void add_force(int unknown, const Vec2& r, const Vec2& e,
               ComplementarityProblem& problem) {
  const PlanarWrench w = wrench_of(r, e);
  for (int row = 0; row < 3; ++row) problem.add(row, unknown, w[row]);
}

void add_balance(const PolyhedralInstant& q, ComplementarityProblem& problem) {
  for (int axis = 0; axis < 3; ++axis) {
    const int row = problem.add_row(ComplementarityProblem::kEquality, q.w_g[axis]);
    for (int k = 0; k < 3; ++k) problem.add(row, k, -q.inertia(axis, k));
  }
}

void add_pusher(const PolyhedralInstant& q, const PolyhedralUnknowns& z, int i,
                ComplementarityProblem& problem) {
  const Vec2 prescribed = point_velocity(q.V_HP, q.p[i]);
  add_force(z.lambda_n(i), q.p[i], q.n, problem);
  const int gap = problem.add_row(z.lambda_n(i), -q.n.dot(prescribed));
  add_velocity(gap, q.p[i], q.n, problem);
  if (!z.pusher_friction) return;

  const int cone = problem.add_row(z.pusher_xi(i), 0.0);
  problem.add(cone, z.lambda_n(i), q.mu);
  for (int side = 0; side < 2; ++side) {
    const int beta = z.pusher_beta(i, side);
    const Vec2 e = kSides[side] * q.t;
    add_force(beta, q.p[i], e, problem);
    problem.add(cone, beta, -1.0);
    const int slip = problem.add_row(beta, -e.dot(prescribed));
    problem.add(slip, z.pusher_xi(i), 1.0);
    add_velocity(slip, q.p[i], e, problem);
  }
}

void add_finger_point(const PolyhedralInstant& q, const PolyhedralUnknowns& z, int j,
                      ComplementarityProblem& problem) {
  const int cone = problem.add_row(z.xi(j), q.bound[j]);
  for (int k = 0; k < z.generators; ++k) {
    add_force(z.beta(j, k), q.r[j], q.d[k], problem);
    problem.add(cone, z.beta(j, k), -1.0);
    const int slip = problem.add_row(z.beta(j, k), 0.0);
    problem.add(slip, z.xi(j), 1.0);
    add_velocity(slip, q.r[j], q.d[k], problem);
  }
}

}  // namespace

Vec2 PolyhedralInstant::pusher_rate(int i, const PlanarTwist& u) const {
  const Vec2 c = point_velocity(u - V_HP, p[i]);
  return {n.dot(c), t.dot(c)};
}

PlanarTwist PolyhedralInstant::twist_in_hand(const PlanarTwist& u) const {
  return twist_at(units.rate * PlanarTwist(u[0], u[1], u[2] / units.length), -centre);
}

PlanarWrench PolyhedralInstant::wrench_in_hand(const PlanarWrench& w) const {
  return wrench_at(units.force * PlanarWrench(w[0], w[1], w[2] * units.length), -centre);
}

double PolyhedralInstant::gauge(const Vec2& c) const {
  double largest = 0.0;
  for (const Vec2& e : d) largest = std::max(largest, -e.dot(c));
  return largest;
}

PolyhedralUnknowns::PolyhedralUnknowns(const PolyhedralInstant& instant)
    : pushers(instant.pushers),
      points(static_cast<int>(instant.r.size())),
      generators(static_cast<int>(instant.d.size())),
      pusher_friction(instant.mu > 0.0),
      fingers_from(3 + (pusher_friction ? 4 : 1) * pushers),
      count(fingers_from + points * (generators + 1)) {}

bool pose_polyhedral(const PlanarGrasp& grasp, const PlanarDrive& drive, int generators,
                     PolyhedralInstant& q) {
  if (generators < 4 || generators > 64 || generators % 2 != 0) return false;
  if (!allows_answer(grasp, drive)) return false;
  q.centre = centre_of(grasp);
  q.units = units_of(grasp, drive, q.centre);
  if (!(q.units.rate > 0.0) || !(q.units.length > 0.0)) return false;

  for (int k = 0; k < generators; ++k) {
    q.d.push_back(rotated(2.0 * std::numbers::pi * k / generators, {1.0, 0.0}));
  }
  const auto scaled = [&q](const Vec2& p) { return (p - q.centre) / q.units.length; };
  for (int j = 0; j < grasp.count; ++j) {
    q.r.push_back(scaled({grasp.x[j], grasp.y[j]}));
    q.bound.push_back(grasp.bound[j] / q.units.force);
  }
  q.pushers = drive.count;
  for (int i = 0; i < drive.count; ++i) q.p[i] = scaled(drive.p_HC[i]);
  q.n = drive.n_H;
  q.t = drive.t_H();
  q.mu = drive.mu;

  const Vec3 lengths(1.0, 1.0, q.units.length);
  q.V_HP = twist_at(drive.V_HP, q.centre).cwiseProduct(lengths) / q.units.rate;
  q.w_g = wrench_at(grasp.w_g, q.centre).cwiseQuotient(lengths) / q.units.force;
  // T: twist about the centre, in units, to the twist about the origin of H.
  Eigen::Matrix3d T;
  for (int k = 0; k < 3; ++k) T.col(k) = q.twist_in_hand(PlanarTwist::Unit(k));
  q.inertia = T.transpose() * grasp.inertia * T / (q.units.force * q.units.rate);
  return true;
}

ComplementarityProblem complementarity_of(const PolyhedralInstant& q) {
  const PolyhedralUnknowns z(q);
  ComplementarityProblem problem;
  problem.variables = z.count;
  add_balance(q, problem);
  for (int i = 0; i < z.pushers; ++i) add_pusher(q, z, i, problem);
  for (int j = 0; j < z.points; ++j) add_finger_point(q, z, j, problem);
  return problem;
}

PolyhedralAnswer answer_of(const PolyhedralInstant& q, std::span<const double> values) {
  const PolyhedralUnknowns z(q);
  PolyhedralAnswer answer;
  answer.u = {values[0], values[1], values[2]};
  for (int i = 0; i < z.pushers; ++i) {
    answer.lambda_n[i] = values[z.lambda_n(i)];
    if (!z.pusher_friction) continue;
    for (int side = 0; side < 2; ++side) {
      answer.lambda_t[i] += kSides[side] * values[z.pusher_beta(i, side)];
    }
  }
  answer.f.assign(z.points, Vec2::Zero());
  for (int j = 0; j < z.points; ++j) {
    for (int k = 0; k < z.generators; ++k) answer.f[j] += values[z.beta(j, k)] * q.d[k];
  }
  return answer;
}

double residual_of(const PolyhedralInstant& q, const PolyhedralAnswer& answer) {
  if (!is_finite(answer)) return kUnbounded;
  double worst = imbalance(q, answer);
  for (std::size_t j = 0; j < q.r.size(); ++j) {
    worst = std::max(worst, finger_residual(q, answer, static_cast<int>(j)));
  }
  for (int i = 0; i < q.pushers; ++i) {
    worst = std::max(worst, pusher_residual(q, answer, i));
  }
  return worst;
}

}  // namespace prehensile
