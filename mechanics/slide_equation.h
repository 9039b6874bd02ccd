/// The scalar equation of a line pusher whose two ends slip. Internal to the mechanics
/// layer.
#pragma once

#include "mechanics/pad_kernels.h"

namespace prehensile {

/// m.f(u0 + s d) = target, f the resisting force of the pads, d a translation.
struct SlideEquation {
  PadColumns pads;
  PlanarTwist u0, d;
  Vec2 m;
  double target;

  /// Newton's method from s; false if it does not settle.
  bool polish(double& s) const noexcept;

  /// Roots with the sign of `slip`, from sign changes on a grid over the half line whose
  /// middle lies at `scale`; returns how many (up to `capacity`).
  int scan(int slip, double scale, int capacity, double* roots) const noexcept;

 private:
  struct Value {
    double gap;
    double slope;
  };
  Value at(double s) const noexcept;
  double refine(double a, double gap_a, double b) const noexcept;
};

}  // namespace prehensile
