#include "mechanics/linear_program.h"

#include <algorithm>
#include <cmath>

namespace prehensile {
namespace {

// Entries below this are rounding, not numbers to pivot on; data are scaled to 1.
constexpr double kPivotFloor = 1e-10;
constexpr double kReducedCostFloor = 1e-11;
// A column without limit whose gain is below this owes the gain to rounding.
constexpr double kCostNoise = 1e-8;
constexpr int kStablePivots = 100;
constexpr int kMaxPivots = 2000;

// The programme in standard form: columns are the variables (free ones split into two),
// then one slack per row "at most", then one artificial per row that has no slack to
// start from. Row i: sum_j cell[i][j] x_j = cell[i][columns].
class Tableau {
 public:
  explicit Tableau(const LinearProgram& program) noexcept;

  LinearSolution solve(const LinearProgram::Point& cost) noexcept;

 private:
  static constexpr int kMaxColumns =
      2 * LinearProgram::kMaxVariables + 2 * LinearProgram::kMaxRows;
  enum class Outcome { kOptimal, kUnbounded, kPivotLimit };

  void add_variables() noexcept;
  void add_slacks() noexcept;
  void add_artificials() noexcept;
  Outcome run_simplex(int entering_columns) noexcept;
  int entering_column(int entering_columns) const noexcept;
  int leaving_row(int column) const noexcept;
  void pivot(int row, int column) noexcept;
  double sum_of_artificials() const noexcept;
  void drive_out_artificials() noexcept;
  void set_cost_of_artificials() noexcept;
  void set_cost(const LinearProgram::Point& cost) noexcept;
  LinearProgram::Point point() const noexcept;
  LinearProgram::Point ray() const noexcept;
  LinearProgram::Multipliers multipliers(double artificial_cost) const noexcept;

