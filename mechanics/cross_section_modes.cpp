#include "mechanics/cross_section_modes.h"

#include <algorithm>
#include <cmath>

#include "scene/constants.h"

namespace prehensile::section {
namespace {

using Relation = LinearProgram::Relation;

constexpr unsigned kOpenBits = 0, kSlipMinusBits = 1, kSlipPlusBits = 2;

unsigned bits_of(Modes modes, int contact) { return (modes >> (2 * contact)) & 3U; }

// Rates of the object relative to its contacts as rows over the freedoms: the gap opens
// at normal.v, the surface slides at tangential.v minus the rate of the sheet.
// Transposed, the rows turn contact forces into generalised forces.
struct Kinematics {
  std::array<Freedoms, kContacts> normal;
  std::array<Freedoms, kContacts> tangential;
};

Kinematics kinematics_of(JawMode mode) {
  const double jaw1 = mode == JawMode::kFixedJaw1 ? 0.0 : 1.0;
  const double jaw2 = mode == JawMode::kFixedJaw2 ? 0.0 : 1.0;
  Kinematics rows;
  rows.normal[kJaw1] = {1.0, 0.0, 0.0, -jaw1};
  rows.normal[kJaw2] = {-1.0, 0.0, 0.0, -jaw2};
  rows.normal[kSheet] = {0.0, 1.0, 0.0, 0.0};
  rows.tangential[kJaw1] = {0.0, 1.0, -1.0, 0.0};
  rows.tangential[kJaw2] = {0.0, 1.0, 1.0, 0.0};
  rows.tangential[kSheet] = {1.0, 0.0, 1.0, 0.0};
  return rows;
}

double dot(const Freedoms& a, const Freedoms& b) {
  double sum = 0.0;
  for (int k = 0; k < kFreedoms; ++k) sum += a[k] * b[k];
  return sum;
}

void add_row(LinearProgram& program, const Freedoms& row, double sign, Relation relation,
             double right) {
  LinearProgram::Point& cells = program.add_row(relation, right);
  for (int k = 0; k < kFreedoms; ++k) cells[k] = sign * row[k];
}

LinearProgram motion_program(const Kinematics& rows, double sheet_rate, Modes modes) {
  LinearProgram program(kFreedoms, /*nonnegative=*/false);
  for (int i = 0; i < kContacts; ++i) {
    const unsigned bits = bits_of(modes, i);
    const double rate = i == kSheet ? sheet_rate : 0.0;
    if (bits == kOpenBits) {
      add_row(program, rows.normal[i], -1.0, Relation::kAtMost, 0.0);
      continue;
    }
    add_row(program, rows.normal[i], 1.0, Relation::kEqual, 0.0);
    if (bits == kSlipMinusBits) {
      add_row(program, rows.tangential[i], 1.0, Relation::kAtMost, rate);
    } else if (bits == kSlipPlusBits) {
      add_row(program, rows.tangential[i], -1.0, Relation::kAtMost, -rate);
    } else {
      add_row(program, rows.tangential[i], 1.0, Relation::kEqual, rate);
    }
  }
  return program;
}

// The extreme motion in one direction; along an unbounded ray, one step of it.
Freedoms extreme_motion(const LinearProgram& program, int freedom, double sign) {
  LinearProgram::Point cost{};
  cost[freedom] = sign;
  const LinearSolution solution = minimise(program, cost);
  const double step = solution.status == LinearStatus::kUnbounded ? 1.0 : 0.0;
  Freedoms v{};
  for (int k = 0; k < kFreedoms; ++k) v[k] = solution.x[k] + step * solution.ray[k];
  return v;
}

MotionSet motions_of(const Kinematics& rows, double sheet_rate, Modes modes) {
  const LinearProgram program = motion_program(rows, sheet_rate, modes);
  MotionSet set;
  if (!find_point(program).feasible()) return set;
  set.count = 1;
  for (const int freedom : {2, 0, 1, 3}) {  // roll first: it tells motions apart best
    set.member[0] = extreme_motion(program, freedom, 1.0);
    set.member[1] = extreme_motion(program, freedom, -1.0);
    if (same_motion(set.member[0], set.member[1])) continue;
    set.count = 2;
    break;
  }
  return set;
}

MotionTable make_motion_table(JawMode mode, double sheet_rate) {
  const Kinematics rows = kinematics_of(mode);
  MotionTable table;
  for (Modes modes = 0; modes <= kAllModes; ++modes)
    table[modes] = motions_of(rows, sheet_rate, modes);
  return table;
}

}  // namespace

bool same_motion(const Freedoms& a, const Freedoms& b) {
  for (int k = 0; k < kFreedoms; ++k)
    if (std::abs(a[k] - b[k]) > kSameMotion) return false;
  return true;
}

const MotionTable& motion_table(JawMode mode, double sheet_rate) {
  static const std::array<std::array<MotionTable, 2>, 3> tables = [] {
    std::array<std::array<MotionTable, 2>, 3> all;
    for (const JawMode each :
         {JawMode::kCoupled, JawMode::kFixedJaw1, JawMode::kFixedJaw2})
      all[static_cast<int>(each)] = {make_motion_table(each, -1.0),
                                     make_motion_table(each, 1.0)};
    return all;
  }();
  return tables[static_cast<int>(mode)][sheet_rate > 0.0 ? 1 : 0];
}

ContactMode mode_of(JawMode jaw_mode, int contact, const Freedoms& v, double sheet_rate) {
  const Kinematics rows = kinematics_of(jaw_mode);
  if (dot(rows.normal[contact], v) > kSameMotion) return ContactMode::kOpen;
  const double slip =
      dot(rows.tangential[contact], v) - (contact == kSheet ? sheet_rate : 0.0);
  if (std::abs(slip) <= kSameMotion) return ContactMode::kStick;
  return slip > 0.0 ? ContactMode::kSlipPlus : ContactMode::kSlipMinus;
}

Balance balance_of(const CrossSectionModel& model, const CrossSectionDrive& drive,
                   double unit_force) {
  const Kinematics rows = kinematics_of(model.jaw_mode);
  const std::array<double, kContacts> mu = {model.friction[0], model.friction[1],
                                            drive.mu};
  Balance balance;
  for (int j = 0; j < kEdges; ++j) {
    const int contact = j / 2;
    const double length = std::hypot(1.0, mu[contact]);
    balance.normal[j] = 1.0 / length;
    balance.tangential[j] = (j % 2 == 0 ? mu[contact] : -mu[contact]) / length;
    for (int k = 0; k < kFreedoms; ++k)
      balance.edge[j][k] = balance.normal[j] * rows.normal[contact][k] +
                           balance.tangential[j] * rows.tangential[contact][k];
  }
  const double jaws = model.jaw_mode == JawMode::kCoupled ? 2.0 : 1.0;
  balance.demand = {0.0, drive.weight / unit_force, 0.0,
                    -jaws * model.grip_force / unit_force};
  return balance;
}

ForceProgram force_program(const Balance& balance, Modes modes, const Freedoms& demand) {
  ForceProgram force;
  int count = 0;
  for (int j = 0; j < kEdges; ++j)
    if ((modes >> j) & 1U) force.column[count++] = j;
  force.program = LinearProgram(count);
  for (int k = 0; k < kFreedoms; ++k) {
    LinearProgram::Point& cells = force.program.add_row(Relation::kEqual, demand[k]);
    for (int c = 0; c < count; ++c) cells[c] = balance.edge[force.column[c]][k];
  }
  return force;
}

CrossSectionForces forces_of(const Balance& balance, const ForceProgram& force,
                             const LinearProgram::Point& load) {
  CrossSectionForces forces;
  forces.normal.fill(0.0);
  forces.tangential.fill(0.0);
  for (int c = 0; c < force.program.variables; ++c) {
    const int j = force.column[c];
    forces.normal[j / 2] += load[c] * balance.normal[j];
    forces.tangential[j / 2] += load[c] * balance.tangential[j];
  }
  return forces;
}

namespace {

// Least and greatest force of the sheet in one component, with the loads there. Where one
// end is infinite, its loads are those of the other end.
struct Extremes {
  bool solved = false;
  double low = 0.0;
  double high = 0.0;
  LinearProgram::Point low_load{};
  LinearProgram::Point high_load{};

