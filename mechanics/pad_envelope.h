/// Feasible rotations of a straight push with the real pads, for every angle of the
/// object in the hand at once.
///
/// Pads that are not round deflect friction from the motion by an amount that depends on
/// the angle. For one kappa the wrench of the pads, seen along the motion e and across
/// it, stays in a box over all angles; a push that sticks for the whole box sticks at
/// every angle, so that straight pushes keep a feasible interval of kappa and rotations
/// still add up. A round pad has a box without width, up to its quadrature: for it this
/// is the limit surface of the pad itself instead of the ellipsoid's.
#pragma once

#include <array>

#include "mechanics/sticking.h"

namespace prehensile {

class PadEnvelope {
 public:
  /// Pads that are whole, on flat faces. Members of the margin box that the torque radius
  /// tells apart get a table each. F > 0, c > 0.
  PadEnvelope(const Model& model, const Margin& margin);

  /// The kappas at which the contact sticks with whole pads, at every place from -> to of
  /// the finger axis (from != to) and every angle, over the margin box. Found on a grid
  /// of kappas up to 50, ends interpolated: a proposal, to be checked. At most as many
  /// intervals as the set holds. No heap.
  KappaSet kappas(const StickContact& contact, const Vec2& from,
                  const Vec2& to) const noexcept;

 private:
  static constexpr int kKappas = 121;
  using Row = std::array<double, kKappas>;

  /// Box of the friction wrench over all angles, in F and F c, one entry per kappa.
  struct Table {
    Row along_low, along_high;    ///< force along e
    Row across;                   ///< greatest |force| across e
    Row moment_low, moment_high;  ///< about the finger axis
    /// Over the kappas, of what `keep` takes for a positive and a negative factor.
    double most_along, least_along, least_across, most_moment, least_moment;
  };

  /// along f_e - across |f_o| + moment m >= right, for the wrench (f_e, f_o, m).
  struct Inequality {
    double along, across, moment, right;
  };

  /// The slack of all kappas from the first to the last with any; it is not kept up to
  /// date beyond those beside them.
  struct Slack {
    Row row;
    int first = 0, last = kKappas - 1;

    bool is_left() const { return first <= last; }
    int begin() const { return first > 0 ? first - 1 : 0; }
    int end() const { return last + 1 < kKappas ? last + 2 : kKappas; }
    void close_in() noexcept;
  };

  /// Whether an inequality may hold at some kappa.
  static bool may_hold(const Inequality& row, const Table& table) noexcept;
  static void keep(const Inequality& row, const Table& table, Slack& slack) noexcept;
  KappaSet intervals(const Slack& slack) const noexcept;
  static Table tabulate(const Model& model, const Row& grid, double stretch);

  Margin margin_;
  double c_;
  Row grid_;   ///< kappas
  Row turns_;  ///< kappa / c [1/m]
  int tables_ = 0;
  std::array<Table, 3> table_;
};

}  // namespace prehensile
