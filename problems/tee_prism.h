/// The outline of a T.
#pragma once

#include "scene/scene.h"

namespace prehensile {

/// A prism of 30 mm over a T that lies along x; all lengths [m]. Its bar, `width` long
/// and `bar` thick, is at the end that 40 % of the length lie behind the origin; `stem`
/// is half of the stem's width.
inline PrismShape tee_prism(double length, double width, double bar, double stem) {
  const double left = -0.4 * length;
  const double step = left + bar;
  const double right = left + length;
  const double half = 0.5 * width;
  return {{{left, -half},
           {step, -half},
           {step, -stem},
           {right, -stem},
           {right, stem},
           {step, stem},
           {step, half},
           {left, half}},
          0.03};
}

}  // namespace prehensile
