#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <vector>

#include "mechanics/pad_law.h"
#include "mechanics/violation.h"
#include "planner/geometry/level_set.h"
#include "planner/pads/clipped_law.h"
#include "planner/pads/local_law.h"
#include "planner/pads/ring_pads.h"
#include "planner/proofs/barrier.h"
#include "planner/proofs/goal_cover.h"
#include "scene/outline.h"

namespace prehensile {
namespace {

/// Vertices of a region, at most: pairs of its edges are compared.
constexpr std::size_t kMostVertices = 2000;

/// Pieces of the border and ranges of directions are halved so often.
constexpr int kMostCuts = 12;
constexpr int kMostTurns = 12;

/// Squares of places of the goal are cut into quarters so often where the region is near.
constexpr int kMostGoalCuts = 5;

constexpr double kRounding = 1e-9;  // [m] of places

/// Of the friction's power: what a fall has to leave. Points that stand for a disc resist
/// up to 0.014 more at one angle of the object than at another, and up to 0.005 more than
/// when spread over all angles.
constexpr double kUneven = 0.02;
constexpr double kUnevenIfSpread = 0.01;

/// Angles of the object at which pads that are not round are looked at.
constexpr int kAnglesOfPads = 48;

/// Pieces where the face clips the discs, in their torque radii: the shortest that are
/// cut.
constexpr double kShortestClipped = 0.02;

bool refuse(std::string* why, const char* text) {
  if (why) *why = text;
  return false;
}

struct Piece {
  Vec2 a, b;
  Vec2 out;  // unit normal, away from the region
  double length() const { return (b - a).norm(); }
  Vec2 middle() const { return 0.5 * (a + b); }
};

bool are_apart(const std::vector<Vec2>& one, const std::vector<Vec2>& other) {
  for (std::size_t i = 0; i < one.size(); ++i) {
    for (std::size_t j = 0; j < other.size(); ++j) {
      if (segments_touch(one[i], one[(i + 1) % one.size()], other[j],
                         other[(j + 1) % other.size()])) {
        return false;
      }
    }
  }
  return true;
}

bool is_well_formed(const Loops& region, std::string* why) {
  std::size_t vertices = 0;
  for (const auto& loop : region) {
    vertices += loop.size();
    if (loop.size() < 3 || vertices > kMostVertices) {
      return refuse(why, "the region has too few or too many vertices");
    }
    for (const Vec2& vertex : loop) {
      if (!vertex.allFinite()) return refuse(why, "a vertex of the region is not finite");
    }
    if (!is_simple(loop)) return refuse(why, "a border of the region crosses itself");
  }
  for (std::size_t i = 0; i < region.size(); ++i) {
    for (std::size_t j = i + 1; j < region.size(); ++j) {
      if (!are_apart(region[i], region[j])) {
        return refuse(why, "two borders of the region cross");
      }
    }
  }
  return !region.empty() || refuse(why, "there is no region");
}

/// Distance of the farthest pad point from the finger axis [m].
double reach_of(const PlanarGrasp& grasp) {
  double reach = 0.0;
  for (int j = 0; j < grasp.count; ++j) {
    reach = std::max(reach, std::hypot(grasp.x[j], grasp.y[j]));
  }
  return reach;
}

/// Whether a square of places [m], each up to `around` off, is outside the region: it is
/// cut where it comes near.
bool is_outside(const Loops& region, const Vec2& middle, const Vec2& half_edge,
                double around, int cuts) {
  const double depth = depth_in_region(region, middle);
  if (depth < -(std::numbers::sqrt2 * half_edge.norm() + around)) return true;
  if (depth > -around || cuts == 0) return false;
  const Vec2 quarter = 0.5 * half_edge;
  for (int k = 0; k < 4; ++k) {
    const Vec2 corner = rotated(0.5 * std::numbers::pi * k, quarter + perp(quarter));
    if (!is_outside(region, middle + corner, quarter, around, cuts - 1)) return false;
  }
  return true;
}

/// The contact's pushes end where the grasp alone does not hold the object in its
/// attitude, whatever its angle. The excess of gravity's power in one twist is affine in
/// the place, so both ends decide for all of the piece. Of pads that are not round no
/// point comes farther than its radius times half a step from where one of the angles has
/// it.
bool falls_all_along(const Model& model, const PushContact& contact, const Piece& piece) {
  const bool is_round = has_round_pads(model) || has_clipped_discs(model);
  const int angles = is_round ? 1 : kAnglesOfPads;
  const double half_step = is_round ? 0.0 : std::numbers::pi / kAnglesOfPads;
  const auto falls_at = [&](double angle) {
    const auto grasp_there = [&](const Vec2& p_OF) {
      return grasp_at(model, pose_from_finger(p_OF, angle), contact.g_O);
    };
    PlanarTwist fall = PlanarTwist::Zero();
    if (gravity_slack_by_pad_law(model, grasp_there(piece.middle()), &fall) >= 0.0) {
      return false;
    }
    return std::ranges::all_of(std::array{piece.a, piece.b}, [&](const Vec2& p_OF) {
      const PlanarGrasp grasp = grasp_there(p_OF);
      const double between = model.F * std::abs(fall[2]) * reach_of(grasp) * half_step;
      return grasp.w_g.dot(fall) >
             (1.0 + kUneven) * friction_power(model, grasp, fall) + between;
    });
  };
  for (int i = 0; i < angles; ++i) {
    if (!falls_at(2.0 * half_step * i)) return false;
  }
  return true;
}

/// Whether the laws keep a contact from crossing the piece in any direction whose angle
/// from `out` is within half_angle of `angle`.
bool none_crosses(const LocalLaw& law, int contact, const Piece& piece, double angle,
                  double half_angle, int turns) {
  const PlaceSpan places{piece.a, piece.b};
  const DirectionSpan directions{rotated(angle, piece.out), half_angle};
  if (!law.may_move(contact, places, directions)) return true;
  if (turns == 0) return false;
  const double half = 0.5 * half_angle;
  return none_crosses(law, contact, piece, angle - half, half, turns - 1) &&
         none_crosses(law, contact, piece, angle + half, half, turns - 1);
}

/// The laws at every place, and which of them hold for a piece.
class BorderLaw {
 public:
  explicit BorderLaw(const Model& model)
      : model_(model),
        clips_(has_clipped_discs(model)),
        whole_(clips_ ? LocalLaw::of_whole_discs(model) : LocalLaw(model)) {}

