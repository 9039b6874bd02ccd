#include "mechanics/spatial_instant.h"

#include <algorithm>

#include "mechanics/spatial_interval.h"
#include "mechanics/spatial_search.h"

namespace prehensile {
namespace {

constexpr double kInside = 1e-12;  ///< friction this much below its bound sticks
constexpr double kGrazing = 1e-6;  ///< gap rates below this do not part

constexpr double kRigid = 1e-8;   ///< compliance of the rigid limit, in units V0 / F0
constexpr double kVaries = 1e-6;  ///< length of an interval of forces that counts
constexpr double kJamForce = 1e3;
constexpr double kFallsFreely = 1e6;  ///< rates of inertia alone, lost to rounding in V0

/// Force of a scaled lane in SI.
SpatialForce force_of(const ScaledSpatial& scaled, const ScaledPatch& patch, int lane,
                      const SpatialForces& forces) {
  const double F0 = scaled.units.force;
  const double spin =
      patch.soft ? F0 * forces.s[lane] * patch.e * scaled.units.length : 0.0;
  return {F0 * forces.n[lane], {F0 * forces.t[lane], F0 * forces.o[lane]}, spin};
}

template <class Use>
void for_each_point(const ScaledSpatial& scaled, Use&& use) {
  for (int k = 0; k < scaled.patch_count; ++k) {
    const ScaledPatch& patch = scaled.patch[k];
    for (int j = 0; j < patch.count; ++j) use(patch, patch.source + j, patch.first + j);
  }
}

ContactMode mode_of(const ScaledPatch& patch, int lane, const SpatialForces& forces) {
  if (forces.n[lane] <= 0.0) return ContactMode::kOpen;
  const double square = forces.t[lane] * forces.t[lane] +
                        forces.o[lane] * forces.o[lane] + forces.s[lane] * forces.s[lane];
  const double bound = patch.mu * forces.n[lane] * (1.0 - kInside);
  return square < bound * bound ? ContactMode::kStick : ContactMode::kSlip;
}

/// Forces, rates and modes of all points at scaled rates v.
void report_points(const SpatialProblem& problem, const ScaledSpatial& scaled,
                   const SpatialRates& v, const SpatialForces& forces,
                   SpatialInstant& answer) {
  const SpatialUnits& units = scaled.units;
  answer.count = problem.count;
  const ScaledPatch* seen = nullptr;
  LocalRates y;
  for_each_point(scaled, [&](const ScaledPatch& patch, int i, int lane) {
    if (seen != &patch) y = patch.relative_rates(v);
    seen = &patch;
    SpatialPoint& point = answer.point[i];
    const SpatialForce f = force_of(scaled, patch, lane, forces);
    point.normal_force = f.normal;
    point.tangential_force = f.tangential;
    point.spin_moment = f.spin;
    const double a = scaled.a[lane];
    const double b = scaled.b[lane];
    point.normal_rate = units.rate * (y[0] + b * y[1] - a * y[2]);
    point.slip_rate = units.rate * Vec2(y[3] - b * y[5], y[4] + a * y[5]);
    point.spin_rate = units.rate / units.length * y[5];
    point.mode = mode_of(patch, lane, forces);
  });
}

void report_motion(const SpatialProblem& problem, const ScaledSpatial& scaled,
                   const SpatialRates& v, const SpatialForces& forces,
                   SpatialInstant& answer) {
  report_points(problem, scaled, v, forces, answer);
  const SpatialRates rates = rates_in_hand(scaled, v);
  answer.V_HO = rates.head<6>();
  answer.jaw_rate = {rates[6], rates[7]};
  answer.w_push.setZero();
  for_each_point(scaled, [&](const ScaledPatch& patch, int i, int) {
    if (patch.body != ContactBody::kPusher) return;
    const SpatialPoint& point = answer.point[i];
    const Vec3 f = patch.Q * Vec3(point.normal_force, point.tangential_force.x(),
                                  point.tangential_force.y());
    answer.w_push.head<3>() += f;
    answer.w_push.tail<3>() +=
        problem.p_HC(i).cross(f) + point.spin_moment * patch.Q.col(0);
  });
  answer.push_force = answer.w_push.head<3>().norm();
}

/// The pusher carries nothing: has it parted everywhere?
InstantStatus judge_rest(const ScaledSpatial& scaled, const SpatialInstant& answer) {
  double least = std::numeric_limits<double>::infinity();
  double yield = kGrazing;
  for_each_point(scaled, [&](const ScaledPatch& patch, int i, int) {
    yield = std::max(yield, std::min(0.1, 10.0 * patch.R));
    if (patch.body != ContactBody::kPusher) return;
    least = std::min(least, answer.point[i].normal_rate / scaled.units.rate);
  });
  return least > yield ? InstantStatus::kSeparated : InstantStatus::kHolds;
}

/// No pad point slips: the object stands still, up to the yield of foundations.
bool pads_stick(const ScaledSpatial& scaled, const SpatialInstant& answer) {
  bool stick = true;
  for_each_point(scaled, [&](const ScaledPatch& patch, int i, int) {
    const SpatialPoint& point = answer.point[i];
    if (patch.body == ContactBody::kPusher) return;
    stick = stick && point.mode == ContactMode::kStick &&
            point.slip_rate.norm() <= 1e-7 * scaled.units.rate;
  });
  return stick;
}

/// More loaded points of rigid pads than equations: their loads cannot be unique.
bool has_free_loads(const SpatialProblem& problem, const SpatialInstant& answer) {
  for (int k = 0; k < problem.patch_count; ++k) {
    const ContactPatch& patch = problem.patch[k];
    if (patch.pressure != PressureLaw::kFree || patch.body == ContactBody::kPusher) {
      continue;
    }
    int loaded = 0;
    for (int i = patch.first; i < patch.first + patch.count; ++i) {
      if (answer.point[i].mode != ContactMode::kOpen) ++loaded;
    }
    if (loaded > 1) return true;
  }
  return false;
}

class Instant {
 public:
  Instant(const SpatialProblem& problem, const SpatialSolveOptions& options,
          SpatialInstant& answer)
      : problem_(problem), options_(options), answer_(answer) {
    scale(problem, scaled_);
  }

