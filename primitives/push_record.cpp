#include "primitives/push_record.h"

#include <cmath>

namespace prehensile {

PushRecord::PushRecord(double certificate_tolerance, std::vector<Sample>* trace)
    : certificate_tolerance_(certificate_tolerance), trace_(trace) {}

void PushRecord::add(const Sample& sample) {
  // fmax and fmin ignore the NaN that stands for "nothing yet".
  transition_.max_push_force = std::fmax(transition_.max_push_force, sample.push_force);
  transition_.min_push_force = std::fmin(transition_.min_push_force, sample.push_force);
  transition_.worst_certificate =
      std::fmax(transition_.worst_certificate, sample.certificate);
  transition_.least_jaw_force = std::fmin(
      transition_.least_jaw_force, std::fmin(sample.jaw_force[0], sample.jaw_force[1]));
  transition_.least_pressed = std::fmin(transition_.least_pressed, sample.pressed);
  transition_.most_out_of_plane =
      std::fmax(transition_.most_out_of_plane, sample.out_of_plane);
  if (trace_) trace_->push_back(sample);
  if (!(sample.certificate <= certificate_tolerance_)) {
    stop({TransitionStatus::kUncertified, {}, "an instant failed its certificate"},
         sample.s);
  }
}

void PushRecord::add(EventKind kind, double s) {
  // One place is kept for the event that ends the push.
  if (transition_.event_count == Transition::kMaxEvents - 1) {
    ++transition_.more_events;
  } else {
    transition_.events[transition_.event_count++] = {kind, s};
  }
}

void PushRecord::take_back() {
  --(transition_.more_events > 0 ? transition_.more_events : transition_.event_count);
}

void PushRecord::stop(const PushStop& why, double s) {
  transition_.status = why.status;
  transition_.reason = why.reason;
  const bool room = transition_.event_count < Transition::kMaxEvents;
  if (why.event && room) {
    transition_.events[transition_.event_count++] = {*why.event, s};
  }
}

Transition PushRecord::finish(const Grasp& end, double s, double error_estimate,
                              int instants, int checks) {
  if (!stopped()) transition_.status = TransitionStatus::kCompleted;
  transition_.end = end;
  transition_.done = s;
  transition_.error_estimate = error_estimate;
  transition_.instants = instants;
  transition_.checks = checks;
  return transition_;
}

}  // namespace prehensile
