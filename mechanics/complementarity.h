/// Linear complementarity with extra linear equalities, and the paper's way to solve it:
/// minimise the sum of all complementarity products subject to the linear constraints
/// (section VI-B). Knows no physics. Internal to the mechanics layer; cold path.
#pragma once

#include <span>
#include <vector>

#include "optimisation/nonlinear_program.h"

namespace prehensile {

/// Rows s = A z + constant. A row with a partner demands 0 <= z[partner] and 0 <= s, with
/// product zero; a row without one demands s = 0. Variables without a row are free.
struct ComplementarityProblem {
  struct Entry {
    int row, column;
    double value;
  };
  static constexpr int kEquality = -1;

  int variables = 0;
  std::vector<double> constant;  ///< per row
  std::vector<int> partner;      ///< per row: a variable, or kEquality
  std::vector<Entry> entries;    ///< A, in any order; equal places add up

  /// Appends a row and returns its index.
  int add_row(int partner_of_row, double constant_of_row);
  void add(int row, int column, double value);

  std::vector<double> slacks(std::span<const double> z) const;
};

/// The programme: its constraints are A z, its objective the sum of z[partner] * s, whose
/// Hessian is constant (the products are bilinear). Each product is >= 0 where the
/// constraints hold, so 0 is the least value possible; but the sum is not convex, and a
/// minimiser may stop above 0. Refers to `problem`, which must outlive it.
NonlinearProgram program_of(const ComplementarityProblem& problem);

}  // namespace prehensile
