#include "mechanics/spatial_evidence.h"

#include <algorithm>

#include "mechanics/certificate_evidence.h"

namespace prehensile {
namespace {

constexpr double kGains = 1e-9;     ///< least gain of power that counts, relative
constexpr double kFalls = 3.0;      ///< a fall is faster than this many unit rates
constexpr double kMostYield = 0.5;  ///< at rest is at most this fast, in unit rates
constexpr double kYields = 10.0;    ///< foundations may yield to this many unit forces

bool is_pad(const ContactPatch& patch) { return patch.body != ContactBody::kPusher; }

/// Speed of a jaw along the normal of its patches.
double jaw_speed(const SpatialProblem& problem, ContactBody body,
                 const SpatialRates& rates) {
  const JawFreedoms jaws = jaw_freedoms(problem);
  const auto& share = body == ContactBody::kJaw1 ? jaws.jaw1 : jaws.jaw2;
  double speed = 0.0;
  for (int i = 0; i < jaws.count; ++i) speed += share[i] * rates[6 + i];
  return speed;
}

/// Power of gravity and of the drive of the jaws.
double driving_power(const SpatialProblem& problem, const SpatialRates& rates) {
  const JawFreedoms jaws = jaw_freedoms(problem);
  double power = problem.w_g.dot(rates.head<6>());
  for (int i = 0; i < jaws.count; ++i) power += jaws.effort[i] * rates[6 + i];
  return power;
}

double size_of(const SpatialRates& rates, const SpatialCertificateUnits& units) {
  const Vec3 w = rates.segment<3>(3);
  const Vec3 v = rates.head<3>() + w.cross(units.centre);
  return v.norm() + units.length * w.norm() + rates.tail<2>().norm();
}

/// Power that a force takes at these rates of the object; the pusher is seen at rest, as
/// it is small against a fall.
double power_taken(const SpatialForce& f, const SeenRates& c) {
  return -(f.normal * c.normal + f.tangential.dot(c.slip) + f.spin * c.spin);
}

/// The object falls with these rates and forces: gravity and the drive of the jaws gain
/// more than pads and, if it is there, the pusher take.
double fall_violation(const SpatialProblem& problem, const SpatialRates& fall,
                      const SpatialForceList& forces, bool with_pusher,
                      const SpatialCertificateUnits& units) {
  if (!fall.allFinite()) return kNan;
  if (!(size_of(fall, units) >= kFalls * units.rate)) return kFails;
  SpatialProblem at_rest = problem;
  at_rest.V_HP.setZero();
  double gain = driving_power(problem, fall);
  double pusher_takes = 0.0;
  for (int k = 0; k < problem.patch_count; ++k) {
    const ContactPatch& patch = problem.patch[k];
    if (!is_pad(patch) && !with_pusher) continue;
    for (int i = patch.first; i < patch.first + patch.count; ++i) {
      const double taken = power_taken(forces[i], rates_at(at_rest, patch, i, fall));
      (is_pad(patch) ? gain : pusher_takes) += is_pad(patch) ? -taken : taken;
    }
  }
  const double margin = kGains * units.force * size_of(fall, units);
  return gain > std::max(0.0, pusher_takes) + margin ? 0.0 : kFails;
}

double other_violation(const SpatialInstant& answer,
                       const SpatialCertificateUnits& units) {
  const SpatialRates apart = answer.other - rates_of(answer);
  const double size = size_of(rates_of(answer), units);
  return size_of(apart, units) > 1e-6 * (units.rate + size) ? 0.0 : kFails;
}

double ambiguous_violation(const SpatialProblem& problem, const SpatialInstant& answer,
                           const SpatialCertificateUnits& units) {
  if (answer.other.allFinite()) return other_violation(answer, units);
  return fall_violation(problem, answer.evidence, answer.other_force, false, units);
}

/// The object stays. A pusher that presses on it nevertheless finds pads that stick.
double rest_violation(const SpatialProblem& problem, const SpatialInstant& answer,
                      const SpatialCertificateUnits& units) {
  double pressed = 0.0;
  double slipped = 0.0;
  double yield = 1e-6 * units.rate;
  for (int k = 0; k < problem.patch_count; ++k) {
    const ContactPatch& patch = problem.patch[k];
    if (patch.pressure == PressureLaw::kFoundation) {
      const double own = kYields * patch.compliance * units.force;
      yield = std::max(yield, std::min(kMostYield * units.rate, own));
    }
    for (int i = patch.first; i < patch.first + patch.count; ++i) {
      const SpatialPoint& point = answer.point[i];
      double& worst = is_pad(patch) ? slipped : pressed;
      worst = worse(worst, is_pad(patch) ? point.slip_rate.norm() / units.rate
                                         : std::abs(point.normal_force) / units.force);
    }
  }
  const double moved = size_of(rates_of(answer), units);
  const bool may_press = answer.status == InstantStatus::kHolds;
  const double worst = may_press ? std::min(pressed, slipped) : pressed;
  return worse(worst, moved <= yield ? 0.0 : moved / units.rate);
}

double interval_violation(const SpatialProblem& problem, const SpatialInstant& answer,
                          const SpatialCertificateUnits& units) {
  double sum = 0.0;
  for (int k = 0; k < problem.patch_count; ++k) {
    const ContactPatch& patch = problem.patch[k];
    if (is_pad(patch)) continue;
    for (int i = patch.first; i < patch.first + patch.count; ++i) {
      sum += answer.point[i].normal_force;
    }
  }
  return worse(worse(0.0, answer.force_low - sum), sum - answer.force_high) / units.force;
}

/// Forces that balance each other and take power from the pusher.
double jammed_violation(const SpatialProblem& problem, const SpatialInstant& answer,
                        const SpatialCertificateUnits& units) {
  SpatialWrench sum = SpatialWrench::Zero();
  const JawFreedoms jaws = jaw_freedoms(problem);
  std::array<double, 2> jaw_sum{0.0, 0.0};
  double largest = 0.0;
  double power = 0.0;
  double worst = 0.0;
  const SpatialRates still = SpatialRates::Zero();
  for (int k = 0; k < problem.patch_count; ++k) {
    const ContactPatch& patch = problem.patch[k];
    for (int i = patch.first; i < patch.first + patch.count; ++i) {
      const SpatialPoint& point = answer.point[i];
      const SpatialForce f{point.normal_force, point.tangential_force, point.spin_moment};
      const bool soft = patch.spin_radius > 0.0;
      const double spin = soft ? f.spin / patch.spin_radius : f.spin / units.length;
      const double friction = std::hypot(f.tangential.norm(), spin);
      worst = worse(worst, worse(-f.normal, friction - patch.mu * f.normal));
      largest = worse(largest, f.normal);
      sum += wrench_at(problem, patch, i, f);
      for (int j = 0; j < jaws.count && is_pad(patch); ++j) {
        const bool first = patch.body == ContactBody::kJaw1;
        jaw_sum[j] += (first ? jaws.jaw1[j] : jaws.jaw2[j]) * f.normal;
      }
      // The object at rest: the pusher's rates relative to it, turned round.
      if (!is_pad(patch)) power += power_taken(f, rates_at(problem, patch, i, still));
    }
  }
  const Vec3 moment = sum.tail<3>() - units.centre.cross(Vec3(sum.head<3>()));
  worst = worse(worst, sum.head<3>().norm());
  worst = worse(worst, moment.norm() / units.length);
  worst = worse(worst, worse(std::abs(jaw_sum[0]), std::abs(jaw_sum[1])));
  worst = worse(worst, std::abs(largest - 1.0));
  return power > 1e-6 * units.rate ? worst : kFails;
}

}  // namespace

SpatialCertificateUnits spatial_certificate_units(const SpatialProblem& problem) {
  SpatialCertificateUnits units;
  if (problem.patch_count < 1 || problem.patch_count > SpatialProblem::kMaxPatches ||
      problem.count > SpatialProblem::kMaxPoints) {
    return units;
  }
  double mu = 1.0;
  double squeeze = problem.grip_force;
  double span = 0.0;
  double reach = 0.0;
  int pad_points = 0;
  for (int k = 0; k < problem.patch_count; ++k) {
    const ContactPatch& patch = problem.patch[k];
    if (patch.first < 0 || patch.first + patch.count > problem.count) return units;
    double sum = 0.0;
    for (int i = patch.first; i < patch.first + patch.count; ++i) {
      if (is_pad(patch)) units.centre += problem.p_HC(i);
      sum += problem.preload[i];
    }
    if (!is_pad(patch)) continue;
    pad_points += patch.count;
    mu = std::max(mu, patch.mu);
    squeeze = std::max(squeeze, sum);
  }
  units.centre /= std::max(1, pad_points);
  for (int k = 0; k < problem.patch_count; ++k) {
    const ContactPatch& patch = problem.patch[k];
    for (int i = patch.first; i < patch.first + patch.count; ++i) {
      const Vec3 p = problem.p_HC(i);
      const double away = (p - units.centre).norm();
      if (is_pad(patch)) {
        span = std::max(span, away);
        continue;
      }
      reach = std::max(reach, away);
      const Vec3 v = problem.V_HP.head<3>() + Vec3(problem.V_HP.tail<3>()).cross(p);
      units.rate = std::max(units.rate, v.norm());
    }
  }
  const double driven = (problem.inertia * problem.V_HP).head<3>().norm();
  units.force = mu * std::max({squeeze, problem.w_g.head<3>().norm(), driven});
  if (units.force == 0.0) units.force = 1.0;
  units.length = std::max(span, 0.01 * reach);
  if (units.length == 0.0) units.length = 1.0;
  units.sane = pad_points > 0 && units.rate > 0.0 && std::isfinite(units.rate) &&
               std::isfinite(units.force) && std::isfinite(units.length);
  return units;
}

SeenRates rates_at(const SpatialProblem& problem, const ContactPatch& patch, int point,
                   const SpatialRates& rates) {
  const bool pushes = patch.body == ContactBody::kPusher;
  const SpatialTwist V =
      pushes ? SpatialTwist(rates.head<6>() - problem.V_HP) : rates.head<6>();
  const Vec3 w = V.tail<3>();
  const Vec3 c = V.head<3>() + w.cross(problem.p_HC(point));
  const double advance = pushes ? 0.0 : jaw_speed(problem, patch.body, rates);
  return {patch.n.dot(c) - advance, {patch.t.dot(c), patch.o().dot(c)}, patch.n.dot(w)};
}

SpatialWrench wrench_at(const SpatialProblem& problem, const ContactPatch& patch,
                        int point, const SpatialForce& force) {
  const Vec3 f = force.normal * patch.n + force.tangential.x() * patch.t +
                 force.tangential.y() * patch.o();
  SpatialWrench w;
  w << f, problem.p_HC(point).cross(f) + force.spin * patch.n;
  return w;
}

SpatialRates imbalance(const SpatialProblem& problem, const SpatialRates& rates,
                       const SpatialForce* forces, bool with_pusher,
                       const SpatialCertificateUnits& units) {
  const JawFreedoms jaws = jaw_freedoms(problem);
  SpatialWrench sum = problem.w_g - problem.inertia * rates.head<6>();
  std::array<double, 2> jaw_sum{0.0, 0.0};
  for (int i = 0; i < jaws.count; ++i) {
    const double mass = problem.jaw_mass * (jaws.jaw1[i] + jaws.jaw2[i]);
    jaw_sum[i] = jaws.effort[i] - mass * rates[6 + i];
  }
  for (int k = 0; k < problem.patch_count; ++k) {
    const ContactPatch& patch = problem.patch[k];
    if (!with_pusher && !is_pad(patch)) continue;
    for (int i = patch.first; i < patch.first + patch.count; ++i) {
      sum += wrench_at(problem, patch, i, forces[i]);
      for (int j = 0; j < jaws.count && is_pad(patch); ++j) {
        const bool first = patch.body == ContactBody::kJaw1;
        jaw_sum[j] -= (first ? jaws.jaw1[j] : jaws.jaw2[j]) * forces[i].normal;
      }
    }
  }
  SpatialRates off;
  const Vec3 moment = sum.tail<3>() - units.centre.cross(Vec3(sum.head<3>()));
  off << sum.head<3>() / units.force, moment / (units.force * units.length),
      jaw_sum[0] / units.force, jaw_sum[1] / units.force;
  return off;
}

void list_forces(const SpatialInstant& answer, SpatialForceList& forces) {
  for (int i = 0; i < answer.count; ++i) {
    const SpatialPoint& point = answer.point[i];
    forces[i] = {point.normal_force, point.tangential_force, point.spin_moment};
  }
}

SpatialRates rates_of(const SpatialInstant& answer) {
  SpatialRates rates;
  rates << answer.V_HO, answer.jaw_rate[0], answer.jaw_rate[1];
  return rates;
}

double evidence_violation(const SpatialProblem& problem, const SpatialInstant& answer,
                          const SpatialCertificateUnits& units) {
  switch (answer.status) {
    case InstantStatus::kMoves:
      return 0.0;
    case InstantStatus::kHolds:
    case InstantStatus::kSeparated:
      return rest_violation(problem, answer, units);
    case InstantStatus::kNonuniqueForces:
      return interval_violation(problem, answer, units);
    case InstantStatus::kAmbiguous:
      return ambiguous_violation(problem, answer, units);
    case InstantStatus::kDynamic: {
      SpatialForceList forces;
      list_forces(answer, forces);
      return fall_violation(problem, answer.evidence, forces, true, units);
    }
    case InstantStatus::kJammed:
      return jammed_violation(problem, answer, units);
    case InstantStatus::kNotRun:
    case InstantStatus::kOutOfIterations:
    case InstantStatus::kBadInput:
      break;
  }
  return kFails;
}

}  // namespace prehensile
