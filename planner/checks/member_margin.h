/// The margin of plans whose object turns about points, of cans, which a place in the
/// hand that is off puts under another part of the pads, and of pads that the face clips,
/// by more or less where they are larger or elsewhere: no closed form knows what they do
/// in the rest of the box, so the whole plan is done by members of the box. Internal to
/// the planner.
#pragma once

#include <string>

#include "planner/plan.h"

namespace prehensile {

/// Why a plan with pushes by points, or of a can, does not survive its margin, or an
/// empty text; empty also for other plans and for no margin.
///
/// 32 corners of the box, the same for every plan, with the least friction of the
/// pushers: in each the object is followed from push to push, from wherever the one
/// before left it, and every push has to be done to its end without slip. A sample, and
/// no proof: the slack of each push along its nominal way is looked at as well.
/// Allocates.
std::string member_margin_fault(const Model& model, const Plan& plan,
                                const TransitionOptions& options);

}  // namespace prehensile
