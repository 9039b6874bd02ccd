#include "primitives/grip_range.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "mechanics/pad_law.h"
#include "primitives/force_search.h"
#include "primitives/linear_push.h"
#include "primitives/space_grip.h"
#include "scene/constants.h"

namespace prehensile {
namespace {

/// Halvings of the search for the least grip that holds.
constexpr int kHalvings = 60;

/// Friction force of the pads per unit of grip force.
double friction_of(const Model& model) {
  const std::array<double, 2>& mu = model.scene.gripper.friction;
  return mu[0] + mu[1];
}

/// A limit a F + b >= 0 on the friction force F of the pads.
void keep(double a, double b, double& low, double& high) {
  if (a > 0.0) {
    low = std::max(low, -b / a);
  } else if (a < 0.0) {
    high = std::min(high, -b / a);
  } else if (b < 0.0) {
    high = -kInfinity;
  }
}

/// The least friction force with which the pads alone hold gravity at this pose [N].
double least_to_hold(const Model& model, const PlanarPose& X_HO, const Vec2& g_O) {
  PlanarGrasp grasp = grasp_at(model, X_HO, g_O);
  if (grasp.count == 0) return kInfinity;
  const double F = grasp.capacity();
  const auto held = [&](double friction) {
    PlanarGrasp scaled = grasp;
    for (int j = 0; j < grasp.count; ++j) scaled.bound[j] *= friction / F;
    return gravity_slack_by_pad_law(model, scaled) > 0.0;
  };
  const double weight = grasp.w_g.head<2>().norm();
  if (weight == 0.0) return 0.0;
  double low = weight;  // no pad holds more than its friction
  double high = 2.0 * weight;
  while (!held(high)) {
    low = high;
    high *= 2.0;
    if (high > 1e9 * weight) return kInfinity;
  }
  for (int i = 0; i < kHalvings && high - low > 1e-12 * high; ++i) {
    const double middle = 0.5 * (low + high);
    (held(middle) ? high : low) = middle;
  }
  return high;
}

class Search {
 public:
  Search(const Model& model, const Grasp& start, const Push& push,
         const GripRangeOptions& options)
      : model_(model), start_(start), push_(push), options_(options) {
    const LinearPush linear = as_linear(push);
    nominal_ = pusher_pose(linear, start.X_HO, 1.0);
    const bool is_general = std::holds_alternative<LinearPush>(push);
    if (is_general && model.contacts[linear.contact].is_point) {
      nominal_ = apply(model, start, push, options.transition).end.X_HO;
    }
  }

  const PlanarPose& nominal() const { return nominal_; }

  Transition at(double force) const {
    return apply(gripped(model_, force), start_, push_, options_.transition);
  }

  double strayed(const Transition& done) const {
    const PlanarPose& end = done.end.X_HO;
    return Vec3(end.x - nominal_.x, end.y - nominal_.y,
                model_.c * (end.theta - nominal_.theta))
        .norm();
  }

  bool does(const Transition& done) const {
    return done.completed() && strayed(done) <= options_.tolerance;
  }

  /// Closes in on the end of the range between two forces.
  GripEnd between(double inside, double outside) const {
    GripEnd end;
    const ForceEnd found = force_end(inside, outside, options_.precision,
                                     [this](double force) { return does(at(force)); });
    end.force = found.inside;
    end.beyond = found.beyond;
    end.inside = at(end.force);
    end.outside = at(end.beyond);
    end.strayed = strayed(end.outside);
    return end;
  }

  GripEnd open(double force) const {
    GripEnd end;
    end.force = force;
    end.is_open = true;
    end.inside = at(force);
    return end;
  }

