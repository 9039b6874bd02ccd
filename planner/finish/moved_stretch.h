/// The way-points of a stretch as variables, places and angles alike, and what the exact
/// check's slack says of the pushes between them. Internal to the planner.
#pragma once

#include <span>
#include <vector>

#include "planner/finish/stretch.h"

namespace prehensile {

/// A push between two moved way-points.
struct MovedPush {
  double slack = kNan;      ///< least over the margin along the push (exact_check.h)
  bool is_allowed = false;  ///< gravity is held at its ends, the pads stay on the object
  bool has_room = false;    ///< they stay on it with twice the margin
};

class MovedStretch {
 public:
  /// The finger axis has travelled so far [m] before it. Keeps references to search, work
  /// and margin.
  MovedStretch(const SearchModel& search, Work& work, const Margin& margin,
               double travelled)
      : search_(search), work_(work), margin_(margin), travelled_(travelled) {}

  /// False if a push is none of the search, or by a point, whose turn is not for a
  /// planner to choose.
  bool read(std::span<const PlannedPush> pushes);

  /// x, y of p_OF and c theta between the pushes as they were read [m].
  const std::vector<double>& way_points() const { return way_points_; }

  /// The pushes through these way-points, and what becomes of each; false if one is too
  /// short.
  bool look(std::span<const double> way_points, std::vector<PlannedPush>& pushes,
            std::vector<MovedPush>& looks);

 private:
  FlatState state_at(std::span<const double> way_points, std::size_t point) const;
  MovedPush look_at(int contact, const PlannedPush& push, const Stop& from,
                    const Stop& to, double travelled) const;

  const SearchModel& search_;
  Work& work_;
  const Margin& margin_;
  double travelled_;
  Stretch stretch_;
  std::vector<double> way_points_;
};

}  // namespace prehensile
