/// Geometric limits of a push, each as a length that is positive on the valid side.
#pragma once

#include <array>

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

class PathLimits {
 public:
  static constexpr int kCount = 6;
  using Values = std::array<double, kCount>;  ///< [m] by Limit

  /// `reach` [m] turns angles into lengths.
  PathLimits(const Model& model, const Grasp& start, const Guard& guard, double reach);

  /// `whole`: whether the pad is to stay whole, or clipped.
  Values at(const SeatGeometry& geometry, const Seat& seat, const Vec2& q,
            const PlanarPose& X_HO, bool whole) const noexcept;

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
