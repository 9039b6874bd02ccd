/// The instants of one push in space: what push_instant.h is for the pad plane.
///
/// The state of a finite push stays (x, y, theta). The jaws keep the faces that they hold
/// parallel to the pads, up to what the foundations of the pads yield, and that yield is
/// taken up once and not again with every step: loads of both pads, their shift within
/// the pads by moments across the pad plane, and the slip of both fingers and of the
/// pusher are those of the spatial instant; its motion along the closing direction and
/// its turns out of the plane are looked at and dropped. Likewise a contact that moves no
/// faster along the pusher, or off it, than the pads yield there sticks and stays.
///
/// Where the instant moves along the closing direction by more than ten times the largest
/// deflection of a loaded pad point, the object tilts between the jaws, goes with them,
/// or opens them: the push ends (kLeavesPlane). Pads of given loads do not resist that.
///
/// A contact mode is never prescribed: rates have kinks where it changes. Internal to the
/// primitives layer.
#pragma once

#include "mechanics/spatial_instant.h"
#include "primitives/contact_reading.h"

namespace prehensile {

class SpatialPushInstant {
 public:
  static constexpr bool kSmoothBeyondMode = false;

  SpatialPushInstant(const Model& model, const LinearPush& push, const Grasp& start,
                     const TransitionOptions& options);

  /// As in PushInstant; a question that was answered last is not solved again.
  PushStop solve(const Seat& seat, double s, const Vec2& q,
                 Search search = Search::kOneMotion) noexcept;

  /// The lawful instant, whatever its mode.
  InMode solve_in_mode(const Seat& seat, double s, const Vec2& q, Regime regime) noexcept;
  InMode check_ride(const Seat& seat, double s) noexcept;

  /// Spacing of the looks at a ride.
  double ride_lasts(double most) const noexcept { return std::min(most, ride_spacing_); }

  bool recedes() const { return recedes_somewhere(answer().drive); }
  PushStop explained(const PushStop& stop) const noexcept;

  void set_aside() { now_ = 1 - now_; }
  void bring_back() { now_ = 1 - now_; }

  /// Where motions lie next to each other the answer is the one next to the last. `keep`
  /// marks the answer at a place that the push has come to, and `resume` goes on from
  /// there: trials beyond do not choose the motion. Whether the last answer belongs to
  /// another motion than the one kept shows on the way back: from there the other one is
  /// found at the place that was kept (`hopped`; false where it is not known).
  void keep();
  void resume() { warm_ = kept_; }
  bool hopped() noexcept;

  bool is_solved() const { return !answer().stop; }

  /// Points that carry load, and how the pusher's do: the rate has a kink where that
  /// changes.
  int pivot() const { return answer().pattern; }

  Vec2 rate() const { return {answer().slip_beyond_yield, answer().contact.tilt_rate}; }
  ModeMargin margin(const Seat& seat, Regime regime) const {
    return margin_of(answer().contact, scales_, seat, regime);
  }
  Regime slip_side() const { return slip_side_of(answer().contact, scales_); }
  Regime regime() const { return regime_of(answer().contact, scales_); }
  Sample sample(double s, double psi) const;

  const SeatGeometry& geometry() const { return geometry_; }
  PlanarPose pose(const Seat& seat, double s, const Vec2& q) const;
  double speed() const { return scales_.speed; }
  double noise() const { return 100.0 * options_.tolerance; }
  double rounding() const { return options_.tolerance; }
  int count() const { return count_; }
  int checks() const { return 0; }

 private:
  struct Answer {
    Seat seat;
    double s = kNan;
    Vec2 q = Vec2::Zero();
    bool answered = false;
    bool probed = false;  ///< for other motions
    PushStop stop;
    PlanarPose X_HO;
    PlanarDrive drive;
    SpatialProblem problem;
    SpatialInstant instant;
    ContactReading contact;
    double slip_beyond_yield = 0.0;  ///< [m] per unit of s
    double out_of_plane = 0.0;       ///< share of what ends the push
    int pattern = -1;
  };
  const Answer& answer() const { return answers_[now_]; }
  void pose_question(const Seat& seat, double s, const Vec2& q) noexcept;
  PushStop ask(Answer& now) noexcept;
  void read(Answer& now) const noexcept;
  double leaves_plane(const Answer& now) const noexcept;
  std::string_view way_out(const Answer& now) const noexcept;

  const Model* model_;
  const PushContact* contact_;
  LinearPush push_;
  PlanarPose X_HO_start_;
  SeatGeometry geometry_;
  SpatialSolveOptions options_;
  ContactScales scales_;
  double ride_spacing_;

  std::array<Answer, 2> answers_;
  SpatialWarmStart warm_;
  SpatialWarmStart kept_;
  Seat kept_seat_;
  double kept_s_ = 0.0;
  Vec2 kept_q_ = Vec2::Zero();
  int kept_pattern_ = -1;
  int now_ = 0;
  int count_ = 0;
};

}  // namespace prehensile