  const LinearProgram& program_;
  int rows_;
  int columns_ = 0;       // all
  int real_columns_ = 0;  // without the artificials
  double largest_right_ = 1.0;
  int unbounded_column_ = -1;
  int pivots_ = 0;
  std::array<double, LinearProgram::kMaxRows> row_scale_;  // sign included
  std::array<int, LinearProgram::kMaxRows> basis_;         // column of each row
  std::array<int, LinearProgram::kMaxRows> unit_column_;   // starts as the unit vector
  std::array<int, LinearProgram::kMaxVariables> positive_part_;
  std::array<int, LinearProgram::kMaxVariables> negative_part_;  // -1: not free
  double cell_[LinearProgram::kMaxRows][kMaxColumns + 1];
  double reduced_cost_[kMaxColumns + 1];  // the last entry is minus the value
};

Tableau::Tableau(const LinearProgram& program) noexcept
    : program_(program), rows_(program.rows) {
  for (int i = 0; i < rows_; ++i) {
    double largest = 0.0;
    for (int j = 0; j < program.variables; ++j)
      largest = std::max(largest, std::abs(program.coefficient[i][j]));
    const double magnitude = largest > 0.0 ? 1.0 / largest : 1.0;
    row_scale_[i] = program.right[i] < 0.0 ? -magnitude : magnitude;
    largest_right_ = std::max(largest_right_, std::abs(program.right[i] * magnitude));
  }
  add_variables();
  add_slacks();
  real_columns_ = columns_;
  add_artificials();
  for (int i = 0; i < rows_; ++i) cell_[i][columns_] = program.right[i] * row_scale_[i];
}

void Tableau::add_variables() noexcept {
  for (int j = 0; j < program_.variables; ++j) {
    positive_part_[j] = columns_;
    for (int i = 0; i < rows_; ++i)
      cell_[i][columns_] = program_.coefficient[i][j] * row_scale_[i];
    ++columns_;
    negative_part_[j] = -1;
    if (program_.nonnegative[j]) continue;
    negative_part_[j] = columns_;
    for (int i = 0; i < rows_; ++i) cell_[i][columns_] = -cell_[i][columns_ - 1];
    ++columns_;
  }
}

void Tableau::add_slacks() noexcept {
  for (int i = 0; i < rows_; ++i) {
    unit_column_[i] = -1;
    if (program_.relation[i] != LinearProgram::Relation::kAtMost) continue;
    for (int k = 0; k < rows_; ++k) cell_[k][columns_] = 0.0;
    cell_[i][columns_] = row_scale_[i] > 0.0 ? 1.0 : -1.0;
    if (row_scale_[i] > 0.0) unit_column_[i] = columns_;
    ++columns_;
  }
}

void Tableau::add_artificials() noexcept {
  for (int i = 0; i < rows_; ++i) {
    if (unit_column_[i] < 0) {
      for (int k = 0; k < rows_; ++k) cell_[k][columns_] = k == i ? 1.0 : 0.0;
      unit_column_[i] = columns_++;
    }
    basis_[i] = unit_column_[i];
  }
}

// The steepest column, and among equal ratios the largest pivot, keep rounding small.
// That may cycle, so after some pivots Bland's rule takes over: least index in both
// choices.
int Tableau::entering_column(int entering_columns) const noexcept {
  int best = -1;
  for (int j = 0; j < entering_columns; ++j) {
    if (reduced_cost_[j] >= -kReducedCostFloor) continue;
    if (pivots_ >= kStablePivots) return j;
    if (best < 0 || reduced_cost_[j] < reduced_cost_[best]) best = j;
  }
  return best;
}

int Tableau::leaving_row(int column) const noexcept {
  int best = -1;
  double best_ratio = 0.0;
  for (int i = 0; i < rows_; ++i) {
    if (cell_[i][column] <= kPivotFloor) continue;
    const double ratio = std::max(0.0, cell_[i][columns_]) / cell_[i][column];
    const bool preferred =
        best >= 0 && (pivots_ < kStablePivots ? cell_[i][column] > cell_[best][column]
                                              : basis_[i] < basis_[best]);
    if (best < 0 || ratio < best_ratio || (ratio == best_ratio && preferred)) {
      best = i;
      best_ratio = ratio;
    }
  }
  return best;
}

void Tableau::pivot(int row, int column) noexcept {
  double* pivot_row = cell_[row];
  const double inverse = 1.0 / pivot_row[column];
  for (int j = 0; j <= columns_; ++j) pivot_row[j] *= inverse;
  pivot_row[column] = 1.0;
  const auto eliminate = [&](double* other) {
    const double factor = other[column];
    if (factor == 0.0) return;
    for (int j = 0; j <= columns_; ++j) other[j] -= factor * pivot_row[j];
    other[column] = 0.0;
  };
  for (int i = 0; i < rows_; ++i)
    if (i != row) eliminate(cell_[i]);
  eliminate(reduced_cost_);
  basis_[row] = column;
  ++pivots_;
}

Tableau::Outcome Tableau::run_simplex(int entering_columns) noexcept {
  while (pivots_ < kMaxPivots) {
    const int column = entering_column(entering_columns);
    if (column < 0) return Outcome::kOptimal;
    const int row = leaving_row(column);
    if (row < 0 && reduced_cost_[column] > -kCostNoise) {
      reduced_cost_[column] = 0.0;
      continue;
    }
    if (row < 0) {
      unbounded_column_ = column;
      return Outcome::kUnbounded;
    }
    pivot(row, column);
  }
  return Outcome::kPivotLimit;
}

void Tableau::set_cost_of_artificials() noexcept {
  for (int j = 0; j <= columns_; ++j) {
    double sum = 0.0;
    for (int i = 0; i < rows_; ++i)
      if (basis_[i] >= real_columns_) sum += cell_[i][j];
    const bool artificial = j >= real_columns_ && j < columns_;
    reduced_cost_[j] = (artificial ? 1.0 : 0.0) - sum;
  }
}

void Tableau::set_cost(const LinearProgram::Point& cost) noexcept {
  for (int j = 0; j <= columns_; ++j) reduced_cost_[j] = 0.0;
  for (int j = 0; j < program_.variables; ++j) {
    reduced_cost_[positive_part_[j]] = cost[j];
    if (negative_part_[j] >= 0) reduced_cost_[negative_part_[j]] = -cost[j];
  }
  for (int i = 0; i < rows_; ++i) {
    const double factor = reduced_cost_[basis_[i]];
    if (factor == 0.0) continue;
    for (int j = 0; j <= columns_; ++j) reduced_cost_[j] -= factor * cell_[i][j];
    reduced_cost_[basis_[i]] = 0.0;
  }
}

double Tableau::sum_of_artificials() const noexcept {
  double sum = 0.0;
  for (int i = 0; i < rows_; ++i)
    if (basis_[i] >= real_columns_) sum += std::abs(cell_[i][columns_]);
  return sum;
}

// An artificial that stays basic at zero must not grow again. Where its row has no real
// column left, the row repeats others and stays at zero by itself.
void Tableau::drive_out_artificials() noexcept {
  for (int i = 0; i < rows_; ++i) {
    if (basis_[i] < real_columns_) continue;
    int best = -1;
    for (int j = 0; j < real_columns_; ++j)
      if (std::abs(cell_[i][j]) > kPivotFloor &&
          (best < 0 || std::abs(cell_[i][j]) > std::abs(cell_[i][best])))
        best = j;
    if (best < 0) continue;
    cell_[i][columns_] = 0.0;
    pivot(i, best);
  }
}

LinearProgram::Point Tableau::point() const noexcept {
  std::array<double, kMaxColumns> value{};
  for (int i = 0; i < rows_; ++i) value[basis_[i]] = std::max(0.0, cell_[i][columns_]);
  LinearProgram::Point x{};
  for (int j = 0; j < program_.variables; ++j) {
    x[j] = value[positive_part_[j]];
    if (negative_part_[j] >= 0) x[j] -= value[negative_part_[j]];
  }
  return x;
}

LinearProgram::Point Tableau::ray() const noexcept {
  std::array<double, kMaxColumns> value{};
  value[unbounded_column_] = 1.0;
  for (int i = 0; i < rows_; ++i)
    value[basis_[i]] = std::max(0.0, -cell_[i][unbounded_column_]);
  LinearProgram::Point direction{};
  for (int j = 0; j < program_.variables; ++j) {
    direction[j] = value[positive_part_[j]];
    if (negative_part_[j] >= 0) direction[j] -= value[negative_part_[j]];
  }
  return direction;
}

// The reduced cost of a column that started as unit vector i is its cost minus y_i.
LinearProgram::Multipliers Tableau::multipliers(double artificial_cost) const noexcept {
  LinearProgram::Multipliers y{};
  for (int i = 0; i < rows_; ++i) {
    const int column = unit_column_[i];
    const double cost = column >= real_columns_ ? artificial_cost : 0.0;
    y[i] = (cost - reduced_cost_[column]) * row_scale_[i];
  }
  return y;
}

LinearSolution Tableau::solve(const LinearProgram::Point& cost) noexcept {
  LinearSolution solution;
  set_cost_of_artificials();
  const Outcome start = run_simplex(real_columns_);
  const double missed = sum_of_artificials();
  if (start != Outcome::kOptimal) {  // the sum of artificials cannot fall for ever
    solution.status = LinearStatus::kPivotLimit;
  } else if (missed > kLinearTolerance * largest_right_) {
    solution.status = LinearStatus::kInfeasible;
    solution.multiplier = multipliers(1.0);
  } else {
    drive_out_artificials();
    set_cost(cost);
    const Outcome outcome = run_simplex(real_columns_);
    solution.x = point();
    for (int j = 0; j < program_.variables; ++j)
      solution.value += cost[j] * solution.x[j];
    if (outcome == Outcome::kOptimal) {
      solution.status = LinearStatus::kOptimal;
      solution.multiplier = multipliers(0.0);
    } else if (outcome == Outcome::kUnbounded) {
      solution.status = LinearStatus::kUnbounded;
      solution.ray = ray();
    } else {
      solution.status = LinearStatus::kPivotLimit;
    }
  }
  solution.pivots = pivots_;
  return solution;
}

}  // namespace

LinearProgram::LinearProgram(int variable_count, bool all_nonnegative) noexcept
    : variables(variable_count) {
  nonnegative.fill(all_nonnegative);
}

LinearProgram::Point& LinearProgram::add_row(Relation row_relation,
                                             double row_right) noexcept {
  relation[rows] = row_relation;
  right[rows] = row_right;
  coefficient[rows].fill(0.0);
  return coefficient[rows++];
}

LinearSolution minimise(const LinearProgram& program,
                        const LinearProgram::Point& cost) noexcept {
  return Tableau(program).solve(cost);
}

LinearSolution find_point(const LinearProgram& program) noexcept {
  return minimise(program, LinearProgram::Point{});
}

}  // namespace prehensile
