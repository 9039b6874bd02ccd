#include "mechanics/mixed_lemke.h"

#include <algorithm>
#include <cmath>

#include <Eigen/QR>

namespace prehensile {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kEquality = ComplementarityProblem::kEquality;
// An equality alone determines a free variable if its coefficient is this large beside
// what an exchange with a pair offers: small coefficients make large answers.
constexpr double kPreferAlone = 0.05;
constexpr double kPivotFloor = 1e-11;
constexpr double kNoise = 1e-15;

/// The problem as a dictionary: rows are what is computed, columns what it is computed
/// from; an exchange swaps one of each. Columns of equalities that were exchanged are
/// zero and rows of free variables wait for the answer.
class Exchange {
 public:
  explicit Exchange(const ComplementarityProblem& problem);

  /// False if some free variable stays undetermined.
  bool free_the_pairs();

  MatrixXd pair_matrix() const;
  VectorXd pair_constant() const;

  /// All variables from those of the pairs that are in the columns.
  std::vector<double> variables(const VectorXd& in_columns) const;

 private:
  struct Place {
    Index row = -1, column = -1, pair = -1;
    double size = 0.0;
  };
  Place best_alone() const;
  Place best_with_pair() const;
  void exchange(Index row, Index column);
  bool rest_is_idle();

  const ComplementarityProblem& problem_;
  std::vector<Index> equalities_, free_;       // not yet exchanged: rows, columns
  std::vector<Index> pair_row_, pair_column_;  // of each pair
  std::vector<bool> swapped_;                  // its variable is in the row
  std::vector<Index> row_of_free_;             // per variable; -1: not free
  std::vector<Index> pair_of_;                 // per variable; -1: free
  MatrixXd cell_;
  VectorXd constant_;
};

Exchange::Exchange(const ComplementarityProblem& problem)
    : problem_(problem),
      row_of_free_(problem.variables, -1),
      pair_of_(problem.variables, -1),
      cell_(
          MatrixXd::Zero(static_cast<Index>(problem.constant.size()), problem.variables)),
      constant_(Eigen::Map<const VectorXd>(problem.constant.data(),
                                           static_cast<Index>(problem.constant.size()))) {
  for (const auto& [row, column, value] : problem.entries) cell_(row, column) += value;
  for (std::size_t row = 0; row < problem.partner.size(); ++row) {
    const int partner = problem.partner[row];
    if (partner == kEquality) {
      equalities_.push_back(static_cast<Index>(row));
      continue;
    }
    pair_of_[partner] = static_cast<Index>(pair_row_.size());
    pair_row_.push_back(static_cast<Index>(row));
    pair_column_.push_back(partner);
  }
  swapped_.assign(pair_row_.size(), false);
  for (Index variable = 0; variable < problem.variables; ++variable) {
    if (pair_of_[variable] < 0) free_.push_back(variable);
  }
}

Exchange::Place Exchange::best_alone() const {
  Place best;
  for (const Index row : equalities_) {
    for (const Index column : free_) {
      const double size = std::abs(cell_(row, column));
      if (size > best.size) best = {row, column, -1, size};
    }
  }
  return best;
}

/// The pair whose two exchanges, one with the free variable and one with the equality,
/// divide by the least.
Exchange::Place Exchange::best_with_pair() const {
  Place best;
  for (std::size_t pair = 0; pair < pair_row_.size(); ++pair) {
    if (swapped_[pair]) continue;
    const Index w = pair_row_[pair];
    const Index z = pair_column_[pair];
    for (const Index row : equalities_) {
      for (const Index column : free_) {
        const double determinant =
            cell_(row, z) * cell_(w, column) - cell_(row, column) * cell_(w, z);
        const double size = std::abs(determinant) /
                            std::max({std::abs(cell_(row, z)), std::abs(cell_(w, column)),
                                      std::abs(cell_(w, z)), 1e-300});
        if (size > best.size && cell_(w, column) != 0.0) {
          best = {row, column, static_cast<Index>(pair), size};
        }
      }
    }
  }
  return best;
}

/// y_row = ... + cell x_column becomes x_column = y_row / cell - ...
void Exchange::exchange(Index row, Index column) {
  const double inverse = 1.0 / cell_(row, column);
  Eigen::RowVectorXd pivot_row = -inverse * cell_.row(row);
  pivot_row[column] = inverse;
  const double constant = -inverse * constant_[row];
  VectorXd factor = cell_.col(column);
  factor[row] = 0.0;
  cell_.col(column).setZero();
  cell_.noalias() += factor * pivot_row;
  constant_ += factor * constant;
  cell_.row(row) = pivot_row;
  constant_[row] = constant;
}

/// Free variables that nothing depends on stay at zero, if the equalities that are left
/// hold by themselves.
bool Exchange::rest_is_idle() {
  for (const Index row : equalities_) {
    if (std::abs(constant_[row]) > kPivotFloor) return false;
    for (Index column = 0; column < cell_.cols(); ++column) {
      if (std::abs(cell_(row, column)) > kPivotFloor) return false;
    }
  }
  return true;
}

bool Exchange::free_the_pairs() {
  if (equalities_.size() != free_.size()) return false;
  while (!free_.empty()) {
    const Place alone = best_alone();
    const Place together = best_with_pair();
    const bool by_itself = alone.size >= kPreferAlone * together.size;
    const Place& best = by_itself ? alone : together;
    if (!(best.size > kPivotFloor)) return rest_is_idle();
    const Index variable = best.column;
    if (by_itself) {
      exchange(best.row, best.column);
      cell_.col(best.column).setZero();
      row_of_free_[variable] = best.row;
    } else {
      const Index w = pair_row_[best.pair];
      const Index z = pair_column_[best.pair];
      exchange(w, best.column);
      exchange(best.row, z);
      cell_.col(z).setZero();
      row_of_free_[variable] = w;
      pair_row_[best.pair] = best.row;
      pair_column_[best.pair] = best.column;
      swapped_[best.pair] = true;
    }
    std::erase(equalities_, best.row);
    std::erase(free_, variable);
  }
  return true;
}

// What rounding left of zeros would become a number once rows are scaled.
MatrixXd Exchange::pair_matrix() const {
  const MatrixXd M = cell_(pair_row_, pair_column_);
  const double noise = kNoise * cell_.lpNorm<Eigen::Infinity>();
  return (M.array().abs() > noise).select(M, 0.0);
}

VectorXd Exchange::pair_constant() const {
  const VectorXd q = constant_(pair_row_);
  const double noise = kNoise * constant_.lpNorm<Eigen::Infinity>();
  return (q.array().abs() > noise).select(q, 0.0);
}

std::vector<double> Exchange::variables(const VectorXd& in_columns) const {
  VectorXd x = VectorXd::Zero(cell_.cols());
  for (std::size_t pair = 0; pair < pair_row_.size(); ++pair) {
    x[pair_column_[pair]] = in_columns[static_cast<Index>(pair)];
  }
  const VectorXd y = cell_ * x + constant_;
  std::vector<double> values(problem_.variables, 0.0);
  for (std::size_t variable = 0; variable < values.size(); ++variable) {
    const Index pair = pair_of_[variable];
    if (pair < 0) {
      const Index row = row_of_free_[variable];
      values[variable] = row < 0 ? 0.0 : y[row];
    } else {
      values[variable] =
          swapped_[pair] ? std::max(0.0, y[pair_row_[pair]]) : x[pair_column_[pair]];
    }
  }
  return values;
}

/// Rows and columns left over by a pattern: which rows are zero, which variables are not.
struct Pattern {
  std::vector<Index> rows, columns;
};

Pattern pattern_of(const ComplementarityProblem& problem, std::span<const double> z,
                   std::span<const double> s) {
  Pattern pattern;
  std::vector<bool> loose(problem.variables, true);
  for (std::size_t row = 0; row < s.size(); ++row) {
    const int partner = problem.partner[row];
    const bool zero = partner == kEquality || z[partner] > s[row];
    if (zero) pattern.rows.push_back(static_cast<Index>(row));
    if (partner != kEquality) loose[partner] = zero;
  }
  for (Index column = 0; column < problem.variables; ++column) {
    if (loose[column]) pattern.columns.push_back(column);
  }
  return pattern;
}

}  // namespace

