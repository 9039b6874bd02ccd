// Checks an answer about a prism's section from the polygon, velocities of body points
// and sums of forces and moments. Shares no code with solver and contact finder.

#include <algorithm>
#include <cmath>

#include "mechanics/certificate_evidence.h"
#include "mechanics/prism_section.h"

namespace prehensile {
namespace {

constexpr double kTouching = 1e-8;  // of the size
constexpr double kTakes = 1e-6;     // least traction of a wedge, of its greatest force

// A place where object and contact touch, with the normal that a force there must have.
struct Place {
  Vec2 p, n;
};

// At most every vertex and both ends of the pad.
struct Places {
  int count = 0;
  std::array<Place, SectionPolygon::kCapacity + 4> place;
};

struct Question {
  const PrismGrip& grip;
  const CrossSectionDrive& drive;
  double size, V, F;
  Vec2 com;
  std::array<Vec2, 3> rate;  // of each contact's surface per unit of closing rate
  std::array<double, 3> mu;
  std::array<Places, 3> touching;
};

// The pad as a body of its own: its deepest advance into the section, found by asking
// how far each candidate point of either body may be pushed along z.
void find_jaw_places(const std::array<Vec2, SectionPolygon::kCapacity>& v, int count,
                     double side, const PadReach& pads, double tolerance, Places& out) {
  // In mirrored coordinates (side z) the jaw always comes from below.
  double nearest = 1e300;
  const auto visit = [&](const auto& keep) {
    for (int i = 0; i < count; ++i) {
      const Vec2& a = v[i];
      const Vec2& b = v[(i + 1) % count];
      if (a.y() > pads.low - tolerance && a.y() < pads.high + tolerance)
        keep(a, Vec2(side, 0.0));
      for (const double u : {pads.low, pads.high}) {
        if ((a.y() - u) * (b.y() - u) >= 0.0) continue;
        const Vec2 p = a + (b - a) * ((u - a.y()) / (b.y() - a.y()));
        const Vec2 d = (b - a) / (b - a).norm();
        // On a flat side the pad pushes with its flat, else with its end.
        const bool flat = std::abs(d.x()) * (b - a).norm() < tolerance;
        keep(p, flat ? Vec2(side, 0.0) : Vec2(-d.y(), d.x()));
      }
    }
  };
  visit([&](const Vec2& p, const Vec2&) { nearest = std::min(nearest, side * p.x()); });
  visit([&](const Vec2& p, const Vec2& n) {
    if (side * p.x() > nearest + tolerance || side * n.x() <= 0.0) return;
    if (out.count < static_cast<int>(out.place.size())) out.place[out.count++] = {p, n};
  });
}

Question question_of(const SectionPolygon& polygon, double roll, const PadReach& pads,
                     const PrismGrip& grip, const CrossSectionDrive& drive) {
  Question q{grip, drive};
  q.size = polygon.size;
  q.V = std::abs(drive.sheet_rate);
  q.F = std::max(2.0 * grip.grip_force, std::abs(drive.weight));
  if (q.F == 0.0) q.F = 1.0;
  q.com = rotated(roll, polygon.com);
  q.rate = {Vec2(grip.jaw_mode == JawMode::kFixedJaw1 ? 0.0 : 1.0, 0.0),
            Vec2(grip.jaw_mode == JawMode::kFixedJaw2 ? 0.0 : -1.0, 0.0), Vec2::Zero()};
  q.mu = {grip.friction[0], grip.friction[1], drive.mu};
  std::array<Vec2, SectionPolygon::kCapacity> v;
  double lowest = 1e300;
  for (int i = 0; i < polygon.count; ++i) {
    v[i] = rotated(roll, polygon.vertex[i]);
    lowest = std::min(lowest, v[i].y());
  }
  const double tolerance = kTouching * q.size;
  find_jaw_places(v, polygon.count, 1.0, pads, tolerance, q.touching[kJaw1]);
  find_jaw_places(v, polygon.count, -1.0, pads, tolerance, q.touching[kJaw2]);
  Places& sheet = q.touching[kSheet];
  for (int i = 0; i < polygon.count; ++i)
    if (v[i].y() <= lowest + tolerance) sheet.place[sheet.count++] = {v[i], {0.0, 1.0}};
  return q;
}

Vec2 tangent_at(int contact, const Vec2& n) {
  return contact == kJaw1 ? Vec2(-n.y(), n.x()) : Vec2(n.y(), -n.x());
}

// Velocity of the object at p against the contact; the support moves at `sheet_rate`.
Vec2 relative_rate(const Question& q, int contact, const CrossSectionMotion& m,
                   const Vec2& p, double sheet_rate) {
  const Vec2 object(m.v_z - m.roll_rate * p.y(), m.v_u + m.roll_rate * p.x());
  const Vec2 sheet(contact == kSheet ? sheet_rate : 0.0, 0.0);
  return object - sheet - m.jaw_rate * q.rate[contact];
}

// How far a force is from acting at the touching places (in sizes) along a normal that a
// force there can have.
double misplacement(const Question& q, int contact, const SectionForces& f) {
  const Places& places = q.touching[contact];
  double nearest = kFails;
  for (int i = 0; i < places.count; ++i) {
    if ((places.place[i].n - f.direction[contact]).norm() > 1e-9) continue;
    for (int j = i; j < places.count; ++j) {
      const Vec2 d = places.place[j].p - places.place[i].p;
      const Vec2 to = f.point[contact] - places.place[i].p;
      const double length = std::max(d.squaredNorm(), 1e-300);
      const double s = std::clamp(d.dot(to) / length, 0.0, 1.0);
      nearest = std::min(nearest, (s * d - to).norm() / q.size);
    }
  }
  return nearest;
}

// Unbalanced force, moment and grip, relative to F. `load` 1: with gravity and grip.
double imbalance(const Question& q, const SectionForces& f, double load) {
  const double weight = load * q.drive.weight;
  Vec2 force(0.0, -weight);
  double moment = -weight * q.com.x();
  double gripped = 0.0;
  double wanted = 0.0;
  for (int i = 0; i < 3; ++i) {
    if (f.normal[i] != 0.0 && misplacement(q, i, f) > 1e-6) return kFails;
    const Vec2& n = f.direction[i];
    const Vec2 on_object = f.normal[i] * n + f.tangential[i] * tangent_at(i, n);
    force += on_object;
    moment += f.point[i].x() * on_object.y() - f.point[i].y() * on_object.x();
    gripped += q.rate[i].dot(on_object);
    if (i != kSheet) wanted += load * q.grip.grip_force * std::abs(q.rate[i].x());
  }
  return worst_of({force.norm(), std::abs(moment) / q.size, std::abs(gripped - wanted)}) /
         q.F;
}

double cone_violation(const Question& q, const SectionForces& f) {
  double worst = 0.0;
  for (int i = 0; i < 3; ++i)
    worst = worst_of({worst, -f.normal[i] / q.F,
                      (std::abs(f.tangential[i]) - q.mu[i] * f.normal[i]) / q.F});
  return worst;
}

// How fast object and contact close in at a touching place, in sheet rates. Where a
// corner of the section meets an end of the pad, one of both normals that parts them is
// enough.
double closing(const Question& q, int contact, const CrossSectionMotion& m,
               const Vec2& p) {
  const Places& places = q.touching[contact];
  double best = 1e300;
  for (int k = 0; k < places.count; ++k) {
    if ((places.place[k].p - p).norm() > kTouching * q.size) continue;
    const Vec2 rate = relative_rate(q, contact, m, p, q.drive.sheet_rate);
    best = std::min(best, -places.place[k].n.dot(rate) / q.V);
  }
  return best;
}

// No touching place closes in, and at each resultant the unilateral law and Coulomb's law
// hold: its distance from its projection after one step along the rate.
double law_violation(const Question& q, const CrossSectionMotion& m,
                     const SectionForces& f) {
  double worst = 0.0;
  for (int i = 0; i < 3; ++i) {
    const Places& places = q.touching[i];
    for (int k = 0; k < places.count; ++k)
      worst = worse(worst, closing(q, i, m, places.place[k].p));
    const double l = f.normal[i] / q.F;
    const double t = f.tangential[i] / q.F;
    if (l == 0.0 && t == 0.0) continue;
    const Vec2& n = f.direction[i];
    const Vec2 rate = relative_rate(q, i, m, f.point[i], q.drive.sheet_rate) / q.V;
    const double bound = q.mu[i] * std::max(0.0, l);
    const double l_step = std::max(0.0, l - n.dot(rate));
    const double t_step = std::clamp(t - tangent_at(i, n).dot(rate), -bound, bound);
    worst = worst_of({worst, std::abs(l - l_step), std::abs(t - t_step)});
  }
  return worst;
}

double solution_violation(const Question& q, const CrossSectionMotion& m,
                          const SectionForces& f) {
  const double sum = m.v_z + m.v_u + m.roll_rate + m.jaw_rate;
  if (!std::isfinite(sum)) return kNan;
  return worst_of({imbalance(q, f, 1.0), cone_violation(q, f), law_violation(q, m, f)});
}

double mode_violation(const Question& q, const PrismInstant& answer) {
  double worst = 0.0;
  for (int i = 0; i < 3; ++i) {
    double gap = 1e300;
    double slip = 0.0;
    for (int k = 0; k < q.touching[i].count; ++k) {
      const Place& place = q.touching[i].place[k];
      const Vec2 rate = relative_rate(q, i, answer.motion, place.p, q.drive.sheet_rate);
      const bool named = (place.n - answer.forces.direction[i]).norm() <= 1e-9;
      if (!named || place.n.dot(rate) >= gap) continue;
      gap = place.n.dot(rate);
      slip = tangent_at(i, place.n).dot(rate) / q.V;
    }
    double wrong = kFails;
    switch (answer.mode[i]) {
      case ContactMode::kOpen:
        wrong = std::abs(answer.forces.normal[i]) / q.F;
        break;
      case ContactMode::kStick:
        wrong = worse(gap / q.V, std::abs(slip));
        break;
      case ContactMode::kSlipPlus:
        wrong = worse(gap / q.V, -slip);
        break;
      case ContactMode::kSlipMinus:
        wrong = worse(gap / q.V, slip);
        break;
      case ContactMode::kSlip:
        break;
    }
    worst = worse(worst, wrong);
  }
  return worst;
}

double largest_rate(const Question& q, const CrossSectionMotion& m) {
  return worst_of({std::abs(m.v_z), std::abs(m.v_u), std::abs(m.roll_rate) * q.size,
                   std::abs(m.jaw_rate)}) /
         q.V;
}

double claim_violation(const Question& q, const PrismInstant& answer) {
  const CrossSectionMotion& m = answer.motion;
  const CrossSectionMotion& other = answer.other;
  if (answer.status == InstantStatus::kHolds) return largest_rate(q, m);
  if (answer.status != InstantStatus::kAmbiguous) return 0.0;
  const CrossSectionMotion gap{m.v_z - other.v_z, m.v_u - other.v_u,
                               m.roll_rate - other.roll_rate,
                               m.jaw_rate - other.jaw_rate};
  const double same = largest_rate(q, gap) > 1e-9 ? 0.0 : kFails;
  return worse(same, solution_violation(q, other, answer.other_forces));
}

// No force that any contact can exert opposes the motion, and gravity and grip gain
// power.
double dynamic_violation(const Question& q, const CrossSectionMotion& fall) {
  const double size = largest_rate(q, fall);
  double worst = 0.0;
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < q.touching[i].count; ++k) {
      const Place& place = q.touching[i].place[k];
      const Vec2 rate = relative_rate(q, i, fall, place.p, 0.0) / q.V;
      const double slip = tangent_at(i, place.n).dot(rate);
      worst = worse(worst, q.mu[i] * std::abs(slip) - place.n.dot(rate));
    }
  }
  double power = -q.drive.weight * (fall.v_u + fall.roll_rate * q.com.x());
  for (const int jaw : {kJaw1, kJaw2})
    power += q.grip.grip_force * std::abs(q.rate[jaw].x()) * fall.jaw_rate;
  return power > 0.0 ? worst / size : kFails;
}

