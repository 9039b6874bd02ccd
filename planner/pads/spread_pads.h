/// Discs that the face may clip, as friction that is the same at every angle of the
/// object: the points that stand for them at a place of the finger axis, spread over all
/// angles. Internal to the planner.
///
/// Where the discs are whole these are the rings of ring_pads.h, which their closed form
/// decides. Pushes have to stick with the points and with these.
#pragma once

#include "mechanics/model.h"
#include "planner/pads/pad_columns.h"

namespace prehensile {

/// Whether the pads are discs on flat faces that clip them where they overhang.
bool has_clipped_discs(const Model& model);

/// Added up in numbers of some kind. No heap.
template <class Scalar>
class SpreadPadsOf {
 public:
  static constexpr int kMostAngles = 11;

  SpreadPadsOf() = default;  ///< lost ones
  /// Spread over so many angles: prime, so that points which are alike at every share of
  /// a turn lie evenly.
  SpreadPadsOf(const Model& model, const Vec2& p_OF, int angles = kMostAngles) noexcept;

  /// They do not touch the object.
  bool are_lost() const { return points_.is_empty(); }

  /// Force over F, and moment [m] over F about the finger axis, that overcome them in a
  /// motion of the object in the hand, in O, of any scale.
  PadDrag drag(const Vec2& velocity, double omega) const noexcept {
    return points_.drag(velocity, omega);
  }

  /// Power over F that they take in a motion of the object in the hand: [m/s] for a twist
  /// in m/s and rad/s.
  double power(const Vec2& velocity, double omega) const noexcept {
    return points_.power(velocity, omega);
  }

 private:
  PadColumns<Scalar, kMostAngles * PlanarGrasp::kCapacity> points_;
  int angles_ = 0;
};

using SpreadPads = SpreadPadsOf<double>;

/// For who looks at many places and motions, each for a few digits.
using QuickSpreadPads = SpreadPadsOf<float>;

/// Least slack of a sticking instant with discs so spread: of the friction cone over F,
/// and of the moments about the ends of the face over F c. The finger axis at p_OF moves
/// by -velocity in O while the object turns by omega in the hand, in a common scale; NaN
/// where nothing moves, -infinity where the pads are lost. No heap.
double spread_slack(const Model& model, const PushContact& contact, const Vec2& p_OF,
                    const Vec2& velocity, double omega) noexcept;

/// The least along a push: the finger axis begins at p_OF and moves by -travel * e in O
/// while the object turns by `turn` in the hand. Looked at at both ends and, unless one
/// of these fails, between them: at places so close that the pads change little, but no
/// more than `most` parts. `clipped` (nullptr: not wanted) receives the number of places
/// at which the discs were not whole, which take as long as some ten stick tests each. No
/// heap.
double spread_slack_along(const Model& model, const PushContact& contact,
                          const Vec2& p_OF, const Vec2& e, double travel, double turn,
                          int most, int* clipped = nullptr) noexcept;

}  // namespace prehensile
