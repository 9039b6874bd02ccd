#include "primitives/push_calibration.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <utility>

namespace prehensile {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kLargestFriction = 2.0;
constexpr double kLargestOffset = 10e-3;  // [m] of a registration
/// What is known without data of one's own (90 %), from pushes of plates measured with
/// care: friction to a quarter, torque radius to a quarter, registration to 1 mm.
constexpr double kKnownShare = 0.25;
constexpr double kKnownOffset = 1e-3;   // [m]
constexpr double kKnownEdgeLoad = 1.0;  // moves the torque radius by about 20 %
constexpr double kLogScale = 1e-3;      // least scale of logs of forces

FitParameter friction_parameter(std::string name, double value) {
  const double start = std::clamp(value, 0.02, kLargestFriction);
  return {.name = std::move(name),
          .start = start,
          .low = 0.01,
          .high = std::max(kLargestFriction, 2.0 * start),
          .step = 0.02,
          .known = kKnownShare * start,
          .tries = {0.5 * start, 0.7 * start, std::min(1.5 * start, 2.0)}};
}

bool has_torque(const Pad& pad) {
  const auto* point = std::get_if<PointPad>(&pad);
  return !point || point->spin_radius.has_value();
}

double mean_friction(const Gripper& gripper) {
  return 0.5 * (gripper.friction[0] + gripper.friction[1]);
}

void add(SceneFit& fit, CalibrationTarget target, FitParameter parameter) {
  fit.targets.push_back(target);
  fit.problem.parameters.push_back(std::move(parameter));
}

void add_finger_friction(SceneFit& fit, const Scene& scene) {
  add(fit, {Target::kFingerFriction},
      friction_parameter("finger friction", mean_friction(scene.gripper)));
}

FitParameter torque_factor() {
  return {.name = "torque radius factor k",
          .start = 1.0,
          .low = 0.3,
          .high = 3.0,
          .step = 0.03,
          .known = kKnownShare,
          .tries = {0.7, 1.4}};
}

void add_pressure(SceneFit& fit, const Scene& scene, PressureFit pressure) {
  if (pressure == PressureFit::kNone || !has_torque(scene.gripper.pad)) return;
  // A soft point has a spin radius and no edge.
  const bool is_point = std::holds_alternative<PointPad>(scene.gripper.pad);
  if (pressure == PressureFit::kTorqueRadius || is_point) {
    add(fit, {Target::kTorqueRadius}, torque_factor());
    return;
  }
  add(fit, {Target::kEdgeLoad},
      {.name = "edge load p",
       .start = std::clamp(scene.gripper.pressure.edge_load, -1.0, 3.0),
       .low = -1.0,
       .high = 3.0,
       .step = 0.1,
       .known = kKnownEdgeLoad,
       .tries = {-0.5, 0.5, 1.5}});
}

/// What an earlier calibration found is where the next begins.
void add_registration(SceneFit& fit, const Scene& scene) {
  const Vec2 before =
      scene.calibration ? scene.calibration->registration : Vec2(0.0, 0.0);
  for (const bool is_y : {false, true}) {
    add(fit, {is_y ? Target::kRegistrationY : Target::kRegistrationX},
        {.name = is_y ? "registration y" : "registration x",
         .start =
             std::clamp(is_y ? before.y() : before.x(), -kLargestOffset, kLargestOffset),
         .low = -kLargestOffset,
         .high = kLargestOffset,
         .step = 1e-4,
         .known = kKnownOffset});
  }
}

/// Predicts all pushes with one set of parameters.
class Predictor {
 public:
  Predictor(Scene scene, std::vector<MeasuredPush> pushes, SceneFitOptions options)
      : scene_(std::move(scene)),
        pushes_(std::move(pushes)),
        options_(std::move(options)) {
    if (!options_.for_each) {
      options_.for_each = [](int count, const std::function<void(int)>& work) {
        for (int i = 0; i < count; ++i) work(i);
      };
    }
  }

  void residuals(const std::vector<CalibrationTarget>& targets, const VectorXd& at,
                 std::span<const int> rows, MatrixXd& out) const {
    const Vec2 registration = registration_of(targets, at);
    std::map<double, Model> models;  // by grip force
    for (const int row : rows) {
      const double force = grip_force(row);
      if (models.find(force) != models.end()) continue;
      Scene scene = with_values(scene_, targets, at);
      scene.gripper.grip_force = force;
      models.emplace(force, prepare(scene, {.points_per_pad = options_.points_per_pad}));
    }
    options_.for_each(static_cast<int>(rows.size()), [&](int i) {
      const int row = rows[static_cast<std::size_t>(i)];
      const MeasuredPush& push = pushes_[static_cast<std::size_t>(row)];
      const PredictedPush end =
          predict(models.at(grip_force(row)), push, registration, options_.transition);
      out.col(i) = difference(push, end);
    });
  }

 private:
  double grip_force(int row) const {
    return pushes_[static_cast<std::size_t>(row)].grip_force.value_or(
        scene_.gripper.grip_force);
  }

  /// A force that the mechanics does not predict, because nothing is pushed, is off by
  /// this (a factor of e).
  static constexpr double kNoForce = 1.0;

  static Eigen::Vector4d difference(const MeasuredPush& push, const PredictedPush& end) {
    Vec2 along = push.to - push.from;
    along = along.norm() > 0.0 ? Vec2(along.normalized()) : Vec2(1.0, 0.0);
    const Vec2 off = translation(push.X_HO_end) - translation(end.X_HO_end);
    double force = std::numeric_limits<double>::quiet_NaN();
    if (push.push_force) {
      force =
          end.push_force > 0.0 ? std::log(*push.push_force / end.push_force) : kNoForce;
    }
    return {off.dot(along), off.dot(perp(along)),
            wrapped(push.X_HO_end.theta - end.X_HO_end.theta), force};
  }

