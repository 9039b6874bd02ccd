/// Which rotations of a push stick at one place of the finger axis, with the pads as the
/// face leaves them there. Internal to the planner.
///
/// Pads that the face clips press beside the finger axis: their friction is not that of
/// the closed form (sticking_kappas), which knows whole pads only. Where the pads are
/// discs, they are the same at every angle of the object, and a place decides.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "planner/pads/pad_columns.h"
#include "planner/steering/steering.h"

namespace prehensile {

/// Up to two intervals of kappa = c dtheta / |dp|.
struct KappaRanges {
  int count = 0;
  std::array<KappaSet::Interval, 2> intervals;
};

/// The kappas that both admit.
KappaRanges common(const KappaRanges& one, const KappaRanges& other) noexcept;

/// The pads at a place of the finger axis, at some angles of the object: the points that
/// stand for discs are not quite the same at each.
class PadsAtPlace {
 public:
  PadsAtPlace(const Model& model, const Vec2& p_OF);

  /// Alike at all such places.
  bool are_whole() const { return are_whole_; }
  static bool are_whole_at(const Model& model, const Vec2& p_OF);

  /// They do not touch the object.
  bool are_lost() const { return at_angles_.empty(); }

  int angles() const { return static_cast<int>(at_angles_.size()); }

  /// Friction that overcomes them at one of the angles, over F and F c. `turning`: c
  /// times the rate of turn of the object, in the scale of its velocity (in O). In single
  /// precision: many are looked at, each for a few digits. No heap.
  PadDrag drag(int angle, const Vec2& velocity, double turning) const noexcept {
    return at_angles_[static_cast<std::size_t>(angle)].drag(velocity, turning);
  }

 private:
  std::vector<PadColumns<float, PlanarGrasp::kCapacity>> at_angles_;
  bool are_whole_;
};

/// The kappas that are looked at.
enum class Steepness {
  kUsual,        ///< up to 10
  kUsualFinely,  ///< the same, of clipped pads twice as many
  kSteep,        ///< up to 40, of clipped pads as many
};

/// Friction of such pads over F, and over F c, for motions in one direction: found where
/// it is first asked for.
class DirectedDrag {
 public:
  /// `e`: motion of the object in the hand (unit, in O). Model and pads must outlive it.
  DirectedDrag(const Model& model, const PadsAtPlace& pads, const Vec2& e,
               Steepness steepness = Steepness::kUsual);
  DirectedDrag(const Model& model, PadsAtPlace&& pads, const Vec2& e,
               Steepness steepness = Steepness::kUsual) = delete;

  /// The kappas for which a contact sticks at all of the angles while the finger axis is
  /// at p_OF. No heap.
  KappaRanges kappas(const StickContact& contact, const Vec2& p_OF) noexcept;

  /// Whether the friction cone of a contact may hold at some kappa: if not, it sticks at
  /// none, wherever the finger axis is. No heap.
  bool is_in_cone(const StickContact& contact) noexcept;

  /// Of motions the other way, whose friction is the opposite: what either has found both
  /// know. Must not outlive this.
  DirectedDrag opposite();

  /// One of the kappas that are looked at, and the angle of (1, kappa) [rad].
  struct Slope {
    double angle, cosine, sine, kappa;
  };

 private:
  struct Sample {
    Vec2 force;
    double moment = 0.0;
    bool known = false;
  };
  enum class Angles { kFirst, kAll };
  /// About the wrenches (force, moment) of a few slopes.
  struct WrenchBox {
    Vec3 middle, half;
    bool known = false;
  };
  class Instants;
  static std::span<const Slope> slopes_for(const PadsAtPlace& pads, Steepness steepness);
  explicit DirectedDrag(DirectedDrag* other);
  Sample sample(std::size_t slope, std::size_t angle) noexcept;
  const WrenchBox& box(std::size_t block, Angles of) noexcept;

  const Model& model_;
  const PadsAtPlace& pads_;
  Vec2 e_;
  std::span<const Slope> slopes_;
  std::size_t angles_;
  std::vector<Sample> samples_;   // by slope and angle; empty where the other has them
  std::vector<WrenchBox> boxes_;  // by block of slopes, at the first angle and at all
  DirectedDrag* opposite_ = nullptr;  // that has
};

}  // namespace prehensile
