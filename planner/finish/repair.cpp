#include "planner/finish/repair.h"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "optimisation/nonlinear_program.h"
#include "planner/finish/moved_stretch.h"

namespace prehensile {
namespace {

constexpr int kEvaluations = 500;
constexpr double kFirstStep = 0.01;      // over L
constexpr double kWanted = 0.01;         // slack of each push: more is no better
constexpr double kEnough = 1e-6;         // above rounding
constexpr double kForbidden = 1.0;       // charge for a push off the object, or not held
constexpr double kReach = 0.5;           // of a way-point from its place, over L
constexpr double kWorst = -10.0;         // slacks below it count as this
constexpr std::size_t kMostPushes = 24;  // beyond it sub-plex gains too little

class StretchRepair {
 public:
  StretchRepair(const SearchModel& search, const Limits& limits, Work& work,
                const Margin& margin, double travelled)
      : search_(search), limits_(limits), stretch_(search, work, margin, travelled) {}

  /// False if no push slips, or no way-points were found with which none does.
  bool run(std::vector<PlannedPush>& pushes) {
    if (!stretch_.read(pushes)) return false;
    NonlinearProgram program;
    program.start = stretch_.way_points();
    for (const double x : program.start) {
      program.lower.push_back(x - kReach * search_.model->L);
      program.upper.push_back(x + kReach * search_.model->L);
    }
    if (missing_of(program.start) == 0.0) return false;
    program.objective = [this](std::span<const double> x, std::span<double>) {
      return missing_of(x);
    };
    program.stop = [this] { return !repaired_.empty() || limits_.reached(); };
    minimise_nlopt(program, LocalMethod::kSubplex,
                   {.tolerance = 1e-6, .max_evaluations = kEvaluations},
                   kFirstStep * search_.model->L);
    if (repaired_.empty()) return false;
    pushes = std::move(repaired_);
    return true;
  }

 private:
  /// What the pushes miss; 0 where they stick with slack to spare. Keeps them if they
  /// stick.
  double missing_of(std::span<const double> x) {
    if (!stretch_.look(x, pushes_, looks_)) return std::numeric_limits<double>::max();
    double missing = 0.0;
    for (const MovedPush& push : looks_) {
      if (!push.is_allowed) missing += kForbidden;
      const double short_of = std::max(0.0, kWanted - std::max(push.slack, kWorst));
      missing += short_of * short_of;
    }
    if (std::ranges::all_of(looks_, [](const MovedPush& push) {
          return push.is_allowed && push.slack >= kEnough;
        })) {
      repaired_ = pushes_;
    }
    return missing;
  }

  const SearchModel& search_;
  const Limits& limits_;
  MovedStretch stretch_;
  std::vector<PlannedPush> pushes_;
  std::vector<MovedPush> looks_;
  std::vector<PlannedPush> repaired_;
};

}  // namespace

bool repair(const SearchModel& search, const Limits& limits, Work& work, Plan& plan) {
  if (!nlopt_is_built()) return false;
  return repair_stretches(
      plan, kMostPushes, [&](std::vector<PlannedPush>& pushes, double travelled) {
        return StretchRepair(search, limits, work, plan.margin, travelled).run(pushes);
      });
}

}  // namespace prehensile