  Scene scene_;
  std::vector<MeasuredPush> pushes_;
  SceneFitOptions options_;
};

}  // namespace

SceneFit push_fit(const Scene& scene, const std::vector<MeasuredPush>& pushes,
                  const SceneFitOptions& options) {
  SceneFit out;
  std::vector<int> used;
  bool has_force = false;
  for (const MeasuredPush& push : pushes) {
    used.push_back(push.pusher);
    has_force = has_force || push.push_force.has_value();
  }
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  for (const int pusher : used) {
    const Pusher& it = scene.pushers[static_cast<std::size_t>(pusher)];
    std::string name = "friction of ";
    add(out, {Target::kPusherFriction, pusher},
        friction_parameter(name += it.name, it.friction));
  }
  if (has_force) add_finger_friction(out, scene);
  add_pressure(out, scene, options.pressure);
  if (options.registration) add_registration(out, scene);
  out.parts = {"along", "across", "angle", "force"};
  out.problem.rows = static_cast<int>(pushes.size());
  out.problem.resolution = {1e-5, 1e-5, 1e-3, kLogScale};
  const auto predictor = std::make_shared<const Predictor>(scene, pushes, options);
  out.problem.residuals = [predictor, targets = out.targets](const VectorXd& at,
                                                             std::span<const int> rows,
                                                             MatrixXd& residuals) {
    predictor->residuals(targets, at, rows, residuals);
  };
  return out;
}

SceneFit slip_fit(const Scene& scene, const std::vector<SlipReading>& readings) {
  SceneFit out;
  add_finger_friction(out, scene);
  bool has_torque_readings = false;
  double largest = 0.0;
  for (const SlipReading& reading : readings) {
    has_torque_readings = has_torque_readings || reading.slip_torque.has_value();
    largest = std::max(largest, reading.slip_force.value_or(0.0));
  }
  const double c = ContactRegion(scene, 64).torque_radius();
  if (has_torque_readings && c > 0.0) add(out, {Target::kTorqueRadius}, torque_factor());
  if (largest > 0.0) {
    add(out, {Target::kForceBias},
        {.name = "bias of the force",
         .start = 0.0,
         .low = -largest,
         .high = largest,
         .step = 0.01 * largest,
         .known = 0.1 * largest});
  }
  out.parts = {"force", "torque"};
  out.problem.rows = static_cast<int>(readings.size());
  out.problem.resolution = {kLogScale, kLogScale};
  out.problem.residuals = [readings, c, targets = out.targets](const VectorXd& at,
                                                               std::span<const int> rows,
                                                               MatrixXd& residuals) {
    double friction = 0.0;
    double k = 1.0;
    double bias = 0.0;
    for (std::size_t j = 0; j < targets.size(); ++j) {
      const double value = at[static_cast<Eigen::Index>(j)];
      if (targets[j].target == Target::kFingerFriction) friction = value;
      if (targets[j].target == Target::kTorqueRadius) k = value;
      if (targets[j].target == Target::kForceBias) bias = value;
    }
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const SlipReading& reading = readings[static_cast<std::size_t>(rows[i])];
      const double slip = 2.0 * friction * reading.grip_force;
      // What would be no force at all is one per mille of the friction.
      const double force = std::max(1e-3 * slip, slip + bias);
      const auto log_ratio = [](const std::optional<double>& measured, double expected) {
        return measured ? std::log(*measured / expected)
                        : std::numeric_limits<double>::quiet_NaN();
      };
      residuals(0, static_cast<Eigen::Index>(i)) = log_ratio(reading.slip_force, force);
      residuals(1, static_cast<Eigen::Index>(i)) =
          log_ratio(reading.slip_torque, slip * k * c);
    }
  };
  return out;
}

Scene with_values(const Scene& scene, const std::vector<CalibrationTarget>& targets,
                  const Eigen::VectorXd& at) {
  Scene out = scene;
  for (std::size_t j = 0; j < targets.size(); ++j) {
    const double value = at[static_cast<Eigen::Index>(j)];
    switch (targets[j].target) {
      case Target::kPusherFriction:
        out.pushers[static_cast<std::size_t>(targets[j].pusher)].friction = value;
        break;
      case Target::kFingerFriction: {
        const double mean = mean_friction(scene.gripper);
        for (double& friction : out.gripper.friction) {
          friction = mean > 0.0 ? friction * (value / mean) : value;
        }
        break;
      }
      case Target::kEdgeLoad:
        out.gripper.pressure.edge_load = value;
        break;
      case Target::kTorqueRadius:
        out.gripper.pad = resized(out.gripper.pad, value);
        break;
      case Target::kRegistrationX:
      case Target::kRegistrationY:
      case Target::kForceBias:
        break;
    }
  }
  return out;
}

Vec2 registration_of(const std::vector<CalibrationTarget>& targets,
                     const Eigen::VectorXd& at) {
  Vec2 out = Vec2::Zero();
  for (std::size_t j = 0; j < targets.size(); ++j) {
    const double value = at[static_cast<Eigen::Index>(j)];
    if (targets[j].target == Target::kRegistrationX) out.x() = value;
    if (targets[j].target == Target::kRegistrationY) out.y() = value;
  }
  return out;
}

}  // namespace prehensile