  void solve(const SpatialInstant* last) {
    SpatialSearch search(scaled_, options_.tolerance, options_.max_iterations);
    SpatialForces known;
    NewtonStart warm;
    const bool follows = last != nullptr && follow(*last, known, warm);
    follows_rest_ = last != nullptr && !scaled_.has_inertia && follow_rest(*last);
    bool found = search.solve_directly(follows ? &warm : nullptr);
    if (scaled_.has_inertia) {
      found = found || search.solve_otherwise() || search.solve_stubbornly();
      if (found && search.result().v.norm() < kFallsFreely) {
        conclude(search, InstantStatus::kMoves);
      } else if (!report_fall(search)) {
        report_jam(search);
      }
    } else {
      solve_quasi_static(search, found);
    }
    answer_.iterations = search.steps();
    answer_.residual = search.result().residual;
  }

 private:
  using Hold = SpatialSearch::Hold;

  void solve_quasi_static(SpatialSearch& search, bool found) {
    Hold hold =
        found && search.rests_in_pads() ? Hold::kHeld : search.judge_hold(last_rest());
    found = found || search.solve_otherwise();
    if (!found && hold == Hold::kFalls && report_fall(search)) return;
    found = found || search.solve_stubbornly();
    const bool rests = found && search.rests_in_pads();
    if (rests) hold = Hold::kHeld;
    if (!found) {
      // Pads that hold an object at rest may lose it while it is pushed.
      const bool falls = hold != Hold::kFalls && report_fall(search);
      if (!falls) report_jam(search);
      return;
    }
    InstantStatus status = InstantStatus::kMoves;
    SpatialForces fall;
    SpatialRates rates;
    bool falls = hold != Hold::kHeld && search.find_fall(true, fall, rates);
    if (falls && search.approach_rest()) {
      falls = false;
      hold = Hold::kHeld;
    }
    if (!falls && hold != Hold::kHeld) hold = search.judge_hold_patiently();
    if (falls) {
      status = InstantStatus::kAmbiguous;
      answer_.evidence = rates_in_hand(scaled_, rates);
      report_other_forces(fall);
    } else if (hold != Hold::kHeld) {
      return;  // A motion, but whether it is the only one is not known.
    } else if (rests) {
      status = InstantStatus::kSeparated;
    } else {
      answer_.evidence = rates_in_hand(scaled_, search.rest_rates());
      report_other_forces(search.rest_forces());
    }
    conclude(search, status);
  }

