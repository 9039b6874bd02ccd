#include "planner/proofs/turn_bounder.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "optimisation/nonlinear_program.h"

namespace prehensile {
namespace {

/// Of a first bound: by so much of 1 + |kappa| it is above what was seen.
constexpr double kLittle = 0.01;

/// Bounds are no steeper.
constexpr double kSteepest = 40.0;

/// Of what bounds are asked to be above, only every so many are looked at at first; then
/// those that are broken by more than a little, so many at once, so often.
constexpr std::size_t kStride = 16;
constexpr double kBroken = 1e-5;
constexpr std::size_t kMostAdded = 200;
constexpr int kMostRounds = 12;

}  // namespace

double TurnBounder::Rows::value(std::size_t i, std::span<const double> x) const {
  return std::inner_product(x.begin(), x.end(), factors[i].begin(), 0.0);
}

void TurnBounder::Rows::add(const Vec2& e, const Vec2& place, double of_last,
                            double at_least) {
  factors.push_back({e.x(), e.y(), e.x() * place.x(),
                     e.x() * place.y() + e.y() * place.x(), e.y() * place.y(), of_last});
  least.push_back(at_least);
}

std::optional<double> TurnBounder::least_along_ways() const {
  Rows rows;
  for (const SeenTurn& one : seen_) {
    rows.add(one.direction, one.from_start / length_, 0.0,
             one.kappa + kLittle * (1.0 + std::abs(one.kappa)));
  }
  for (const Vec2& way : ways_) rows.add(-way / length_, 0.5 * way / length_, 1.0, 0.0);
  const auto x = solve(rows, kSteepest);
  return x ? std::optional(x->back() * length_) : std::nullopt;
}

std::optional<TurnRate> TurnBounder::surest(double most) const {
  Rows rows;
  for (const SeenTurn& one : seen_) {
    rows.add(one.direction, one.from_start / length_, 1.0 + std::abs(one.kappa),
             one.kappa);
  }
  for (const Vec2& way : ways_) {
    rows.add(-way / length_, 0.5 * way / length_, 0.0, -most / length_);
  }
  const auto x = solve(rows, 0.0);
  if (!x) return std::nullopt;
  return TurnRate{{(*x)[0], (*x)[1]}, Vec3((*x)[2], (*x)[3], (*x)[4]) / length_};
}

/// With a few rows at first, to which those that the solution breaks are added.
std::optional<TurnBounder::Point> TurnBounder::solve(const Rows& rows,
                                                     double most_of_last) const {
  std::vector<std::size_t> some;
  for (std::size_t i = 0; i < rows.least.size(); i += kStride) some.push_back(i);
  for (int round = 0; round < kMostRounds; ++round) {
    const auto x = solve(rows, some, most_of_last);
    if (!x) return std::nullopt;
    const auto broken = broken_by(*x, rows);
    if (broken.empty()) return x;
    some.insert(some.end(), broken.begin(), broken.end());
  }
  return std::nullopt;
}

/// Those that are broken most.
std::vector<std::size_t> TurnBounder::broken_by(const Point& x, const Rows& rows) {
  std::vector<std::pair<double, std::size_t>> broken;
  for (std::size_t i = 0; i < rows.least.size(); ++i) {
    const double left = rows.value(i, x) - rows.least[i];
    if (left < -kBroken) broken.emplace_back(left, i);
  }
  std::ranges::sort(broken);
  broken.resize(std::min(broken.size(), kMostAdded));
  std::vector<std::size_t> most(broken.size());
  std::ranges::transform(broken, most.begin(),
                         [](const auto& one) { return one.second; });
  return most;
}

std::optional<TurnBounder::Point> TurnBounder::solve(const Rows& rows,
                                                     const std::vector<std::size_t>& some,
                                                     double most_of_last) const {
  NonlinearProgram program;
  program.start.assign(kVariables, 0.0);
  program.lower.assign(kVariables, -kSteepest);
  program.upper.assign(kVariables, kSteepest);
  program.upper.back() = most_of_last;
  program.objective = [](std::span<const double> x, std::span<double> gradient) {
    if (!gradient.empty()) {
      std::ranges::fill(gradient, 0.0);
      gradient.back() = 1.0;
    }
    return x.back();
  };
  program.constraint_lower.resize(some.size());
  std::ranges::transform(some, program.constraint_lower.begin(),
                         [&](std::size_t i) { return rows.least[i]; });
  program.constraint_upper.assign(some.size(), kUnbounded);
  program.constraints = [&](std::span<const double> x, std::span<double> g) {
    for (std::size_t k = 0; k < some.size(); ++k) g[k] = rows.value(some[k], x);
  };
  for (int k = 0; k < static_cast<int>(some.size()); ++k) {
    for (int j = 0; j < kVariables; ++j) {
      program.jacobian_rows.push_back(k);
      program.jacobian_columns.push_back(j);
    }
  }
  program.jacobian = [&](std::span<const double>, std::span<double> values) {
    auto value = values.begin();
    for (const std::size_t i : some) {
      value = std::ranges::copy(rows.factors[i], value).out;
    }
  };
  program.hessian = [](std::span<const double>, double, std::span<const double>,
                       std::span<double>) {};
  program.stop = stopped_;
  const NlpResult result =
      minimise_ipopt(program, {.tolerance = 1e-6, .max_evaluations = 200});
  if (result.status != NlpStatus::kConverged) return std::nullopt;
  Point x;
  std::ranges::copy(result.x, x.begin());
  return x;
}

}  // namespace prehensile
