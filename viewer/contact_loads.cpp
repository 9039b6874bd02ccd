#include "viewer/contact_loads.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "mechanics/pad_law.h"
#include "mechanics/spatial_certificate.h"
#include "mechanics/spatial_model.h"
#include "primitives/prism_attitudes.h"
#include "primitives/roll.h"

namespace prehensile::viewer {
namespace {

constexpr double kTouching = 1e-6;  // [m] beyond which two bodies do not touch
constexpr double kFlush = 1e-9;     // [rad]
constexpr double kLooseTolerance = 1e-7;

Vec3 raised(const Vec2& v, double z) { return {v.x(), v.y(), z}; }

/// Soft points: each exerts its share of what balances pusher and gravity.
void add_soft_points(const Model& model, const PlanarGrasp& grasp,
                     const PlanarDrive& drive, const PlanarInstant& instant,
                     ContactLoads& loads) {
  PlanarWrench friction = -grasp.w_g;
  for (int i = 0; i < instant.pusher_count; ++i) {
    const PusherPoint& point = instant.pusher[i];
    friction -= wrench_of(drive.p_HC[i], point.normal_force * drive.n_H +
                                             point.tangential_force * drive.t_H());
  }
  for (std::size_t jaw = 0; jaw < 2; ++jaw) {
    const double side = jaw == 0 ? 1.0 : -1.0;
    const double mu = model.scene.gripper.friction[jaw];
    const double share = mu * model.jaw_force[jaw] / model.F;
    loads.pad[jaw].push_back(
        {.p = {0.0, 0.0, -side * model.half_thickness},
         .n = side * Vec3::UnitZ(),
         .force = raised(share * friction.head<2>(), side * model.jaw_force[jaw]),
         .spin = side * share * friction[2],
         .slip = raised(instant.V_HO.head<2>(), 0.0),
         .mu = mu,
         .mode = instant.V_HO.isZero() ? ContactMode::kStick : ContactMode::kSlip});
  }
}

/// Pads whose loads are those at rest: friction of both fingers together is shared out in
/// proportion to what each can bear.
void add_planar_pads(const Model& model, const PlanarGrasp& grasp,
                     const PlanarInstant& instant, ContactLoads& loads) {
  for (std::size_t jaw = 0; jaw < 2; ++jaw) {
    const double side = jaw == 0 ? 1.0 : -1.0;
    const double mu = model.scene.gripper.friction[jaw];
    const double share = mu * model.jaw_force[jaw] / model.F;
    loads.pad[jaw].reserve(static_cast<std::size_t>(instant.finger_count));
    for (int j = 0; j < instant.finger_count; ++j) {
      const Vec2 p(grasp.x[j], grasp.y[j]);
      const FingerPoint& finger = instant.finger[j];
      const double normal = model.jaw_force[jaw] * grasp.bound[j] / model.F;
      loads.pad[jaw].push_back({.p = raised(p, -side * model.half_thickness),
                                .n = side * Vec3::UnitZ(),
                                .force = raised(share * finger.force, side * normal),
                                .slip = raised(point_velocity(instant.V_HO, p), 0.0),
                                .mu = mu,
                                .mode = finger.mode});
    }
  }
}

void add_planar_pusher(const PlanarDrive& drive, const PlanarInstant& instant,
                       ContactLoads& loads) {
  for (int i = 0; i < instant.pusher_count; ++i) {
    const PusherPoint& point = instant.pusher[i];
    loads.pusher.push_back(
        {.p = raised(drive.p_HC[i], 0.0),
         .n = raised(drive.n_H, 0.0),
         .force = raised(
             point.normal_force * drive.n_H + point.tangential_force * drive.t_H(), 0.0),
         .slip = raised(point.slip_rate * drive.t_H(), 0.0),
         .mu = drive.mu,
         .mode = point.mode});
  }
}

ContactLoads solved_in_pad_plane(const Model& model, const PlanarGrasp& grasp,
                                 const PlanarDrive& drive) {
  ContactLoads loads;
  if (grasp.count == 0) return loads;
  PlanarInstant instant = solve_by_pad_law(model, grasp, drive);
  if (instant.status == InstantStatus::kOutOfIterations) {
    instant = solve_by_pad_law(model, grasp, drive, {.tolerance = kLooseTolerance});
  }
  loads.status = instant.status;
  if (!has_motion(instant.status)) return loads;
  loads.push_force = instant.push_force;
  loads.certificate = certify_by_pad_law(model, grasp, drive, instant);
  if (model.has_soft_points()) {
    add_soft_points(model, grasp, drive, instant, loads);
  } else {
    add_planar_pads(model, grasp, instant, loads);
  }
  add_planar_pusher(drive, instant, loads);
  return loads;
}

ContactLoads solved_in_space(const SpatialProblem& problem) {
  ContactLoads loads;
  if (problem.count == 0) return loads;
  const auto instant = std::make_unique<SpatialInstant>(solve_spatial(problem));
  loads.status = instant->status;
  if (!has_motion(instant->status)) return loads;
  loads.push_force = instant->push_force;
  loads.certificate = certify(problem, *instant).worst;
  for (int k = 0; k < problem.patch_count; ++k) {
    const ContactPatch& patch = problem.patch[k];
    std::vector<PointLoad>& points =
        patch.body == ContactBody::kPusher
            ? loads.pusher
            : loads.pad[patch.body == ContactBody::kJaw1 ? 0 : 1];
    for (int i = patch.first; i < patch.first + patch.count; ++i) {
      const SpatialPoint& point = instant->point[i];
      const Vec2& f = point.tangential_force;
      points.push_back(
          {.p = problem.p_HC(i),
           .n = patch.n,
           .force = point.normal_force * patch.n + f[0] * patch.t + f[1] * patch.o(),
           .spin = point.spin_moment,
           .slip = point.slip_rate[0] * patch.t + point.slip_rate[1] * patch.o(),
           .mu = patch.mu,
           .mode = point.mode});
    }
  }
  return loads;
}

/// Loads under the scene's grip become those under `share` of it.
void scale(double share, ContactLoads& loads) {
  loads.push_force *= share;
  for (auto* points : {&loads.pusher, &loads.pad[0], &loads.pad[1]}) {
    for (PointLoad& point : *points) {
      point.force *= share;
      point.spin *= share;
    }
  }
}

ContactLoads linear_loads(const Model& model, const Grasp& start, const LinearPush& push,
                          const Sample& sample, bool in_space) {
  const PushContact& contact = model.contacts[static_cast<std::size_t>(push.contact)];
  const PlanarPose X_HP = pusher_pose(push, start.X_HO, sample.s);
  const PlanarPose& X_HO = sample.grasp.X_HO;
  const PlanarPose X_PO = compose(inverse(X_HP), X_HO);
  const Touch touch = touch_of(contact, push.place, X_PO);
  if (touch.count == 0) return {};
  const PlanarDrive drive{
      .count = touch.count,
      .p_HC = {transform(X_HP, touch.p_P[0]), transform(X_HP, touch.p_P[1])},
      .n_H = rotated(X_HP.theta, touch.n_P),
      .mu = contact.mu,
      .V_HP = pusher_twist(push, start.X_HO, sample.s)};
  // The pusher stands still in the world, so gravity is constant in P.
  const Vec2 g_O = rotated(-X_PO.theta, contact.g_O);
  ContactLoads loads =
      in_space ? solved_in_space(spatial_problem_at(model, contact, drive, X_HO, g_O,
                                                    {.follow_free_pressure = true}))
               : solved_in_pad_plane(model, grasp_at(model, X_HO, g_O), drive);
  scale(contact.grip_share, loads);
  return loads;
}

/// A cross-section stands in H: u along the normal of the support, z as it is; `foot` is
/// where its origin lies.
struct SectionFrame {
  Vec3 foot = Vec3::Zero();
  Vec3 u = Vec3::UnitX();

