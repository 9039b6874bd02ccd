#include "mechanics/cross_section.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mechanics/cross_section_modes.h"
#include "mechanics/section_answer.h"

namespace prehensile {
namespace {

using namespace section;
using Relation = LinearProgram::Relation;

// The distinct motions that have forces. At a given motion the admissible forces form one
// convex cone, so the modes under which it was found are joined.
struct Solutions {
  struct Found {
    Freedoms motion;
    Modes modes;
  };
  int count = 0;
  std::array<Found, 2 * (kAllModes + 1)> found;

  void add(const Freedoms& motion, Modes modes) {
    for (int i = 0; i < count; ++i) {
      if (!same_motion(found[i].motion, motion)) continue;
      found[i].modes |= modes;
      return;
    }
    found[count++] = {motion, modes};
  }
};

// False if a linear programme got lost.
bool find_solutions(const MotionTable& table, const Balance& balance,
                    Solutions& solutions) {
  std::array<bool, kAllModes + 1> unbalanced{};
  for (Modes modes = kAllModes + 1; modes-- > 0;) {  // larger sets of edges first
    for (int j = 0; j < kEdges; ++j) {
      const Modes larger = modes | (1U << j);
      if (larger != modes && unbalanced[larger]) unbalanced[modes] = true;
    }
    const MotionSet& motions = table[modes];
    if (unbalanced[modes] || motions.count == 0) continue;
    const LinearSolution forces =
        find_point(force_program(balance, modes, balance.demand).program);
    if (forces.status == LinearStatus::kPivotLimit) return false;
    unbalanced[modes] = !forces.feasible();
    for (int i = 0; i < motions.count && !unbalanced[modes]; ++i)
      solutions.add(motions.member[i], modes);
  }
  return true;
}

void write_motion(CrossSectionInstant& answer, JawMode jaw_mode, const Freedoms& v,
                  double sheet_rate, const SectionUnits& units) {
  const CrossSectionMotion motion = in_si(v, units);
  answer.v_z = motion.v_z;
  answer.v_u = motion.v_u;
  answer.roll_rate = motion.roll_rate;
  answer.jaw_rate = motion.jaw_rate;
  for (int i = 0; i < kContacts; ++i)
    answer.mode[i] = mode_of(jaw_mode, i, v, sheet_rate);
}

void write_forces(CrossSectionInstant& answer, const ForceRange& range,
                  const SectionUnits& units) {
  const CrossSectionForces forces = in_si(range.middle, units);
  answer.normal_force = forces.normal;
  answer.tangential_force = forces.tangential;
  answer.push_force = std::hypot(forces.normal[kSheet], forces.tangential[kSheet]);
  answer.sheet_force_low = range.sheet_low * units.force;
  answer.sheet_force_high = range.sheet_high * units.force;
}

InstantStatus verdict(const Solutions& solutions, const ForceRange& range) {
  if (solutions.count > 1) return InstantStatus::kAmbiguous;
  if (!range.unique) return InstantStatus::kNonuniqueForces;
  const Freedoms still{};
  return same_motion(solutions.found[0].motion, still) ? InstantStatus::kHolds
                                                       : InstantStatus::kMoves;
}

// A motion off the sheet that no force of the jaws opposes, while gravity and grip gain
// power from it: the jaws alone cannot hold the object.
bool falls(CrossSectionInstant& answer, const Balance& balance,
           const SectionUnits& units) {
  LinearProgram program(kFreedoms, /*nonnegative=*/false);
  for (int j = 0; j < kEdges; ++j) {
    if (j / 2 == kSheet) continue;
    LinearProgram::Point& opposed = program.add_row(Relation::kAtMost, 0.0);
    for (int k = 0; k < kFreedoms; ++k) opposed[k] = -balance.edge[j][k];
  }
  program.add_row(Relation::kAtMost, 0.0)[1] = -1.0;  // v_u >= 0: off the sheet
  for (int k = 0; k < kFreedoms; ++k) {
    program.add_row(Relation::kAtMost, 1.0)[k] = 1.0;
    program.add_row(Relation::kAtMost, 1.0)[k] = -1.0;
  }
  LinearProgram::Point lost_power{};
  for (int k = 0; k < kFreedoms; ++k) lost_power[k] = balance.demand[k];
  const LinearSolution fall = minimise(program, lost_power);
  if (fall.status != LinearStatus::kOptimal || fall.value >= -kLinearTolerance)
    return false;
  answer.status = InstantStatus::kDynamic;
  answer.evidence = in_si(Freedoms{fall.x[0], fall.x[1], fall.x[2], fall.x[3]}, units);
  return true;
}

// The sheet drags the object into a wedge: forces that balance each other and take power
// from the sheet.
bool is_jammed(CrossSectionInstant& answer, const Balance& balance, double sheet_rate,
               const SectionUnits& units) {
  ForceProgram force = force_program(balance, kAllModes, Freedoms{});
  LinearProgram::Point& power = force.program.add_row(Relation::kEqual, 1.0);
  for (int c = 0; c < kEdges; ++c)
    if (force.column[c] / 2 == kSheet)
      power[c] = sheet_rate * balance.tangential[force.column[c]];
  const LinearSolution wedge = find_point(force.program);
  if (!wedge.feasible()) return false;
  answer.status = InstantStatus::kJammed;
  answer.evidence_forces = in_si(forces_of(balance, force, wedge.x), units);
  return true;
}

bool well_posed(const CrossSectionModel& model, const CrossSectionDrive& drive) {
  const auto finite_from_zero = [](double x) { return std::isfinite(x) && x >= 0.0; };
  const bool has_one_jaw_rate =
      model.jaw_mode != JawMode::kIndependent && model.jaw_mode != JawMode::kLocked;
  return has_one_jaw_rate && std::isfinite(model.radius) && model.radius > 0.0 &&
         finite_from_zero(model.grip_force) && finite_from_zero(model.friction[0]) &&
         finite_from_zero(model.friction[1]) && finite_from_zero(drive.mu) &&
         std::isfinite(drive.weight) && std::isfinite(drive.sheet_rate) &&
         drive.sheet_rate != 0.0;
}

SectionUnits units_of(const CrossSectionModel& model, const CrossSectionDrive& drive) {
  const double force = std::max(2.0 * model.grip_force, std::abs(drive.weight));
  return {force > 0.0 ? force : 1.0, std::abs(drive.sheet_rate), model.radius};
}

}  // namespace

CrossSectionInstant solve_cross_section(const CrossSectionModel& model,
                                        const CrossSectionDrive& drive) noexcept {
  CrossSectionInstant answer;
  answer.status = InstantStatus::kBadInput;
  if (!well_posed(model, drive)) return answer;

  const SectionUnits units = units_of(model, drive);
  const double sheet_rate = drive.sheet_rate > 0.0 ? 1.0 : -1.0;
  const Balance balance = balance_of(model, drive, units.force);

  answer.status = InstantStatus::kOutOfIterations;
  Solutions solutions;
  if (!find_solutions(motion_table(model.jaw_mode, sheet_rate), balance, solutions))
    return answer;
  answer.motions_found = solutions.count;
  if (solutions.count == 0) {
    if (!falls(answer, balance, units)) is_jammed(answer, balance, sheet_rate, units);
    return answer;
  }
  put_fastest_first(solutions, kSameMotion);
  const Solutions::Found& first = solutions.found[0];
  const ForceRange range = force_range(balance, first.modes);
  if (!range.solved) return answer;
  write_motion(answer, model.jaw_mode, first.motion, sheet_rate, units);
  write_forces(answer, range, units);
  if (solutions.count > 1) {
    const Solutions::Found& other = solutions.found[1];
    answer.other = in_si(other.motion, units);
    answer.other_forces = in_si(force_range(balance, other.modes).middle, units);
  }
  answer.status = verdict(solutions, range);
  return answer;
}

double rolling_threshold(const CrossSectionModel& model, double sheet_rate,
                         double weight) noexcept {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  // Both jaws slip against the roll at mu x normal force; z and moment balance give
  // traction = mu_up l_up + mu_down l_down = l_down - l_up.
  const bool to_jaw2 = sheet_rate > 0.0;
  const double mu_up = model.friction[to_jaw2 ? 0 : 1];
  const double mu_down = model.friction[to_jaw2 ? 1 : 0];
  const double N = model.grip_force;
  const JawMode fixed_downstream = to_jaw2 ? JawMode::kFixedJaw2 : JawMode::kFixedJaw1;
  double traction = (mu_up + mu_down) * N;
  double l_up = N;
  if (model.jaw_mode == JawMode::kCoupled) {  // l_up + l_down = 2 N
    traction /= 1.0 + 0.5 * (mu_up - mu_down);
    l_up = N - 0.5 * traction;
  } else if (model.jaw_mode == fixed_downstream) {  // l_up = N
    if (mu_down >= 1.0) return kNever;
    traction /= 1.0 - mu_down;
  } else {  // l_down = N
    traction /= 1.0 + mu_up;
    l_up = N - traction;
  }
  if (mu_down > 1.0) return kNever;  // the upstream jaw would have to pull
  const double load = weight - mu_up * l_up + mu_down * (l_up + traction);
  return load > 0.0 ? traction / load : kNever;
}

}  // namespace prehensile
