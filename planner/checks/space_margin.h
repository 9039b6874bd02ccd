/// The margin of pushes that are followed in space, where no closed form knows how the
/// loads shift: the push is done again by members of the margin box.
#pragma once

#include <string>

#include "planner/plan.h"

namespace prehensile {

/// Why a planned push does not survive the box, or an empty text; empty also for pushes
/// that are followed in the pad plane, whose slack says it, and for an empty box.
///
/// The members have the least friction of the pusher and, at a line or plane, every
/// combination of the ends of force, torque radius, place and centre of mass along the
/// face; at a point, as for its slack, those of the force alone. Errors of the grasp and
/// of tilt are left to the slack of the pad plane. Each member must do the whole push
/// without slip, certified. Allocates.
std::string space_margin_fault(const Model& model, const PlannedPush& planned,
                               const Margin& margin, const TransitionOptions& options);

}  // namespace prehensile
