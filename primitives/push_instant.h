/// The instants of one push: builds the question at a point of the path, has it answered,
/// and reads the answer in the terms of the push: rates of its coordinates, distance to
/// the next change of contact mode, reasons to stop.
#pragma once

#include <algorithm>
#include <limits>

#include "mechanics/contact_mode.h"
#include "primitives/push_record.h"
#include "primitives/seat.h"

namespace prehensile {

/// What the contact does along the pusher.
enum class Regime { kStick, kSlipPlus, kSlipMinus };

/// How firmly each part of the present contact mode holds, dimensionless: positive while
/// it holds, through zero where it changes.
struct ModeMargin {
  std::array<double, 2> pressed;  ///< load against lift of each end of a flush line
  double regime = 0.0;            ///< friction left against slip, or the reverse

  double least() const { return std::min({pressed[0], pressed[1], regime}); }
};

class PushInstant {
 public:
  PushInstant(const Model& model, const LinearPush& push, const Grasp& start,
              const TransitionOptions& options);

  /// Solves the instant at the share s of the push with the object at q in the seat.
  /// `kAllMotions` tries every contact mode where the answer need not be unique.
  enum class Search { kOneMotion, kAllMotions };
  Obstacle solve(const Seat& seat, double s, const Vec2& q,
                 Search search = Search::kOneMotion) noexcept;

  /// The instant in a prescribed contact mode, lawful or not: smooth beyond the end of
  /// the mode. `kUnknown` where the mode has no motion or the pusher does not advance;
  /// `kUnheld` where the pads alone do not hold gravity, so that no push goes on there.
  enum class InMode { kMoves, kUnknown, kUnheld };
  InMode solve_in_mode(const Seat& seat, double s, const Vec2& q, Regime regime) noexcept;

  /// The same for a ride, where nothing needs to be solved: not counted as an instant.
  InMode check_ride(const Seat& seat, double s) noexcept;

  /// Share of the push over which the ride that was checked last is sure to go on, at
  /// most `most`.
  double ride_lasts(double most) const noexcept;

  /// Whether the pusher recedes at a point of the last answer: there motions need not be
  /// unique, and `kAllMotions` has to be asked.
  bool recedes() const;

  /// The reason behind an obstacle that the last instant met: a pusher that leaves the
  /// object might drag it along as well, and an instant is called ambiguous also where
  /// the pusher has to carry the object.
  Obstacle explained(const Obstacle& obstacle) const noexcept;

  /// Keeps the last answer while others are sought, and brings it back.
  void set_aside() { now_ = 1 - now_; }
  void bring_back() { now_ = 1 - now_; }

  /// The last answer is that of `solve`, not of a mode.
  bool is_solved() const { return answer().solved; }

  /// Pad point about which the object turns in the last answer of a mode; -1: none. The
  /// rate has a kink where that changes.
  int pivot() const { return answer().pivot; }

  /// Of the last answer.
  Vec2 rate() const { return {answer().slip, answer().tilt_rate}; }
  ModeMargin margin(const Seat& seat, Regime regime) const;
  Regime slip_side() const;
  Regime regime() const;
  Sample sample(double s, double psi) const;

  const SeatGeometry& geometry() const { return geometry_; }
  PlanarPose pose(const Seat& seat, double s, const Vec2& q) const;
  double speed() const { return speed_; }

  /// Margins and rates over `speed` below this are noise of the solver.
  double noise() const { return 100.0 * options_.tolerance; }

  int count() const { return count_; }
  int checks() const { return checks_; }

 private:
  /// A question, its answer, and what it means for the push.
  struct Answer {
    PlanarPose X_HO;
    PlanarGrasp grasp;
    PlanarDrive drive;
    PlanarInstant instant;  ///< if `solved`
    bool solved = false;
    int pivot = -1;
    PlanarTwist V_HO = PlanarTwist::Zero();
    std::array<double, 2> load{0.0, 0.0};  ///< [N] normal, of each end
    double slip = 0.0;       ///< [m] per unit of s, of the object along the pusher
    double tilt_rate = 0.0;  ///< [rad] per unit of s
    std::array<double, 2> lift{0.0, 0.0};  ///< [m] per unit of s
    double normal_force = 0.0;             ///< [N]
    double tangential_force = 0.0;         ///< [N]
  };
  const Answer& answer() const { return answers_[now_]; }
  double friction_left(const Answer& answer) const;
  void pose_question(const Seat& seat, double s, const Vec2& q) noexcept;
  InMode take_mode(const Seat& seat, Regime regime) noexcept;
  void read(const Seat& seat, Answer& answer) const noexcept;
  bool is_ellipsoid() const { return friction_ == FrictionModel::kEllipsoid; }

  const Model* model_;
  const PushContact* contact_;
  LinearPush push_;
  PlanarPose X_HO_start_;
  SeatGeometry geometry_;
  PlanarSolveOptions options_;
  FrictionModel friction_;
  double speed_;  ///< [m] per unit of s: unit of rates
  double force_;  ///< [N] unit of forces

  std::array<Answer, 2> answers_;
  PlanarWarmStart warm_;
  int now_ = 0;
  int count_ = 0;
  int checks_ = 0;
};

}  // namespace prehensile
