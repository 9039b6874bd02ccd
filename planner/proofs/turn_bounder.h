/// Functions of the place that bound a rate of turn, from linear programmes, for Ipopt.
/// Internal to the planner.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "planner/plan.h"

namespace prehensile {

/// A rate of turn that some contact makes, in one sense.
struct SeenTurn {
  Vec2 from_start;     ///< [m] the place
  Vec2 direction;      ///< of dp_OF
  double kappa = 0.0;  ///< sense c dtheta / |dp_OF|
};

/// Bounds in one sense on what was seen. The variables of the programmes are the rate at
/// the start, its change over `length`, and one more, which they minimise.
class TurnBounder {
 public:
  using Stopped = std::function<bool()>;

  /// `length` [m] > 0, of the ways; `stopped` must outlive it.
  TurnBounder(double length, const Stopped& stopped)
      : length_(length), stopped_(stopped) {}

  void add(const SeenTurn& seen) { seen_.push_back(seen); }

  /// From the start to a place of the goal [m].
  void add_way(const Vec2& way) { ways_.push_back(way); }

  /// The least over the ways to the goal [m].
  std::optional<double> least_along_ways() const;

  /// That which is above what was seen by the greatest share of 1 + |kappa|, and over the
  /// ways at most `most` [m].
  std::optional<TurnRate> surest(double most) const;

 private:
  static constexpr int kVariables = 6;
  using Point = std::array<double, kVariables>;

  struct Rows {
    std::vector<Point> factors;
    std::vector<double> least;

    double value(std::size_t i, std::span<const double> x) const;

    /// The rate at a place, along `e`, and `of_last` times the last variable are
    /// `at_least`.
    void add(const Vec2& e, const Vec2& place, double of_last, double at_least);
  };

  static std::vector<std::size_t> broken_by(const Point& x, const Rows& rows);
  std::optional<Point> solve(const Rows& rows, double most_of_last) const;
  std::optional<Point> solve(const Rows& rows, const std::vector<std::size_t>& some,
                             double most_of_last) const;

  std::vector<SeenTurn> seen_;
  std::vector<Vec2> ways_;
  double length_;
  const Stopped& stopped_;
};

}  // namespace prehensile
