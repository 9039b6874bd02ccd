#include "planner/finish/repair.h"

#include <algorithm>
#include <limits>

#include "optimisation/nonlinear_program.h"
#include "planner/checks/exact_check.h"
#include "planner/finish/stretch.h"
#include "planner/steering/draft.h"
#include "planner/steering/goal.h"

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
constexpr int kSpreadParts = 8;          // of a push over clipped discs
constexpr std::int64_t kLook = 10;       // work of the slack of a push, in stick tests

/// The way-points of one stretch as variables: x, y of p_OF and c theta [m].
class StretchRepair {
 public:
  StretchRepair(const SearchModel& search, const Limits& limits, Work& work,
                const Margin& margin, double travelled)
      : search_(search),
        limits_(limits),
        work_(work),
        margin_(margin),
        travelled_(travelled) {}

  /// False if no push slips, or no way-points were found with which none does.
  bool run(std::vector<PlannedPush>& pushes) {
    if (!read_stretch(search_, pushes, stretch_) || any_by_point(search_, stretch_)) {
      return false;
    }
    NonlinearProgram program;
    for (std::size_t i = 0; i + 1 < pushes.size(); ++i) {
      const FlatState at = flat_state(pushes[i].end);
      for (const double x : {at.p_OF.x(), at.p_OF.y(), search_.model->c * at.theta}) {
        program.start.push_back(x);
        program.lower.push_back(x - kReach * search_.model->L);
        program.upper.push_back(x + kReach * search_.model->L);
      }
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
  FlatState state_at(std::span<const double> x, std::size_t point) const {
    if (3 * point == x.size()) return stretch_.end;
    return {{x[3 * point], x[3 * point + 1]}, x[3 * point + 2] / search_.model->c};
  }

  /// What the pushes miss; 0 where they stick with slack to spare. Keeps them if they
  /// stick.
  double missing_of(std::span<const double> x) {
    constexpr double kFar = std::numeric_limits<double>::max();
    Plan part{.start = grasp_of(stretch_.start, stretch_.psi)};
    FlatState from = stretch_.start;
    double missing = 0.0;
    double travelled = travelled_;
    bool sticks = true;
    const std::size_t last = stretch_.contacts.size() - 1;
    for (std::size_t k = 0; k <= last; ++k) {
      const FlatState to = state_at(x, k);
      if ((to.p_OF - from.p_OF).norm() < kShortestLeg) return kFar;
      append_move(search_, {stretch_.contacts[k], from, to}, part);
      const Margin margin = carried(margin_, travelled);
      if (!is_allowed(stretch_.contacts[k], {from.p_OF, k == 0}, {to.p_OF, k == last},
                      margin)) {
        missing += kForbidden;
        sticks = false;
      }
      const PlannedPush& push = part.pushes.back();
      const double slack =
          push_slack(*search_.model, push.start, push.push, margin, kSpreadParts);
      work_.other += kLook;
      const double short_of = std::max(0.0, kWanted - std::max(slack, kWorst));
      missing += short_of * short_of;
      sticks = sticks && slack >= kEnough;
      travelled += travel_in_pad_plane(push.push);
      from = to;
    }
    if (sticks) repaired_ = std::move(part.pushes);
    return missing;
  }

  bool is_allowed(int contact, const Stop& from, const Stop& to,
                  const Margin& margin) const {
    return is_held(search_, contact, from) && is_held(search_, contact, to) &&
           path_on_object(*search_.model, {from.p_OF, from.given}, {to.p_OF, to.given},
                          margin);
  }

  const SearchModel& search_;
  const Limits& limits_;
  Work& work_;
  const Margin& margin_;
  double travelled_;
  Stretch stretch_;
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
