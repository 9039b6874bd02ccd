#include <algorithm>
#include <cmath>

#include "mechanics/prism_modes.h"
#include "mechanics/section_answer.h"

namespace prehensile {
namespace {

using namespace prism;
using Relation = LinearProgram::Relation;

// The distinct motions that have forces, with the modes under which they were found.
struct Solutions {
  struct Found {
    Freedoms motion;
    Modes modes;
    int turning;
  };
  int count = 0;
  std::array<Found, 6 * (kAllModes + 1)> found;

  // A motion that does not turn is found again among those that may turn, with less
  // forces: the first case knows all of them.
  void add(const Freedoms& motion, Modes modes, int turning) {
    for (int i = 0; i < count; ++i) {
      if (!same_motion(found[i].motion, motion)) continue;
      if (found[i].turning == turning) found[i].modes |= modes;
      return;
    }
    found[count++] = {motion, modes, turning};
  }
};

// False if a linear programme got lost.
bool find_solutions(const Turning& turning, int index, const Balance& balance,
                    double sheet_rate, Solutions& solutions) {
  std::array<bool, kAllModes + 1> unbalanced{};
  for (Modes modes = kAllModes + 1; modes-- > 0;) {  // larger sets of edges first
    for (int j = 0; j < 2 * kContacts; ++j) {
      const Modes larger = modes | (1U << j);
      if (larger != modes && unbalanced[larger]) unbalanced[modes] = true;
    }
    if (unbalanced[modes]) continue;
    const LinearSolution forces =
        find_point(force_program(turning, balance, modes, balance.demand).program);
    if (forces.status == LinearStatus::kPivotLimit) return false;
    unbalanced[modes] = !forces.feasible();
    if (unbalanced[modes]) continue;
    const MotionSet motions = motions_of(turning, sheet_rate, modes);
    for (int i = 0; i < motions.count; ++i)
      solutions.add(motions.member[i], modes, index);
  }
  return true;
}

ContactMode mode_of(const Turning& turning, int contact, const Freedoms& v,
                    double sheet_rate) {
  int first = 0;
  while (first + 1 < turning.count && turning.point[first].contact != contact) ++first;
  const PointRows& point = turning.point[first];
  if (dot(point.normal, v) > kSameMotion) return ContactMode::kOpen;
  const double slip = dot(point.tangential, v) - (contact == kSheet ? sheet_rate : 0.0);
  if (std::abs(slip) <= kSameMotion) return ContactMode::kStick;
  return slip > 0.0 ? ContactMode::kSlipPlus : ContactMode::kSlipMinus;
}

// A motion that no contact opposes, while gravity and grip gain power from it: no forces
// balance the object.
bool tips(PrismInstant& answer, const Turning& all, const Balance& balance,
          const SectionUnits& units) {
  LinearProgram program(kFreedoms, /*nonnegative=*/false);
  for (int p = 0; p < all.count; ++p) {
    for (const double sign : {1.0, -1.0}) {
      const Freedoms edge = edge_of(all.point[p], balance.mu[all.point[p].contact], sign);
      LinearProgram::Point& opposed = program.add_row(Relation::kAtMost, 0.0);
      for (int k = 0; k < kFreedoms; ++k) opposed[k] = -edge[k];
    }
  }
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

// The support drags the object into a wedge: forces that balance each other and take
// power from it.
bool is_jammed(PrismInstant& answer, const Turning& all, const Balance& balance,
               double sheet_rate, const SectionUnits& units) {
  ForceProgram force = force_program(all, balance, kAllModes, Freedoms{});
  LinearProgram::Point& power = force.program.add_row(Relation::kEqual, 1.0);
  const double mu = balance.mu[kSheet];
  for (int c = 0; c < force.program.variables; ++c)
    if (all.point[force.column[c] / 2].contact == kSheet)
      power[c] = sheet_rate * (force.column[c] % 2 == 0 ? mu : -mu);
  const LinearSolution wedge = find_point(force.program);
  if (!wedge.feasible()) return false;
  answer.status = InstantStatus::kJammed;
  SectionForces forces = forces_of(all, balance, force, wedge.x);
  // Only their ratios say something.
  const double most = *std::max_element(forces.normal.begin(), forces.normal.end());
  answer.evidence_forces = in_si(forces, SectionUnits{units.force / most, 1.0, 1.0});
  return true;
}

bool well_posed(const SectionPolygon& polygon, double roll, const PrismContacts& contacts,
                const PrismGrip& grip, const CrossSectionDrive& drive) {
  const bool one_jaw_rate = grip.jaw_mode == JawMode::kCoupled ||
                            grip.jaw_mode == JawMode::kFixedJaw1 ||
                            grip.jaw_mode == JawMode::kFixedJaw2;
  const double sum = roll + grip.grip_force + grip.friction[0] + grip.friction[1] +
                     drive.mu + drive.sheet_rate + drive.weight;
  return one_jaw_rate && std::isfinite(sum) && polygon.size > 0.0 && contacts.held() &&
         grip.grip_force >= 0.0 && grip.friction[0] >= 0.0 && grip.friction[1] >= 0.0 &&
         drive.mu >= 0.0 && drive.sheet_rate != 0.0;
}

Balance balance_of(const SectionPolygon& polygon, double roll, const PrismGrip& grip,
                   const CrossSectionDrive& drive, const SectionUnits& units) {
  Balance balance;
  balance.mu = {grip.friction[0], grip.friction[1], drive.mu};
  const Vec2 com = rotated(roll, polygon.com) / units.length;
  const double weight = drive.weight / units.force;
  const double jaws = grip.jaw_mode == JawMode::kCoupled ? 2.0 : 1.0;
  balance.demand = {0.0, weight, weight * com.x(), -jaws * grip.grip_force / units.force};
  return balance;
}

void write_forces(PrismInstant& answer, const ForceRange& range,
                  const SectionUnits& units) {
  answer.forces = in_si(range.middle, units);
  answer.least = in_si(range.least, units);
  answer.greatest = in_si(range.greatest, units);
  answer.wedges = range.wedges;
  answer.push_force =
      std::hypot(answer.forces.normal[kSheet], answer.forces.tangential[kSheet]);
}

}  // namespace

PrismInstant solve_prism(const SectionPolygon& polygon, double roll,
                         const PrismContacts& contacts, const PrismGrip& grip,
                         const CrossSectionDrive& drive) noexcept {
  PrismInstant answer;
  answer.status = InstantStatus::kBadInput;
  if (!well_posed(polygon, roll, contacts, grip, drive)) return answer;
  SectionUnits units{std::max(2.0 * grip.grip_force, std::abs(drive.weight)),
                     std::abs(drive.sheet_rate), polygon.size};
  if (units.force == 0.0) units.force = 1.0;
  const double sheet_rate = drive.sheet_rate > 0.0 ? 1.0 : -1.0;
  const Balance balance = balance_of(polygon, roll, grip, drive, units);
  const Turnings turnings = turnings_of(contacts, grip.jaw_mode, polygon.size);

  answer.status = InstantStatus::kOutOfIterations;
  Solutions solutions;
  for (int i = 0; i < turnings.count; ++i)
    if (!find_solutions(turnings.each[i], i, balance, sheet_rate, solutions))
      return answer;
  answer.motions_found = solutions.count;
  if (solutions.count == 0) {
    const Turning& all = turnings.each[0];
    answer.exhausted = !tips(answer, all, balance, units) &&
                       !is_jammed(answer, all, balance, sheet_rate, units);
    return answer;
  }
  put_fastest_first(solutions, kSameMotion);
  const Solutions::Found& first = solutions.found[0];
  const Turning& turning = turnings.each[first.turning];
  const ForceRange range = force_range(turning, balance, first.modes);
  if (!range.solved) return answer;
  answer.motion = in_si(first.motion, units);
  for (int i = 0; i < kContacts; ++i)
    answer.mode[i] = mode_of(turning, i, first.motion, sheet_rate);
  write_forces(answer, range, units);
  if (solutions.count > 1) {
    const Solutions::Found& other = solutions.found[1];
    answer.other = in_si(other.motion, units);
    answer.other_forces = in_si(
        force_range(turnings.each[other.turning], balance, other.modes).middle, units);
    answer.status = InstantStatus::kAmbiguous;
  } else if (!range.unique) {
    answer.status = InstantStatus::kNonuniqueForces;
  } else {
    answer.status = same_motion(first.motion, Freedoms{}) ? InstantStatus::kHolds
                                                          : InstantStatus::kMoves;
  }
  return answer;
}

}  // namespace prehensile
