/// What a push leaves behind: extremes, events, samples, and the reason it stopped.
#pragma once

#include <optional>
#include <vector>

#include "primitives/transition.h"

namespace prehensile {

/// Why a push cannot go on; status kNotRun: it can.
struct PushStop {
  TransitionStatus status = TransitionStatus::kNotRun;
  std::optional<EventKind> event;
  std::string_view reason;

  explicit operator bool() const { return status != TransitionStatus::kNotRun; }
};

class PushRecord {
 public:
  /// Instants whose certificate exceeds `certificate_tolerance` stop the push.
  PushRecord(double certificate_tolerance, std::vector<Sample>* trace);

  void add(const Sample& sample);

  /// An event that does not end the push: kept while there is room, else only counted.
  void add(EventKind kind, double s);

  /// Forgets the last event, which turned out not to be one.
  void take_back();

  void stop(const PushStop& why, double s);
  bool stopped() const { return transition_.status != TransitionStatus::kNotRun; }

  /// Path of the contact along the pusher [m].
  void add_slip(double length) { transition_.slipped += length; }

  /// The transition; one that was not stopped has been completed.
  Transition finish(const Grasp& end, double s, double error_estimate, int instants,
                    int checks = 0);

 private:
  double certificate_tolerance_;
  std::vector<Sample>* trace_;
  Transition transition_;
};

}  // namespace prehensile
