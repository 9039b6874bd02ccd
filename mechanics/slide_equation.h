/// The scalar equation of a line pusher whose two ends slip. Internal to the mechanics
/// layer.
#pragma once

#include "mechanics/pad_kernels.h"
#include "mechanics/push_modes.h"

namespace prehensile {

/// A SlideQuestion over pads.
struct SlideEquation {
  PaddedColumns pads;
  SlideQuestion question;

  /// Newton's method from s; false if it does not settle.
  bool polish(double& s) const noexcept;

  /// Roots beyond the start, from sign changes on a grid that is fine within `scale` of
  /// rest and of the start, and reaches far; returns how many (up to `capacity`).
  int scan(double scale, int capacity, double* roots) const noexcept;

 private:
  struct Value {
    double gap;
    double slope;
  };
  Value at(double s) const noexcept;
  double gap(double s) const noexcept;
  double refine(double a, double gap_a, double b) const noexcept;
};

}  // namespace prehensile
