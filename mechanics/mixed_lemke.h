/// Linear complementarity with free variables and equalities, by pivoting. Knows no
/// physics. Internal to the mechanics layer; cold path.
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "mechanics/complementarity.h"
#include "mechanics/lemke.h"

namespace prehensile {

struct PivotingResult {
  /// As of Lemke's method; kRay also where no pattern of the pairs determines the free
  /// variables. kInfeasible: proved for the problem without its free variables, so for
  /// all of it.
  LcpStatus status = LcpStatus::kNotRun;
  std::vector<double> z;
  double residual = std::numeric_limits<double>::infinity();
  int pivots = 0;
};

/// Exchanges the free variables against the equalities, then solves what is left by
/// solve_lcp, then solves the linear equations of the pattern it found once more.
///
/// Where the equalities do not determine the free variables (a twist without inertia), as
/// many complementary pairs as are missing take part in the exchange: the search then
/// starts from a pattern in which those contacts hold. Nothing is divided by the inertia,
/// so a small one costs no accuracy. There must be as many equalities as free variables.
PivotingResult solve_by_pivoting(const ComplementarityProblem& problem,
                                 const LcpOptions& options = {});

/// Solves the linear equations of the pattern of z (of each pair the larger side is the
/// one that is not zero), moving z as little as possible: sharpens what an interior-point
/// method leaves. To be judged like any other answer, because the pattern may be wrong.
std::vector<double> sharpened(const ComplementarityProblem& problem,
                              std::span<const double> z);

/// Largest |s| of the equalities and |min(z, s)| of the pairs; infinite if a number is
/// not finite.
double residual_of(const ComplementarityProblem& problem, std::span<const double> z);

}  // namespace prehensile
