#include "planner/finish/ease.h"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "optimisation/nonlinear_program.h"
#include "planner/costs.h"
#include "planner/finish/moved_stretch.h"

namespace prehensile {
namespace {

constexpr int kEvaluations = 300;
constexpr double kTolerance = 1e-4;
constexpr double kFirstStep = 0.01;      // over L
constexpr double kWanted = 0.3;          // slack of each push: more is no better
constexpr double kWorst = -10.0;         // slacks below it count as this
constexpr double kCrowded = 0.1;         // charge for a push without room beside its way
constexpr double kForbidden = 1.0;       // for one that is not allowed
constexpr double kPrice = 0.1;           // of a plan that costs twice as much
constexpr double kTooDear = 1e3;         // of what it costs beyond what it may
constexpr double kWorthwhile = 1e-3;     // gain below which the plan stays
constexpr std::size_t kMostPushes = 12;  // beyond it sub-plex gains too little

class EasedStretch {
 public:
  /// Of a plan that costs `cost`, and may cost `share` more.
  EasedStretch(const SearchModel& search, const Limits& limits, MovedStretch stretch,
               double cost, double share)
      : search_(search),
        limits_(limits),
        stretch_(std::move(stretch)),
        cost_(cost),
        share_(share) {}

  bool run(std::vector<PlannedPush>& pushes) {
    if (!stretch_.read(pushes)) return false;
    NonlinearProgram program;
    program.start = stretch_.way_points();
    if (!stretch_.look(program.start, pushes_, looks_)) return false;
    least_slack_ = least_slack();
    first_cost_ = cost_of_pushes();
    least_ = value_at(program.start) - kWorthwhile;
    program.objective = [this](std::span<const double> x, std::span<double>) {
      return value_at(x);
    };
    program.stop = [this] { return limits_.reached(); };
    minimise_nlopt(program, LocalMethod::kSubplex,
                   {.tolerance = kTolerance, .max_evaluations = kEvaluations},
                   kFirstStep * search_.model->L);
    if (eased_.empty()) return false;
    pushes = std::move(eased_);
    return true;
  }

  /// Share of the plan's cost that the pushes now cost more; may be negative.
  double spent() const { return spent_; }

 private:
  double least_slack() const {
    return std::ranges::min(looks_, {}, &MovedPush::slack).slack;
  }

  double cost_of_pushes() const {
    Plan part{.start = pushes_.front().start, .pushes = pushes_};
    account(*search_.model, part);
    return part.cost;
  }

  /// What the pushes miss of the wanted slack, squared and summed, and the price of what
  /// they cost. Keeps the best that are worth it, none of which has less slack than the
  /// least was.
  double value_at(std::span<const double> x) {
    if (!stretch_.look(x, pushes_, looks_)) return std::numeric_limits<double>::max();
    const double dearer = (cost_of_pushes() - first_cost_) / cost_;
    double value = kPrice * dearer + kTooDear * std::max(0.0, dearer - share_);
    bool is_allowed = dearer <= share_;
    for (const MovedPush& push : looks_) {
      const double missing = std::max(0.0, kWanted - std::max(push.slack, kWorst));
      value += missing * missing + (push.has_room ? 0.0 : kCrowded) +
               (push.is_allowed ? 0.0 : kForbidden);
      is_allowed = is_allowed && push.is_allowed;
    }
    if (is_allowed && value < least_ && least_slack() >= least_slack_) {
      least_ = value;
      spent_ = dearer;
      eased_ = pushes_;
    }
    return value;
  }

  const SearchModel& search_;
  const Limits& limits_;
  MovedStretch stretch_;
  double cost_, share_;
  double least_slack_ = kNan;  ///< at the start
  double first_cost_ = kNan;   ///< of the stretch alone
  double least_ = kNan;        ///< value that another has to be below
  std::vector<PlannedPush> pushes_;
  std::vector<MovedPush> looks_;
  std::vector<PlannedPush> eased_;
  double spent_ = 0.0;  ///< share of the plan's cost, by those
};

}  // namespace

bool ease(const SearchModel& search, double share, const Limits& limits, Work& work,
          Plan& plan) {
  if (!nlopt_is_built() || !plan.margin.has_box() || !(share > 0.0)) return false;
  account(*search.model, plan);
  double left = share;
  return repair_stretches(
      plan, kMostPushes, [&](std::vector<PlannedPush>& pushes, double travelled) {
        EasedStretch stretch(search, limits, {search, work, plan.margin, travelled},
                             plan.cost, left);
        const bool is_eased = stretch.run(pushes);
        left -= stretch.spent();
        return is_eased;
      });
}

}  // namespace prehensile