  bool equal() const { return high - low <= kSameForce; }
};

Extremes extremes_at_sheet(const ForceProgram& force,
                           const std::array<double, kEdges>& component) {
  LinearProgram::Point up{};
  LinearProgram::Point down{};
  for (int c = 0; c < force.program.variables; ++c) {
    if (force.column[c] / 2 != kSheet) continue;
    up[c] = component[force.column[c]];
    down[c] = -up[c];
  }
  const LinearSolution least = minimise(force.program, up);
  const LinearSolution greatest = minimise(force.program, down);
  const bool no_least = least.status == LinearStatus::kUnbounded;
  const bool no_greatest = greatest.status == LinearStatus::kUnbounded;
  return {.solved = least.feasible() && greatest.feasible(),
          .low = no_least ? -kInfinity : least.value,
          .high = no_greatest ? kInfinity : -greatest.value,
          .low_load = no_least ? greatest.x : least.x,
          .high_load = no_greatest ? least.x : greatest.x};
}

}  // namespace

ForceRange force_range(const Balance& balance, Modes modes) {
  const ForceProgram force = force_program(balance, modes, balance.demand);
  const Extremes normal = extremes_at_sheet(force, balance.normal);
  const Extremes tangential = extremes_at_sheet(force, balance.tangential);
  const Extremes& wider = normal.equal() ? tangential : normal;
  LinearProgram::Point middle{};
  for (int c = 0; c < force.program.variables; ++c)
    middle[c] = 0.5 * (wider.low_load[c] + wider.high_load[c]);
  return {.solved = normal.solved && tangential.solved,
          .unique = normal.equal() && tangential.equal(),
          .sheet_low = std::max(0.0, normal.low),
          .sheet_high = std::max(0.0, normal.high),
          .middle = forces_of(balance, force, middle)};
}

}  // namespace prehensile::section
