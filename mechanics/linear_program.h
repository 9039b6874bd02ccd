/// A small dense linear programme: enough to decide which contact modes are possible and
/// how far their forces may vary, with evidence for every verdict.
///
///     minimise c.x  subject to  a_i.x = b_i  or  a_i.x <= b_i,  x_j >= 0 where said so
///
/// Solver: two-phase simplex on a tableau, steepest column first, with Bland's rule as
/// the safeguard against cycling ("New finite pivoting rules for the simplex method",
/// 1977). Fixed capacity, no heap. Rows are scaled inside; the caller scales variables,
/// right sides and cost to about 1.
#pragma once

#include <array>

namespace prehensile {

struct LinearProgram {
  static constexpr int kMaxVariables = 16;
  static constexpr int kMaxRows = 32;
  using Point = std::array<double, kMaxVariables>;
  using Multipliers = std::array<double, kMaxRows>;

  enum class Relation { kEqual, kAtMost };

  int variables = 0;  ///< 1..kMaxVariables
  int rows = 0;       ///< 0..kMaxRows
  std::array<Point, kMaxRows> coefficient;
  Multipliers right;
  std::array<Relation, kMaxRows> relation;
  std::array<bool, kMaxVariables> nonnegative;  ///< false: the variable is free

  explicit LinearProgram(int variables, bool nonnegative = true) noexcept;

  /// Appends a row of zeros and returns it to be filled; the caller keeps to kMaxRows.
  Point& add_row(Relation relation, double right) noexcept;
};

enum class LinearStatus {
  kNotRun,
  kOptimal,     ///< x, value and multipliers valid
  kInfeasible,  ///< no point exists: multipliers are the proof (Farkas)
  kUnbounded,   ///< x is a point, and cost falls for ever from it along `ray`
  kPivotLimit,  ///< no answer; only rounding could cause it
};

struct LinearSolution {
  LinearStatus status = LinearStatus::kNotRun;
  double value = 0.0;  ///< c.x
  LinearProgram::Point x{};
  LinearProgram::Point ray{};  ///< see kUnbounded; every x + t ray, t >= 0, fits

  /// One number per row, y_i <= 0 on rows "at most".
  /// kOptimal: y.A <= c (equal for free variables) and y.b = value: no point is better.
  /// kInfeasible: y.A <= 0 (equal for free variables) and y.b > 0: no point exists.
  LinearProgram::Multipliers multiplier{};
  int pivots = 0;

  bool feasible() const {
    return status == LinearStatus::kOptimal || status == LinearStatus::kUnbounded;
  }
};

/// Rows may be missed by this much (after each row is scaled to largest coefficient 1,
/// relative to the largest right side above 1) and still count as met.
inline constexpr double kLinearTolerance = 1e-11;

/// Least value of cost.x.
LinearSolution minimise(const LinearProgram& program,
                        const LinearProgram::Point& cost) noexcept;

/// Any point that meets all rows.
LinearSolution find_point(const LinearProgram& program) noexcept;

}  // namespace prehensile
