/// The proximal semismooth Newton iteration in at most eight rates, whatever the contacts
/// are. Internal to the mechanics layer.
///
/// `Contacts` knows the laws and the force centres:
///   void add_forces(v, r, balance, jacobian)   projects all forces at rates v with the
///       proximal step r, subtracts them from the balance, adds their stiffness
///   void move_centres()                        centres become the forces found
///   double distance_from_laws(v) const         of forces and rates, whatever the centres
///   double largest_force() const               normal
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "mechanics/spatial_instant.h"

namespace prehensile {

using RateMatrix = Eigen::Matrix<double, 8, 8, Eigen::RowMajor>;

/// M v = f + forces, in units of the problem.
struct RateBalance {
  const Eigen::Matrix<double, 8, 8>& M;
  const SpatialRates& f;
  int freedoms;
  bool has_inertia;
};

/// Rates at which a run starts, and its proximal steps.
struct ProximalStart {
  SpatialRates v = SpatialRates::Zero();
  double r = 0.3;           ///< first proximal step of the forces
  double e = 0.0;           ///< first artificial inertia
  double pace = 1.0;        ///< scales all proximal steps
  double added_mass = 0.0;  ///< on every rate
};

struct NewtonResult {
  bool converged = false;
  bool runs_away = false;  ///< without inertia, rates grew beyond all bounds
  SpatialRates v = SpatialRates::Zero();
  double residual = kNan;      ///< natural map and balance, in units (F0, V0)
  double largest_force = 0.0;  ///< normal
};

/// Solves the leading n x n system in place by elimination with row exchange; false where
/// it is singular.
bool solve_small(RateMatrix& A, SpatialRates& x, int n) noexcept;

template <class Contacts>
class ProximalIteration {
 public:
  ProximalIteration(const RateBalance& problem, Contacts& contacts)
      : problem_(problem), contacts_(contacts) {}

  NewtonResult run(const ProximalStart& start, double tolerance, int max_steps,
                   int& steps) {
    added_mass_ = start.added_mass;
    v_ = before_ = start.v;
    double r = start.r * start.pace;
    double e = start.e;
    NewtonResult result;
    const bool has_mass = problem_.has_inertia || start.added_mass > 0.0;
    double residual = std::numeric_limits<double>::infinity();
    while (true) {
      r_ = r;
      e_ = e;
      evaluate(v_);
      const double wanted =
          std::max(0.1 * tolerance, std::min(1e-2, 0.1 * residual * residual));
      const bool settled = settle(wanted, steps, max_steps);
      const double now = natural_map();
      if (std::isfinite(now)) residual = now;
      if (residual <= tolerance || steps >= max_steps) break;
      if (!has_mass && !(v_.norm() < kRunsAway)) {
        result.runs_away = true;
        break;
      }
      if (settled) {
        contacts_.move_centres();
        before_ = v_;
        r = std::max(kLeastProx * start.pace, 0.3 * r);
        e *= 0.2;
      } else {
        e = std::max(10.0 * e, 0.1 / start.pace);
        r = std::min(3.0 * start.pace, 2.0 * r);
      }
      ++steps;
    }
    result.v = v_;
    result.residual = residual;
    result.largest_force = contacts_.largest_force();
    result.converged = residual <= tolerance;
    return result;
  }

 private:
  static constexpr int kStepsPerCentre = 25;
  static constexpr int kHalvings = 12;
  static constexpr double kLeastProx = 1e-7;
  static constexpr double kRunsAway = 1e7;  // rates that only a falling object reaches

  /// Newton's method for the present force centres.
  bool settle(double tolerance, int& steps, int max_steps) {
    const int n = problem_.freedoms;
    for (int step = 0; step < kStepsPerCentre && steps < max_steps; ++step, ++steps) {
      if (balance_.norm() <= tolerance) return true;
      SpatialRates stride = -balance_;
      if (!solve_small(jacobian_, stride, n)) return false;
      if (!line_search(stride)) return balance_.norm() <= 10.0 * tolerance;
    }
    return balance_.norm() <= tolerance;
  }

  double natural_map() const {
    return std::max((balance_ - e_ * (v_ - before_)).norm(),
                    contacts_.distance_from_laws(v_));
  }

  void evaluate(const SpatialRates& v) {
    balance_ = e_ * (v - before_) - problem_.f;
    jacobian_.setZero();
    jacobian_.diagonal().setConstant(e_ + added_mass_);
    if (added_mass_ > 0.0) balance_ += added_mass_ * v;
    if (problem_.has_inertia) {
      balance_ += problem_.M * v;
      jacobian_ += problem_.M;
    }
    contacts_.add_forces(v, r_, balance_, jacobian_);
    for (int i = problem_.freedoms; i < 8; ++i) balance_[i] = 0.0;
  }

  bool line_search(const SpatialRates& stride) {
    const SpatialRates from = v_;
    const double before = balance_.norm();
    double share = 1.0;
    for (int halving = 0; halving < kHalvings; ++halving, share *= 0.5) {
      const SpatialRates there = from + share * stride;
      evaluate(there);
      if (balance_.norm() <= (1.0 - 1e-4 * share) * before) {
        v_ = there;
        return true;
      }
    }
    evaluate(from);
    return false;
  }

  RateMatrix jacobian_ = RateMatrix::Zero();
  SpatialRates v_ = SpatialRates::Zero();
  SpatialRates before_ = SpatialRates::Zero();
  SpatialRates balance_ = SpatialRates::Zero();
  const RateBalance problem_;
  Contacts& contacts_;
  double r_ = 1.0;
  double e_ = 0.0;
  double added_mass_ = 0.0;
};

}  // namespace prehensile
