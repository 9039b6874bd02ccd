#include "planner/finish/trajectory_rows.h"

#include <algorithm>
#include <limits>

#include "planner/checks/exact_check.h"
#include "planner/geometry/segment.h"

namespace prehensile {
namespace {

constexpr double kEnough = 1e-6;     // slack above rounding
constexpr double kWorst = -3.0;      // slacks beyond it, either way, count as this
constexpr double kSpareRoom = 1e-5;  // beyond what the margin needs, over L
constexpr double kSameRoom = 1e-8;   // over L, of rounding
constexpr int kSpreadParts = 8;      // of a push, for discs that the face clips

/// NaN and -infinity, too, are numbers for the library.
double counted(double slack) {
  return slack >= kWorst ? std::min(slack, -kWorst) : kWorst;
}

}  // namespace

Move TrajectoryRows::move_of_push(std::size_t k, const Unknowns& at) const {
  const double c = search_.model->c;
  return {stretch_.contacts[k], {{at[0], at[1]}, at[2] / c}, {{at[3], at[4]}, at[5] / c}};
}

void TrajectoryRows::fill(std::size_t k, const Unknowns& at,
                          std::span<double> rows) const {
  const double L = search_.model->L;
  const Move move = move_of_push(k, at);
  const double length = (move.to.p_OF - move.from.p_OF).norm();
  const Margin margin = carried(margin_, at[kTravelled]);
  fill_slacks(move, margin, rows);
  const double spread = slack_of_spread_pads(search_, move, kSpreadParts, work_);
  rows[kSpread] = counted(spread) - wanted_;
  rows[kHeld] = held_slack(search_, move.contact, {move.from.p_OF, k == 0});
  rows[kHeld + 1] = held_slack(search_, move.contact, {move.to.p_OF, k == last()});
  rows[kRoom] = room_of(k, move, margin) / L;
  rows[kLength] = (length - least_lengths_[k]) / L;
  rows[kPath] = (at[kTravelled] + length) / L;
}

/// At the places where the exact check looks: discs of points that turn about a place
/// under them have a slack that leaps.
void TrajectoryRows::fill_slacks(const Move& move, const Margin& margin,
                                 std::span<double> rows) const {
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
    row = std::min(row, counted(slack) - wanted_);
  }
  work_.stick_tests += static_cast<std::int64_t>(count);
}

/// Of a place of the finger axis from the border of the face [m]; negative outside.
double TrajectoryRows::depth_at(const Vec2& p_OF) const {
  const std::vector<Vec2>& face = search_.model->pad_face;
  const double distance = distance_to_border(face, p_OF, p_OF);
  return segment_inside(face, p_OF, p_OF) ? distance : -distance;
}

/// By how much the pads may be farther off their way before they leave the object [m].
/// A given end is as deep as it is.
double TrajectoryRows::room_of(std::size_t k, const Move& move,
                               const Margin& margin) const {
  constexpr int kPlaces = 9;
  const Model& model = *search_.model;
  const Vec2& from = move.from.p_OF;
  const Vec2& to = move.to.p_OF;
  Margin wanted = margin;
  wanted.grasp += kSpareRoom * model.L;
  if (segment_inside(model.pad_face, from, to)) {
    return path_room(model, {from, k == 0}, {to, k == last()}, wanted);
  }
  double depth = 0.0;
  for (int i = 0; i < kPlaces; ++i) {
    const double s = static_cast<double>(i) / (kPlaces - 1);
    depth = std::min(depth, depth_at(from + s * (to - from)));
  }
  return depth - carried(wanted, (to - from).norm()).grasp;
}

bool TrajectoryRows::sticks(const Rows& rows) const {
  const auto first = rows.begin();
  return *std::min_element(first, first + kHeld) >= kEnough - wanted_ &&
         *std::min_element(first + kHeld, first + kRoom) > 0.0 &&
         rows[kRoom] >= -kSameRoom;
}

}  // namespace prehensile
