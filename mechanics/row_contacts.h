/// Contact with friction stated by rows rather than by points in the hand: what is known
/// of every contact is how its rates depend on at most eight rates of the system,
///
///   u_i = G_i v + b_i,   M v = f + sum_i G_i' r_i,
///
/// and Coulomb's law on the circular cone between u_i and r_i (n, t, o). One rigid body
/// among fixed ones is such a problem with six rates; a local friction problem
/// u = W r + q is one too if W = G M^-1 G' has so few dimensions.
///
/// Source: paper eq. (1) to (4), (8); solved as the spatial instant is, see there.
#pragma once

#include <array>

#include "mechanics/spatial_instant.h"

namespace prehensile {

struct RowProblem {
  static constexpr int kMaxRates = 8;
  static constexpr int kMaxContacts = 136;
  using Rows = Eigen::Matrix<double, 3, kMaxRates>;

  int rates = 6;                        ///< 1..8; columns and entries beyond are not read
  int count = 0;                        ///< contacts, >= 1
  std::array<Rows, kMaxContacts> G;     ///< in like units for all columns
  std::array<Vec3, kMaxContacts> b;     ///< (n, t, o); b_n < 0 approaches
  std::array<double, kMaxContacts> mu;  ///< >= 0
  std::array<double, kMaxContacts> compliance;  ///< R >= 0: u_n + R (r_n - preload)
                                                ///< takes the place of u_n in the law
  std::array<double, kMaxContacts> preload;     ///< >= 0
  Eigen::Matrix<double, kMaxRates, kMaxRates> inertia =  ///< M; symmetric, may be zero
      Eigen::Matrix<double, kMaxRates, kMaxRates>::Zero();
  SpatialRates f = SpatialRates::Zero();
};

/// Not initialised where `status` is not kMoves, but for residual and iterations.
struct RowSolution {
  InstantStatus status = InstantStatus::kNotRun;  ///< kMoves, kOutOfIterations, kBadInput
  SpatialRates v;
  std::array<Vec3, RowProblem::kMaxContacts> r;  ///< (n, t, o); r_n >= 0
  double residual = kNan;  ///< natural map and balance, in units of the problem
  int iterations = 0;      ///< Newton steps
};

/// Reads `tolerance` (of the residual) and `max_iterations`. No heap, no exceptions. What
/// is found is a motion; it is not said whether it is the only one. kBadInput: counts or
/// values out of the ranges above, or not finite.
RowSolution solve_rows(const RowProblem& problem,
                       const SpatialSolveOptions& options = {}) noexcept;

}  // namespace prehensile
