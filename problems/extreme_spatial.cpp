#include "problems/extreme_spatial.h"

#include <cmath>
#include <numbers>
#include <sstream>

namespace prehensile {
namespace {

constexpr double kGravity = 9.81;
constexpr double kDenormal = 1e-310;
constexpr double kRate = 0.01;  ///< [m/s] of pushes set here

std::string number(double x) {
  std::ostringstream text;
  text << x;
  return text.str();
}

void set_mu(SpatialProblem& q, bool pads, double mu) {
  for (int k = 0; k < q.patch_count; ++k) {
    if ((q.patch[k].body != ContactBody::kPusher) == pads) q.patch[k].mu = mu;
  }
}

void scale_grip(SpatialProblem& q, double factor) {
  q.grip_force *= factor;
  for (int i = 0; i < q.count; ++i) q.preload[i] *= factor;
  for (int k = 0; k < q.patch_count; ++k) {
    q.patch[k].compliance /= std::max(factor, 1e-6);
  }
}

void scale_points(SpatialProblem& q, bool pads_only, double factor) {
  for (int k = 0; k < q.patch_count; ++k) {
    const ContactPatch& patch = q.patch[k];
    if (pads_only && patch.body == ContactBody::kPusher) continue;
    for (int i = patch.first; i < patch.first + patch.count; ++i) {
      q.x[i] *= factor;
      q.y[i] *= factor;
      if (!pads_only) q.z[i] *= factor;
    }
  }
}

void scale_size(SpatialProblem& q, double factor) {
  scale_points(q, false, factor);
  q.w_g.tail<3>() *= factor;
}

void scale_rate(SpatialProblem& q, double factor) {
  q.V_HP *= factor;
  for (int k = 0; k < q.patch_count; ++k) q.patch[k].compliance *= factor;
}

/// Turns the second half of the pusher's push so that its normal all but equals a pad's.
void tilt_pusher(SpatialProblem& q, double angle) {
  ContactPatch& patch = q.patch[2];
  const Vec3 n = patch.n;
  patch.n = std::sin(angle) * n + std::cos(angle) * Vec3::UnitZ();
  patch.t = patch.n.cross(n).normalized();
  for (int i = patch.first + 1; i < patch.first + patch.count; ++i) {
    const Vec3 p = q.p_HC(i) - patch.n.dot(q.p_HC(i) - q.p_HC(patch.first)) * patch.n;
    q.x[i] = p.x();
    q.y[i] = p.y();
    q.z[i] = p.z();
  }
}

void set_grip(SpatialProblem& q, double grip_force) {
  scale_grip(q, grip_force / q.grip_force);
}

void set_mass(SpatialProblem& q, double mass) {
  const double factor = mass * kGravity / q.w_g.head<3>().norm();
  q.w_g *= factor;
  q.inertia *= factor;
}

/// The pusher drives the object against the fixed jaw, seen from which it lies at an
/// angle to the jaw's normal. The object jams if both friction cones contain the line
/// between them: frictions of `margin` times what that takes.
void wedge(SpatialProblem& q, double degrees, double margin_pads, double margin_pusher) {
  const double alpha = degrees * std::numbers::pi / 180.0;
  scale_points(q, true, 0.1);
  q.jaw_mode = JawMode::kFixedJaw1;
  q.w_g.setZero();
  const Vec3 jaw(0.0, 0.0, q.z[0]);
  const Vec3 towards(-std::sin(alpha), 0.0, std::cos(alpha));
  ContactPatch& pusher = q.patch[2];
  pusher.n = Vec3::UnitX();
  pusher.t = Vec3::UnitY();
  pusher.count = 1;
  pusher.pressure = PressureLaw::kFree;
  q.count = pusher.first + 1;
  const Vec3 p = jaw + 0.03 * towards;
  q.x[pusher.first] = p.x();
  q.y[pusher.first] = p.y();
  q.z[pusher.first] = p.z();
  q.V_HP << -kRate * towards, Vec3::Zero();
  // Stiff pads: soft ones yield by as much as the pusher asks for.
  for (int k = 0; k < 2; ++k) q.patch[k].compliance *= 1e-2;
  set_mu(q, true, margin_pads * std::tan(alpha));
  set_mu(q, false, margin_pusher / std::tan(alpha));
}

/// A line in the mid-plane pushes straight, and the weight acts along it at the centre of
/// the pads, as a share of what friction at the line holds: it sticks up to a share of 1.
void push_straight_under_weight(SpatialProblem& q, double share) {
  ContactPatch& pusher = q.patch[2];
  const Vec3 n = pusher.n;
  const Vec3 t = pusher.t;
  pusher.count = 2;
  pusher.pressure = PressureLaw::kFree;
  q.count = pusher.first + 2;
  int i = pusher.first;
  for (const double end : {-0.1, 0.1}) {
    const Vec3 p = -0.03 * n + end * t;
    q.x[i] = p.x();
    q.y[i] = p.y();
    q.z[i] = 0.0;
    q.preload[i++] = 0.0;
  }
  q.V_HP << kRate * n, Vec3::Zero();
  const double capacity = 2.0 * q.patch[0].mu * q.grip_force;
  q.w_g << -share * pusher.mu * capacity * t, Vec3::Zero();
}

class List {
 public:
  SpatialExtreme& add(const char* group, std::string name,
                      std::function<void(SpatialProblem&)> apply, double allowed = 0.01) {
    all_.push_back({group, std::move(name), std::move(apply), allowed});
    return all_.back();
  }
  SpatialExtreme& last() { return all_.back(); }
  std::vector<SpatialExtreme> take() { return std::move(all_); }

