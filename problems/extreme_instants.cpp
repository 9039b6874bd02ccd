#include "problems/extreme_instants.h"

#include <cmath>
#include <sstream>

namespace prehensile {
namespace {

constexpr double kGravity = 9.81;
constexpr double kDenormal = 1e-310;

std::string number(double x) {
  std::ostringstream text;
  text << x;
  return text.str();
}

void scale_pads(RandomInstant& q, double factor) {
  for (int j = 0; j < q.grasp.count; ++j) {
    q.grasp.x[j] *= factor;
    q.grasp.y[j] *= factor;
  }
}

void scale_bounds(RandomInstant& q, double factor) {
  for (int j = 0; j < q.grasp.count; ++j) q.grasp.bound[j] *= factor;
}

/// Friction 0.5 of both fingers.
void set_grip(RandomInstant& q, double grip_force) {
  scale_bounds(q, grip_force / q.grasp.capacity());
}

void set_mass(RandomInstant& q, double mass) {
  const double factor = mass * kGravity / q.grasp.w_g.head<2>().norm();
  q.grasp.w_g *= factor;
  q.grasp.inertia *= factor;
}

void scale_size(RandomInstant& q, double factor) {
  scale_pads(q, factor);
  for (Vec2& p : q.drive.p_HC) p *= factor;
  q.grasp.w_g[2] *= factor;
  q.drive.V_HP[2] /= factor;
}

Vec2 centre_of(const PlanarGrasp& grasp) {
  Vec2 centre = Vec2::Zero();
  for (int j = 0; j < grasp.count; ++j) {
    centre += grasp.bound[j] * Vec2(grasp.x[j], grasp.y[j]);
  }
  return centre / grasp.capacity();
}

/// A push along the normal, past the centre of the pads at an offset; no gravity.
void push_straight(RandomInstant& q, double offset) {
  const Vec2 centre = -0.03 * q.drive.n_H + offset * q.drive.t_H();
  const double half = q.drive.count == 2 ? 0.01 : 0.0;
  q.drive.p_HC = {centre - half * q.drive.t_H(), centre + half * q.drive.t_H()};
  q.drive.V_HP << 0.01 * q.drive.n_H, 0.0;
  q.grasp.w_g.setZero();
}

/// A wall pushes straight, and the weight acts along it at the centre of the pads, as a
/// share of what friction at the wall holds: it sticks up to a share of 1.
void push_straight_under_weight(RandomInstant& q, double share) {
  push_straight(q, 0.0);
  const Vec2 centre = centre_of(q.grasp);
  q.drive.count = 2;
  const Vec2 foot = centre - 0.03 * q.drive.n_H;
  q.drive.p_HC = {foot - 0.1 * q.drive.t_H(), foot + 0.1 * q.drive.t_H()};
  const Vec2 weight = -share * q.drive.mu * q.grasp.capacity() * q.drive.t_H();
  q.grasp.w_g << weight, cross(centre, weight);
}

/// The same wall without friction; the pads hold a weight up to a share of 1.
void hold_weight(RandomInstant& q, double share) {
  push_straight_under_weight(q, 0.0);
  q.drive.mu = 0.0;
  const Vec2 weight = -share * q.grasp.capacity() * q.drive.t_H();
  q.grasp.w_g << weight, cross(centre_of(q.grasp), weight);
}

class List {
 public:
  PlanarExtreme& add(const char* group, std::string name,
                     std::function<void(RandomInstant&)> apply) {
    all_.push_back({group, std::move(name), std::move(apply)});
    return all_.back();
  }
  std::vector<PlanarExtreme> take() { return std::move(all_); }