 private:
  const Model& model_;
  const Grasp& start_;
  const Push& push_;
  const GripRangeOptions& options_;
  PlanarPose nominal_;
};

/// Why the question makes no sense; empty if it does.
std::string_view refusal(const Model& model, const Push& push,
                         const GripRangeOptions& options) {
  const int contact = contact_of(push);
  if (std::holds_alternative<Roll>(push)) return "a roll has a grip force of its own";
  if (contact < 0 || contact >= static_cast<int>(model.contacts.size())) {
    return "the scene has no such contact";
  }
  const bool ordered = options.least > 0.0 && options.greatest > options.least;
  if (!ordered || !(options.precision > 0.0) || !(options.tolerance > 0.0) ||
      options.samples < 1 || !are_usable(options.transition)) {
    return "an option is out of range";
  }
  if (!(friction_of(model) > 0.0)) return "the pads have no friction";
  return {};
}

}  // namespace

GripSample grip_sample(const Model& model, const Grasp& start, const LinearPush& push,
                       double s) {
  GripSample sample;
  sample.s = s;
  const PushContact& contact = model.contacts[push.contact];
  const PlanarPose X_HO = pusher_pose(push, start.X_HO, s);
  const double per_grip = friction_of(model);
  sample.hold = least_to_hold(model, X_HO, contact.g_O) / per_grip;
  if (contact.is_point) return sample;
  const PlanarTwist V_HP = pusher_twist(push, start.X_HO, s);
  const PlanarDrive drive = drive_at(contact, push.place, X_HO, V_HP);
  PlanarGrasp grasp = grasp_at(model, X_HO, contact.g_O);
  const ContactModeOfPush flush{ContactModeOfPush::Load::kBoth, 0};
  const MotionInMode with = solve_in_mode_by_pad_law(model, grasp, drive, flush);
  grasp.w_g.setZero();
  const MotionInMode without = solve_in_mode_by_pad_law(model, grasp, drive, flush);
  if (!with.exists || !without.exists) return sample;

  // Every load is a part that grows with the friction of the pads, and one that does not.
  const double F = grasp.capacity();
  double low = 0.0;
  double high = kInfinity;
  double normal = 0.0;
  double normal_rest = 0.0;
  double tangential = 0.0;
  double tangential_rest = 0.0;
  for (int k = 0; k < 2; ++k) {
    const double grows = without.normal_force[k];
    const double rest = with.normal_force[k] - grows;
    keep(grows / F, rest, low, high);
    normal += grows;
    normal_rest += rest;
    tangential += without.tangential_force[k];
    tangential_rest += with.tangential_force[k] - without.tangential_force[k];
  }
  for (const double side : {1.0, -1.0}) {
    keep((contact.mu * normal + side * tangential) / F,
         contact.mu * normal_rest + side * tangential_rest, low, high);
  }
  sample.stick_low = low / per_grip;
  sample.stick_high = high / per_grip;
  return sample;
}

GripRange grip_range(const Model& model, const Grasp& start, const Push& push,
                     const GripRangeOptions& options) {
  GripRange range;
  range.reason = refusal(model, push, options);
  if (!range.reason.empty()) return range;
  const Search search(model, start, push, options);
  const LinearPush linear = as_linear(push);
  range.nominal = search.nominal();
  const bool in_space = is_in_space(model, linear, options.transition);
  range.in_space = in_space;
  for (int i = 0; i <= options.samples; ++i) {
    const double s = static_cast<double>(i) / options.samples;
    range.profile.push_back(in_space
                                ? grip_sample_in_space(model, start, linear, s, options)
                                : grip_sample(model, start, linear, s));
  }
  const Vec2& g_O = model.contacts[linear.contact].g_O;
  const auto hold = [&](const PlanarPose& X_HO, const Vec2& g) {
    return in_space ? least_to_hold_in_space(model, linear.contact, X_HO, g, options)
                    : least_to_hold(model, X_HO, g) / friction_of(model);
  };
  range.hold_start = hold(start.X_HO, g_O);
  const double tilt = range.nominal.theta - pusher_pose(linear, start.X_HO, 1.0).theta;
  range.hold_end = hold(range.nominal, rotated(-tilt, g_O));

  const ForceGrid grid(model.scene.gripper.grip_force, options.least, options.greatest);
  const std::optional<ForceRun> run =
      run_of_forces(grid, [&](double force) { return search.does(search.at(force)); });
  if (!run) {
    range.reason = "with no grip force of the search does the push what it should";
    return range;
  }
  range.found = true;
  range.low = run->low == grid.first()
                  ? search.open(grid.at(run->low))
                  : search.between(grid.at(run->low), grid.at(run->low - 1));
  range.high = run->high == grid.last()
                   ? search.open(grid.at(run->high))
                   : search.between(grid.at(run->high), grid.at(run->high + 1));
  return range;
}

}  // namespace prehensile