  /// No motion that the pusher has to do with: does the object fall?
  bool report_fall(SpatialSearch& search) {
    SpatialForces fall;
    SpatialRates rates;
    if (!search.find_fall(false, fall, rates)) return false;
    answer_.status = InstantStatus::kDynamic;
    report_points(problem_, scaled_, rates, fall, answer_);
    answer_.evidence = rates_in_hand(scaled_, rates);
    return true;
  }

  /// Forces that balance each other and take power from the pusher: is it held up?
  bool report_jam(SpatialSearch& search) {
    SpatialForces jam;
    if (!search.find_jam(jam)) return false;
    answer_.status = InstantStatus::kJammed;
    report_points(problem_, scaled_, SpatialRates::Zero(), jam, answer_);
    for (int i = 0; i < answer_.count; ++i) {
      SpatialPoint& point = answer_.point[i];
      point.normal_force /= scaled_.units.force;
      point.tangential_force /= scaled_.units.force;
      point.spin_moment /= scaled_.units.force;
    }
    return true;
  }

  /// A motion was found.
  void conclude(SpatialSearch& search, InstantStatus status) {
    if (search.result().largest_force > kJamForce && report_jam(search)) return;
    report_motion(problem_, scaled_, search.result().v, search.forces(), answer_);
    if (status == InstantStatus::kSeparated) status = judge_rest(scaled_, answer_);
    const bool stands = status == InstantStatus::kMoves && !scaled_.has_inertia &&
                        search.is_at_rest() && pads_stick(scaled_, answer_);
    if (stands) status = InstantStatus::kHolds;
    if (status == InstantStatus::kMoves || stands) report_interval(search, status);
    SpatialForces extra;
    SpatialRates rates;
    if (options_.probe_multiplicity && search.find_other(extra, rates)) {
      status = InstantStatus::kAmbiguous;
      answer_.other = rates_in_hand(scaled_, rates);
      answer_.evidence.setConstant(kNan);
      report_other_forces(extra);
    }
    answer_.status = status;
  }

  /// Do the pads leave the push force open, or the share of their points in the load?
  void report_interval(const SpatialSearch& search, InstantStatus& status) {
    const ForceInterval interval =
        force_interval(scaled_, search.result().v, search.forces());
    if (!interval.free_forces) return;
    const double F0 = scaled_.units.force;
    double sum = 0.0;
    for_each_point(scaled_, [&](const ScaledPatch& patch, int i, int) {
      if (patch.body == ContactBody::kPusher) sum += answer_.point[i].normal_force;
    });
    const bool varies =
        interval.found && interval.high - interval.low > kVaries * (1.0 + interval.low);
    if (!varies && !has_free_loads(problem_, answer_)) return;
    status = InstantStatus::kNonuniqueForces;
    answer_.force_low = interval.found ? std::min(sum, F0 * interval.low) : sum;
    answer_.force_high = interval.found ? std::max(sum, F0 * interval.high) : sum;
  }

