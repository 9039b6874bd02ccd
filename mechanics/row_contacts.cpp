#include "mechanics/row_contacts.h"

#include <algorithm>

#include "mechanics/proximal_iteration.h"

namespace prehensile {
namespace {

constexpr int kBudget = 300;

using Matrix8 = Eigen::Matrix<double, 8, 8>;
using Forces = std::array<Vec3, RowProblem::kMaxContacts>;

struct RowUnits {
  double lever = 1.0;  ///< rate at a contact per rate of the system
  double force = 1.0;
  double rate = 1.0;  ///< at a contact
};

/// The problem in units in which rates, forces and inertia are of order one.
struct ScaledRows {
  RowProblem rows;
  RowUnits units;
};

bool is_from_zero(double x) { return std::isfinite(x) && x >= 0.0; }

bool is_posed(const RowProblem& p) {
  if (p.rates < 1 || p.rates > RowProblem::kMaxRates || p.count < 1 ||
      p.count > RowProblem::kMaxContacts) {
    return false;
  }
  if (!p.inertia.topLeftCorner(p.rates, p.rates).allFinite() ||
      !p.f.head(p.rates).allFinite()) {
    return false;
  }
  for (int i = 0; i < p.count; ++i) {
    if (!p.G[i].leftCols(p.rates).allFinite() || !p.b[i].allFinite() ||
        !is_from_zero(p.mu[i]) || !is_from_zero(p.compliance[i]) ||
        !is_from_zero(p.preload[i])) {
      return false;
    }
  }
  return true;
}

RowUnits units_of(const RowProblem& p) {
  RowUnits units;
  double lever = 0.0;
  double rate = 0.0;
  double load = 0.0;
  for (int i = 0; i < p.count; ++i) {
    lever = std::max(lever, p.G[i].leftCols(p.rates).norm());
    rate = std::max(rate, p.b[i].norm());
    load = std::max(load, p.preload[i]);
  }
  if (lever > 0.0) units.lever = lever;
  const double f = p.f.head(p.rates).norm() / units.lever;
  const double mass = p.inertia.topLeftCorner(p.rates, p.rates).trace() /
                      (p.rates * units.lever * units.lever);
  if (rate <= 0.0 && mass > 0.0) rate = f / mass;
  if (rate > 0.0) units.rate = rate;
  units.force = std::max({load, f, mass * units.rate});
  if (units.force <= 0.0) units.force = 1.0;
  return units;
}

void scale(const RowProblem& p, ScaledRows& scaled) {
  scaled.units = units_of(p);
  const auto& [lever, force, rate] = scaled.units;
  RowProblem& out = scaled.rows;
  out.rates = p.rates;
  out.count = p.count;
  out.inertia.setZero();
  out.inertia.topLeftCorner(p.rates, p.rates) =
      rate / (force * lever * lever) * p.inertia.topLeftCorner(p.rates, p.rates);
  out.f.setZero();
  out.f.head(p.rates) = p.f.head(p.rates) / (force * lever);
  for (int i = 0; i < p.count; ++i) {
    out.G[i].setZero();
    out.G[i].leftCols(p.rates) = p.G[i].leftCols(p.rates) / lever;
    out.b[i] = p.b[i] / rate;
    out.mu[i] = p.mu[i];
    out.compliance[i] = p.compliance[i] * force / rate;
    out.preload[i] = p.preload[i] / force;
  }
}

/// For the proximal iteration: `rows` in their units, with their force centres.
class RowContacts {
 public:
  explicit RowContacts(const RowProblem& rows) : rows_(rows) { reset(); }

  void reset() {
    for (int i = 0; i < rows_.count; ++i) centre_[i] = {rows_.preload[i], 0.0, 0.0};
  }
  void move_centres() { centre_ = force_; }
  const Forces& forces() const { return force_; }

  void add_forces(const SpatialRates& v, double r, SpatialRates& balance,
                  RateMatrix& jacobian) {
    for (int i = 0; i < rows_.count; ++i) {
      const RowProblem::Rows& G = rows_.G[i];
      const Eigen::Matrix3d stiffness = project(i, G * v + rows_.b[i], r);
      balance -= G.transpose() * force_[i];
      const RowProblem::Rows pulled = stiffness * G;
      jacobian += G.transpose() * pulled;
    }
  }

  double distance_from_laws(const SpatialRates& v) const {
    double worst = 0.0;
    for (int i = 0; i < rows_.count; ++i) {
      const Vec3& f = force_[i];
      const Vec3 u = rows_.G[i] * v + rows_.b[i];
      const double gap = u[0] + rows_.compliance[i] * (f[0] - rows_.preload[i]);
      worst = std::max(worst, std::abs(f[0] - std::max(0.0, f[0] - gap)));
      const Vec2 y = f.tail<2>() - u.tail<2>();
      const double share = std::min(1.0, rows_.mu[i] * f[0] / std::max(y.norm(), 1e-200));
      worst = std::max(worst, (f.tail<2>() - share * y).norm());
    }
    return worst;
  }

