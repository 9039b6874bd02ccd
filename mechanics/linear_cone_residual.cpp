/// The polyhedral laws read from the problem, point by point, for judging answers.
#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "mechanics/linear_cone.h"

namespace prehensile {
namespace {

/// What is left of eq. (8) about the centre, and of the drive of each jaw.
struct Balance {
  Vec3 force;
  Vec3 moment;
  std::array<double, 2> drive{0.0, 0.0};
};

Vec3 velocity_at(const SpatialTwist& V, const Vec3& p) {
  return V.head<3>() + V.tail<3>().cross(p);
}

Balance without_contacts(const SpatialProblem& q, const JawFreedoms& jaws,
                         const LinearConeForces& answer, const Vec3& centre) {
  const SpatialWrench w = q.w_g - q.inertia * answer.V_HO;
  Balance balance{w.head<3>(), w.tail<3>() - centre.cross(w.head<3>())};
  const double rate1 =
      jaws.jaw1[0] * answer.jaw_rate[0] + jaws.jaw1[1] * answer.jaw_rate[1];
  const double rate2 =
      jaws.jaw2[0] * answer.jaw_rate[0] + jaws.jaw2[1] * answer.jaw_rate[1];
  for (int i = 0; i < jaws.count; ++i) {
    balance.drive[i] =
        jaws.effort[i] - q.jaw_mass * (jaws.jaw1[i] * rate1 + jaws.jaw2[i] * rate2);
  }
  return balance;
}

class Judge {
 public:
  Judge(const SpatialProblem& q, const LinearCone& units, const LinearConeForces& answer)
      : q_(q),
        units_(units),
        answer_(answer),
        jaws_(jaw_freedoms(q)),
        balance_(without_contacts(q, jaws_, answer, units.centre)) {}

  void point(const ContactPatch& patch, const Eigen::Matrix3Xd& d, int i);
  double worst() const;

 private:
  void note(double missed) {
    worst_ = std::isfinite(missed) ? std::max(worst_, std::abs(missed))
                                   : std::numeric_limits<double>::infinity();
  }
  void normal_law(const ContactPatch& patch, int i, double rate);
  void friction_law(const ContactPatch& patch, const Eigen::Matrix3Xd& d,
                    const LinearConePoint& point, const Vec3& slip);

  const SpatialProblem& q_;
  const LinearCone& units_;
  const LinearConeForces& answer_;
  JawFreedoms jaws_;
  Balance balance_;
  double worst_ = 0.0;
};

void Judge::normal_law(const ContactPatch& patch, int i, double rate) {
  const double force = answer_.point[i].normal_force;
  double slack = rate;
  if (patch.pressure == PressureLaw::kGiven) {
    note((force - q_.preload[i]) / units_.force);
    return;
  }
  if (patch.pressure == PressureLaw::kFoundation) {
    slack += patch.compliance * (force - q_.preload[i]);
  }
  note(std::min(force / units_.force, slack / units_.rate));
}

void Judge::friction_law(const ContactPatch& patch, const Eigen::Matrix3Xd& d,
                         const LinearConePoint& point, const Vec3& slip) {
  if (!(patch.mu > 0.0)) return;
  double xi = 0.0;
  double sum = 0.0;
  for (Eigen::Index k = 0; k < d.cols(); ++k) {
    xi = std::max(xi, -d.col(k).dot(slip));
    sum += point.beta[k];
  }
  note(std::min(xi / units_.rate, (patch.mu * point.normal_force - sum) / units_.force));
  for (Eigen::Index k = 0; k < d.cols(); ++k) {
    note(std::min(point.beta[k] / units_.force, (xi + d.col(k).dot(slip)) / units_.rate));
  }
}

void Judge::point(const ContactPatch& patch, const Eigen::Matrix3Xd& d, int i) {
  const LinearConePoint& point = answer_.point[i];
  const Vec3 p = q_.p_HC(i);
  const bool pusher = patch.body == ContactBody::kPusher;
  const SpatialTwist relative =
      pusher ? SpatialTwist(answer_.V_HO - q_.V_HP) : answer_.V_HO;
  const Vec3 c = velocity_at(relative, p);
  double normal_rate = patch.n.dot(c);
  const auto& jaw = patch.body == ContactBody::kJaw1 ? jaws_.jaw1 : jaws_.jaw2;
  for (int k = 0; k < jaws_.count && !pusher; ++k) {
    normal_rate -= jaw[k] * answer_.jaw_rate[k];
    balance_.drive[k] -= jaw[k] * point.normal_force;
  }
  normal_law(patch, i, normal_rate);
  friction_law(patch, d, point,
               {patch.t.dot(c), patch.o().dot(c),
                patch.spin_radius * patch.n.dot(relative.tail<3>())});

  Vec3 f = point.normal_force * patch.n;
  Vec3 spin = Vec3::Zero();
  for (std::size_t k = 0; k < point.beta.size(); ++k) {
    const Vec3 e = d.col(static_cast<Eigen::Index>(k));
    f += point.beta[k] * (e.x() * patch.t + e.y() * patch.o());
    spin += point.beta[k] * e.z() * patch.spin_radius * patch.n;
  }
  balance_.force += f;
  balance_.moment += (p - units_.centre).cross(f) + spin;
}

double Judge::worst() const {
  Judge sum = *this;
  for (int k = 0; k < 3; ++k) {
    sum.note(balance_.force[k] / units_.force);
    sum.note(balance_.moment[k] / (units_.force * units_.length));
  }
  for (int k = 0; k < jaws_.count; ++k) sum.note(balance_.drive[k] / units_.force);
  return sum.worst_;
}

}  // namespace

double linear_cone_residual(const SpatialProblem& problem, int generators,
                            const LinearConeForces& answer) {
  LinearCone units;
  if (!pose_linear_cone(problem, generators, units)) {
    return std::numeric_limits<double>::infinity();
  }
  Judge judge(problem, units, answer);
  for (int k = 0; k < problem.patch_count; ++k) {
    const ContactPatch& patch = problem.patch[k];
    const Eigen::Matrix3Xd d = friction_generators(generators, patch.spin_radius > 0.0);
    for (int i = patch.first; i < patch.first + patch.count; ++i) {
      judge.point(patch, d, i);
    }
  }
  return judge.worst();
}

}  // namespace prehensile