 private:
  std::vector<SpatialExtreme> all_;
};

void add_parameters(List& list) {
  for (const double mu : {0.0, 1e-6, 10.0, 1e3}) {
    list.add(
        "friction", "pusher friction " + number(mu),
        [=](auto& q) { set_mu(q, false, mu); }, 0.04);
  }
  for (const double mu : {0.0, 1e-6, 3.0, 10.0, 100.0, 1e3}) {
    const auto all_mu = [=](auto& q) {
      set_mu(q, true, mu);
      set_mu(q, false, mu);
    };
    list.add("friction", "all friction " + number(mu), all_mu, mu > 1.0 ? 0.1 : 0.01);
  }
  for (const double factor : {0.0, 1e-6, 1e-3, 1e3}) {
    list.add("mass", "weight x " + number(factor), [=](auto& q) { q.w_g *= factor; });
  }
  for (const double mass : {1e-6, 1e-3, 10.0, 1e3}) {
    list.add(
        "mass", "mass " + number(mass) + " kg", [=](auto& q) { set_mass(q, mass); },
        0.02);
  }
  for (const double factor : {0.0, 1e-6, 1e6}) {
    list.add("grip", "grip x " + number(factor), [=](auto& q) { scale_grip(q, factor); });
  }
  for (const double force : {1e-3, 1e3, 1e6}) {
    list.add("grip", "grip " + number(force) + " N",
             [=](auto& q) { set_grip(q, force); });
  }
  for (const double factor : {1e-3, 10.0}) {
    list.add("size", "size x " + number(factor), [=](auto& q) { scale_size(q, factor); });
  }
  for (const double rate : {1e-9, 1e-6, 1e-3, 1.0, 1e3}) {
    list.add(
            "acceleration", "acceleration " + number(rate) + " m/s^2", [](auto&) {}, 0.03)
        .acceleration = rate;
  }
  for (const double factor : {1e-9, 1e9}) {
    list.add("rate", "rate x " + number(factor), [=](auto& q) { scale_rate(q, factor); });
  }
}

void add_shapes(List& list) {
  for (const double factor : {1e-6, 1e-4, 1e-2}) {
    list.add(
        "patch", "pads x " + number(factor),
        [=](auto& q) { scale_points(q, true, factor); }, 0.12);
  }
  for (const double angle : {1e-3, 1e-6, 1e-9}) {
    list.add(
        "parallel", "pusher normal parallel to the grip within " + number(angle),
        [=](auto& q) { tilt_pusher(q, angle); }, 0.06);
  }
  list.add("duplicate", "pad points doubled", [](auto& q) {
    for (int k = 0; k < 2; ++k) {
      const ContactPatch& patch = q.patch[k];
      for (int i = 1; i < patch.count; i += 2) {
        q.x[patch.first + i] = q.x[patch.first + i - 1];
        q.y[patch.first + i] = q.y[patch.first + i - 1];
      }
    }
  });
  list.add("far", "far from the origin", [](auto& q) {
    for (int i = 0; i < q.count; ++i) {
      q.x[i] += 100.0;
      q.y[i] -= 200.0;
    }
    const Vec3 p(100.0, -200.0, 0.0);
    q.w_g.template tail<3>() += p.cross(Vec3(q.w_g.template head<3>()));
    // The same body: its inertia about the origin of H is another one now.
    Eigen::Matrix3d across;
    across << 0.0, -p.z(), p.y(), p.z(), 0.0, -p.x(), -p.y(), p.x(), 0.0;
    Eigen::Matrix<double, 6, 6> shift = Eigen::Matrix<double, 6, 6>::Identity();
    shift.topRightCorner<3, 3>() = -across;
    q.inertia = Eigen::Matrix<double, 6, 6>(shift.transpose() * q.inertia * shift);
  });
}

void add_motions(List& list) {
  for (const double approach : {0.0, 1e-9, -1e-9}) {
    list.add("grazing", "along the face, approaching at " + number(approach),
             [=](auto& q) {
               q.V_HP.template head<3>() = kRate * q.patch[2].t + approach * q.patch[2].n;
             });
  }
  list.add("grazing", "receding", [](auto& q) { q.V_HP = -q.V_HP; });
  list.add("turn", "turning pusher",
           [](auto& q) { q.V_HP.template tail<3>() = Vec3(0.3, -0.2, 0.5); });
}

void add_thresholds(List& list) {
  for (const double margin_pads : {0.6, 1.4}) {
    for (const double margin_pusher : {0.6, 1.4}) {
      const bool jams = margin_pads > 1.0 && margin_pusher > 1.0;
      list.add(
              "wedge",
              "wedge of margins " + number(margin_pads) + " " + number(margin_pusher),
              [=](auto& q) { wedge(q, 45.0, margin_pads, margin_pusher); },
              jams ? 0.2 : 0.05)
          .acceleration = 0.0;
      // Forces that balance each other do not rule out that the object swings aside.
      if (jams) continue;
      list.last().expected = [](const SpatialInstant& answer) {
        return answer.status != InstantStatus::kJammed;
      };
    }
  }
  for (const double margin : {-1e-3, -1e-6, 1e-6, 1e-3}) {
    list.add(
            "threshold", "wedges up to 1, at 1 + " + number(margin),
            [=](auto& q) { wedge(q, 45.0, 1.0 + margin, 1.0 + margin); }, 1.0)
        .acceleration = 0.0;
    list.add(
            "threshold", "line sticks up to 1, at 1 + " + number(margin),
            [=](auto& q) { push_straight_under_weight(q, 1.0 + margin); }, 0.05)
        .acceleration = 0.0;
    list.last().expected = [=](const SpatialInstant& answer) {
      // The share of a sticking line's ends is open, so judge by the motion.
      const double slip = answer.point[answer.count - 1].slip_rate.norm() / kRate;
      return answer.status == InstantStatus::kMoves && (slip < 3e-8) == (margin < 0.0);
    };
  }
}

void add_denormals(List& list) {
  list.add("denormal", "denormal weight", [](auto& q) { q.w_g *= kDenormal; });
  list.add("denormal", "denormal pusher friction",
           [](auto& q) { set_mu(q, false, kDenormal); });
  list.add(
      "denormal", "denormal rate", [](auto& q) { q.V_HP *= kDenormal; }, 1.0);
  list.add(
      "denormal", "denormal pads", [](auto& q) { scale_points(q, true, kDenormal); },
      0.12);
  list.add("denormal", "denormal turn",
           [](auto& q) { q.V_HP.template tail<3>().setConstant(kDenormal); });
}

}  // namespace

std::vector<SpatialExtreme> spatial_extremes() {
  List list;
  add_parameters(list);
  add_shapes(list);
  add_motions(list);
  add_thresholds(list);
  add_denormals(list);
  return list.take();
}

SpatialProblem extreme_spatial(const SpatialExtreme& extreme, std::uint64_t seed,
                               std::uint64_t index, int points_per_pad,
                               double acceleration) {
  SpatialProblem problem =
      random_spatial(seed, index,
                     {.points_per_pad = points_per_pad,
                      .acceleration = extreme.acceleration >= 0.0 ? extreme.acceleration
                                                                  : acceleration});
  extreme.apply(problem);
  return problem;
}

}  // namespace prehensile
