/// What a contact can and cannot do about a wanted motion, in closed form.
#include <algorithm>
#include <cmath>

#include "primitives/place.h"
#include "primitives/place_wrench.h"
#include "scene/constants.h"

namespace prehensile {
namespace {

/// Powers below this share of the wrench count as none.
constexpr double kNoPower = 1e-9;

/// Twists that no force of the contact works against, and that together say what the
/// contact can exert: friction to either side, and load between the ends of the face.
std::array<PlanarTwist, 4> limits_of(const PushContact& contact, const PlanarPose& X_HO,
                                     double length) {
  const Vec2 n = rotated(X_HO.theta, contact.n);
  const Vec2 t = rotated(X_HO.theta, contact.t);
  const Vec2 a = transform(X_HO, contact.a);
  const Vec2 b = transform(X_HO, contact.b);
  const auto force = [](const Vec2& f) { return PlanarTwist(f.x(), f.y(), 0.0); };
  // Turning about a point: power of a force is its moment about the point.
  const auto about = [&](const Vec2& p, double sign) -> PlanarTwist {
    return sign / length * PlanarTwist(p.y(), -p.x(), 1.0);
  };
  if (contact.mu == 0.0) {
    return {force(-t), force(t), about(a, -1.0), about(b, 1.0)};
  }
  return {force(contact.mu * n - t), force(contact.mu * n + t), about(a, -1.0),
          about(b, 1.0)};
}

constexpr std::array<std::string_view, 4> kReasons = {
    "it would have to pull, or push with more friction than it has (towards +t)",
    "it would have to pull, or push with more friction than it has (towards -t)",
    "it would have to push beyond one end of its face",
    "it would have to push beyond the other end of its face"};

/// Least and greatest grip force for which value + slope * grip >= 0.
struct GripRange {
  double low, high;
};
GripRange allowed(double at_low, double at_high, double low, double high) {
  if (at_low >= 0.0 && at_high >= 0.0) return {low, high};
  if (at_low < 0.0 && at_high < 0.0) return {kInfinity, -kInfinity};
  const double zero = low + (high - low) * at_low / (at_low - at_high);
  return at_low < 0.0 ? GripRange{zero, high} : GripRange{low, zero};
}

}  // namespace

NeededWrench needed_wrench(const Model& model, const WantedMotion& wanted,
                           const PushContact& contact) {
  NeededWrench out;
  const PlanarGrasp grasp = grasp_at(model, wanted.X_HO, contact.g_O);
  const PlanarTwist V = wanted.twist_HO();
  if (model.has_soft_points()) {
    out.w = -model.surface().friction(V) - grasp.w_g;
    return out;
  }
  const double still = 1e-12 * (V.head<2>().norm() + model.c * std::abs(V[2]));
  for (int j = 0; j < grasp.count; ++j) {
    const Vec2 p(grasp.x[j], grasp.y[j]);
    const Vec2 slip = point_velocity(V, p);
    const double speed = slip.norm();
    const double bound = grasp.bound[j];
    if (speed > still) {
      out.w += wrench_of(p, bound / speed * slip);
    } else {
      // A pad point at the centre of rotation carries any force up to its bound.
      out.unknown_force += bound;
      out.unknown_at = p;
    }
  }
  out.w -= grasp.w_g;
  return out;
}

GripEnds::GripEnds(const Model& model, const PlaceOptions& options)
    : limits(grip_limits(model, options)),
      loosest(with_grip(model, limits.low)),
      tightest(with_grip(model, limits.high)) {}

std::vector<ContactVerdict> verdicts_of(const Model& model, const WantedMotion& wanted,
                                        const PlaceOptions& options) {
  return verdicts_of(GripEnds(model, options), wanted, options);
}

std::vector<ContactVerdict> verdicts_of(const GripEnds& ends, const WantedMotion& wanted,
                                        const PlaceOptions& options) {
  std::vector<ContactVerdict> out;
  const GripLimits& grip = ends.limits;
  const Model& model = ends.loosest;  // but for forces all models of the scene are alike
  for (int i = 0; i < static_cast<int>(model.contacts.size()); ++i) {
    const bool listed = options.contacts.empty() ||
                        std::find(options.contacts.begin(), options.contacts.end(), i) !=
                            options.contacts.end();
    if (!listed) continue;
    const PushContact& contact = model.contacts[i];
    const NeededWrench low = needed_wrench(ends.loosest, wanted, contact);
    const NeededWrench high = needed_wrench(ends.tightest, wanted, contact);
    const double length = std::max(model.c, 1e-9);
    const std::array<PlanarTwist, 4> limits = limits_of(contact, wanted.X_HO, length);
    std::array<GripRange, 4> ranges;
    ContactVerdict verdict{.contact = i, .possible = true};
    verdict.grip_low = grip.low;
    verdict.grip_high = grip.high;
    int binding_low = 0, binding_high = 0;
    for (int k = 0; k < 4; ++k) {
      const auto power = [&](const NeededWrench& needed) {
        const double room =
            needed.unknown_force * point_velocity(limits[k], needed.unknown_at).norm();
        return limits[k].dot(needed.w) + room;
      };
      const double tiny = kNoPower * (low.w.head<2>().norm() + high.w.head<2>().norm());
      ranges[k] = allowed(power(low) + tiny, power(high) + tiny, grip.low, grip.high);
      if (ranges[k].low > verdict.grip_low) binding_low = k;
      if (ranges[k].high < verdict.grip_high) binding_high = k;
      verdict.grip_low = std::max(verdict.grip_low, ranges[k].low);
      verdict.grip_high = std::min(verdict.grip_high, ranges[k].high);
    }
    if (verdict.grip_low > verdict.grip_high) {
      verdict.possible = false;
      verdict.grip_low = verdict.grip_high = kNan;
      verdict.reason = kReasons[binding_low];
      // Alone where one limit is broken at every grip force, else the two that exclude
      // each other, weighed so that their sum does not depend on the grip force.
      const auto slope = [&](int k) { return limits[k].dot(high.w - low.w); };
      verdict.proof = limits[binding_low];
      if (std::isfinite(ranges[binding_low].low)) {
        verdict.proof = limits[binding_low] / std::abs(slope(binding_low)) +
                        limits[binding_high] / std::abs(slope(binding_high));
        verdict.proof /= verdict.proof.norm();
        verdict.reason = "no grip force suits both its friction and its face";
      }
    } else if (!advances(contact, wanted)) {
      verdict.possible = false;
      verdict.reason = "its face moves away from the pusher";
    }
    out.push_back(verdict);
  }
  return out;
}

bool proves(const Model& model, const WantedMotion& wanted, const PlaceOptions& options,
            const ContactVerdict& verdict) {
  if (!verdict.proof.allFinite()) return false;
  const PushContact& contact = model.contacts[verdict.contact];
  const PlanarTwist& y = verdict.proof;
  double largest = 0.0;
  for (const Vec2& end : {contact.a, contact.b}) {
    for (const double side : {-1.0, 1.0}) {
      const Vec2 f =
          rotated(wanted.X_HO.theta, contact.n + side * contact.mu * contact.t);
      const double power = y.dot(wrench_of(transform(wanted.X_HO, end), f));
      if (power < -1e-9 * f.norm() * y.norm()) return false;
      largest = std::max(largest, std::abs(power));
    }
  }
  const GripLimits grip = grip_limits(model, options);
  for (const double force : {grip.low, grip.high}) {
    const NeededWrench needed = needed_wrench(with_grip(model, force), wanted, contact);
    const double room =
        needed.unknown_force * point_velocity(y, needed.unknown_at).norm();
    if (!(y.dot(needed.w) + room < 0.0)) return false;
  }
  return true;
}

bool advances(const PushContact& contact, const WantedMotion& wanted) {
  const Vec2 p_OF = finger_in_object(wanted.X_HO);
  for (const Vec2& end : {contact.a, contact.b}) {
    if (contact.n.dot(wanted.velocity + wanted.turn * perp(end - p_OF)) > 0.0) {
      return true;
    }
  }
  return false;
}

GripLimits grip_limits(const Model& model, const PlaceOptions& options) {
  const double own = model.scene.gripper.grip_force;
  if (options.grip_low == 0.0 && options.grip_high == 0.0) return {own, own};
  return {options.grip_low, options.grip_high};
}

Model with_grip(const Model& model, double grip_force) {
  if (grip_force == model.scene.gripper.grip_force) return model;
  Scene scene = model.scene;
  scene.gripper.grip_force = grip_force;
  return prepare(scene, model.options);
}

}  // namespace prehensile
