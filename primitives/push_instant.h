/// The instants of one push: builds the question at a point of the path, has it answered,
/// and reads the answer in the terms of the push: rates of its coordinates, distance to
/// the next change of contact mode, reasons to stop.
#pragma once

#include "mechanics/contact_mode.h"
#include "primitives/contact_reading.h"

namespace prehensile {

class PushInstant {
 public:
  PushInstant(const Model& model, const LinearPush& push, const Grasp& start,
              const TransitionOptions& options);

  using Search = prehensile::Search;
  using InMode = prehensile::InMode;

  /// Rates are those of the contact mode also beyond its end.
  static constexpr bool kSmoothBeyondMode = true;

  /// Solves the instant at the share s of the push with the object at q in the seat.
  PushStop solve(const Seat& seat, double s, const Vec2& q,
                 Search search = Search::kOneMotion) noexcept;

  /// The instant in a prescribed contact mode, lawful or not: smooth beyond the end of
  /// the mode.
  InMode solve_in_mode(const Seat& seat, double s, const Vec2& q, Regime regime) noexcept;

  /// The same for a ride, where nothing needs to be solved: not counted as an instant.
  InMode check_ride(const Seat& seat, double s) noexcept;

  /// Share of the push over which the ride that was checked last is sure to go on, at
  /// most `most`.
  double ride_lasts(double most) const noexcept;

  /// Whether the pusher recedes at a point of the last answer: there motions need not be
  /// unique, and `kAllMotions` has to be asked.
  bool recedes() const;

  /// The reason behind a stop that the last instant met: a pusher that leaves the
  /// object might drag it along as well, and an instant is called ambiguous also where
  /// the pusher has to carry the object.
  PushStop explained(const PushStop& stop) const noexcept;

  /// Keeps the last answer while others are sought, and brings it back.
  void set_aside() { now_ = 1 - now_; }
  void bring_back() { now_ = 1 - now_; }

  /// A mode has one motion, wherever it is sought from.
  void keep() {}
  void resume() {}
  static constexpr bool hopped() { return false; }

  /// The last answer is that of `solve`, not of a mode.
  bool is_solved() const { return answer().solved; }

  /// Pad point about which the object turns in the last answer of a mode; -1: none. The
  /// rate has a kink where that changes.
  int pivot() const { return answer().pivot; }

  /// Of the last answer.
  Vec2 rate() const { return {answer().contact.slip, answer().contact.tilt_rate}; }
  ModeMargin margin(const Seat& seat, Regime regime) const {
    return margin_of(answer().contact, scales_, seat, regime);
  }
  Regime slip_side() const { return slip_side_of(answer().contact, scales_); }
  Regime regime() const { return regime_of(answer().contact, scales_); }
  Sample sample(double s, double psi) const;

  const SeatGeometry& geometry() const { return geometry_; }
  PlanarPose pose(const Seat& seat, double s, const Vec2& q) const;
  double speed() const { return scales_.speed; }

  /// Margins and rates over `speed` below this are noise of the solver.
  double noise() const { return 100.0 * options_.tolerance; }

  /// Relative error of a rate: the modes are solved to rounding.
  static constexpr double rounding() { return 1e-14; }

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
    ContactReading contact;
  };
  const Answer& answer() const { return answers_[now_]; }
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
  ContactScales scales_;

  std::array<Answer, 2> answers_;
  PlanarWarmStart warm_;
  int now_ = 0;
  int count_ = 0;
  int checks_ = 0;
};

}  // namespace prehensile
