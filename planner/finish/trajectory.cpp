#include "planner/finish/trajectory.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "optimisation/nonlinear_program.h"
#include "planner/checks/exact_check.h"
#include "planner/finish/stretch.h"
#include "planner/finish/trajectory_rows.h"
#include "planner/steering/draft.h"
#include "planner/steering/goal.h"

namespace prehensile {
namespace {

constexpr int kIterations = 100;
constexpr int kFewIterations = 20;  // to shorten: most of the gain comes first
constexpr double kTolerance = 1e-6;
constexpr double kReach = 0.15;       // of a way-point from its place, over L
constexpr double kWanted = 0.01;      // slack of each push
constexpr double kLeastShare = 0.5;   // of the length of a push, which has to stay
constexpr double kWorthwhile = 1e-4;  // relative gain below which the plan stays
constexpr double kPrice = 10.0;       // of what a push misses, against squares of moves
constexpr double kFirstLack = 0.01;   // more than what a push misses at the start
constexpr double kDifference = 1e-6;  // for derivatives, over L
constexpr std::size_t kMostPushes = 80;

using Unknowns = TrajectoryRows::Unknowns;
using Rows = TrajectoryRows::Rows;
constexpr std::size_t kRows = TrajectoryRows::kCount;
constexpr std::size_t kPathRow = TrajectoryRows::kPath;
constexpr std::size_t kTravelled = TrajectoryRows::kTravelled;

enum class Aim { kRepair, kShorten };

/// One stretch of a plan. The variables, all over L: the way-points (x, y of p_OF and c
/// theta), the path travelled before each push but the first, and what each push misses,
/// which is nothing where one that sticks is shortened.
class Trajectory {
 public:
  Trajectory(Aim aim, const SearchModel& search, const Limits& limits, Work& work,
             const Margin& margin, double travelled)
      : aim_(aim),
        search_(search),
        limits_(limits),
        work_(work),
        margin_(margin),
        travelled_(travelled),
        L_(search.model->L) {}

  /// False if the aim is met already, or no such way-points were found.
  bool run(std::vector<PlannedPush>& pushes) {
    if (!read_stretch(search_, pushes, stretch_) || any_by_point(search_, stretch_)) {
      return false;
    }
    NonlinearProgram program;
    set_start(pushes, program);
    const bool sticks = keep_if_it_sticks(program.start);
    if (sticks != (aim_ == Aim::kShorten)) return false;
    const double before = shortest_;
    set_objective(program);
    set_constraints(program);
    program.stop = [this] {
      return (aim_ == Aim::kRepair && !kept_.empty()) || limits_.reached();
    };
    minimise_ipopt(program, {.tolerance = kTolerance,
                             .max_evaluations =
                                 aim_ == Aim::kRepair ? kIterations : kFewIterations});
    if (kept_.empty()) return false;
    if (aim_ == Aim::kShorten && shortest_ > before * (1.0 - kWorthwhile)) return false;
    pushes = std::move(kept_);
    return true;
  }

 private:
  std::size_t count() const { return stretch_.contacts.size(); }
  std::size_t inner() const { return count() - 1; }

  /// Where unknown `i` of push `k` is among the variables, or -1 if it is given.
  int variable_of(std::size_t k, std::size_t i) const {
    if (i < 3) return k == 0 ? -1 : static_cast<int>(3 * (k - 1) + i);
    if (i < 6) return k == inner() ? -1 : static_cast<int>(3 * k + i - 3);
    return k == 0 ? -1 : static_cast<int>(3 * inner() + k - 1);
  }
  std::size_t lack_of(std::size_t k) const { return 4 * inner() + k; }

