#include "planner/trajectory.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "optimisation/nonlinear_program.h"
#include "planner/exact_check.h"
#include "planner/goal.h"
#include "planner/push_search.h"
#include "planner/segment.h"
#include "planner/stretch.h"

namespace prehensile {
namespace {

constexpr int kIterations = 100;
constexpr double kTolerance = 1e-6;
constexpr double kReach = 0.15;       // of a way-point from its place, over L
constexpr double kWanted = 0.01;      // slack of each push
constexpr double kEnough = 1e-6;      // above rounding
constexpr double kWorst = -3.0;       // slacks beyond it, either way, count as this
constexpr double kLeastRoom = 1e-4;   // beyond what the margin needs, over L
constexpr double kLeastShare = 0.5;   // of the length of a push, which has to stay
constexpr double kPrice = 10.0;       // of what a push misses, against squares of moves
constexpr double kFirstLack = 0.01;   // more than what a push misses at the start
constexpr double kDifference = 1e-6;  // for derivatives, over L
constexpr int kSpreadParts = 8;       // of a push, for discs that the face clips
constexpr std::size_t kMostPushes = 80;

/// Rows of a push. The least slack of each part of it comes first; all but the last count
/// what is there beyond what is wanted.
constexpr std::size_t kParts = 5;
constexpr std::size_t kSpreadRow = kParts;    // slack of pads spread over all angles
constexpr std::size_t kHeldRow = kParts + 1;  // gravity, at both ends
constexpr std::size_t kRoomRow = kParts + 3;
constexpr std::size_t kLengthRow = kParts + 4;
constexpr std::size_t kPathRow = kParts + 5;  // travelled before the next push
constexpr std::size_t kRows = kParts + 6;
using Rows = std::array<double, kRows>;

/// What the rows of a push depend on [m]: from and to (x, y of p_OF and c theta), and the
/// path travelled before it.
constexpr std::size_t kTravelled = 6;
using Unknowns = std::array<double, 7>;

/// One stretch of a plan. The variables, all over L: the way-points (x, y of p_OF and c
/// theta), the path travelled before each push but the first, and what each push misses.
class Trajectory {
 public:
  Trajectory(const SearchModel& search, const Limits& limits, Work& work,
             const Margin& margin, double travelled)
      : search_(search),
        limits_(limits),
        work_(work),
        margin_(margin),
        travelled_(travelled),
        L_(search.model->L) {}

