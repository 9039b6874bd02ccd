/// What the fingers alone hold at the places where a plan has the object in the hand.
/// Internal to the planner.
#pragma once

#include <string>

#include "planner/plan.h"

namespace prehensile {

/// Whether the fingers alone hold the object at the start, at so many times the grip of
/// the scene. True of what may roll: a support may carry it.
bool fingers_hold_start(const Model& model, double grip_share = 1.0);

/// Why the fingers drop the object before the first push, with the grip of the way there,
/// or an empty text. Not of what may roll: a support may carry it.
std::string start_holding_fault(const Model& model, const Plan& plan);

/// Why the fingers may drop the object somewhere within the margin, or an empty text:
/// where a push begins or ends, with gravity as in that push, unless start or goal have
/// the object there; of pads that are not round also along the pushes between such
/// places. Round ones that are whole hold along a push what they hold at its ends. Not of
/// rolls, in which a support may carry the object, and not about points, which members of
/// the box try (member_margin.h).
std::string margin_holding_fault(const Model& model, const Plan& plan);

/// What a plan cannot better because its start and its goal are given, or an empty text:
/// somewhere within the margin the fingers alone do not hold the object there, or the
/// pads are beside it.
std::string given_caveat(const Model& model, const Plan& plan);

}  // namespace prehensile
