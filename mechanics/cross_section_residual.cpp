// Checks an answer about the cross-section from velocities of body points and sums of
// forces and moments. Shares no rows and no code with the solver.

#include <algorithm>
#include <cmath>

#include "mechanics/certificate_evidence.h"
#include "mechanics/cross_section.h"

namespace prehensile {
namespace {

constexpr double kTakes = 1e-6;  // least traction of a wedge, of its greatest force

struct Question {
  double r, V, F;  // units: radius, sheet rate, force
  double sheet_rate, weight, grip;
  std::array<double, 3> mu;
  bool jaw1_moves, jaw2_moves;
};

Question question_of(const CrossSectionModel& model, const CrossSectionDrive& drive) {
  Question q{};
  q.r = model.radius;
  q.V = std::abs(drive.sheet_rate);
  q.F = std::max(2.0 * model.grip_force, std::abs(drive.weight));
  if (q.F == 0.0) q.F = 1.0;
  q.sheet_rate = drive.sheet_rate;
  q.weight = drive.weight;
  q.grip = model.grip_force;
  q.mu = {model.friction[0], model.friction[1], drive.mu};
  q.jaw1_moves = model.jaw_mode != JawMode::kFixedJaw1;
  q.jaw2_moves = model.jaw_mode != JawMode::kFixedJaw2;
  return q;
}

// Rate at which each gap opens and at which the surface slides over its contact [m/s].
struct Rates {
  std::array<double, 3> gap;
  std::array<double, 3> slip;
};

Rates rates_of(const Question& q, const CrossSectionMotion& m, double sheet_rate) {
  // Velocity of the body point at (z, u): (v_z - roll_rate u, v_u + roll_rate z).
  const double jaw1 = q.jaw1_moves ? m.jaw_rate : 0.0;
  const double jaw2 = q.jaw2_moves ? -m.jaw_rate : 0.0;
  return {{m.v_z - jaw1, jaw2 - m.v_z, m.v_u},
          {m.v_u - m.roll_rate * q.r, m.v_u + m.roll_rate * q.r,
           m.v_z + m.roll_rate * q.r - sheet_rate}};
}

// Unbalanced force, moment and grip, relative to F. `load` 1: with gravity and grip; 0:
// the contact forces by themselves.
double imbalance(const Question& q, const CrossSectionForces& f, double load) {
  const auto& l = f.normal;
  const auto& t = f.tangential;
  const double z = l[kJaw1] - l[kJaw2] + t[kSheet];
  const double u = t[kJaw1] + t[kJaw2] + l[kSheet] - load * q.weight;
  const double moment_over_r = -t[kJaw1] + t[kJaw2] + t[kSheet];
  double gripped = 0.0;
  double wanted = 0.0;
  if (q.jaw1_moves) gripped += l[kJaw1], wanted += load * q.grip;
  if (q.jaw2_moves) gripped += l[kJaw2], wanted += load * q.grip;
  return worst_of({std::abs(z), std::abs(u), std::abs(moment_over_r),
                   std::abs(gripped - wanted)}) /
         q.F;
}

double cone_violation(const Question& q, const CrossSectionForces& f) {
  double worst = 0.0;
  for (int i = 0; i < 3; ++i)
    worst = worst_of({worst, -f.normal[i] / q.F,
                      (std::abs(f.tangential[i]) - q.mu[i] * f.normal[i]) / q.F});
  return worst;
}

// Distance of a force from its projection after one step along the rate: zero exactly if
// the unilateral law (normal) and Coulomb's law (tangential) hold.
double law_violation(const Question& q, const CrossSectionForces& f, const Rates& rates) {
  double worst = 0.0;
  for (int i = 0; i < 3; ++i) {
    const double l = f.normal[i] / q.F;
    const double t = f.tangential[i] / q.F;
    const double bound = q.mu[i] * std::max(0.0, l);
    const double l_step = std::max(0.0, l - rates.gap[i] / q.V);
    const double t_step = std::clamp(t - rates.slip[i] / q.V, -bound, bound);
    worst = worst_of({worst, std::abs(l - l_step), std::abs(t - t_step)});
  }
  return worst;
}

double solution_violation(const Question& q, const CrossSectionMotion& m,
                          const CrossSectionForces& f) {
  const double worst = worst_of({imbalance(q, f, 1.0), cone_violation(q, f),
                                 law_violation(q, f, rates_of(q, m, q.sheet_rate))});
  const double sum = m.v_z + m.v_u + m.roll_rate + m.jaw_rate;
  return std::isfinite(sum) ? worst : kNan;
}

double mode_violation(const Question& q, const CrossSectionInstant& answer) {
  const Rates rates = rates_of(q, answer.motion(), q.sheet_rate);
  double worst = 0.0;
  for (int i = 0; i < 3; ++i) {
    const double slip = rates.slip[i] / q.V;
    double wrong = kFails;
    switch (answer.mode[i]) {
      case ContactMode::kOpen:
        wrong = std::abs(answer.normal_force[i]) / q.F;
        break;
      case ContactMode::kStick:
        wrong = std::abs(slip);
        break;
      case ContactMode::kSlipPlus:
        wrong = -slip;
        break;
      case ContactMode::kSlipMinus:
        wrong = slip;
        break;
      case ContactMode::kSlip:
        break;
    }
    worst = worse(worst, wrong);
  }
  return worst;
}

// While the sheet slips, its normal force l determines every other force at a given
// motion: traction by Coulomb, jaw loads by z and grip, jaw friction by u and moment.
// The least slack of the jaws' cones is concave in l, so its zeros end the range.
double jaw_slack(const Question& q, const Rates& rates, double l) {
  const double traction =
      l > 0.0 ? (rates.slip[kSheet] > 0.0 ? -q.mu[kSheet] : q.mu[kSheet]) * l : 0.0;
  double l1 = q.grip;
  double l2 = q.grip;
  if (!q.jaw1_moves) {
    l1 = l2 - traction;
  } else if (!q.jaw2_moves) {
    l2 = l1 + traction;
  } else {
    l1 -= 0.5 * traction;
    l2 += 0.5 * traction;
  }
  const double t1 = 0.5 * (q.weight - l + traction);
  const double t2 = 0.5 * (q.weight - l - traction);
  return std::min(
             {l1, l2, q.mu[kJaw1] * l1 - std::abs(t1), q.mu[kJaw2] * l2 - std::abs(t2)}) /
         q.F;
}

double range_violation(const Question& q, const CrossSectionInstant& answer) {
  const double l = answer.normal_force[kSheet];
  const double low = answer.sheet_force_low;
  const double high = answer.sheet_force_high;
  const double outside = worst_of({-low, low - l, l - high}) / q.F;
  if (answer.status != InstantStatus::kNonuniqueForces) return outside;
  const Rates rates = rates_of(q, answer.motion(), q.sheet_rate);
  const bool jaws_stick =
      std::abs(rates.slip[kJaw1]) + std::abs(rates.slip[kJaw2]) <= 1e-9 * q.V;
  if (!jaws_stick || std::abs(rates.slip[kSheet]) <= 1e-9 * q.V) return outside;
  // A little beyond an end some slack must be lost.
  const auto beyond = [&](double end, double sign) {
    return jaw_slack(q, rates, end + sign * 1e-6 * (q.F + end));
  };
  double worst = worse(outside, -jaw_slack(q, rates, low));
  if (low > 1e-5 * q.F && beyond(low, -1.0) > 0.0) worst = worse(worst, kFails);
  const double farthest = std::isfinite(high) ? high : 1e6 * q.F;
  worst = worse(worst, -jaw_slack(q, rates, farthest));
  if (std::isfinite(high) && beyond(high, 1.0) > 0.0) worst = worse(worst, kFails);
  return worst;
}

double push_force_violation(const Question& q, const CrossSectionInstant& answer) {
  const double force =
      std::hypot(answer.normal_force[kSheet], answer.tangential_force[kSheet]);
  return std::abs(force - answer.push_force) / q.F;
}

double largest_rate(const Question& q, const CrossSectionMotion& m) {
  return worst_of({std::abs(m.v_z), std::abs(m.v_u), std::abs(m.roll_rate) * q.r,
                   std::abs(m.jaw_rate)}) /
         q.V;
}

double claim_violation(const Question& q, const CrossSectionInstant& answer) {
  const CrossSectionMotion& other = answer.other;
  if (answer.status == InstantStatus::kHolds)
    return worst_of({std::abs(answer.v_z), std::abs(answer.v_u),
                     std::abs(answer.roll_rate) * q.r}) /
           q.V;
  if (answer.status != InstantStatus::kAmbiguous) return 0.0;
  const CrossSectionMotion gap{answer.v_z - other.v_z, answer.v_u - other.v_u,
                               answer.roll_rate - other.roll_rate,
                               answer.jaw_rate - other.jaw_rate};
  const double same = largest_rate(q, gap) > 1e-9 ? 0.0 : kFails;
  return worse(same, solution_violation(q, other, answer.other_forces));
}

// The jaws oppose the motion with no force that they can exert, the gap to the sheet
// opens, and gravity and grip gain power.
double dynamic_violation(const Question& q, const CrossSectionMotion& fall) {
  const Rates rates = rates_of(q, fall, 0.0);
  const double size = largest_rate(q, fall);
  double worst = 0.0;
  for (const int jaw : {kJaw1, kJaw2})
    worst = worse(worst, (q.mu[jaw] * std::abs(rates.slip[jaw]) - rates.gap[jaw]) / q.V);
  const int driven = (q.jaw1_moves ? 1 : 0) + (q.jaw2_moves ? 1 : 0);
  const double power = -q.weight * fall.v_u + driven * q.grip * fall.jaw_rate;
  return power > 0.0 && rates.gap[kSheet] > 0.0 ? worst / size : kFails;
}

// Relative to the wedge's own greatest force: in units of the grip a tiny one would
// always balance.
double jam_violation(const Question& q, const CrossSectionForces& wedge) {
  double largest = 0.0;
  for (int i = 0; i < 3; ++i)
    largest =
        worst_of({largest, std::abs(wedge.normal[i]), std::abs(wedge.tangential[i])});
  const double taken = wedge.tangential[kSheet] * std::copysign(1.0, q.sheet_rate);
  if (!(taken > kTakes * largest)) return kFails;
  return worse(imbalance(q, wedge, 0.0), cone_violation(q, wedge)) * (q.F / largest);
}

}  // namespace

double cross_section_residual(const CrossSectionModel& model,
                              const CrossSectionDrive& drive,
                              const CrossSectionInstant& answer) noexcept {
  const Question q = question_of(model, drive);
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
  return worst_of({solution_violation(q, answer.motion(), answer.forces()),
                   mode_violation(q, answer), range_violation(q, answer),
                   push_force_violation(q, answer), claim_violation(q, answer)});
}

}  // namespace prehensile
