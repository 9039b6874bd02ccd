/// The friction of pads of points that are not round, as boxes around samples. Internal
/// to the planner.
#pragma once

#include "mechanics/model.h"
#include "planner/pads/pad_section.h"

namespace prehensile {

/// Every point has a partner with its weight a quarter turn further about the finger
/// axis: such sections have cells.
bool alike_at_quarter_turns(const ContactPoints& points, double c);

/// As `pad_section` has it of such pads; `c` is their torque radius [m].
PadSection section_of_points(const ContactPoints& points, double c);

}  // namespace prehensile
