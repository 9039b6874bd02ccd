#include "planner/steering/pad_kappas.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace prehensile {
namespace {

constexpr int kTrials = 25;        // kappas, denser around zero
constexpr double kLargest = 12.0;  // kappa
constexpr int kRefinements = 4;    // halvings of the step at an end of an interval
constexpr int kPoints = 4;         // along the push
constexpr int kOrientations = 4;   // over half a turn

double trial_kappa(int i) {
  const double u = 2.0 * i / (kTrials - 1) - 1.0;
  return kLargest * std::sinh(4.0 * u) / std::sinh(4.0);
}

class PadTrial {
 public:
  PadTrial(const SearchModel& search, int contact, const Vec2& from, const Vec2& to,
           Work& work)
      : search_(search),
        pusher_(search.contacts[contact]),
        from_(from),
        to_(to),
        e_((from - to).normalized()),
        work_(work),
        margin_(search.margin_from(from)) {
    const bool disc = std::holds_alternative<DiscPad>(search.model->scene.gripper.pad);
    orientations_ = disc ? 1 : kOrientations;
  }

  bool sticks(double kappa) {
    for (int i = 0; i < kPoints; ++i) {
      const Vec2 p_OF = from_ + i * (to_ - from_) / (kPoints - 1);
      const double travelled = (p_OF - from_).norm();
      for (int k = 0; k < orientations_; ++k) {
        const double theta = std::numbers::pi * k / orientations_;
        if (!sticks_at(pose_from_finger(p_OF, theta), kappa, travelled)) return false;
      }
    }
    return true;
  }

  /// The last kappa from `good` towards `bad` that still sticks.
  double end_between(double good, double bad) {
    for (int i = 0; i < kRefinements; ++i) {
      const double middle = 0.5 * (good + bad);
      (sticks(middle) ? good : bad) = middle;
    }
    return good;
  }

 private:
  bool sticks_at(const PlanarPose& X_HO, double kappa, double travelled) {
    ++work_.stick_tests;
    const Model& model = *search_.model;
    const StickTest test =
        exact_stick_test(model, model.contacts[pusher_.contact], pusher_.place, X_HO, e_,
                         1.0, kappa / model.c, margin_, travelled, 0.0);
    return test.slack >= 0.0;
  }

  const SearchModel& search_;
  const SearchContact& pusher_;
  Vec2 from_, to_, e_;
  Work& work_;
  Margin margin_;
  int orientations_;
};

}  // namespace

KappaSet measured_kappas(const SearchModel& search, int contact, const Vec2& from,
                         const Vec2& to, Work& work) noexcept {
  PadTrial trial(search, contact, from, to, work);
  KappaSet set;
  bool inside = false;
  for (int i = 0; i < kTrials; ++i) {
    const double kappa = trial_kappa(i);
    const bool sticks = trial.sticks(kappa);
    if (sticks && !inside) {
      if (set.count == static_cast<int>(set.intervals.size())) break;
      const double lo = i > 0 ? trial.end_between(kappa, trial_kappa(i - 1)) : kappa;
      set.intervals[set.count++] = {lo, kappa};
    } else if (sticks) {
      set.intervals[set.count - 1].hi = kappa;
    } else if (inside) {
      set.intervals[set.count - 1].hi = trial.end_between(trial_kappa(i - 1), kappa);
    }
    inside = sticks;
  }
  return set;
}

}  // namespace prehensile