  /// False if no push slips, or no way-points were found with which none does.
  bool run(std::vector<PlannedPush>& pushes) {
    if (!read_stretch(search_, pushes, stretch_) || any_by_point(search_, stretch_)) {
      return false;
    }
    NonlinearProgram program;
    set_start(pushes, program);
    if (keep_if_it_sticks(program.start)) return false;
    set_objective(program);
    set_constraints(program);
    program.stop = [this] { return !repaired_.empty() || limits_.reached(); };
    minimise_ipopt(program, {.tolerance = kTolerance, .max_evaluations = kIterations});
    if (repaired_.empty()) return false;
    pushes = std::move(repaired_);
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
    double travelled = travelled_;
    for (const PlannedPush& push : pushes) {
      const double length = travel_in_pad_plane(push.push);
      least_lengths_.push_back(kLeastShare * length);
      travelled += length;
      if (least_lengths_.size() < count()) add(travelled / L_, -kUnbounded, kUnbounded);
    }
    Rows rows;
    for (std::size_t k = 0; k < count(); ++k) {
      fill_rows(k, unknowns_of(k, program.start), rows);
      const double least = *std::min_element(rows.begin(), rows.begin() + kPathRow);
      add(kFirstLack + std::max(0.0, -least), 0.0, kUnbounded);
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

  Move move_of_push(std::size_t k, const Unknowns& at) const {
    const double c = search_.model->c;
    return {
        stretch_.contacts[k], {{at[0], at[1]}, at[2] / c}, {{at[3], at[4]}, at[5] / c}};
  }

  void fill_rows(std::size_t k, const Unknowns& at, std::span<double> rows) const {
    const Move move = move_of_push(k, at);
    const double length = (move.to.p_OF - move.from.p_OF).norm();
    const Margin margin = carried(margin_, at[kTravelled]);
    fill_slacks(move, margin, rows);
    const double spread = slack_of_spread_pads(search_, move, kSpreadParts, work_);
    rows[kSpreadRow] = counted(spread) - kWanted;
    rows[kHeldRow] = held_slack(search_, move.contact, {move.from.p_OF, k == 0});
    rows[kHeldRow + 1] = held_slack(search_, move.contact, {move.to.p_OF, k == inner()});
    rows[kRoomRow] = room_of(k, move, margin) / L_ - kLeastRoom;
    rows[kLengthRow] = (length - least_lengths_[k]) / L_;
    rows[kPathRow] = (at[kTravelled] + length) / L_;
  }

  /// NaN and -infinity, too, are numbers for the library.
  static double counted(double slack) {
    return slack >= kWorst ? std::min(slack, -kWorst) : kWorst;
  }

  /// At the places where the exact check looks: discs of points that turn about a place
  /// under them have a slack that leaps.
  void fill_slacks(const Move& move, const Margin& margin, std::span<double> rows) const {
    const Model& model = *search_.model;
    const SearchContact& contact = search_.contacts[move.contact];
    const Vec2 d = move.to.p_OF - move.from.p_OF;
    const double length = d.norm();
    const double turn = move.to.theta - move.from.theta;
    const auto count = static_cast<std::size_t>(
        std::max(static_cast<int>(kParts), places_along(length, turn)));
    std::fill(rows.begin(), rows.begin() + kParts, std::numeric_limits<double>::max());
    for (std::size_t i = 0; i < count; ++i) {
      const double s = static_cast<double>(i) / static_cast<double>(count - 1);
      const double slack =
          exact_stick_test(model, model.contacts[contact.contact], contact.place,
                           pose_along(move.from, move.to, s), -d / length, length, turn,
                           margin, s * length)
              .slack;
      double& row = rows[i * kParts / count];
      row = std::min(row, counted(slack) - kWanted);
    }
    work_.stick_tests += static_cast<std::int64_t>(count);
  }

  /// Of a place of the finger axis from the border of the face [m]; negative outside.
  double depth_at(const Vec2& p_OF) const {
    const std::vector<Vec2>& face = search_.model->pad_face;
    const double distance = distance_to_border(face, p_OF, p_OF);
    return segment_inside(face, p_OF, p_OF) ? distance : -distance;
  }

  /// By how much the pads may be farther off their way before they leave the object [m].
  /// A given end is as deep as it is.
  double room_of(std::size_t k, const Move& move, const Margin& margin) const {
    constexpr int kPlaces = 9;
    const Vec2 d = move.to.p_OF - move.from.p_OF;
    const int first = k == 0 ? 1 : 0;
    const int last = k == inner() ? kPlaces - 2 : kPlaces - 1;
    double needed = carried(margin, d.norm()).grasp;
    if (k == 0) needed = std::min(needed, depth_at(move.from.p_OF));
    if (k == inner()) needed = std::min(needed, depth_at(move.to.p_OF));
    double depth = std::numeric_limits<double>::infinity();
    for (int i = first; i <= last; ++i) {
      const double s = static_cast<double>(i) / (kPlaces - 1);
      depth = std::min(depth, depth_at(move.from.p_OF + s * d));
    }
    return depth - needed;
  }

  /// Squares of the moves of the way-points, and what is missing.
  void set_objective(NonlinearProgram& program) const {
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
        fill_rows(k, unknowns_of(k, x), rows);
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
      fill_rows(k, at, here);
      for (std::size_t i = 0; i < at.size(); ++i) {
        if (variable_of(k, i) < 0) continue;
        Unknowns moved = at;
        moved[i] += kDifference * L_;
        fill_rows(k, moved, beside);
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
  /// by itself, and that the pads stay where they have to.
  bool keep_if_it_sticks(std::span<const double> x) {
    Plan part{.start = grasp_of(stretch_.start, stretch_.psi)};
    Rows rows;
    double travelled = travelled_;
    for (std::size_t k = 0; k < count(); ++k) {
      Unknowns at = unknowns_of(k, x);
      at[kTravelled] = travelled;
      fill_rows(k, at, rows);
      const auto first = rows.begin();
      if (*std::min_element(first, first + kHeldRow) < kEnough - kWanted) return false;
      if (*std::min_element(first + kHeldRow, first + kRoomRow) <= 0.0) return false;
      if (rows[kRoomRow] < -0.9 * kLeastRoom) return false;
      travelled = L_ * rows[kPathRow];
      append_move(search_, move_of_push(k, at), part);
    }
    repaired_ = std::move(part.pushes);
    return true;
  }

  const SearchModel& search_;
  const Limits& limits_;
  Work& work_;
  const Margin& margin_;
  double travelled_;  // [m] before the stretch
  double L_;
  Stretch stretch_;
  std::vector<double> least_lengths_;  // [m] by push
  std::vector<PlannedPush> repaired_;
};

}  // namespace

bool repair_as_trajectory(const SearchModel& search, const Limits& limits, Work& work,
                          Plan& plan) {
  if (!ipopt_is_built()) return false;
  return repair_stretches(
      plan, kMostPushes, [&](std::vector<PlannedPush>& pushes, double travelled) {
        return Trajectory(search, limits, work, plan.margin, travelled).run(pushes);
      });
}

}  // namespace prehensile
