#include "mechanics/slide_equation.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace prehensile {
namespace {

constexpr double kEnough = 2e-15;
constexpr int kNewtonSteps = 12;
constexpr int kBracketSteps = 100;
constexpr int kGrid = 48;

}  // namespace

SlideEquation::Value SlideEquation::at(double s) const noexcept {
  const pad_kernels::Curvature here =
      pad_kernels::curvature(pads, question.V + s * question.t);
  const PlanarWrench turned = here.hessian * question.t;
  return {question.m.dot(here.gradient.head<2>()) - question.target,
          question.m.dot(turned.head<2>())};
}

double SlideEquation::gap(double s) const noexcept {
  return pad_kernels::resisting_force(pads, question.V + s * question.t, question.m) -
         question.target;
}

bool SlideEquation::polish(double& s) const noexcept {
  for (int step = 0; step < kNewtonSteps; ++step) {
    const Value value = at(s);
    if (std::abs(value.gap) <= kEnough) return true;
    const double next = s - value.gap / value.slope;
    if (!std::isfinite(next)) return false;
    if (std::abs(next - s) <= 1e-16 * std::abs(s)) return std::abs(value.gap) <= 1e-12;
    s = next;
  }
  return false;
}

double SlideEquation::refine(double a, double gap_a, double b) const noexcept {
  double s = 0.5 * (a + b);
  for (int step = 0; step < kBracketSteps; ++step) {
    const Value value = at(s);
    if (std::abs(value.gap) <= kEnough) break;
    (value.gap * gap_a > 0.0 ? a : b) = s;
    const double newton = s - value.gap / value.slope;
    const bool inside = (newton - a) * (newton - b) < 0.0;
    const double next = inside ? newton : 0.5 * (a + b);
    if (next == s || next == a || next == b) break;
    s = next;
  }
  return s;
}

int SlideEquation::scan(double scale, int capacity, double* roots) const noexcept {
  std::array<double, 3 * kGrid> grid;
  int size = 0;
  const double far = std::max(scale, std::abs(question.start));
  for (int k = 1; k < kGrid; ++k) {
    const double share = k / static_cast<double>(kGrid - k);
    grid[size++] = question.start + question.slip * far * share;
    grid[size++] = scale * share;
    grid[size++] = -scale * share;
  }
  const auto nearer = [this](double x, double y) {
    return (x - y) * question.slip < 0.0;
  };
  std::sort(grid.begin(), grid.begin() + size, nearer);

  int count = 0;
  double a = question.start;
  double gap_a = gap(a);
  for (int k = 0; k < size && count < capacity; ++k) {
    const double b = grid[k];
    if (!nearer(a, b)) continue;
    const double gap_b = gap(b);
    if (gap_a * gap_b < 0.0) roots[count++] = refine(a, gap_a, b);
    a = b;
    gap_a = gap_b;
  }
  return count;
}

}  // namespace prehensile
