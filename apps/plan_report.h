/// Plans and replays as text that a person can follow.
#pragma once

#include <string>

#include "planner/checks/replay.h"
#include "planner/plan.h"

namespace prehensile::apps {

std::string describe(const Model& model, const Plan& plan);
std::string describe(const Model& model, const Plan& plan, const Replay& replay);

/// "wall on -x" for a contact.
std::string contact_text(const Model& model, int contact);

/// "x 1.00 mm, y 2.00 mm, theta 3.0 deg" with roll where there is any.
std::string pose_text(const Model& model, const Grasp& grasp);

}  // namespace prehensile::apps
