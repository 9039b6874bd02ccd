#include "primitives/measured_push.h"

#include <cmath>

namespace prehensile {
namespace {

/// So far may the path begin inside the object, as a share of its length or in [m],
/// whichever is more.
constexpr double kDeepestShare = 0.5;
constexpr double kDeepest = 5e-3;

/// Less steeply than this (sine) no path is said to meet a face.
constexpr double kLeastAdvance = 1e-3;

struct Meeting {
  int contact = -1;
  double share = 0.0;  ///< of the path at which the pusher meets the face; may be < 0
  double place = 0.0;
};

/// Where the pusher's centre meets the face of a contact on its way, in O.
std::optional<Meeting> meeting(const PushContact& contact, int index, const Vec2& from,
                               const Vec2& way) {
  const double length = way.norm();
  const double advance = way.dot(contact.n);
  if (!(advance > kLeastAdvance * length)) return std::nullopt;
  Meeting out;
  out.contact = index;
  out.share = (contact.a - from).dot(contact.n) / advance;
  if (out.share >= 1.0 ||
      -out.share * length > std::max(kDeepest, kDeepestShare * length)) {
    return std::nullopt;
  }
  const Vec2 met = from + out.share * way;
  const Vec2 middle = 0.5 * (contact.a + contact.b);
  out.place = (met - middle).dot(contact.t);
  const double half = 0.5 * (contact.b - contact.a).norm() + contact.half_length;
  if (std::abs(out.place) > half) return std::nullopt;
  return out;
}

}  // namespace

std::optional<LinearPush> push_of(const Model& model, const MeasuredPush& measured,
                                  const Vec2& registration) noexcept {
  const PlanarPose X_OH = inverse(measured.X_HO_start);
  const Vec2 from = transform(X_OH, measured.from + registration);
  const Vec2 way = transform(X_OH, measured.to + registration) - from;
  std::optional<Meeting> first;
  for (std::size_t i = 0; i < model.contacts.size(); ++i) {
    const PushContact& contact = model.contacts[i];
    if (contact.pusher != measured.pusher) continue;
    if (measured.face >= 0 && contact.face != measured.face) continue;
    const std::optional<Meeting> here = meeting(contact, static_cast<int>(i), from, way);
    // Inside the object the last face that was passed counts, before it the first.
    if (!here) continue;
    const bool is_nearer =
        !first ||
        (first->share < 0.0 && here->share > first->share && here->share < 0.0) ||
        (first->share >= 0.0 && here->share < first->share);
    if (is_nearer) first = here;
  }
  if (!first) return std::nullopt;
  // The pusher at the meeting and at the end, seen from the object: as in pusher_pose,
  // the finger axis runs by the difference in P.
  const Vec2 met = from + first->share * way;
  const double turn = (1.0 - std::max(0.0, first->share)) * measured.turn;
  const double theta = measured.X_HO_start.theta;
  const Vec2 axis_at_start = -rotated(-theta, translation(measured.X_HO_start));
  const Vec2 axis_at_end = met - rotated(-theta - turn, measured.to + registration);
  const Vec2 travel = axis_at_start - axis_at_end;
  LinearPush push;
  push.contact = first->contact;
  push.place = first->place;
  push.travel = travel.norm();
  if (push.travel > 0.0) push.e = travel / push.travel;
  push.turn = turn;
  return push;
}

PredictedPush predict(const Model& model, const MeasuredPush& measured,
                      const Vec2& registration,
                      const TransitionOptions& options) noexcept {
  PredictedPush out;
  out.X_HO_end = measured.X_HO_start;
  const std::optional<LinearPush> push = push_of(model, measured, registration);
  if (!push) return out;
  const Transition end = apply(model, {measured.X_HO_start, 0.0}, *push, options);
  out.status = end.status;
  out.X_HO_end = end.end.X_HO;
  out.push_force = end.max_push_force;
  return out;
}

}  // namespace prehensile
