#include "mechanics/proximal_iteration.h"

namespace prehensile {

/// Whole rows are combined, so that they may go in lanes.
bool solve_small(RateMatrix& A, SpatialRates& x, int n) noexcept {
  for (int k = 0; k < n; ++k) {
    int best = k;
    double size = std::abs(A(k, k));
    for (int i = k + 1; i < n; ++i) {
      if (std::abs(A(i, k)) > size) {
        best = i;
        size = std::abs(A(i, k));
      }
    }
    if (!(size > 0.0)) return false;
    if (best != k) {
      A.row(k).swap(A.row(best));
      std::swap(x[k], x[best]);
    }
    const double per_pivot = 1.0 / A(k, k);
    for (int i = k + 1; i < n; ++i) {
      const double factor = A(i, k) * per_pivot;
      if (factor == 0.0) continue;
      A.row(i) -= factor * A.row(k);
      x[i] -= factor * x[k];
    }
    A(k, k) = per_pivot;
  }
  for (int k = n - 1; k >= 0; --k) {
    double rest = x[k];
    for (int j = k + 1; j < n; ++j) rest -= A(k, j) * x[j];
    x[k] = rest * A(k, k);
  }
  return x.allFinite();
}

}  // namespace prehensile
