/// Rigorous minima of functions of one angle, from a Lipschitz constant. Internal to the
/// planner.
#pragma once

#include <algorithm>
#include <limits>

namespace prehensile {

/// A lower bound, tight to about `accuracy`, of the minimum over [low, high] of f, where
/// |f(x) - f(y)| <= slope |x - y|. Intervals whose bound exceeds the best value seen are
/// dropped, the others halved. Only the sign matters below zero: the first value <= 0
/// that is met is returned. After kMostEvaluations of f what is left is not halved any
/// more: the bound stays valid and is less tight. No heap.
template <class Function>
double least_over_angle(double low, double high, double slope, double accuracy,
                        const Function& f) {
  constexpr int kMostDepth = 40;
  constexpr int kMostEvaluations = 1'000'000;
  struct Frame {
    double low, high;
    int depth;
  };
  Frame stack[kMostDepth + 2];
  int size = 0;
  stack[size++] = {low, high, 0};
  double best = std::min(f(low), f(high));
  if (best <= 0.0) return best;
  double bound = best;
  int evaluations = 0;
  while (size > 0) {
    const Frame frame = stack[--size];
    const double middle = 0.5 * (frame.low + frame.high);
    const double value = f(middle);
    if (value <= 0.0) return value;
    best = std::min(best, value);
    const double slack = slope * 0.5 * (frame.high - frame.low);
    const bool last = frame.depth == kMostDepth || ++evaluations >= kMostEvaluations;
    if (last || value - slack >= best - accuracy) {
      bound = std::min(bound, value - slack);
      continue;
    }
    stack[size++] = {frame.low, middle, frame.depth + 1};
    stack[size++] = {middle, frame.high, frame.depth + 1};
  }
  return bound;
}

}  // namespace prehensile
