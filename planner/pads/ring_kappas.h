/// Steering over ring pads (ring_pads.h): which rotations stick on a straight move.
/// Internal to the planner.
///
/// Force and moment of the pads for all kappa are half a convex curve, of which each row
/// of the stick test cuts one arc or two: its ends are found by bisection in a table.
#pragma once

#include <array>

#include "mechanics/stick_rows.h"
#include "planner/pads/ring_pads.h"

namespace prehensile {

class RingTable {
 public:
  explicit RingTable(const Model& model);

  /// Like robust_kappas, but for a line contact over ring pads; a little smaller, for
  /// what lies between the entries. No heap.
  KappaSet kappas(const StickContact& contact, const Vec2& p_OF, const Vec2& e,
                  const Margin& margin = Margin::none()) const noexcept;

 private:
  static constexpr int kHalf = 256;
  static constexpr int kEntries = 2 * kHalf + 1;

  struct Row {
    double along, moment,
        constant;  // along x force + moment x moment / c + constant >= 0
  };
  /// Those that the rows leave with pads stretched about the finger axis.
  KappaSet sticking(const StickRows& rows, double c, double stretch) const noexcept;

  double at(const Row& row, int i) const {
    return row.along * along_[i] + row.moment * moment_[i] + row.constant;
  }
  /// The entry between `low` and `high`, as a fraction, where a row that is monotone
  /// there changes its sign.
  double crossing(const Row& row, int low, int high) const noexcept;
  /// The entry where a row is greatest (`side` 1) or least (-1).
  int extreme_of(const Row& row, double side) const noexcept;
  void cut(const Row& row, KappaSet& angles) const noexcept;

  std::array<double, kEntries> along_;   // of F, by angle from -pi / 2 to pi / 2
  std::array<double, kEntries> moment_;  // of F c
  std::array<bool, kEntries> bent_;      // from an entry to the next: where the centre of
                                         // rotation crosses a circle
};

}  // namespace prehensile