  double largest_force() const {
    double most = 0.0;
    for (int i = 0; i < rows_.count; ++i) most = std::max(most, force_[i][0]);
    return most;
  }

 private:
  /// The force at rates u, and - d force / d u.
  Eigen::Matrix3d project(int i, const Vec3& u, double r) {
    const double R = rows_.compliance[i];
    Vec3& f = force_[i];
    Eigen::Matrix3d stiffness = Eigen::Matrix3d::Zero();
    f.setZero();
    f[0] = std::max(0.0, (r * centre_[i][0] - u[0] + R * rows_.preload[i]) / (r + R));
    if (f[0] <= 0.0) return stiffness;
    stiffness(0, 0) = 1.0 / (r + R);
    const Vec2 y = centre_[i].tail<2>() - u.tail<2>() / r;
    const double size = y.norm();
    const double bound = rows_.mu[i] * f[0];
    if (size <= bound) {
      f.tail<2>() = y;
      stiffness(1, 1) = stiffness(2, 2) = 1.0 / r;
      return stiffness;
    }
    const Vec2 along = y / size;
    f.tail<2>() = bound * along;
    const Vec2 across = perp(along);
    stiffness.bottomRightCorner<2, 2>() =
        bound / (r * size) * across * across.transpose();
    stiffness.bottomLeftCorner<2, 1>() = rows_.mu[i] * stiffness(0, 0) * along;
    return stiffness;
  }

  const RowProblem& rows_;
  Forces centre_;
  Forces force_;
};

class RowSearch {
 public:
  RowSearch(const RowProblem& rows, const SpatialSolveOptions& options)
      : rows_(rows), options_(options), easier_(rows), contacts_(easier_) {}

  bool solve() {
    const std::array<ProximalStart, 8> starts = {{{},
                                                  {.r = 3.0},
                                                  {.r = 3.0, .e = 10.0},
                                                  {.e = 10.0, .pace = 30.0},
                                                  {.r = 3.0, .e = 0.1, .pace = 30.0},
                                                  {.r = 3.0, .pace = 1e-2},
                                                  {.r = 3.0, .pace = 1e-4},
                                                  {.r = 3.0, .pace = 1e3}}};
    for (const ProximalStart& start : starts) {
      contacts_.reset();
      if (attempt(start, options_.tolerance)) return true;
    }
    return approach_friction();
  }

  const NewtonResult& result() const { return result_; }
  const Forces& forces() const { return contacts_.forces(); }
  int steps() const { return steps_; }

 private:
  bool attempt(const ProximalStart& start, double tolerance) {
    const int last = std::min(options_.max_iterations, steps_ + kBudget);
    if (steps_ >= last) return false;
    const RateBalance balance{rows_.inertia, rows_.f, rows_.rates,
                              !rows_.inertia.isZero(0.0)};
    result_ = ProximalIteration(balance, contacts_).run(start, tolerance, last, steps_);
    return result_.converged;
  }

  /// From easier frictions, level by level.
  bool approach_friction() {
    const auto end = rows_.mu.begin() + rows_.count;
    const double most = *std::max_element(rows_.mu.begin(), end);
    ProximalStart start{.r = 3.0};
    contacts_.reset();
    double level = std::min(0.1, 0.1 * most);
    while (true) {
      for (int i = 0; i < rows_.count; ++i) {
        easier_.mu[i] = std::min(rows_.mu[i], level);
      }
      const bool last = level >= most;
      if (!attempt(start, last ? options_.tolerance : 1e-6)) return false;
      if (last) return true;
      contacts_.move_centres();
      start = {.v = result_.v, .r = 0.03};
      level = std::min(most, 1.25 * level);
    }
  }

  const RowProblem& rows_;
  const SpatialSolveOptions& options_;
  RowProblem easier_;  // the rows with some of their friction
  RowContacts contacts_;
  NewtonResult result_;
  int steps_ = 0;
};

}  // namespace

RowSolution solve_rows(const RowProblem& problem,
                       const SpatialSolveOptions& options) noexcept {
  RowSolution solution;
  if (!is_posed(problem)) {
    solution.status = InstantStatus::kBadInput;
    return solution;
  }
  ScaledRows scaled;
  scale(problem, scaled);
  RowSearch search(scaled.rows, options);
  const bool found = search.solve();
  solution.residual = search.result().residual;
  solution.iterations = search.steps();
  solution.status = found ? InstantStatus::kMoves : InstantStatus::kOutOfIterations;
  if (!found) return solution;
  solution.v = scaled.units.rate / scaled.units.lever * search.result().v;
  for (int i = 0; i < problem.count; ++i) {
    solution.r[i] = scaled.units.force * search.forces()[i];
  }
  return solution;
}

}  // namespace prehensile