 private:
  std::vector<PlanarExtreme> all_;
};

void add_parameters(List& list) {
  for (const double mu : {0.0, 1e-6, 10.0, 1e3, 1e6}) {
    list.add("friction", "pusher friction " + number(mu),
             [=](auto& q) { q.drive.mu = mu; });
  }
  for (const double mass : {0.0, 1e-6, 1e-3, 10.0, 1e3}) {
    list.add("mass", "mass " + number(mass) + " kg", [=](auto& q) { set_mass(q, mass); });
  }
  for (const double factor : {1e6, 1e12}) {
    list.add("mass", "weight x " + number(factor),
             [=](auto& q) { q.grasp.w_g *= factor; });
  }
  for (const double force : {0.0, 1e-6, 1e-3, 1e3, 1e6}) {
    list.add("grip", "grip " + number(force) + " N",
             [=](auto& q) { set_grip(q, force); });
  }
  for (const double factor : {1e-12, 1e-6, 1e6}) {
    list.add("grip", "grip x " + number(factor),
             [=](auto& q) { scale_bounds(q, factor); });
  }
  for (const double factor : {1e-3, 0.1, 10.0}) {
    list.add("size", "size x " + number(factor), [=](auto& q) { scale_size(q, factor); });
  }
  for (const double rate : {1e-9, 1e-6, 1e-3, 1.0, 1e3}) {
    list.add("acceleration", "acceleration " + number(rate) + " m/s^2", [](auto&) {})
        .range.inertia = rate;
  }
  for (const double factor : {1e-9, 1e9}) {
    list.add("rate", "rate x " + number(factor),
             [=](auto& q) { q.drive.V_HP *= factor; });
  }
}

void add_shapes(List& list) {
  for (const double factor : {1e-9, 1e-6, 1e-4, 1e-2}) {
    list.add("patch", "pads x " + number(factor),
             [=](auto& q) { scale_pads(q, factor); });
    list.add("patch", "pads without weight x " + number(factor), [=](auto& q) {
      scale_pads(q, factor);
      q.grasp.w_g.setZero();
    });
  }
  for (const double length : {0.0, 1e-9}) {
    list.add("duplicate", "line of length " + number(length), [=](auto& q) {
      q.drive.p_HC[1] = q.drive.p_HC[0] + length * q.drive.t_H();
    });
  }
  for (const double apart : {0.0, 1e-12, 1e-9}) {
    list.add("duplicate", "pad points in pairs " + number(apart) + " m apart",
             [=](auto& q) {
               for (int j = 1; j < q.grasp.count; j += 2) {
                 q.grasp.x[j] = q.grasp.x[j - 1] + apart;
                 q.grasp.y[j] = q.grasp.y[j - 1];
               }
             });
  }
  list.add("far", "far from the origin", [](auto& q) {
    const Vec2 d(1e3, -2e3);
    for (int j = 0; j < q.grasp.count; ++j) {
      q.grasp.x[j] += d.x();
      q.grasp.y[j] += d.y();
    }
    for (Vec2& p : q.drive.p_HC) p += d;
    q.grasp.w_g[2] += cross(d, Vec2(q.grasp.w_g.template head<2>()));
    const Vec2 carried = q.drive.V_HP[2] * perp(d);
    q.drive.V_HP.template head<2>() -= carried;
  });
}

void add_motions(List& list) {
  for (const double approach : {0.0, 1e-9, -1e-9, -1e-3}) {
    list.add("grazing", "along the face, approaching at " + number(approach),
             [=](auto& q) {
               const Vec2 v = 0.01 * q.drive.t_H() + approach * q.drive.n_H;
               q.drive.V_HP << v, 0.0;
             });
  }
  list.add("grazing", "receding", [](auto& q) { q.drive.V_HP = -q.drive.V_HP; });
  for (const double offset : {0.0, 1e-12, 1e-9, 1e-6, 1e-3}) {
    list.add("straight", "straight, off centre by " + number(offset),
             [=](auto& q) { push_straight(q, offset); });
  }
  list.add("pivot", "turn about a pad point", [](auto& q) {
    const int j = q.grasp.count / 2;
    q.drive.V_HP = 0.5 * PlanarTwist(q.grasp.y[j], -q.grasp.x[j], 1.0);
  });
  list.add("pivot", "turn beside the contact", [](auto& q) {
    const Vec2 p = q.drive.p_HC[0] + 1e-4 * q.drive.t_H();
    q.drive.V_HP = 0.5 * PlanarTwist(p.y(), -p.x(), 1.0);
  });
}

void add_thresholds(List& list) {
  for (const double margin : {-1e-3, -1e-6, 1e-6, 1e-3}) {
    const auto mode = margin < 0.0 ? ContactMode::kStick : ContactMode::kSlipMinus;
    list.add("threshold", "wall sticks up to 1, at 1 + " + number(margin),
             [=](auto& q) { push_straight_under_weight(q, 1.0 + margin); })
        .expected = [=](const PlanarInstant& answer) {
      return answer.status == InstantStatus::kMoves && answer.pusher[0].mode == mode;
    };
    list.add("threshold", "pads hold up to 1, at 1 + " + number(margin),
             [=](auto& q) { hold_weight(q, 1.0 + margin); })
        .expected = [=](const PlanarInstant& answer) {
      return (answer.status == InstantStatus::kMoves) == (margin < 0.0);
    };
  }
}

void add_denormals(List& list) {
  list.add("denormal", "denormal weight", [](auto& q) { q.grasp.w_g *= kDenormal; });
  list.add("denormal", "denormal pusher friction",
           [](auto& q) { q.drive.mu = kDenormal; });
  list.add("denormal", "denormal grip", [](auto& q) { scale_bounds(q, kDenormal); });
  list.add("denormal", "denormal rate", [](auto& q) { q.drive.V_HP *= kDenormal; });
  list.add("denormal", "denormal pads", [](auto& q) { scale_pads(q, kDenormal); });
  list.add("denormal", "denormal turn", [](auto& q) { q.drive.V_HP[2] = kDenormal; });
}

}  // namespace

std::vector<PlanarExtreme> planar_extremes() {
  List list;
  add_parameters(list);
  add_shapes(list);
  add_motions(list);
  add_thresholds(list);
  add_denormals(list);
  return list.take();
}

RandomInstant extreme_instant(const PlanarExtreme& extreme, std::uint64_t seed,
                              std::uint64_t index, int points_per_pad) {
  InstantRange range = extreme.range;
  range.points_per_pad = points_per_pad;
  RandomInstant instant = random_instant(seed, index, range);
  extreme.apply(instant);
  return instant;
}

}  // namespace prehensile