double residual_of(const ComplementarityProblem& problem, std::span<const double> z) {
  const std::vector<double> s = problem.slacks(z);
  double worst = 0.0;
  for (std::size_t row = 0; row < s.size(); ++row) {
    const int partner = problem.partner[row];
    const double missed = partner == kEquality ? s[row] : std::min(z[partner], s[row]);
    if (!std::isfinite(missed)) return std::numeric_limits<double>::infinity();
    worst = std::max(worst, std::abs(missed));
  }
  return worst;
}

std::vector<double> sharpened(const ComplementarityProblem& problem,
                              std::span<const double> z) {
  const std::vector<double> s = problem.slacks(z);
  const Pattern pattern = pattern_of(problem, z, s);
  MatrixXd A = MatrixXd::Zero(static_cast<Index>(s.size()), problem.variables);
  for (const auto& [row, column, value] : problem.entries) A(row, column) += value;
  std::vector<double> sharp(z.size(), 0.0);
  for (const Index column : pattern.columns) sharp[column] = z[column];
  const std::vector<double> missed = problem.slacks(sharp);
  const Eigen::Map<const VectorXd> all(missed.data(), static_cast<Index>(missed.size()));
  const MatrixXd B = A(pattern.rows, pattern.columns);
  const VectorXd step =
      B.completeOrthogonalDecomposition().solve(VectorXd(all(pattern.rows)));
  for (std::size_t i = 0; i < pattern.columns.size(); ++i) {
    sharp[pattern.columns[i]] -= step[static_cast<Index>(i)];
  }
  return sharp;
}

PivotingResult solve_by_pivoting(const ComplementarityProblem& problem,
                                 const LcpOptions& options) {
  PivotingResult result;
  Exchange exchange(problem);
  if (!exchange.free_the_pairs()) {
    result.status = LcpStatus::kRay;
    return result;
  }
  const LcpSolution found =
      solve_lcp(exchange.pair_matrix(), exchange.pair_constant(), options);
  result.status = found.status;
  result.pivots = found.pivots;
  if (found.z.size() == 0 && found.status != LcpStatus::kSolved) return result;
  result.z = exchange.variables(found.z);
  result.residual = residual_of(problem, result.z);
  std::vector<double> sharp = sharpened(problem, result.z);
  const double residual = residual_of(problem, sharp);
  if (residual < result.residual) {
    result.z = std::move(sharp);
    result.residual = residual;
  }
  return result;
}

}  // namespace prehensile
