/// Where a grip force does: the run of forces around the scene's own, or nearest to it.
/// Forces may do in several runs; only this one is sought. Internal to the primitives
/// layer.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

namespace prehensile {

/// Forces at equal steps of their logarithm between two limits; number 0 is one of the
/// forces between.
class ForceGrid {
 public:
  ForceGrid(double own, double least, double greatest)
      : own_(std::clamp(own, least, greatest)),
        least_(least),
        greatest_(greatest),
        below_(static_cast<int>(std::ceil(kPerDecade * std::log10(own_ / least)))),
        above_(static_cast<int>(std::ceil(kPerDecade * std::log10(greatest / own_)))) {}

  double at(int i) const {
    return std::clamp(own_ * std::pow(10.0, static_cast<double>(i) / kPerDecade), least_,
                      greatest_);
  }
  int first() const { return -below_; }
  int last() const { return above_; }

 private:
  static constexpr int kPerDecade = 5;

  double own_, least_, greatest_;
  int below_, above_;
};

struct ForceRun {
  int low, high;  ///< numbers on the grid, both of which do
};

/// `does(force)`; none where no force of the grid does.
template <class Does>
std::optional<ForceRun> run_of_forces(const ForceGrid& grid, const Does& does) {
  const auto does_at = [&](int i) {
    return i >= grid.first() && i <= grid.last() && does(grid.at(i));
  };
  const int farthest = std::max(-grid.first(), grid.last());
  for (int distance = 0; distance <= farthest; ++distance) {
    for (const int nearest : {distance, -distance}) {
      if (!does_at(nearest)) continue;
      ForceRun run{nearest, nearest};
      while (does_at(run.low - 1)) --run.low;
      while (does_at(run.high + 1)) ++run.high;
      return run;
    }
  }
  return {};
}

struct ForceEnd {
  double inside, beyond;  ///< the one does, the other does not
};

/// Closes in on the end of a run between two forces.
template <class Does>
ForceEnd force_end(double inside, double beyond, double precision, const Does& does) {
  while (std::abs(beyond - inside) > precision * inside) {
    const double middle = std::sqrt(inside * beyond);
    (does(middle) ? inside : beyond) = middle;
  }
  return {inside, beyond};
}

}  // namespace prehensile