  void set_start(const std::vector<PlannedPush>& pushes, NonlinearProgram& program) {
    const auto add = [&](double x, double low, double high) {
      program.start.push_back(x);
      program.lower.push_back(low);
      program.upper.push_back(high);
    };
    for (std::size_t k = 0; k < inner(); ++k) {
      const FlatState at = flat_state(pushes[k].end);
      for (const double x : {at.p_OF.x(), at.p_OF.y(), search_.model->c * at.theta}) {
        add(x / L_, x / L_ - kReach, x / L_ + kReach);
      }
    }
    std::vector<double> least_lengths;
    double travelled = travelled_;
    for (const PlannedPush& push : pushes) {
      const double length = travel_in_pad_plane(push.push);
      least_lengths.push_back(kLeastShare * length);
      travelled += length;
      if (least_lengths.size() < count()) add(travelled / L_, -kUnbounded, kUnbounded);
    }
    rows_.emplace(search_, work_, margin_, stretch_, kWanted, std::move(least_lengths));
    Rows rows;
    for (std::size_t k = 0; k < count(); ++k) {
      rows_->fill(k, unknowns_of(k, program.start), rows);
      const double least = *std::min_element(rows.begin(), rows.begin() + kPathRow);
      const bool may_lack = aim_ == Aim::kRepair;
      add(may_lack ? kFirstLack + std::max(0.0, -least) : 0.0, 0.0,
          may_lack ? kUnbounded : 0.0);
    }
  }

  Unknowns unknowns_of(std::size_t k, std::span<const double> x) const {
    const double c = search_.model->c;
    const FlatState& start = stretch_.start;
    const FlatState& end = stretch_.end;
    Unknowns at = {start.p_OF.x(), start.p_OF.y(), c * start.theta, end.p_OF.x(),
                   end.p_OF.y(),   c * end.theta,  travelled_};
    for (std::size_t i = 0; i < at.size(); ++i) {
      const int variable = variable_of(k, i);
      if (variable >= 0) at[i] = L_ * x[static_cast<std::size_t>(variable)];
    }
    return at;
  }

  void set_objective(NonlinearProgram& program) const {
    if (aim_ == Aim::kShorten) return set_length(program);
    set_moves(program);
  }

  /// Of a push in the planner's space, as costs count it [m].
  static Vec3 way_of(const Unknowns& at) {
    return {at[3] - at[0], at[4] - at[1], at[5] - at[2]};
  }

  /// The ways of all pushes, over L.
  void set_length(NonlinearProgram& program) const {
    program.objective = [this](std::span<const double> x, std::span<double> gradient) {
      double length = 0.0;
      std::ranges::fill(gradient, 0.0);
      for (std::size_t k = 0; k < count(); ++k) {
        const Vec3 d = way_of(unknowns_of(k, x));
        const double way = d.norm();
        length += way / L_;
        if (way == 0.0) continue;
        for (std::size_t i = 0; i < 6 && !gradient.empty(); ++i) {
          const int variable = variable_of(k, i);
          if (variable < 0) continue;
          const double along = d[static_cast<Eigen::Index>(i % 3)] / way;
          gradient[static_cast<std::size_t>(variable)] += i < 3 ? -along : along;
        }
      }
      return length;
    };
  }

  /// Squares of the moves of the way-points, and what is missing.
  void set_moves(NonlinearProgram& program) const {
    const std::size_t moved = 3 * inner();
    const std::vector<double> at(
        program.start.begin(),
        program.start.begin() + static_cast<std::ptrdiff_t>(moved));
    const std::size_t lacks = lack_of(0);
    program.objective = [at, lacks](std::span<const double> x,
                                    std::span<double> gradient) {
      double cost = 0.0;
      std::ranges::fill(gradient, 0.0);
      for (std::size_t i = 0; i < at.size(); ++i) {
        const double step = x[i] - at[i];
        cost += step * step;
        if (!gradient.empty()) gradient[i] = 2.0 * step;
      }
      for (std::size_t i = lacks; i < x.size(); ++i) {
        cost += kPrice * x[i];
        if (!gradient.empty()) gradient[i] = kPrice;
      }
      return cost;
    };
  }

  void set_constraints(NonlinearProgram& program) {
    for (std::size_t i = 0; i < count() * kRows; ++i) {
      program.constraint_lower.push_back(0.0);
      program.constraint_upper.push_back(i % kRows == kPathRow ? 0.0 : kUnbounded);
    }
    program.constraints = [this](std::span<const double> x, std::span<double> g) {
      for (std::size_t k = 0; k < count(); ++k) {
        const std::span<double> rows = g.subspan(k * kRows, kRows);
        rows_->fill(k, unknowns_of(k, x), rows);
        for (std::size_t i = 0; i < kPathRow; ++i) rows[i] += x[lack_of(k)];
        rows[kPathRow] = k == inner() ? 0.0 : rows[kPathRow] - travelled_before(k + 1, x);
      }
      keep_if_it_sticks(x);
    };
    add_pattern(program);
    program.jacobian = [this](std::span<const double> x, std::span<double> values) {
      fill_jacobian(x, values);
    };
  }

