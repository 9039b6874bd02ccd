#include "planner/arm/push_load.h"

#include <Eigen/Geometry>

#include "mechanics/sticking.h"

namespace prehensile {
namespace {

Vec3 raised(const Vec2& p, double z) { return {p.x(), p.y(), z}; }

/// From the origin of O, in directions of O at roll 0.
Vec3 centre_of_mass(const Model& model, double psi) {
  const Vec3 p = raised(model.p_OCom, model.z_OCom);
  if (!model.prism) return p;
  return Eigen::AngleAxisd(psi, raised(model.prism->axis, 0.0)) * p;
}

}  // namespace

HeldLoad load_at_rest(const Model& model, const PlanarPose& X_HO) {
  return {.p_HCom = raised(transform(X_HO, model.p_OCom), model.z_OCom)};
}

PushLoads::PushLoads(const Model& model, const PlannedPush& planned, double z_WH)
    : model_(model), planned_(planned), z_WH_(z_WH) {
  if (const auto* roll = std::get_if<Roll>(&planned.push)) {
    rolling_ = roll_loads(model, planned.start, *roll);
  }
}

HeldLoad PushLoads::at(double s) const {
  return rolling_.empty() ? of_push(s) : of_roll(s);
}

const PushContact& PushLoads::contact() const {
  return model_.contacts[static_cast<std::size_t>(contact_of(planned_.push))];
}

HeldLoad PushLoads::of_push(double s) const {
  const LinearPush push = as_linear(planned_.push);
  const PushContact& touched = contact();
  const PlanarPose X_HO = pusher_pose(push, planned_.start.X_HO, s);
  const StickTest test = exact_stick_test(model_, touched, push.place, X_HO, push.e,
                                          push.travel, push.turn, Margin::none());
  const Vec2 f_O = test.normal_force * touched.n + test.tangential_force * touched.t;
  const Vec2 p_OP = 0.5 * (touched.a + touched.b) + test.centre_of_pressure * touched.t;
  HeldLoad load = load_at_rest(model_, X_HO);
  load.p_HP =
      raised(transform(X_HO, p_OP), 0.5 * (touched.z_low + touched.z_high) - z_WH_);
  load.f_H = raised(rotated(X_HO.theta, f_O), 0.0);
  return load;
}

/// The support stays where it touched the object first.
HeldLoad PushLoads::of_roll(double s) const {
  const PushContact& touched = contact();
  const PlanarPose& X_HO_start = planned_.start.X_HO;
  const RollLoad rolling = roll_load_at(rolling_, s);
  const Vec3 com = centre_of_mass(model_, rolling.grasp.psi);
  const Vec2 n_H = rotated(X_HO_start.theta, touched.n);
  const Vec2 t_H = rotated(X_HO_start.theta, touched.t);
  const double height = n_H.dot(transform(X_HO_start, touched.a));
  return {.p_HCom = raised(transform(rolling.grasp.X_HO, Vec2(com.head<2>())),
                           rolling.z_HO + com.z()),
          .p_HP = raised(height * n_H + rolling.along * t_H, rolling.z_foot),
          .f_H = raised(rolling.normal_force * n_H, rolling.tangential_force)};
}

}  // namespace prehensile
