#include "mechanics/lemke.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/LU>

namespace prehensile {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kPivotFloor = 1e-10;  // of the largest entry of the column
constexpr double kTie = 1e-11;         // values closer than this, in units, are equal
constexpr int kPivotsPerFactor = 40;   // after which the inverse is computed anew
constexpr int kScalingSweeps = 8;
// How far a proof may be off in units of its data.
constexpr double kProof = 1e-9;

/// M' = diag(row) M diag(column), q' = diag(row) q / size: entries of about 1. The
/// complementary pairs stay what they are, because both factors are positive.
struct Scaled {
  MatrixXd M;
  VectorXd q, row, column;
  double size;  // z = size * column * z'
};

double inverse_root(double value) { return value > 0.0 ? 1.0 / std::sqrt(value) : 1.0; }

Scaled scaled(const MatrixXd& M, const VectorXd& q) {
  const Index n = q.size();
  Scaled s{M, q, VectorXd::Ones(n), VectorXd::Ones(n), 1.0};
  if (n == 0) return s;
  for (int sweep = 0; sweep < kScalingSweeps; ++sweep) {
    const VectorXd row = s.M.cwiseAbs().rowwise().maxCoeff().unaryExpr(
        [](double v) { return inverse_root(v); });
    const VectorXd column = s.M.cwiseAbs().colwise().maxCoeff().transpose().unaryExpr(
        [](double v) { return inverse_root(v); });
    s.M = row.asDiagonal() * s.M * column.asDiagonal();
    s.row.array() *= row.array();
    s.column.array() *= column.array();
  }
  s.q = s.row.cwiseProduct(q);
  const double largest = s.q.cwiseAbs().maxCoeff();
  if (largest > 0.0) s.size = largest;
  s.q /= s.size;
  return s;
}

/// Where a search begins: the covering vector, and the pairs whose z takes the place of w
/// in the first basis.
struct Start {
  VectorXd cover;
  std::vector<Index> swapped;
};

double golden_share(Index number) {
  const double turn = 0.6180339887498949 * static_cast<double>(number);
  return turn - std::floor(turn);
}

/// Pairs {i} or {i, k} that may be swapped without dividing by little.
std::vector<std::vector<Index>> exchangeable(const MatrixXd& M) {
  constexpr double kLarge = 0.05;  // entries are about 1
  std::vector<std::vector<Index>> sets;
  for (Index i = 0; i < M.rows(); ++i) {
    if (std::abs(M(i, i)) > kLarge) sets.push_back({i});
    for (Index k = 0; k < i; ++k) {
      const double determinant = M(i, i) * M(k, k) - M(i, k) * M(k, i);
      if (std::abs(determinant) > kLarge) sets.push_back({k, i});
    }
  }
  return sets;
}

/// Number 0 starts from all w and covers with ones; odd numbers cover with numbers
/// between 1/2 and 3/2, even ones start from a basis in which a pair or two are swapped.
Start start_of(const MatrixXd& M, int number) {
  const Index n = M.rows();
  Start start{VectorXd::Ones(n), {}};
  for (Index i = 0; number % 2 == 1 && i < n; ++i) {
    start.cover[i] = 0.5 + golden_share((i + 1) * number);
  }
  if (number == 0 || number % 2 == 1) return start;
  const std::vector<std::vector<Index>> sets = exchangeable(M);
  if (sets.empty()) return start;
  const double share = golden_share(number / 2);
  start.swapped =
      sets[static_cast<std::size_t>(share * static_cast<double>(sets.size()))];
  return start;
}

/// The dictionary w - M z - d z0 = q. Columns: w_i, then z_i, then z0. With swapped pairs
/// in the first basis B, z0 enters with B d, and ties are broken by rows of inverse * B.
class Pivoting {
 public:
  enum class End { kAnswer, kRay, kPivotLimit };

  Pivoting(const Scaled& problem, Start start);

  End run(int max_pivots);
  int pivots() const { return pivots_; }

  /// z of the complementary basis, solved for anew.
  VectorXd answer() const;

  /// Direction of z along the last entering column.
  VectorXd ray() const;

 private:
  VectorXd column(Index variable) const;
  MatrixXd basis_matrix() const;
  Index first_row() const;
  Index leaving_row() const;
  void pivot(Index row);
  void factorise();
  Index complement(Index variable) const {
    return variable < n_ ? variable + n_ : variable - n_;
  }

