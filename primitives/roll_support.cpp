#include "primitives/roll_support.h"

#include <algorithm>
#include <cmath>

#include "mechanics/linear_program.h"

namespace prehensile {

bool lines_suffice(const RollLoads& loads) noexcept {
  // Unknowns: places above `low`, in units of the object's length and the load scale.
  double force = 0.0;
  for (int i = 0; i < 3; ++i)
    force = std::max({force, std::abs(loads.along_z[i]), std::abs(loads.along_u[i])});
  LinearProgram program(3);
  LinearProgram::Point& tilts = program.add_row(LinearProgram::Relation::kEqual, 0.0);
  LinearProgram::Point& yaws = program.add_row(LinearProgram::Relation::kEqual, 0.0);
  double tilt_right = loads.weight * loads.arm_of_weight;
  double yaw_right = 0.0;
  for (int i = 0; i < 3; ++i) {
    tilts[i] = loads.along_u[i] / force;
    yaws[i] = loads.along_z[i] / force;
    tilt_right -= loads.along_u[i] * loads.low[i];
    yaw_right -= loads.along_z[i] * loads.low[i];
    program.add_row(LinearProgram::Relation::kAtMost,
                    (loads.high[i] - loads.low[i]) / loads.length)[i] = 1.0;
  }
  program.right[0] = tilt_right / (force * loads.length);
  program.right[1] = yaw_right / (force * loads.length);
  return find_point(program).feasible();
}

void add_support(const Model& model, const PushContact& contact, const Grasp& grasp,
                 RollLoads& loads) noexcept {
  const double finger = contact.t.dot(finger_in_object(grasp.X_HO));
  const PushContact::Segment support = contact.segment(0.0);
  loads.low[kSheet] = contact.t.dot(support.a) - finger;
  loads.high[kSheet] = contact.t.dot(support.b) - finger;
  loads.arm_of_weight = contact.t.dot(model.p_OCom) - finger;
}

}  // namespace prehensile
