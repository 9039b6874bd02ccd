/// Newton steps of programs along a path: each place depends on its neighbours only, and
/// one variable on all. Internal to the planner.
#pragma once

#include <array>
#include <cmath>

#include <Eigen/Core>

namespace prehensile {

/// A symmetric matrix whose entries lie within kWidth of the diagonal or in the last row;
/// its factors and solutions cost as much as its size.
template <int kSize, int kWidth>
class BorderedBand {
 public:
  using Vector = Eigen::Matrix<double, kSize, 1>;

  void set_zero() {
    for (auto& row : band_) row.fill(0.0);
    border_.fill(0.0);
    inverse_.fill(0.0);
  }

  /// Only of the lower triangle.
  void add(int i, int j, double value) {
    if (i < j) return;
    if (i == kLast) {
      border_[kWidth + j] += value;
    } else {
      band_[kWidth + i][i - j] += value;
    }
  }

  /// Replaces the matrix by its factors; false if it is not positive definite.
  bool factor() {
    double corner = border_[kWidth + kLast];
    for (int i = kWidth; i < kWidth + kLast; ++i) {
      Row& row = band_[i];
      for (int d = kWidth; d > 0; --d) {
        const Row& above = band_[i - d];
        for (int k = 1; k <= kWidth - d; ++k) row[d] -= row[d + k] * above[k];
        row[d] *= inverse_[i - d];
      }
      double sum = row[0];
      for (int d = 1; d <= kWidth; ++d) {
        sum -= row[d] * row[d];
        border_[i] -= row[d] * border_[i - d];
      }
      if (!(sum > 0.0)) return false;
      inverse_[i] = 1.0 / std::sqrt(sum);
      border_[i] *= inverse_[i];
      corner -= border_[i] * border_[i];
    }
    if (!(corner > 0.0)) return false;
    inverse_[kWidth + kLast] = 1.0 / std::sqrt(corner);
    return true;
  }

  Vector solve(const Vector& b) const {
    std::array<double, kWidth + kLast + kWidth> x{};
    double last = b[kLast];
    for (int i = kWidth; i < kWidth + kLast; ++i) {
      x[i] = b[i - kWidth];
      for (int d = 1; d <= kWidth; ++d) x[i] -= band_[i][d] * x[i - d];
      x[i] *= inverse_[i];
      last -= border_[i] * x[i];
    }
    Vector solution;
    last *= inverse_[kWidth + kLast] * inverse_[kWidth + kLast];
    solution[kLast] = last;
    for (int i = kWidth + kLast - 1; i >= kWidth; --i) {
      x[i] -= border_[i] * last;
      x[i] *= inverse_[i];
      for (int d = 1; d <= kWidth; ++d) x[i - d] -= band_[i][d] * x[i];
      solution[i - kWidth] = x[i];
    }
    return solution;
  }

 private:
  static constexpr int kLast = kSize - 1;

  // kWidth places of zeros come first.
  using Row = std::array<double, kWidth + 1>;
  std::array<Row, kWidth + kLast> band_;
  std::array<double, kWidth + kSize> border_, inverse_;  // of the diagonal of the factor
};

}  // namespace prehensile