  const Scaled& problem_;
  Start start_;
  Index n_;
  std::vector<Index> basis_;
  MatrixXd first_basis_;   // empty: the identity
  VectorXd cover_column_;  // of z0
  MatrixXd inverse_;       // of the basis
  VectorXd value_;         // of the basic variables
  VectorXd change_;        // they fall by this much per unit of the entering variable
  Index entering_;
  int pivots_ = 0;
};

Pivoting::Pivoting(const Scaled& problem, Start start)
    : problem_(problem),
      start_(std::move(start)),
      n_(problem.q.size()),
      cover_column_(-start_.cover),
      inverse_(MatrixXd::Identity(n_, n_)),
      value_(problem.q),
      entering_(2 * n_) {
  for (Index i = 0; i < n_; ++i) basis_.push_back(i);
  if (start_.swapped.empty()) return;
  for (const Index i : start_.swapped) basis_[i] = i + n_;
  first_basis_ = basis_matrix();
  cover_column_ = -first_basis_ * start_.cover;
  factorise();
}

VectorXd Pivoting::column(Index variable) const {
  if (variable < n_) return VectorXd::Unit(n_, variable);
  if (variable < 2 * n_) return -problem_.M.col(variable - n_);
  return cover_column_;
}

MatrixXd Pivoting::basis_matrix() const {
  MatrixXd B(n_, n_);
  for (Index i = 0; i < n_; ++i) B.col(i) = column(basis_[i]);
  return B;
}

void Pivoting::factorise() {
  inverse_ = basis_matrix().partialPivLu().inverse();
  value_ = inverse_ * problem_.q;
}

/// The row in which z0 enters: all others stay lexicographically positive. Of equal rows
/// the last is the least, because of the identity beside them.
Index Pivoting::first_row() const {
  const VectorXd ratio = value_.cwiseQuotient(start_.cover);
  const double least = ratio.minCoeff();
  Index row = n_ - 1;
  while (ratio[row] > least + kTie) --row;
  return row;
}

/// The least ratio; among equal ones z0, which ends the search, else the lexicographic
/// rule over the rows of the inverse. -1: the entering variable may grow for ever.
Index Pivoting::leaving_row() const {
  const double floor = kPivotFloor * std::max(1.0, change_.cwiseAbs().maxCoeff());
  std::vector<Index> rows;
  for (Index i = 0; i < n_; ++i) {
    if (change_[i] > floor) rows.push_back(i);
  }
  const auto keep_least = [&](const auto& entry) {
    double least = std::numeric_limits<double>::infinity();
    double largest = 0.0;
    for (const Index i : rows) {
      least = std::min(least, entry(i) / change_[i]);
      largest = std::max(largest, std::abs(entry(i)));
    }
    const double tie = kTie * largest;
    std::erase_if(rows, [&](Index i) { return entry(i) - least * change_[i] > tie; });
  };
  if (rows.empty()) return -1;
  const double size = std::max(1.0, value_.cwiseAbs().maxCoeff());
  double least = std::numeric_limits<double>::infinity();
  for (const Index i : rows) {
    least = std::min(least, std::max(0.0, value_[i]) / change_[i]);
  }
  std::erase_if(rows, [&](Index i) {
    return std::max(0.0, value_[i]) - least * change_[i] > kTie * size;
  });
  for (const Index i : rows) {
    if (basis_[i] == 2 * n_) return i;
  }
  for (Index k = 0; k < n_ && rows.size() > 1; ++k) {
    if (start_.swapped.empty()) {
      keep_least([&](Index i) { return inverse_(i, k); });
    } else {
      const VectorXd column_k = inverse_ * first_basis_.col(k);
      keep_least([&](Index i) { return column_k[i]; });
    }
  }
  return rows.front();
}

void Pivoting::pivot(Index row) {
  basis_[row] = entering_;
  ++pivots_;
  if (pivots_ % kPivotsPerFactor == 0) {
    factorise();
    return;
  }
  const Eigen::RowVectorXd pivot_row = inverse_.row(row) / change_[row];
  const double step = value_[row] / change_[row];
  inverse_.noalias() -= change_ * pivot_row;
  inverse_.row(row) = pivot_row;
  value_ -= change_ * step;
  value_[row] = step;
}

Pivoting::End Pivoting::run(int max_pivots) {
  if (n_ == 0 || value_.minCoeff() >= 0.0) return End::kAnswer;
  Index row = first_row();
  change_ = -start_.cover;
  while (pivots_ < max_pivots) {
    const Index leaving = basis_[row];
    pivot(row);
    if (leaving == 2 * n_) return End::kAnswer;
    entering_ = complement(leaving);
    change_ = inverse_ * column(entering_);
    row = leaving_row();
    if (row < 0) return End::kRay;
  }
  return End::kPivotLimit;
}

VectorXd Pivoting::answer() const {
  const MatrixXd B = basis_matrix();
  const Eigen::PartialPivLU<MatrixXd> lu(B);
  VectorXd x = lu.solve(problem_.q);
  x += lu.solve(VectorXd(problem_.q - B * x));
  VectorXd z = VectorXd::Zero(n_);
  for (Index i = 0; i < n_; ++i) {
    if (basis_[i] >= n_ && basis_[i] < 2 * n_) z[basis_[i] - n_] = std::max(0.0, x[i]);
  }
  return z;
}

VectorXd Pivoting::ray() const {
  VectorXd z = VectorXd::Zero(n_);
  if (entering_ >= n_ && entering_ < 2 * n_) z[entering_ - n_] = 1.0;
  for (Index i = 0; i < n_; ++i) {
    if (basis_[i] < n_ || basis_[i] >= 2 * n_) continue;
    z[basis_[i] - n_] = std::max(0.0, -change_[i]);
  }
  // What rounding left of zeros would hide the rows that a proof does not touch.
  const double noise = kPivotFloor * z.cwiseAbs().maxCoeff();
  return (z.array() > noise).select(z, 0.0);
}

/// y >= 0 with M^T y <= 0 and q . y < 0: every z >= 0 would give w . y < 0.
bool proves_infeasible(const MatrixXd& M, const VectorXd& q, const VectorXd& y) {
  const VectorXd size = M.cwiseAbs().transpose() * y;
  const VectorXd excess = M.transpose() * y - kProof * size;
  return excess.maxCoeff() <= 0.0 && q.dot(y) < -kProof * q.cwiseAbs().dot(y);
}

void judge(const MatrixXd& M, const VectorXd& q, const Scaled& s, LcpSolution& solution) {
  const VectorXd& z = solution.z;
  const VectorXd& w = solution.w = M * z + q;
  solution.residual = solution.relative_residual =
      w.allFinite() ? 0.0 : std::numeric_limits<double>::infinity();
  // In units; what rounding may do to a row grows with its terms.
  const VectorXd unit_z = z.cwiseQuotient(s.column) / s.size;
  const VectorXd room = (s.M.cwiseAbs() * unit_z.cwiseAbs()).array() + 1.0;
  for (Index i = 0; w.allFinite() && i < z.size(); ++i) {
    solution.residual = std::max(solution.residual, std::abs(std::min(z[i], w[i])));
    const double missed = z[i] > 0.0 ? std::abs(w[i]) : std::max(0.0, -w[i]);
    const double unit_missed = missed * s.row[i] / s.size / room[i];
    solution.relative_residual =
        std::max({solution.relative_residual, unit_missed, -unit_z[i]});
  }
}

bool is_sound(const MatrixXd& M, const VectorXd& q) {
  return M.rows() == q.size() && M.cols() == q.size() && M.allFinite() && q.allFinite();
}

/// One start; returns true where nothing better can be found by another.
bool try_start(const MatrixXd& M, const VectorXd& q, const Scaled& s, int start,
               const LcpOptions& options, LcpSolution& best) {
  const Index n = q.size();
  Pivoting pivoting(s, start_of(s.M, start));
  const int limit =
      options.max_pivots > 0 ? options.max_pivots : 1000 + 50 * static_cast<int>(n);
  const Pivoting::End end = pivoting.run(limit);
  best.pivots += pivoting.pivots();

  if (end == Pivoting::End::kAnswer) {
    LcpSolution found;
    found.pivots = best.pivots;
    found.z = s.size * s.column.cwiseProduct(pivoting.answer());
    judge(M, q, s, found);
    const bool solved = found.relative_residual <= options.tolerance;
    found.status = solved ? LcpStatus::kSolved : LcpStatus::kInaccurate;
    if (!(found.relative_residual <= best.relative_residual)) return false;
    best = std::move(found);
    return solved;
  }
  if (best.status == LcpStatus::kInaccurate) return false;
  if (end == Pivoting::End::kPivotLimit) {
    best.status = LcpStatus::kPivotLimit;
    return false;
  }
  best.ray = s.column.cwiseProduct(pivoting.ray());
  const bool proved = proves_infeasible(M, q, best.ray);
  best.status = proved ? LcpStatus::kInfeasible : LcpStatus::kRay;
  return proved;
}

}  // namespace

void judge_lcp(const MatrixXd& M, const VectorXd& q, LcpSolution& solution) {
  judge(M, q, scaled(M, q), solution);
}

LcpSolution solve_lcp(const MatrixXd& M, const VectorXd& q, const LcpOptions& options) {
  LcpSolution best;
  if (!is_sound(M, q) || options.starts < 1) {
    best.status = LcpStatus::kBadInput;
    return best;
  }
  const Scaled s = scaled(M, q);
  for (int start = 0; start < options.starts; ++start) {
    if (try_start(M, q, s, start, options, best)) break;
  }
  return best;
}

}  // namespace prehensile
