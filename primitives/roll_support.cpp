#include "primitives/roll_support.h"

#include <algorithm>
#include <cmath>

#include "mechanics/linear_program.h"

namespace prehensile {
namespace {

/// Unknowns: places above `low`, in units of the object's length and the load scale; room
/// for more.
LinearProgram balance(const RollLoads& loads, int variables) {
  double force = 0.0;
  for (int i = 0; i < 3; ++i)
    force = std::max({force, std::abs(loads.along_z[i]), std::abs(loads.along_u[i])});
  LinearProgram program(variables);
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
  return program;
}

}  // namespace

bool lines_suffice(const RollLoads& loads) noexcept {
  return find_point(balance(loads, 3)).feasible();
}

double support_place(const RollLoads& loads) noexcept {
  constexpr int kOff = 3;  // from the middle, either way
  LinearProgram program = balance(loads, 4);
  const double low = loads.low[kSheet];
  const double middle = 0.5 * (loads.high[kSheet] - low) / loads.length;
  for (const double way : {1.0, -1.0}) {
    LinearProgram::Point& row =
        program.add_row(LinearProgram::Relation::kAtMost, way * middle);
    row[kSheet] = way;
    row[kOff] = -1.0;
  }
  LinearProgram::Point cost{};
  cost[kOff] = 1.0;
  const LinearSolution found = minimise(program, cost);
  return found.feasible() ? low + found.x[kSheet] * loads.length : kNan;
}

void add_support(const Model& model, const PushContact& contact, const Grasp& grasp,
                 RollLoads& loads) noexcept {
  const double finger = contact.t.dot(finger_in_object(grasp.X_HO));
  const PushContact::Segment support = contact.segment(0.0);
  loads.low[kSheet] = contact.t.dot(support.a) - finger;
  loads.high[kSheet] = contact.t.dot(support.b) - finger;
  loads.arm_of_weight = contact.t.dot(model.p_OCom) - finger;
}

SectionRoll section_roll(const Model& model, const Roll& roll, double weight) noexcept {
  CrossSectionModel gripped = *model.cross_section;
  if (roll.grip_force > 0.0) gripped.grip_force = roll.grip_force;
  return {gripped, {model.contacts[roll.contact].mu, roll.travel, weight}};
}

RollLoads cylinder_loads(const Model& model, const PushContact& contact,
                         const Grasp& grasp, const CrossSectionInstant& instant,
                         double weight) noexcept {
  const ContactPoints pad = model.region.at(grasp.X_HO);
  const Vec2 t_H = rotated(grasp.X_HO.theta, contact.t);
  double pad_low = 0.0;
  double pad_high = 0.0;
  for (int j = 0; j < pad.count; ++j) {
    const double along = t_H.dot(Vec2(pad.x[j], pad.y[j]));
    pad_low = j == 0 ? along : std::min(pad_low, along);
    pad_high = j == 0 ? along : std::max(pad_high, along);
  }
  const auto& normal = instant.normal_force;
  const auto& tangential = instant.tangential_force;
  RollLoads loads;
  loads.along_z = {normal[kJaw1], -normal[kJaw2], tangential[kSheet]};
  loads.along_u = {tangential[kJaw1], tangential[kJaw2], normal[kSheet]};
  loads.low = {pad_low, pad_low, 0.0};
  loads.high = {pad_high, pad_high, 0.0};
  loads.weight = weight;
  loads.length = std::get_if<CylinderShape>(&model.scene.object.shape)->length;
  add_support(model, contact, grasp, loads);
  return loads;
}

}  // namespace prehensile
