/// What ways of the finger axis cost where they may cheat, for the finder of barriers.
/// Internal to the planner.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "mechanics/model.h"
#include "planner/geometry/free_directions.h"
#include "planner/geometry/level_set.h"

namespace prehensile {

/// Where a straight piece of a way is judged. What sticks changes much between places
/// where the face clips the pads.
enum class Judged {
  kWhereItBegins,
  kAtBothEnds,  ///< as where it costs less: a long one leaps across what nothing crosses
  kAllAlong,    ///< each of its parts as at its ends
};

/// What ways of the finger axis from the start cost: the part of them across what sticks.
class CheatField {
 public:
  using Stopped = std::function<bool()>;

  /// `free_at` says what sticks at a place. `stopped`, asked at each node, must outlive
  /// the field.
  CheatField(const Model& model, int nodes_per_side, FreeAt free_at,
             const Stopped& stopped);

  const PlaceGrid& grid() const { return grid_; }

  /// The cost at each node [m], as far as it is below that of the goal, which receives
  /// the least of its places: the rest keep that. `of_goal` is infinite if it was
  /// stopped. `freely` [rad]: by so much more than what sticks a way may turn for
  /// nothing.
  std::vector<double> costs(const Vec2& start, const std::vector<Vec2>& goals,
                            Judged judged, double freely, double* of_goal);

 private:
  struct Step {
    int i, j;
    double length, angle;  // [m], [rad]
  };

  double cheating_of(int node, int next, const Step& step, Judged judged, double freely);
  double cheating_along(int node, const Step& step, double freely);
  const FreeDirections& free_of(int node);

  const Stopped& stopped_;
  PlaceGrid grid_;
  FreeAt free_at_;
  std::vector<Step> steps_;
  std::vector<std::optional<FreeDirections>> free_;  // of nodes looked at
};

}  // namespace prehensile
