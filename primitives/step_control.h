/// Lengths of the steps along a push: error control, landings on events, and the closing
/// in on places beyond which there is no motion.
#pragma once

#include <limits>

namespace prehensile {

class StepControl {
 public:
  static constexpr double kNever = std::numeric_limits<double>::infinity();

  /// `tolerance` [m] of the whole push; `longest` step and `location` of events as shares
  /// of the push.
  StepControl(double tolerance, double longest, double location);

  double location() const { return location_; }

  /// Length of the next step from s; at most `cap`, and exactly 1 - s if it is the last.
  double next(double s, double cap);

  /// Whether a step of length h with this error [m], which grows with the power `order`
  /// of h, is good enough. Steps may spend their share of the tolerance, so that all
  /// errors add up to it.
  bool accepts(double h, double error, int order = 5);

  /// The error that a step of length h may have [m].
  double allowed(double h) const;

  /// What was refused before, and why, says nothing about the steps from here on.
  void renew();

  /// The next step shall have this length.
  void land(double length) { landing_ = length; }

  /// There is no motion at `at`. True if that is as close to s as an event is located;
  /// otherwise the next steps close in on it by halves.
  bool is_at_block(double s, double at);

  /// The push has come to s.
  void passed(double s);

  /// Where no motion was found, and not yet that there is one; infinity: nowhere.
  double blocked() const { return blocked_; }
  void unblock() { blocked_ = kNever; }

 private:
  double tolerance_;
  double longest_;
  double location_;
  double natural_;            ///< length that error control asks for
  bool was_refused_ = false;  ///< then the next step does not grow
  double landing_ = kNever;   ///< wanted once
  double blocked_ = kNever;   ///< share of the push at which no motion was found
};

}  // namespace prehensile
