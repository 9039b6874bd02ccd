#include "mechanics/sticking.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Geometry>

#include "scene/constants.h"

namespace prehensile {
namespace {

constexpr double kEllipsoidMoment = 1e-9;  // tolerances at a point contact, over F c
constexpr double kPadMoment = 1e-3;

/// Drag of the real pads over F, in O, for a twist of any scale, the points moved away
/// from the finger axis by `stretch`.
PadDrag pad_drag(const Model& model, const PlanarGrasp& grasp,
                 const Eigen::Matrix2d& R_HO, const Vec2& velocity, double omega,
                 double stretch) {
  if (model.has_soft_points()) {
    return drag_of_ellipsoid(stretch * model.c, velocity, omega);
  }
  const PadDrag drag = drag_of_points(grasp.count, grasp.x, grasp.y, grasp.bound, stretch,
                                      R_HO * velocity, omega);
  return {R_HO.transpose() * drag.force / model.F, drag.moment / model.F};
}

/// Push wrench on the object over F: what remains of the drag after gravity.
struct Effort {
  Vec2 force;
  double moment_a, moment_b;  ///< [m] about the ends of the face
};

Effort effort_of(const StickContact& contact, const Vec2& p_OF, const PadDrag& drag,
                 double gravity) {
  const Vec2 force = drag.force - gravity * contact.gamma;
  const double moment =
      drag.moment - gravity * cross(contact.p_OCom - p_OF, contact.gamma);
  return {force, moment + cross(p_OF - contact.a, force),
          moment + cross(p_OF - contact.b, force)};
}

double cone_slack(const StickContact& contact, const Effort& effort) {
  const double f_n = effort.force.dot(contact.n);
  const double slack = contact.mu * f_n - std::abs(effort.force.dot(contact.t));
  return contact.mu == 0.0 ? std::min(slack, f_n) : slack;
}

/// b lies after a along t, so pressure between them has a negative moment about a and a
/// positive one about b.
double end_slack(const StickContact& contact, const Effort& effort) {
  return std::min(-effort.moment_a, effort.moment_b) / contact.c;
}

Vec2 centre_of_pressure(const StickContact& contact, const Effort& effort) {
  return contact.a - effort.moment_a / effort.force.dot(contact.n) * contact.t;
}

/// Greatest normal rate of the pusher between x and y, over the speed of the twist, at
/// worst over tilt and place of the finger axis.
double advance(const StickContact& contact, const Vec2& x, const Vec2& y,
               const Vec2& p_OF, const Vec2& velocity, double omega,
               const Margin& margin) {
  const double n = contact.n.dot(velocity);
  const double lost = n - least_turned(n, cross(contact.n, velocity), margin.tilt) +
                      margin.grasp * std::abs(omega);
  const auto rate = [&](const Vec2& end) {
    return contact.n.dot(velocity + omega * perp(end - p_OF)) - lost;
  };
  const double turn = contact.c * omega;
  return std::max(rate(x), rate(y)) / std::sqrt(velocity.squaredNorm() + turn * turn);
}

/// A single point cannot choose its moment: nothing to test within the tolerance.
double point_slack(const StickContact& contact, const Effort& effort, double tolerance) {
  const double slack = end_slack(contact, effort);
  return contact.a == contact.b && slack >= -tolerance ? kInfinity : slack;
}

/// The worst of the box that is known beforehand: least friction, ends moved inward. The
/// moments are affine in a shift of the pusher, with the positive normal force as slope.
StickContact weakened(const StickContact& contact, const Margin& margin) {
  StickContact weak = contact;
  weak.mu *= std::max(0.0, 1.0 - margin.friction);
  if (!contact.is_point) {
    weak.a += margin.place * contact.t;
    weak.b -= margin.place * contact.t;
  }
  return weak;
}

/// Where the finger axis is, and where it was when the push began: a tilt of the push
/// turns its path about that place.
struct FingerPath {
  Vec2 p_OF, p_OF_begin;
};

/// How far drag and gravity may be turned [rad].
struct Tilts {
  double drag, gravity;
};

/// Cone and ends as cone_slack and end_slack say, but drag and gravity turned to the
/// worst, each row by itself, and the finger axis off its place.
double turned_slack(const StickContact& weak, const FingerPath& path, const PadDrag& drag,
                    double gravity, const Margin& margin, const Tilts& tilts,
                    double least) {
  const auto row = [&](double n, double t) {
    const Vec2 w = n * weak.n + t * weak.t;
    return least_turned(w.dot(drag.force), cross(w, drag.force), tilts.drag) +
           gravity *
               least_turned(-w.dot(weak.gamma), cross(w, weak.gamma), tilts.gravity);
  };
  double slack = std::min(row(weak.mu, -1.0), row(weak.mu, 1.0));
  if (weak.mu == 0.0) slack = std::min(slack, row(1.0, 0.0));
  if (weak.is_point || slack < least) return slack;
  const auto moment = [&](double sign, const Vec2& end) {
    const Vec2 lever = weak.p_OCom - end;
    return sign * drag.moment - margin.grasp * drag.force.norm() +
           least_turned(sign * cross(path.p_OF - end, drag.force),
                        (path.p_OF_begin - end).dot(drag.force), tilts.drag) +
           gravity * least_turned(-sign * cross(lever, weak.gamma), lever.dot(weak.gamma),
                                  tilts.gravity);
  };
  const double ends = std::min(moment(-1.0, weak.a), moment(1.0, weak.b));
  const double shift = gravity * margin.centre_of_mass * weak.gamma.norm();
  return std::min(slack, (ends - shift) / weak.c);
}

/// Least slack of a weakened contact at one drag over the box of m/F and centre of mass,
/// in both of which the rows are affine, and over tilt and place of the finger axis; as
/// much of it as tells that it is below `least`.
double slack_of_drag(const StickContact& weak, const FingerPath& path,
                     const PadDrag& drag, const Margin& margin, const Tilts& tilts,
                     double least = -kInfinity) {
  const bool straight = tilts.drag == 0.0 && tilts.gravity == 0.0 && margin.grasp == 0.0;
  double slack = kInfinity;
  for (const double gravity : {margin.least_weight(), margin.most_weight()}) {
    if (!straight) {
      slack =
          std::min(slack, turned_slack(weak, path, drag, gravity, margin, tilts, least));
      if (slack < least) return slack;
      continue;
    }
    const Effort effort = effort_of(weak, path.p_OF, drag, gravity);
    slack = std::min(slack, cone_slack(weak, effort));
    if (weak.is_point) continue;
    const double shift = gravity * margin.centre_of_mass * weak.gamma.norm() / weak.c;
    slack = std::min(slack, end_slack(weak, effort) - shift);
  }
  return slack;
}

StickTest reported(const StickContact& contact, const Vec2& p_OF, const PadDrag& drag,
                   double F, double moment_tolerance) {
  const Effort effort = effort_of(contact, p_OF, drag, 1.0);
  StickTest test;
  test.push_force = F * effort.force.norm();
  test.normal_force = F * effort.force.dot(contact.n);
  test.tangential_force = F * effort.force.dot(contact.t);
  test.centre_of_pressure =
      (centre_of_pressure(contact, effort) - contact.centre).dot(contact.t);
  test.slack = std::min(cone_slack(contact, effort),
                        point_slack(contact, effort, moment_tolerance));
  return test;
}

}  // namespace

StickContact stick_contact(const Model& model, const PushContact& contact, double place) {
  const PushContact::Segment segment = contact.segment(place);
  StickContact stick;
  stick.n = contact.n;
  stick.t = contact.t;
  stick.a = segment.a;
  stick.b = segment.b;
  stick.centre = 0.5 * (contact.a + contact.b);
  stick.mu = contact.mu;
  stick.gamma = model.mass / model.F * contact.g_O;
  stick.p_OCom = model.p_OCom;
  stick.c = model.c;
  stick.is_point = contact.is_point;
  return stick;
}

StickContact face_contact(const Model& model, const PushContact& contact) {
  StickContact stick = stick_contact(model, contact, 0.0);
  stick.a = contact.a;
  stick.b = contact.b;
  return stick;
}

StickTest stick_test(const StickContact& contact, double F, const Vec2& p_OF,
                     const Vec2& e, double v, double omega) noexcept {
  const Vec2 velocity = v * e;
  const PadDrag drag = drag_of_ellipsoid(contact.c, velocity, omega);
  StickTest test = reported(contact, p_OF, drag, F, kEllipsoidMoment);
  test.slack = std::min(test.slack, advance(contact, contact.a, contact.b, p_OF, velocity,
                                            omega, Margin::none()));
  return test;
}

double robust_slack(const StickContact& contact, const Vec2& p_OF, const Vec2& velocity,
                    double omega, const Margin& margin, double least) noexcept {
  if (velocity.isZero(0.0) && omega == 0.0) return kNan;
  const StickContact weak = weakened(contact, margin);
  double slack = kInfinity;
  if (!contact.is_point) {
    slack = advance(contact, weak.a, weak.b, p_OF, velocity, omega, margin);
    if (slack < least) return slack;
  }
  const auto slack_at = [&](double c) {
    return slack_of_drag(weak, {p_OF, p_OF}, drag_of_ellipsoid(c, velocity, omega),
                         margin, {margin.tilt, margin.tilt}, least);
  };
  const double c_lo = (1.0 - margin.torque_radius) * contact.c;
  const double c_hi = (1.0 + margin.torque_radius) * contact.c;
  slack = std::min(slack, slack_at(c_lo));
  if (slack < least) return slack;
  slack = std::min(slack, slack_at(c_hi));
  if (contact.is_point) {
    Margin tilt = Margin::none();  // what concerns the friction cone only
    tilt.tilt = margin.tilt;
    const PadDrag nominal = drag_of_ellipsoid(contact.c, velocity, omega);
    const Effort effort = effort_of(contact, p_OF, nominal, 1.0);
    const Vec2 point = centre_of_pressure(contact, effort);
    return std::min({slack, point_slack(contact, effort, kEllipsoidMoment),
                     advance(contact, point, point, p_OF, velocity, omega, tilt)});
  }
  // The moment about an end x has one stationary point in c, where
  // c^2 omega^2 + 2 |v|^2 = omega cross(p - x, v): nearly always outside the box.
  for (const Vec2& end : {weak.a, weak.b}) {
    const double squared =
        omega * cross(p_OF - end, velocity) - 2.0 * velocity.squaredNorm();
    const double c_omega_lo = c_lo * std::abs(omega);
    const double c_omega_hi = c_hi * std::abs(omega);
    if (squared <= c_omega_lo * c_omega_lo || squared >= c_omega_hi * c_omega_hi)
      continue;
    slack = std::min(slack, slack_at(std::sqrt(squared) / std::abs(omega)));
  }
  return slack;
}

double slack_of_frictions(const StickContact& contact, const Vec2& p_OF,
                          std::span<const PadDrag> frictions,
                          const Margin& margin) noexcept {
  const StickContact weak = weakened(contact, margin);
  double slack = kInfinity;
  for (const PadDrag& friction : frictions) {
    slack = std::min(slack, slack_of_drag(weak, {p_OF, p_OF}, friction, margin,
                                          {margin.tilt, margin.tilt}));
  }
  return slack;
}

StickTest exact_stick_test(const Model& model, const PushContact& contact, double place,
                           const PlanarPose& X_HO, const Vec2& e, double v, double omega,
                           const Margin& margin, double travelled,
                           double least) noexcept {
  StickTest test;
  if (v == 0.0 && omega == 0.0) return test;
  const PlanarGrasp grasp = grasp_at(model, X_HO, contact.g_O);
  if (grasp.count == 0) {
    test.slack = -kInfinity;
    return test;
  }
  StickContact stick = stick_contact(model, contact, place);
  if (stick.c == 0.0) stick.c = model.L;  // a point pad has no torque to count moments in
  const Vec2 p_OF = finger_in_object(X_HO);
  const Eigen::Matrix2d R_HO = Eigen::Rotation2Dd(X_HO.theta).toRotationMatrix();
  const auto drag_at = [&](const Vec2& direction, double stretch) {
    return pad_drag(model, grasp, R_HO, v * direction, omega, stretch);
  };
  const PadDrag nominal = drag_at(e, 1.0);
  test = reported(stick, p_OF, nominal, model.F * contact.grip_share, kPadMoment);
  if (test.slack < least) return test;
  const StickContact weak = weakened(stick, margin);
  const Vec2 p_OF_begin = p_OF + travelled * e;
  const bool turns_drag = model.region.is_isotropic();  // by as much as the motion
  const FingerPath path{p_OF, p_OF_begin};
  const Tilts tilts{turns_drag ? margin.tilt : 0.0, margin.tilt};
  test.slack = std::min({test.slack, slack_of_drag(weak, path, nominal, margin, tilts),
                         advance(stick, weak.a, weak.b, p_OF, v * e, omega, margin)});
  const auto keep = [&](const Vec2& direction, double stretch, const FingerPath& at) {
    if (test.slack < least) return;
    const PadDrag drag = drag_at(direction, stretch);
    test.slack = std::min(test.slack, slack_of_drag(weak, at, drag, margin, tilts));
  };
  const double stretched = margin.torque_radius;
  if (stretched != 0.0) {
    keep(e, 1.0 - stretched, path);
    keep(e, 1.0 + stretched, path);
  }
  if (turns_drag || margin.tilt == 0.0 || v == 0.0) return test;
  for (const double tilt : {-margin.tilt, margin.tilt}) {
    const Vec2 direction = rotated(tilt, e);
    const Vec2 there = p_OF_begin - travelled * direction;
    keep(direction, 1.0, {there, there});
    if (stretched == 0.0) continue;
    keep(direction, 1.0 - stretched, {there, there});
    keep(direction, 1.0 + stretched, {there, there});
  }
  return test;
}

double uncertain_moment(const Model& model, const Vec2& p_OF, const Vec2& g_O,
                        const Margin& margin) noexcept {
  const double turned = std::abs((model.p_OCom - p_OF).dot(g_O)) * margin.tilt;
  const double off = (margin.centre_of_mass + margin.grasp) * g_O.norm();
  return (1.0 + margin.force) * model.mass * (turned + off);
}

double holding_slack(const Model& model, const Vec2& p_OF, const Vec2& g_O,
                     const Margin& margin) noexcept {
  const double mass = (1.0 + margin.force) * model.mass;
  const double weight = mass * g_O.norm();
  if (weight == 0.0) return 1.0;
  const double moment = mass * std::abs(cross(model.p_OCom - p_OF, g_O)) +
                        uncertain_moment(model, p_OF, g_O, margin);
  const double c = (1.0 - margin.torque_radius) * model.c;
  return 1.0 - std::hypot(weight / model.F, moment / (model.F * c));
}

}  // namespace prehensile
