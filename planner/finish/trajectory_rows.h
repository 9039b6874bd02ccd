/// What each push of a trajectory has to keep, as rows of a nonlinear program over its
/// way-points. Internal to the planner.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "planner/finish/stretch.h"

namespace prehensile {

class TrajectoryRows {
 public:
  /// What the rows of a push depend on [m]: from and to (x, y of p_OF and c theta), and
  /// the path travelled before it.
  static constexpr std::size_t kTravelled = 6;
  using Unknowns = std::array<double, 7>;

  /// The least slack of each part of the push comes first; all but the last count what is
  /// there beyond what is wanted.
  static constexpr std::size_t kParts = 5;
  static constexpr std::size_t kSpread = kParts;    ///< of pads spread over all angles
  static constexpr std::size_t kHeld = kParts + 1;  ///< gravity, at both ends
  static constexpr std::size_t kRoom = kParts + 3;
  static constexpr std::size_t kLength = kParts + 4;
  static constexpr std::size_t kPath = kParts + 5;  ///< travelled before the next push
  static constexpr std::size_t kCount = kParts + 6;
  using Rows = std::array<double, kCount>;

  /// `wanted`: slack of each push. `least_lengths`: by push [m]. Keeps references to
  /// search, work and stretch.
  TrajectoryRows(const SearchModel& search, Work& work, const Margin& margin,
                 const Stretch& stretch, double wanted, std::vector<double> least_lengths)
      : search_(search),
        work_(work),
        margin_(margin),
        stretch_(stretch),
        wanted_(wanted),
        least_lengths_(std::move(least_lengths)) {}

  Move move_of_push(std::size_t k, const Unknowns& at) const;

  void fill(std::size_t k, const Unknowns& at, std::span<double> rows) const;

  /// Whether the exact check will find that such a push sticks, by itself, and that the
  /// pads stay where they have to.
  bool sticks(const Rows& rows) const;

 private:
  std::size_t last() const { return stretch_.contacts.size() - 1; }
  void fill_slacks(const Move& move, const Margin& margin, std::span<double> rows) const;
  double depth_at(const Vec2& p_OF) const;
  double room_of(std::size_t k, const Move& move, const Margin& margin) const;

  const SearchModel& search_;
  Work& work_;
  Margin margin_;
  const Stretch& stretch_;
  double wanted_;
  std::vector<double> least_lengths_;
};

}  // namespace prehensile