  bool is_known() const { return clips_ ? has_clipped_law(model_) : whole_.is_known(); }

  bool is_sealed(const Piece& piece, int cuts) const {
    const double depth = depth_inside(model_.pad_face, piece.middle());
    if (depth < -0.5 * piece.length()) return true;
    const bool whole = is_whole(piece);
    const double c = model_.c;
    if (whole ? all_blocked(piece)
              : piece.length() <= ClippedLaw::kLongest * c &&
                    all_blocked_where_clipped(piece)) {
      return true;
    }
    if (cuts == 0 || (!whole && piece.length() < kShortestClipped * c)) return false;
    const Vec2 middle = piece.middle();
    return is_sealed({piece.a, middle, piece.out}, cuts - 1) &&
           is_sealed({middle, piece.b, piece.out}, cuts - 1);
  }

 private:
  bool is_whole(const Piece& piece) const {
    return !clips_ || model_.region.whole_margin(pose_from_finger(piece.middle(), 0.0)) >=
                          0.5 * piece.length();
  }

  bool all_blocked(const Piece& piece) const {
    constexpr double kAcross = 0.5 * std::numbers::pi;
    bool all = true;
    for (std::size_t k = 0; k < model_.contacts.size() && all; ++k) {
      all = none_crosses(whole_, static_cast<int>(k), piece, 0.0, kAcross, kMostTurns) ||
            falls(model_.contacts[k], piece);
    }
    return all;
  }

  bool all_blocked_where_clipped(const Piece& piece) const {
    const ClippedLaw law(model_, {piece.a, piece.b}, piece.out);
    bool all = law.is_known();
    for (std::size_t k = 0; k < model_.contacts.size() && all; ++k) {
      all = !law.may_cross(static_cast<int>(k)) || falls(law, model_.contacts[k], piece);
    }
    return all;
  }

  /// About a point the object may have turned to another attitude, in which it is held.
  bool falls(const PushContact& contact, const Piece& piece) const {
    if (contact.is_point) return false;
    if (!clips_) return falls_all_along(model_, contact, piece);
    return falls(ClippedLaw(model_, {piece.a, piece.b}, piece.out), contact, piece);
  }