// Relative to the wedge's own greatest force: in units of the grip a tiny one would
// always balance.
double jam_violation(const Question& q, const SectionForces& wedge) {
  double largest = 0.0;
  for (int i = 0; i < 3; ++i)
    largest =
        worst_of({largest, std::abs(wedge.normal[i]), std::abs(wedge.tangential[i])});
  const double taken = wedge.tangential[kSheet] * std::copysign(1.0, q.drive.sheet_rate);
  if (!(taken > kTakes * largest)) return kFails;
  return worse(imbalance(q, wedge, 0.0), cone_violation(q, wedge)) * (q.F / largest);
}

}  // namespace

double prism_residual(const SectionPolygon& polygon, double roll, const PadReach& pads,
                      const PrismGrip& grip, const CrossSectionDrive& drive,
                      const PrismInstant& answer) noexcept {
  const Question q = question_of(polygon, roll, pads, grip, drive);
  switch (answer.status) {
    case InstantStatus::kMoves:
    case InstantStatus::kHolds:
    case InstantStatus::kNonuniqueForces:
    case InstantStatus::kAmbiguous:
      break;
    case InstantStatus::kDynamic:
      return dynamic_violation(q, answer.evidence);
    case InstantStatus::kJammed:
      return jam_violation(q, answer.evidence_forces);
    case InstantStatus::kNotRun:
    case InstantStatus::kSeparated:
    case InstantStatus::kOutOfIterations:
    case InstantStatus::kBadInput:
      return kNan;
  }
  const double force =
      std::hypot(answer.forces.normal[kSheet], answer.forces.tangential[kSheet]);
  return worst_of({solution_violation(q, answer.motion, answer.forces),
                   solution_violation(q, answer.motion, answer.least),
                   solution_violation(q, answer.motion, answer.greatest),
                   mode_violation(q, answer), std::abs(force - answer.push_force) / q.F,
                   claim_violation(q, answer)});
}

}  // namespace prehensile