  void report_other_forces(const SpatialForces& forces) {
    for_each_point(scaled_, [&](const ScaledPatch& patch, int i, int lane) {
      answer_.other_force[i] = force_of(scaled_, patch, lane, forces);
    });
  }

  /// Rates and forces of the last instant as a start.
  bool follow(const SpatialInstant& last, SpatialForces& known, NewtonStart& warm) {
    if (last.count != problem_.count || !last.V_HO.allFinite()) return false;
    SpatialRates rates;
    rates << last.V_HO, last.jaw_rate[0], last.jaw_rate[1];
    scale_forces(known, [&](int i) {
      const SpatialPoint& point = last.point[i];
      return SpatialForce{point.normal_force, point.tangential_force, point.spin_moment};
    });
    warm = start_at(rates, known);
    return true;
  }

  /// How the object rested in the pads alone in the last instant as a start.
  bool follow_rest(const SpatialInstant& last) {
    const bool rested = usable(last.status) && last.evidence.allFinite();
    if (last.count != problem_.count || !rested) return false;
    scale_forces(rest_forces_, [&](int i) { return last.other_force[i]; });
    rest_ = start_at(last.evidence, rest_forces_);
    return true;
  }
  const NewtonStart* last_rest() const { return follows_rest_ ? &rest_ : nullptr; }

  NewtonStart start_at(SpatialRates rates, const SpatialForces& known) const {
    for (int i = scaled_.freedoms; i < 8; ++i) rates[i] = 0.0;
    return {.v = scaled_rates(scaled_, rates), .forces = &known, .r = 0.03};
  }

  /// `force(i)` of all points in the lanes of the scaled problem.
  template <class Force>
  void scale_forces(SpatialForces& known, Force&& force) const {
    const double per_force = 1.0 / scaled_.units.force;
    for (int j = 0; j < scaled_.padded; ++j) {
      known.n[j] = known.t[j] = known.o[j] = known.s[j] = 0.0;
    }
    for_each_point(scaled_, [&](const ScaledPatch& patch, int i, int lane) {
      const SpatialForce f = force(i);
      known.n[lane] = per_force * f.normal;
      known.t[lane] = per_force * f.tangential.x();
      known.o[lane] = per_force * f.tangential.y();
      if (patch.soft) {
        known.s[lane] = per_force * f.spin / (patch.e * scaled_.units.length);
      }
    });
  }

  const SpatialProblem& problem_;
  const SpatialSolveOptions& options_;
  SpatialInstant& answer_;
  ScaledSpatial scaled_;
  SpatialForces rest_forces_;
  NewtonStart rest_;
  bool follows_rest_ = false;
};

}  // namespace

SpatialProblem rigid_limit_of(const SpatialProblem& problem) noexcept {
  SpatialProblem rigid = problem;
  const SpatialUnits units = spatial_units(problem);
  for (int k = 0; k < rigid.patch_count; ++k) {
    ContactPatch& patch = rigid.patch[k];
    if (patch.pressure == PressureLaw::kFoundation) {
      patch.compliance = kRigid * units.rate / units.force;
    }
  }
  return rigid;
}

SpatialInstant solve_spatial(const SpatialProblem& problem,
                             const SpatialSolveOptions& options,
                             SpatialWarmStart* warm) noexcept {
  SpatialInstant answer;
  if (!is_posed(problem)) {
    answer.status = InstantStatus::kBadInput;
    return answer;
  }
  answer.status = InstantStatus::kOutOfIterations;
  const SpatialInstant* last = warm != nullptr && warm->valid ? &warm->last : nullptr;
  if (options.rigid_limit) {
    const SpatialProblem rigid = rigid_limit_of(problem);
    Instant(rigid, options, answer).solve(last);
  } else {
    Instant(problem, options, answer).solve(last);
  }
  if (warm != nullptr) {
    warm->valid = usable(answer.status);
    warm->last = answer;
  }
  return answer;
}

}  // namespace prehensile