  bool falls(const ClippedLaw& law, const PushContact& contact,
             const Piece& piece) const {
    const PlanarGrasp grasp =
        grasp_at(model_, pose_from_finger(piece.middle(), 0.0), contact.g_O);
    PlanarTwist fall = PlanarTwist::Zero();
    return gravity_slack_by_pad_law(model_, grasp, &fall) < 0.0 &&
           law.falls(contact, fall, kUnevenIfSpread);
  }

  const Model& model_;
  bool clips_;
  LocalLaw whole_;
};

/// The piece with its normal away from the region. Borders neither cross nor touch, so
/// that one place beside the piece decides for all of it.
Piece piece_of(const Loops& region, const Vec2& a, const Vec2& b) {
  Piece piece{a, b, perp((a - b).normalized())};
  const double aside = 1e-6 * piece.length();
  if (is_between(region, piece.middle() + aside * piece.out)) piece.out = -piece.out;
  return piece;
}

/// All of the border. A border that may be crossed may be so along some of it, which is
/// soon found among pieces each of which is far from those before it; and near `weak`.
std::vector<Piece> pieces_of(const Loops& region, const Vec2* weak) {
  constexpr double kGolden = 0.6180339887498949;
  std::vector<Piece> pieces;
  for (const auto& loop : region) {
    auto step = 1 + static_cast<std::size_t>(kGolden * static_cast<double>(loop.size()));
    while (std::gcd(step, loop.size()) != 1) ++step;
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const std::size_t i = k * step % loop.size();
      pieces.push_back(piece_of(region, loop[i], loop[(i + 1) % loop.size()]));
    }
  }
  if (weak) {
    const auto nearest = std::ranges::min_element(
        pieces, {}, [&](const Piece& piece) { return (piece.middle() - *weak).norm(); });
    std::iter_swap(pieces.begin(), nearest);
  }
  return pieces;
}

/// Whether no push crosses the border; `weak` as of verify_barrier.
bool is_sealed(const BorderLaw& law, const Loops& region, std::string* why,
               std::optional<Vec2>* weak) {
  for (const Piece& piece : pieces_of(region, weak && *weak ? &**weak : nullptr)) {
    if (law.is_sealed(piece, kMostCuts)) continue;
    if (weak) *weak = piece.middle();
    return refuse(why, "a push may cross the border of the region");
  }
  return true;
}

}  // namespace

double depth_in_region(const Loops& region, const Vec2& p) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& loop : region) {
    nearest = tighter(nearest, std::abs(depth_inside(loop, p)));
  }
  return is_between(region, p) ? nearest : -nearest;
}

bool goal_is_outside(const Loops& region, const Goal& goal) {
  const double tolerance = goal.position_tolerance;
  const double farthest = Vec2(*goal.x, *goal.y).norm() + std::numbers::sqrt2 * tolerance;
  return for_all_goal_angles(goal, [&](double theta, double half_step) {
    const Vec2 middle = goal_place(goal, theta);
    const double around = half_step * farthest + kRounding;
    if (goal.test == GoalTest::kWeightedSum) {
      return depth_in_region(region, middle) < -(tolerance + around);
    }
    return is_outside(region, middle, rotated(-theta, Vec2(tolerance, 0.0)), around,
                      kMostGoalCuts);
  });
}

bool is_never_left(const Model& model, const Loops& region, std::string* why) {
  const BorderLaw law(model);
  if (!law.is_known())
    return refuse(why, "the friction of these pads is not known at every angle");
  return is_well_formed(region, why) && is_sealed(law, region, why, nullptr);
}

bool verify_barrier(const Model& model, const Loops& region, std::string* why,
                    std::optional<Vec2>* weak) {
  const Goal& goal = *model.scene.goal;
  if (!goal.x || !goal.y) return refuse(why, "the goal leaves a coordinate free");
  const BorderLaw law(model);
  if (!law.is_known())
    return refuse(why, "the friction of these pads is not known at every angle");
  if (!is_well_formed(region, why)) return false;
  const Vec2 start = finger_in_object(model.scene.start.X_HO);
  if (depth_in_region(region, start) <= 0.0) {
    return refuse(why, "the start is not in the region");
  }
  if (!goal_is_outside(region, goal)) {
    return refuse(why, "a pose of the goal is in the region");
  }
  return is_sealed(law, region, why, weak);
}

}  // namespace prehensile