  double travelled_before(std::size_t k, std::span<const double> x) const {
    return x[static_cast<std::size_t>(variable_of(k, kTravelled))];
  }

  void add_pattern(NonlinearProgram& program) const {
    const auto add = [&program](std::size_t row, int variable) {
      program.jacobian_rows.push_back(static_cast<int>(row));
      program.jacobian_columns.push_back(variable);
    };
    for (std::size_t k = 0; k < count(); ++k) {
      const std::size_t first = k * kRows;
      for (std::size_t i = 0; i < Unknowns().size(); ++i) {
        if (variable_of(k, i) < 0) continue;
        for (std::size_t row = 0; row < kRows; ++row) add(first + row, variable_of(k, i));
      }
      for (std::size_t row = 0; row < kPathRow; ++row) {
        add(first + row, static_cast<int>(lack_of(k)));
      }
      if (k != inner()) add(first + kPathRow, variable_of(k + 1, kTravelled));
    }
  }

  /// In the order of the pattern.
  void fill_jacobian(std::span<const double> x, std::span<double> values) const {
    auto value = values.begin();
    Rows here;
    Rows beside;
    for (std::size_t k = 0; k < count(); ++k) {
      const Unknowns at = unknowns_of(k, x);
      rows_->fill(k, at, here);
      for (std::size_t i = 0; i < at.size(); ++i) {
        if (variable_of(k, i) < 0) continue;
        Unknowns moved = at;
        moved[i] += kDifference * L_;
        rows_->fill(k, moved, beside);
        for (std::size_t row = 0; row < kPathRow; ++row) {
          *value++ = (beside[row] - here[row]) / kDifference;
        }
        *value++ = k == inner() ? 0.0 : (beside[kPathRow] - here[kPathRow]) / kDifference;
      }
      value = std::fill_n(value, kPathRow, 1.0);
      if (k != inner()) *value++ = -1.0;
    }
  }

  /// Keeps the pushes to these way-points if the exact check will find that each sticks,
  /// by itself, and that the pads stay where they have to; of several the shortest.
  bool keep_if_it_sticks(std::span<const double> x) {
    Plan part{.start = grasp_of(stretch_.start, stretch_.psi)};
    Rows rows;
    double travelled = travelled_;
    double length = 0.0;
    for (std::size_t k = 0; k < count(); ++k) {
      Unknowns at = unknowns_of(k, x);
      at[kTravelled] = travelled;
      rows_->fill(k, at, rows);
      if (!rows_->sticks(rows)) return false;
      travelled = L_ * rows[kPathRow];
      length += way_of(at).norm();
      append_move(search_, rows_->move_of_push(k, at), part);
    }
    if (length < shortest_) {
      shortest_ = length;
      kept_ = std::move(part.pushes);
    }
    return true;
  }

  Aim aim_;
  const SearchModel& search_;
  const Limits& limits_;
  Work& work_;
  const Margin& margin_;
  double travelled_;  // [m] before the stretch
  double L_;
  Stretch stretch_;
  std::optional<TrajectoryRows> rows_;
  std::vector<PlannedPush> kept_;
  double shortest_ = std::numeric_limits<double>::infinity();  // [m] their length
};

bool change(Aim aim, const SearchModel& search, const Limits& limits, Work& work,
            Plan& plan) {
  if (!ipopt_is_built()) return false;
  return repair_stretches(
      plan, kMostPushes, [&](std::vector<PlannedPush>& pushes, double travelled) {
        return Trajectory(aim, search, limits, work, plan.margin, travelled).run(pushes);
      });
}

}  // namespace

bool repair_as_trajectory(const SearchModel& search, const Limits& limits, Work& work,
                          Plan& plan) {
  return change(Aim::kRepair, search, limits, work, plan);
}

bool shorten_as_trajectory(const SearchModel& search, const Limits& limits, Work& work,
                           Plan& plan) {
  return change(Aim::kShorten, search, limits, work, plan);
}

}  // namespace prehensile