  Vec3 direction(const Vec2& zu) const { return zu.x() * Vec3::UnitZ() + zu.y() * u; }
  Vec3 point(const Vec2& zu) const { return foot + direction(zu); }
};

/// The section at the finger axis, or at the middle of the support.
SectionFrame section_at(const PlanarPose& X_HO, const Vec2& axis_O, double along,
                        const Vec2& n_O, double z) {
  return {raised(transform(X_HO, along * axis_O), z),
          raised(rotated(X_HO.theta, n_O), 0.0)};
}

ContactLoads cylinder_loads(const Model& model, const Roll& roll, const Sample& sample) {
  ContactLoads loads;
  const PushContact& contact = model.contacts[static_cast<std::size_t>(roll.contact)];
  CrossSectionModel gripped = *model.cross_section;
  if (roll.grip_force > 0.0) gripped.grip_force = roll.grip_force;
  const double weight = -contact.n.dot(model.mass * contact.g_O);
  const CrossSectionDrive drive{contact.mu, roll.travel, weight};
  const CrossSectionInstant instant = solve_cross_section(gripped, drive);
  loads.status = instant.status;
  if (!has_motion(instant.status)) return loads;
  loads.push_force = instant.push_force;
  loads.certificate = cross_section_residual(gripped, drive, instant);
  const double r = gripped.radius;
  loads.jaw_z = {-r, r};
  const std::array<Vec2, 3> at{Vec2(-r, 0.0), Vec2(r, 0.0), Vec2(0.0, -r)};
  const std::array<Vec2, 3> n{Vec2(1.0, 0.0), Vec2(-1.0, 0.0), Vec2(0.0, 1.0)};
  const std::array<Vec2, 3> t{Vec2(0.0, 1.0), Vec2(0.0, 1.0), Vec2(1.0, 0.0)};
  const PlanarPose& X_HO = sample.grasp.X_HO;
  const double finger = contact.t.dot(finger_in_object(X_HO));
  const double support = contact.t.dot(0.5 * (contact.a + contact.b));
  for (std::size_t i = 0; i < 3; ++i) {
    const bool is_jaw = i != kSheet;
    const SectionFrame section =
        section_at(X_HO, contact.t, is_jaw ? finger : support, contact.n, 0.0);
    Vec2 rate(instant.v_z - instant.roll_rate * at[i].y(),
              instant.v_u + instant.roll_rate * at[i].x());
    if (!is_jaw) rate.x() -= roll.travel;
    const PointLoad load{.p = section.point(at[i]),
                         .n = section.direction(n[i]),
                         .force = section.direction(instant.normal_force[i] * n[i] +
                                                    instant.tangential_force[i] * t[i]),
                         .slip = section.direction(rate.dot(t[i]) * t[i]),
                         .mu = is_jaw ? gripped.friction[i] : contact.mu,
                         .mode = instant.mode[i]};
    (is_jaw ? loads.pad[i] : loads.pusher).push_back(load);
  }
  return loads;
}

/// Height of O in H by what the jaws hold on to: their middle, or the one that stands
/// still.
double height_between(const std::array<double, 2>& jaw_z, JawMode mode, double half) {
  if (mode == JawMode::kFixedJaw1) return -half - jaw_z[0];
  if (mode == JawMode::kFixedJaw2) return half - jaw_z[1];
  return -0.5 * (jaw_z[0] + jaw_z[1]);
}

ContactLoads prism_loads(const Model& model, const Grasp& start, const Roll& roll,
                         const Sample& sample) {
  ContactLoads loads;
  const PushContact& contact = model.contacts[static_cast<std::size_t>(roll.contact)];
  const PrismRoll rolling(model, start, roll);
  const double sign = contact.t.dot(model.prism->axis) > 0.0 ? 1.0 : -1.0;
  const PrismLook look = rolling.look(sign * sample.grasp.psi);
  const PrismContacts begin = rolling.contacts(rolling.first());
  loads.status = look.instant.status;
  if (!look.contacts.held() || !begin.held()) return loads;
  const double half = 0.5 * (begin.jaw_z[kJaw2] - begin.jaw_z[kJaw1]);
  loads.z_HO = height_between(look.contacts.jaw_z, model.scene.gripper.jaw_mode, half);
  loads.jaw_z = {look.contacts.jaw_z[kJaw1] + loads.z_HO,
                 look.contacts.jaw_z[kJaw2] + loads.z_HO};
  if (!has_motion(look.instant.status)) return loads;
  loads.push_force = look.instant.push_force;
  loads.certificate = look.certificate;
  const PlanarPose& X_HO = sample.grasp.X_HO;
  const double finger = contact.t.dot(finger_in_object(X_HO));
  const double support = contact.t.dot(0.5 * (contact.a + contact.b));
  const SectionForces& forces = look.instant.forces;
  for (std::size_t i = 0; i < 3; ++i) {
    const bool is_jaw = i != kSheet;
    const SectionFrame section =
        section_at(X_HO, contact.t, is_jaw ? finger : support, contact.n, loads.z_HO);
    const Vec2& n = forces.direction[i];
    const Vec2 t = i == kJaw1 ? perp(n) : Vec2(-perp(n));
    const CrossSectionMotion& motion = look.instant.motion;
    Vec2 rate(motion.v_z - motion.roll_rate * forces.point[i].y(),
              motion.v_u + motion.roll_rate * forces.point[i].x());
    if (!is_jaw) rate.x() -= roll.travel;
    const PointLoad load{
        .p = section.point(forces.point[i]),
        .n = section.direction(n),
        .force = section.direction(forces.normal[i] * n + forces.tangential[i] * t),
        .slip = section.direction(rate.dot(t) * t),
        .mu = is_jaw ? model.scene.gripper.friction[i] : contact.mu,
        .mode = look.instant.mode[i]};
    (is_jaw ? loads.pad[i] : loads.pusher).push_back(load);
  }
  return loads;
}

}  // namespace

Touch touch_of(const PushContact& contact, double place, const PlanarPose& X_PO) {
  const Vec2 centre = 0.5 * (contact.a + contact.b);
  const double half_face = 0.5 * (contact.b - contact.a).norm();
  const Vec2 n_face = rotated(X_PO.theta, contact.n);
  const Vec2 t_face = perp(n_face);
  const Vec2 face = transform(X_PO, centre);
  Touch touch;
  if (contact.is_point) {
    const Vec2 point = centre + place * contact.t;
    touch = {1, {point, point}, n_face, n_face.dot(face - point)};
  } else if (std::abs(X_PO.theta) <= kFlush) {
    const double offset = contact.t.dot(face - centre);
    const double low = std::max(offset - half_face, place - contact.half_length);
    const double high = std::min(offset + half_face, place + contact.half_length);
    touch = {low <= high ? 2 : 0,
             {centre + low * contact.t, centre + high * contact.t},
             contact.n,
             contact.n.dot(face - centre)};
  } else {
    // One end touches: of the face on the pusher's line, or of the pusher on the face.
    for (const double end : {-half_face, half_face}) {
      const Vec2 p = face + end * t_face;
      const double gap = contact.n.dot(p - centre);
      const bool faces =
          std::abs(contact.t.dot(p - centre) - place) <= contact.half_length + kTouching;
      if (faces && !(std::abs(gap) >= std::abs(touch.gap))) {
        touch = {1, {p, p}, contact.n, gap};
      }
    }
    for (const double end : {-contact.half_length, contact.half_length}) {
      if (!std::isfinite(end)) continue;
      const Vec2 p = centre + (place + end) * contact.t;
      const double gap = n_face.dot(face - p);
      const bool faces = std::abs(t_face.dot(p - face)) <= half_face + kTouching;
      if (faces && !(std::abs(gap) >= std::abs(touch.gap))) {
        touch = {1, {p, p}, n_face, gap};
      }
    }
  }
  if (!(std::abs(touch.gap) <= kTouching)) touch.count = 0;
  return touch;
}

ContactLoads loads_at(const Model& model, const Grasp& start, const Push& push,
                      const Sample& sample, bool in_space) {
  ContactLoads loads;
  if (const auto* roll = std::get_if<Roll>(&push)) {
    if (model.prism) loads = prism_loads(model, start, *roll, sample);
    if (model.cross_section) loads = cylinder_loads(model, *roll, sample);
  } else {
    loads = linear_loads(model, start, as_linear(push), sample, in_space);
  }
  if (std::isnan(loads.jaw_z[0])) {
    loads.jaw_z = {-model.half_thickness, model.half_thickness};
  }
  return loads;
}

}  // namespace prehensile::viewer
