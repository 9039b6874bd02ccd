/// Linear complementarity by complementary pivoting: knows no physics.
///
///     w = M z + q,   0 <= w,   0 <= z,   w . z = 0
///
/// Solver: Lemke's method with a covering vector ("Bimatrix equilibrium points and
/// mathematical programming", 1965) and the lexicographic rule, so that ties, which
/// statically indeterminate contact makes all the time, cannot make it cycle. It answers
/// whenever M is copositive-plus and the rows can be met at all, or M is a P-matrix; on
/// other matrices it may end on a ray, and another start may still succeed.
///
/// A reference, dense and on the heap: cold path.
#pragma once

#include <limits>

#include <Eigen/Core>

namespace prehensile {

enum class LcpStatus {
  kNotRun,
  kSolved,      ///< within the tolerance, judged from M, q and z alone
  kInfeasible,  ///< no z >= 0 with M z + q >= 0 exists: `ray` is the proof
  kRay,         ///< every start led to a ray: nothing is proved
  kPivotLimit,
  kInaccurate,  ///< pivoting ended, but rounding spoilt the answer; z is what is left
  kBadInput,    ///< shapes that do not fit, numbers that are not finite
};

struct LcpOptions {
  int max_pivots = 0;  ///< per start; 0: 1000 + 50 rows
  int starts = 1;      ///< tried in turn: covering by ones (after scaling), then by other
                       ///< vectors, or from other first bases
  double tolerance = 1e-9;  ///< of `relative_residual`
};

struct LcpSolution {
  LcpStatus status = LcpStatus::kNotRun;
  Eigen::VectorXd z, w;  ///< w = M z + q as computed from z; z >= 0 exactly

  /// Largest |min(z_i, w_i)|, in the units of the data.
  double residual = std::numeric_limits<double>::infinity();

  /// The same law in units that make the largest entry of every row and column of M, and
  /// of q, about 1; each row relative to its terms, 1 + |M| |z|. Does not depend on the
  /// units of the data; rounding is about 1e-16 times the number of rows.
  double relative_residual = std::numeric_limits<double>::infinity();

  /// kInfeasible, kRay: direction in which z left for infinity. kInfeasible: ray >= 0,
  /// M^T ray <= 0 and q . ray < 0, so that no z can do.
  Eigen::VectorXd ray;

  int pivots = 0;  ///< of all starts
};

/// Rows and columns are scaled inside; data of any size are fine.
LcpSolution solve_lcp(const Eigen::MatrixXd& M, const Eigen::VectorXd& q,
                      const LcpOptions& options = {});

/// Judges z against the data: fills w and both residuals.
void judge_lcp(const Eigen::MatrixXd& M, const Eigen::VectorXd& q, LcpSolution& solution);

}  // namespace prehensile
