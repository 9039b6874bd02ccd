#include "mechanics/prism_modes.h"

#include <algorithm>
#include <cmath>

namespace prehensile::prism {
namespace {

using Relation = LinearProgram::Relation;
constexpr unsigned kOpenBits = 0, kSlipMinusBits = 1, kSlipPlusBits = 2;

// Velocity of a jaw along z per unit of closing rate.
double jaw_rate_of(JawMode mode, int contact) {
  if (contact == kJaw1 && mode != JawMode::kFixedJaw1) return 1.0;
  if (contact == kJaw2 && mode != JawMode::kFixedJaw2) return -1.0;
  return 0.0;
}

// Tangent by the normal: towards +u at the jaws, towards +z at the support.
Vec2 tangent_of(int contact, const Vec2& n) {
  return contact == kJaw1 ? perp(n) : -perp(n);
}

Freedoms row_of(const Vec2& direction, const Vec2& place, double jaw_rate) {
  return {direction.x(), direction.y(), cross(place, direction),
          -jaw_rate * direction.x()};
}

void add_point(Turning& turning, int contact, const SectionTouch& touch, int index,
               JawMode mode, double length) {
  PointRows& point = turning.point[turning.count++];
  point.contact = contact;
  point.place = touch.point[index];
  point.direction = touch.normal;
  const Vec2 place = touch.point[index] / length;
  const double jaw_rate = jaw_rate_of(mode, contact);
  point.normal = row_of(touch.normal, place, jaw_rate);
  point.tangential = row_of(tangent_of(contact, touch.normal), place, jaw_rate);
}

void add_row(LinearProgram& program, const Freedoms& row, double sign, Relation relation,
             double right) {
  LinearProgram::Point& cells = program.add_row(relation, right);
  for (int k = 0; k < kFreedoms; ++k) cells[k] = sign * row[k];
}

// Points of one contact have the same rates here: where the object turns only one of them
// stays.
bool is_first_of_contact(const Turning& turning, int p) {
  return p == 0 || turning.point[p - 1].contact != turning.point[p].contact;
}

LinearProgram motion_program(const Turning& turning, double sheet_rate, Modes modes) {
  LinearProgram program(kFreedoms, /*nonnegative=*/false);
  for (int p = 0; p < turning.count; ++p) {
    if (!is_first_of_contact(turning, p)) continue;
    const PointRows& point = turning.point[p];
    const unsigned bits = bits_of(modes, point.contact);
    const double rate = point.contact == kSheet ? sheet_rate : 0.0;
    if (bits == kOpenBits) {
      add_row(program, point.normal, -1.0, Relation::kAtMost, 0.0);
      continue;
    }
    add_row(program, point.normal, 1.0, Relation::kEqual, 0.0);
    if (bits == kSlipMinusBits) {
      add_row(program, point.tangential, 1.0, Relation::kAtMost, rate);
    } else if (bits == kSlipPlusBits) {
      add_row(program, point.tangential, -1.0, Relation::kAtMost, -rate);
    } else {
      add_row(program, point.tangential, 1.0, Relation::kEqual, rate);
    }
  }
  switch (turning.way) {
    case Turning::Way::kNone:
      program.add_row(Relation::kEqual, 0.0)[2] = 1.0;
      break;
    case Turning::Way::kPlus:
      program.add_row(Relation::kAtMost, 0.0)[2] = -1.0;
      break;
    case Turning::Way::kMinus:
      program.add_row(Relation::kAtMost, 0.0)[2] = 1.0;
      break;
    case Turning::Way::kAny:
      break;
  }
  return program;
}

// Whether a motion is what the modes say: rows that are nearly parallel can make the
// programme lose its way.
bool is_allowed(const LinearProgram& program, const Freedoms& v) {
  constexpr double kMissed = 1e-8;
  for (int row = 0; row < program.rows; ++row) {
    double excess = -program.right[row];
    for (int k = 0; k < kFreedoms; ++k) excess += program.coefficient[row][k] * v[k];
    if (program.relation[row] == Relation::kEqual) excess = std::abs(excess);
    if (!(excess <= kMissed)) return false;
  }
  return true;
}

// The extreme motion in one direction; along an unbounded ray, one step of it. The
// `known` one where the programme gets lost.
Freedoms extreme_motion(const LinearProgram& program, int freedom, double sign,
                        const Freedoms& known) {
  LinearProgram::Point cost{};
  cost[freedom] = sign;
  const LinearSolution solution = minimise(program, cost);
  if (!solution.feasible()) return known;
  const double step = solution.status == LinearStatus::kUnbounded ? 1.0 : 0.0;
  Freedoms v{};
  for (int k = 0; k < kFreedoms; ++k) v[k] = solution.x[k] + step * solution.ray[k];
  return is_allowed(program, v) ? v : known;
}

}  // namespace

Turnings turnings_of(const PrismContacts& contacts, JawMode mode, double length) {
  using Way = Turning::Way;
  Turnings turnings;
  const auto add = [&](Way way) {
    Turning& turning = turnings.each[turnings.count++];
    turning.way = way;
    for (int contact = 0; contact < kContacts; ++contact) {
      const SectionTouch& touch = contacts.touch[contact];
      if (way != Way::kNone) {
        const int index = staying_point(touch, way == Way::kMinus ? -1 : 1);
        add_point(turning, contact, touch, index, mode, length);
        continue;
      }
      for (int i = 0; i < touch.count; ++i)
        add_point(turning, contact, touch, i, mode, length);
    }
  };
  if (!contacts.any_flat()) {
    add(Way::kAny);
    return turnings;
  }
  for (const Way way : {Way::kNone, Way::kPlus, Way::kMinus}) add(way);
  return turnings;
}

MotionSet motions_of(const Turning& turning, double sheet_rate, Modes modes) {
  const LinearProgram program = motion_program(turning, sheet_rate, modes);
  MotionSet set;
  const LinearSolution point = find_point(program);
  if (!point.feasible()) return set;
  const Freedoms known{point.x[0], point.x[1], point.x[2], point.x[3]};
  if (!is_allowed(program, known)) return set;
  set.count = 1;
  for (const int freedom : {2, 0, 1, 3}) {  // roll first: it tells motions apart best
    set.member[0] = extreme_motion(program, freedom, 1.0, known);
    set.member[1] = extreme_motion(program, freedom, -1.0, known);
    if (same_motion(set.member[0], set.member[1])) continue;
    set.count = 2;
    break;
  }
  return set;
}

bool same_motion(const Freedoms& a, const Freedoms& b) {
  for (int k = 0; k < kFreedoms; ++k)
    if (std::abs(a[k] - b[k]) > kSameMotion) return false;
  return true;
}

double dot(const Freedoms& a, const Freedoms& b) {
  double sum = 0.0;
  for (int k = 0; k < kFreedoms; ++k) sum += a[k] * b[k];
  return sum;
}

Freedoms edge_of(const PointRows& point, double mu, double sign) {
  const double length = std::hypot(1.0, mu);
  Freedoms edge{};
  for (int k = 0; k < kFreedoms; ++k)
    edge[k] = (point.normal[k] + sign * mu * point.tangential[k]) / length;
  return edge;
}

ForceProgram force_program(const Turning& turning, const Balance& balance, Modes modes,
                           const Freedoms& demand) {
  ForceProgram force;
  int count = 0;
  for (int p = 0; p < turning.count; ++p)
    for (int bit = 0; bit < 2; ++bit)
      if ((bits_of(modes, turning.point[p].contact) >> bit) & 1U)
        force.column[count++] = 2 * p + bit;
  force.program = LinearProgram(count);
  for (int k = 0; k < kFreedoms; ++k) force.program.add_row(Relation::kEqual, demand[k]);
  for (int c = 0; c < count; ++c) {
    const PointRows& point = turning.point[force.column[c] / 2];
    const Freedoms edge =
        edge_of(point, balance.mu[point.contact], force.column[c] % 2 == 0 ? 1.0 : -1.0);
    for (int k = 0; k < kFreedoms; ++k) force.program.coefficient[k][c] = edge[k];
  }
  return force;
}

SectionForces forces_of(const Turning& turning, const Balance& balance,
                        const ForceProgram& force, const LinearProgram::Point& load) {
  SectionForces forces;
  forces.normal.fill(0.0);
  forces.tangential.fill(0.0);
  std::array<Vec2, kContacts> moment;
  moment.fill(Vec2::Zero());
  for (int p = turning.count - 1; p >= 0; --p) {
    forces.point[turning.point[p].contact] = turning.point[p].place;
    forces.direction[turning.point[p].contact] = turning.point[p].direction;
  }
  for (int c = 0; c < force.program.variables; ++c) {
    const PointRows& point = turning.point[force.column[c] / 2];
    const double mu = balance.mu[point.contact];
    const double normal = load[c] / std::hypot(1.0, mu);
    forces.normal[point.contact] += normal;
    forces.tangential[point.contact] += (force.column[c] % 2 == 0 ? mu : -mu) * normal;
    moment[point.contact] += normal * point.place;
  }
  for (int i = 0; i < kContacts; ++i)
    if (forces.normal[i] > 0.0) forces.point[i] = moment[i] / forces.normal[i];
  return forces;
}

namespace {

// What tells the forces at one motion apart: the resultant of each contact and where it
// acts. The split between the two ends of a flat contact says nothing more.
constexpr int kParts = 3 * kContacts;

double part_of(const PointRows& point, double mu, double sign, int part) {
  const int contact = (part / 3 + kSheet) % kContacts;  // the support's load comes first
  if (point.contact != contact) return 0.0;
  const double normal = 1.0 / std::hypot(1.0, mu);
  if (part % 3 == 0) return normal;
  if (part % 3 == 1) return sign * mu * normal;
  return normal * point.normal[2];  // its moment
}

}  // namespace

ForceRange force_range(const Turning& turning, const Balance& balance, Modes modes) {
  const ForceProgram force = force_program(turning, balance, modes, balance.demand);
  const int count = force.program.variables;
  ForceRange range;
  LinearProgram::Point least{};
  LinearProgram::Point greatest{};
  for (int part = 0; part < kParts && !range.wedges; ++part) {
    LinearProgram::Point up{};
    LinearProgram::Point down{};
    for (int c = 0; c < count; ++c) {
      const PointRows& point = turning.point[force.column[c] / 2];
      up[c] = part_of(point, balance.mu[point.contact],
                      force.column[c] % 2 == 0 ? 1.0 : -1.0, part);
      down[c] = -up[c];
    }
    const LinearSolution low = minimise(force.program, up);
    const LinearSolution high = minimise(force.program, down);
    if (low.status == LinearStatus::kUnbounded) continue;  // another part wedges too
    if (!low.feasible() || !high.feasible()) return range;
    least = low.x;
    range.wedges = high.status == LinearStatus::kUnbounded;
    greatest = range.wedges ? low.x : high.x;
    if (range.wedges || -high.value - low.value > kSameForce) break;
    range.unique = part == kParts - 1;
  }
  LinearProgram::Point middle{};
  for (int c = 0; c < count; ++c) middle[c] = 0.5 * (least[c] + greatest[c]);
  range.solved = true;
  range.least = forces_of(turning, balance, force, least);
  range.greatest = forces_of(turning, balance, force, greatest);
  range.middle = forces_of(turning, balance, force, middle);
  return range;
}

}  // namespace prehensile::prism
