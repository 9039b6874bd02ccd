/// The exact check of a plan found by a search: every push is done by the transition
/// function with the real pads, in space where it needs that, and sticks over the margin
/// box at points along it. In space members of the box do the push as well
/// (space_margin.h), and where points push, the whole plan (member_margin.h).
#pragma once

#include <string>

#include "planner/plan.h"

namespace prehensile {

/// At how many places along a straight push its slack is looked at, both ends included:
/// every 2 mm and 0.1 rad, 3 to 50.
int places_along(double travel, double turn) noexcept;

/// Least slack over the margin box along a push that starts at this grasp, by the real
/// pad, in the pad plane, at places along the way that the object takes; of discs without
/// a margin also as they are when spread over all angles, clipped ones in at most so many
/// parts of the way. Infinity for a roll, which has no margin box.
double push_slack(const Model& model, const Grasp& start, const Push& push,
                  const Margin& margin, int most_spread_parts = 100);

/// Whether the pads stay on the object during the pushes of a plan over its margin, as
/// far as its start and its goal allow; also says which push does not.
bool stays_on_object(const Model& model, const Plan& plan, std::string* why);

/// Path of the finger axis in the object [m]; 0 for a roll.
double travel_in_pad_plane(const Push& push);

/// Fills force, slack, certificate and error estimate of every push and counts instants.
/// True if each push completes without slip, certified, with slack >= 0 over plan.margin,
/// and ends within 1e-6 of where the plan says ([m] and [rad]; where a point pushes, [m]
/// with angles weighing c), within limits and clear of obstacles; also at half the step,
/// one push after the other, to a goal of the scene; and if the fingers hold the object
/// within the margin (holding_check.h). Else `why` names the first that does not.
bool check_exactly(const Model& model, const TransitionOptions& options, Plan& plan,
                   std::string* why);

/// Whether exact checks of the pushes, one by one, need not speak for the plan done as a
/// whole: it should be replayed.
bool is_delicate(const Model& model, const Plan& plan);

}  // namespace prehensile
