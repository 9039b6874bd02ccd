/// Newton steps of programs along a path: each place depends on its neighbours only, and
/// one variable on all. Internal to the planner.
#pragma once

#include <algorithm>
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
    border_.setZero();
  }

  /// Only of the lower triangle.
  void add(int i, int j, double value) {
    if (i < j) return;
    if (i == kLast) {
      border_[j] += value;
    } else {
      band_[i][i - j] += value;
    }
  }

  /// Replaces the matrix by its factors; false if it is not positive definite.
  bool factor() {
    for (int i = 0; i < kLast; ++i) {
      for (int d = std::min(i, kWidth); d >= 0; --d) {
        const int j = i - d;
        double sum = band_[i][d];
        for (int k = std::max({0, i - kWidth, j - kWidth}); k < j; ++k) {
          sum -= band_[i][i - k] * band_[j][j - k];
        }
        if (d > 0) {
          band_[i][d] = sum / band_[j][0];
        } else if (sum > 0.0) {
          band_[i][0] = std::sqrt(sum);
        } else {
          return false;
        }
      }
    }
    double corner = border_[kLast];
    for (int i = 0; i < kLast; ++i) {
      for (int k = std::max(0, i - kWidth); k < i; ++k) {
        border_[i] -= border_[k] * band_[i][i - k];
      }
      border_[i] /= band_[i][0];
      corner -= border_[i] * border_[i];
    }
    border_[kLast] = std::sqrt(std::max(0.0, corner));
    return corner > 0.0;
  }

  Vector solve(Vector x) const {
    double last = x[kLast];
    for (int i = 0; i < kLast; ++i) {
      for (int k = std::max(0, i - kWidth); k < i; ++k) x[i] -= x[k] * band_[i][i - k];
      x[i] /= band_[i][0];
      last -= border_[i] * x[i];
    }
    x[kLast] = last / (border_[kLast] * border_[kLast]);
    for (int i = kLast - 1; i >= 0; --i) {
      x[i] -= border_[i] * x[kLast];
      for (int k = i + 1; k <= std::min(kLast - 1, i + kWidth); ++k) {
        x[i] -= x[k] * band_[k][k - i];
      }
      x[i] /= band_[i][0];
    }
    return x;
  }

 private:
  static constexpr int kLast = kSize - 1;
  std::array<std::array<double, kWidth + 1>, kLast> band_;
  Vector border_;
};

}  // namespace prehensile
