/// Geometric limits of a push, each as a length that is positive on the valid side.
#pragma once

#include <array>
#include <limits>

#include "primitives/linear_push.h"
#include "primitives/push_record.h"
#include "primitives/seat.h"

namespace prehensile {

enum class Limit {
  kRoom,       ///< the contact reaches the end of the face or of the pusher
  kPad,        ///< the centre of the pads reaches the border of the face
  kGuard,      ///< the object strays from the named primitive
  kClearance,  ///< another part of the object reaches the pusher
  kFlush,      ///< a tipped line comes to lie on the face again: ends the seat only
  kWholePad,   ///< the pad begins or ceases to overhang: the quadrature changes there
};

/// Bounds on the motion along a step, per share of it. What comes back is the part of a
/// motion against its prevailing direction.
struct StepBound {
  double way = 0.0;         ///< [m] of the finger axis in the object
  double turn = 0.0;        ///< [rad] of the object in the hand
  double slide_back = 0.0;  ///< [m]
  double tilt_back = 0.0;   ///< [rad]
  double spacing = std::numeric_limits<double>::infinity();  ///< of looks at clearances
};

class PathLimits {
 public:
  static constexpr int kCount = 6;
  using Values = std::array<double, kCount>;  ///< [m] by Limit

  /// `reach` [m] turns angles into lengths.
  PathLimits(const Model& model, const Grasp& start, const Guard& guard, double reach);

  /// `whole`: whether the pad is to stay whole, or clipped.
  Values at(const SeatGeometry& geometry, const Seat& seat, const Vec2& q,
            const PlanarPose& X_HO, bool whole) const noexcept;

  /// Whether no limit, kWholePad aside, can be crossed by more than twice the `depth` [m]
  /// between two places of a step, `width` of it apart, where none is crossed by more
  /// than `depth`. Exact but for kClearance, of which only the spacing is looked at.
  bool are_kept(const Values& one, const Values& other, const StepBound& bound,
                double width, double depth) const noexcept;

  /// What to report when a limit that ends the push is reached.
  PushStop why_not(Limit limit, const Seat& seat) const;

 private:
  const Model* model_;
  Guard guard_;
  Vec2 p_OF_start_;
  double theta_start_;
  double reach_;
};

}  // namespace prehensile
