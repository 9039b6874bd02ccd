#include "mjcf/mujoco_replay.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <mujoco/mujoco.h>
#include <mutex>
#include <numbers>

#include "mjcf/mjcf.h"
#include "planner/costs.h"

namespace prehensile::mjcf {
namespace {

constexpr double kSettle = 0.5;        // [s] for the pads to close on the object
constexpr double kRamp = 0.2;          // [s] from rest to full speed, and back
constexpr double kWindow = 0.05;       // [s] over which forces are averaged, or this
constexpr double kWindowShare = 0.02;  // share of the time, if that is longer
constexpr double kBackOff = 2e-4;      // [m] from the pusher, on top of where it may be
constexpr double kNever = -1.0;        // [m] margin of a pair that must not touch

struct FreeModel {
  void operator()(mjModel* model) const { mj_deleteModel(model); }
};
struct FreeData {
  void operator()(mjData* data) const { mj_deleteData(data); }
};
using ModelPointer = std::unique_ptr<mjModel, FreeModel>;
using DataPointer = std::unique_ptr<mjData, FreeData>;

/// MuJoCo would print warnings, and write them to a file in the working directory.
void ignore_warning(const char*) {}

/// Null, with the reason in `why`.
ModelPointer load(const std::string& text, std::string& why) {
  constexpr const char* kFile = "scene.xml";
  static std::mutex guard;  // its compiler keeps global state
  const std::lock_guard<std::mutex> lock(guard);
  mju_user_warning = ignore_warning;
  const auto files = std::make_unique<mjVFS>();
  mj_defaultVFS(files.get());
  const int size = static_cast<int>(text.size());
  mj_makeEmptyFileVFS(files.get(), kFile, size);
  std::copy(text.begin(), text.end(),
            static_cast<char*>(files->filedata[mj_findFileVFS(files.get(), kFile)]));
  std::array<char, 1000> error{};
  ModelPointer model(mj_loadXML(kFile, files.get(), error.data(), error.size()));
  mj_deleteVFS(files.get());
  if (!model) why = error.data();
  return model;
}

std::string warnings_of(const mjData& data) {
  std::string words;
  for (int i = 0; i < mjNWARNING; ++i) {
    if (data.warning[i].number == 0) continue;
    words += (words.empty() ? "" : "; ") +
             std::string(mju_warningText(i, data.warning[i].lastinfo));
  }
  return words;
}

Eigen::Isometry3d pose_of(const HandPose& hand) {
  Eigen::Isometry3d X_WH = Eigen::Isometry3d::Identity();
  X_WH.translate(Vec3(hand.X_WH.x, hand.X_WH.y, hand.z));
  X_WH.rotate(Eigen::AngleAxisd(hand.X_WH.theta, Vec3::UnitZ()));
  return X_WH;
}

/// One model of MuJoCo whose hand is led by us.
class Simulation {
 public:
  explicit Simulation(ModelPointer model)
      : model_(std::move(model)), data_(mj_makeData(model_.get())) {
    object_ = mj_name2id(model_.get(), mjOBJ_BODY, std::string(kObject).c_str());
    first_of_object_ = model_->jnt_qposadr[model_->body_jntadr[object_]];
    margins_.assign(model_->pair_margin, model_->pair_margin + model_->npair);
  }

  /// The only pusher that touches from now on.
  void let_touch(const std::string& pusher) {
    const int body = mj_name2id(model_.get(), mjOBJ_BODY,
                                (std::string(kPusherPrefix) + pusher).c_str());
    for (int i = 0; i < model_->npair; ++i) {
      const std::array<int, 2> bodies{model_->geom_bodyid[model_->pair_geom1[i]],
                                      model_->geom_bodyid[model_->pair_geom2[i]]};
      const bool is_other = std::any_of(bodies.begin(), bodies.end(), [&](int one) {
        return is_pusher(one) && one != body;
      });
      model_->pair_margin[i] = is_other ? kNever : margins_[static_cast<std::size_t>(i)];
    }
  }

  /// Each finger with so much [N] from now on.
  void grip(double force) { data_->ctrl[0] = force; }

  /// Puts hand and object somewhere, at rest.
  void place(const HandPose& hand, const Eigen::Isometry3d& X_HO) {
    const Eigen::Isometry3d X_WO = pose_of(hand) * X_HO;
    const Eigen::Quaterniond q(X_WO.linear());
    double* at = data_->qpos + first_of_object_;
    for (int i = 0; i < 3; ++i) at[i] = X_WO.translation()[i];
    at[3] = q.w();
    at[4] = q.x();
    at[5] = q.y();
    at[6] = q.z();
    mju_zero(data_->qvel, model_->nv);
    mju_zero(data_->qacc_warmstart, model_->nv);
    lead(hand, hand);
  }

  /// The object in the hand, as MuJoCo has it.
  Eigen::Isometry3d held(const HandPose& hand) const {
    const double* at = data_->qpos + first_of_object_;
    Eigen::Isometry3d X_WO = Eigen::Isometry3d::Identity();
    X_WO.translate(Vec3(at[0], at[1], at[2]));
    X_WO.rotate(Eigen::Quaterniond(at[3], at[4], at[5], at[6]).normalized());
    return pose_of(hand).inverse() * X_WO;
  }

  /// Follows hand(t) for so many seconds; returns the greatest push force over a window,
  /// of those after `unseen` [s].
  template <typename Path>
  double follow(double seconds, const Path& hand, double unseen = 0.0) {
    const double dt = model_->opt.timestep;
    const auto steps = std::max(1LL, std::llround(std::ceil(seconds / dt)));
    const auto skipped = std::min(steps - 1, std::llround(unseen / dt));
    const double averaged = std::max(kWindow, kWindowShare * seconds);
    const auto window = std::min(steps - skipped, std::llround(averaged / dt));
    Vec3 sum = Vec3::Zero();
    double peak = 0.0;
    for (auto k = 0LL; k < steps; ++k) {
      const auto done = static_cast<double>(k);
      lead(hand(done * dt), hand((done + 1.0) * dt));
      mj_step(model_.get(), data_.get());
      if (k < skipped) continue;
      sum += push_force();
      if ((k + 1 - skipped) % window != 0) continue;
      peak = std::max(peak, sum.norm() / static_cast<double>(window));
      sum.setZero();
    }
    return peak;
  }

  std::string trouble() const { return warnings_of(*data_); }

 private:
  /// Fixed to the world, and not the world itself.
  bool is_pusher(int body) const { return body > 0 && model_->body_weldid[body] == 0; }

  void lead(const HandPose& now, const HandPose& next) {
    const double dt = model_->opt.timestep;
    const auto joints = [](const HandPose& hand) {
      return std::array<double, kHandJoints>{hand.X_WH.x, hand.X_WH.y, hand.z,
                                             hand.X_WH.theta};
    };
    const std::array<double, kHandJoints> from = joints(now), to = joints(next);
    for (std::size_t i = 0; i < kHandJoints; ++i) {
      data_->qpos[i] = from[i];
      data_->qvel[i] = (to[i] - from[i]) / dt;
    }
  }

  /// Of the pusher on the object, in W [N].
  Vec3 push_force() const {
    Vec3 sum = Vec3::Zero();
    for (int i = 0; i < data_->ncon; ++i) {
      const mjContact& contact = data_->contact[i];
      const bool first = is_pusher(model_->geom_bodyid[contact.geom1]);
      if (!first && !is_pusher(model_->geom_bodyid[contact.geom2])) continue;
      std::array<double, 6> force{};
      mj_contactForce(model_.get(), data_.get(), i, force.data());
      // Rows of the frame: normal from geom1 to geom2, two tangents.
      const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> rows(
          contact.frame);
      const Vec3 on_second = rows.transpose() * Vec3(force[0], force[1], force[2]);
      sum += first ? on_second : Vec3(-on_second);
    }
    return sum;
  }

  ModelPointer model_;
  DataPointer data_;
  std::vector<double> margins_;
  int object_ = 0;
  int first_of_object_ = 0;
};

/// The share of a way that is done at t: even, but for a ramp at both ends.
class Pace {
 public:
  explicit Pace(double seconds)
      : ramp_(std::min(kRamp, std::max(seconds, 1e-9))), seconds_(seconds + ramp_) {}

  double seconds() const { return seconds_; }
  double ramp() const { return ramp_; }

  double done(double t) const {
    const double u = std::clamp(t, 0.0, seconds_);
    const double rate = 1.0 / (seconds_ - ramp_);
    if (u < ramp_) return 0.5 * rate * u * u / ramp_;
    const double rest = seconds_ - u;
    if (rest < ramp_) return 1.0 - 0.5 * rate * rest * rest / ramp_;
    return rate * (u - 0.5 * ramp_);
  }

 private:
  double ramp_, seconds_;
};

/// What a pose in space is in the plane, next to the pose that was expected.
Grasp grasp_of(const Model& model, const Eigen::Isometry3d& X_HO, const Grasp& expected) {
  const Eigen::Matrix3d R = X_HO.linear();
  const auto* cylinder = std::get_if<CylinderShape>(&model.scene.object.shape);
  const bool along_y = cylinder && cylinder->axis == Axis::kY;
  Grasp grasp;
  grasp.X_HO.x = X_HO.translation().x();
  grasp.X_HO.y = X_HO.translation().y();
  grasp.X_HO.theta =
      along_y ? std::atan2(-R(0, 1), R(1, 1)) : std::atan2(R(1, 0), R(0, 0));
  grasp.X_HO.theta =
      expected.X_HO.theta + wrapped(grasp.X_HO.theta - expected.X_HO.theta);
  if (!model.cross_section) return grasp;
  const Eigen::Matrix3d rolled =
      Eigen::AngleAxisd(-grasp.X_HO.theta, Vec3::UnitZ()).toRotationMatrix() * R;
  const double psi = along_y ? std::atan2(rolled(0, 2), rolled(0, 0))
                             : std::atan2(rolled(2, 1), rolled(1, 1));
  grasp.psi = expected.psi + wrapped(psi - expected.psi);
  return grasp;
}

/// Of the direction in the object that should stay in the pad plane, or across it.
double tilt_of(const Model& model, const Eigen::Isometry3d& X_HO) {
  const auto* cylinder = std::get_if<CylinderShape>(&model.scene.object.shape);
  if (model.cross_section && cylinder) {
    const int axis = static_cast<int>(cylinder->axis);
    return std::abs(std::asin(std::clamp(X_HO.linear()(2, axis), -1.0, 1.0)));
  }
  const Vec3 z = X_HO.linear().col(2);
  return std::atan2(z.head<2>().norm(), z.z());
}

/// The pose with another roll and place in the plane.
Eigen::Isometry3d in_space(const Model& model, const Grasp& grasp) {
  Eigen::Isometry3d X_HO = Eigen::Isometry3d::Identity();
  X_HO.translate(Vec3(grasp.X_HO.x, grasp.X_HO.y, 0.0));
  X_HO.rotate(attitude(model, grasp.X_HO.theta, grasp.psi));
  return X_HO;
}

/// A push that goes on where the one before it left the pusher.
bool continues(const PlannedPush& before, const PlannedPush& now) {
  return contact_of(before.push) == contact_of(now.push) &&
         as_linear(before.push).place == as_linear(now.push).place;
}

struct Difference {
  Vec2 place = Vec2::Zero();
  double theta = 0.0, psi = 0.0;

  double angle() const { return std::max(std::abs(theta), std::abs(psi)); }
};

Difference difference(const Grasp& one, const Grasp& other) {
  return {translation(one.X_HO) - translation(other.X_HO),
          one.X_HO.theta - other.X_HO.theta, one.psi - other.psi};
}

Difference operator-(const Difference& one, const Difference& other) {
  return {one.place - other.place, one.theta - other.theta, one.psi - other.psi};
}

class Replayer {
 public:
  Replayer(const Model& model, const Stage& stage, ModelPointer loaded)
      : model_(model),
        stage_(stage),
        simulation_(std::move(loaded)),
        X_HO_(in_space(model, stage.pushes.front().start)),
        grip_(grip_force_on_way(model, stage.pushes, 0)) {
    simulation_.grip(grip_);
  }

  MujocoPush play(std::size_t index) {
    const PlannedPush& planned = stage_.pushes[index];
    const bool goes_on = index > 0 && continues(stage_.pushes[index - 1], planned);
    const Difference before =
        difference(grasp_of(model_, X_HO_, planned.start), planned.start);
    MujocoPush result;
    result.seconds = goes_on ? 0.0 : approach(planned, before);
    const Pace pace(seconds_of(stage_, planned));
    const double begin = goes_on ? z_WH_ : 0.0;
    const auto hand = [&](double s) {
      HandPose at = hand_at(model_, planned, s);
      at.z += begin;
      return at;
    };
    result.seconds += change_grip(grip_force_of(model_, planned.push), hand(0.0));
    // Not while the hand gathers speed: the pads still hold some of the last push's load.
    result.peak_force = simulation_.follow(
        pace.seconds(), [&](double t) { return hand(pace.done(t)); }, pace.ramp());
    result.seconds += pace.seconds();
    result.seconds +=
        change_grip(grip_force_on_way(model_, stage_.pushes, index + 1), hand(1.0));
    z_WH_ = hand(1.0).z;
    X_HO_ = simulation_.held(hand(1.0));
    result.end = grasp_of(model_, X_HO_, planned.end);
    const Difference now = difference(result.end, planned.end);
    const Difference added = now - before;
    result.position_error = now.place.norm();
    result.angle_error = now.angle();
    result.position_added = added.place.norm();
    result.angle_added = added.angle();
    result.force_error = result.peak_force / planned.push_force - 1.0;
    result.out_of_plane = std::abs(X_HO_.translation().z());
    result.tilt = tilt_of(model_, X_HO_);
    result.trouble = simulation_.trouble();
    return result;
  }

 private:
  /// From clear of the pusher, along its normal, to where the push begins: an object that
  /// lies otherwise than planned touches before or after that, as with a robot.
  double approach(const PlannedPush& planned, const Difference& before) {
    const PushContact& contact =
        model_.contacts[static_cast<std::size_t>(contact_of(planned.push))];
    const double gap = kBackOff + before.place.norm() +
                       std::abs(before.theta) * (contact.b - contact.a).norm();
    simulation_.let_touch(
        model_.scene.pushers[static_cast<std::size_t>(contact.pusher)].name);
    const HandPose away = hand_at(model_, planned, 0.0, gap);
    simulation_.place(away, X_HO_);
    simulation_.follow(kSettle, [&away](double) { return away; });
    const Pace pace(gap / stage_.speed);
    simulation_.follow(pace.seconds(), [&](double t) {
      return hand_at(model_, planned, 0.0, (1.0 - pace.done(t)) * gap);
    });
    return kSettle + pace.seconds();
  }

  /// Fingers loosen and close again only where the pusher bears the object.
  double change_grip(double force, const HandPose& hand) {
    if (force == grip_) return 0.0;
    grip_ = force;
    simulation_.grip(force);
    simulation_.follow(kSettle, [&hand](double) { return hand; });
    return kSettle;
  }

  const Model& model_;
  const Stage& stage_;
  Simulation simulation_;
  Eigen::Isometry3d X_HO_;
  double z_WH_ = 0.0;
  double grip_ = 0.0;  // [N] of each finger
};

}  // namespace

MujocoReplay mujoco_replay(const Model& model, const Plan& plan,
                           const MujocoOptions& options) {
  MujocoReplay replay;
  const Stage staged = stage(model, plan.pushes, options.speed);
  replay.speed = staged.speed;
  replay.overhangs = staged.overhangs;
  replay.in_space = staged.in_space;
  if (plan.pushes.empty()) return replay;
  std::string why;
  ModelPointer loaded = load(document(staged), why);
  if (!loaded) throw std::runtime_error("MuJoCo does not load the scene: " + why);
  Replayer replayer(model, staged, std::move(loaded));
  for (std::size_t i = 0; i < plan.pushes.size(); ++i) {
    replay.pushes.push_back(replayer.play(i));
    if (options.on_push) options.on_push(static_cast<int>(i));
    if (!replay.pushes.back().trouble.empty()) break;
  }
  return replay;
}

std::string load_error(const std::string& mjcf_text) {
  std::string why;
  const ModelPointer model = load(mjcf_text, why);
  if (!model) return why.empty() ? "not loaded" : why;
  const DataPointer data(mj_makeData(model.get()));
  for (int key = 0; key < model->nkey; ++key) {
    mj_resetDataKeyframe(model.get(), data.get(), key);
    mj_step(model.get(), data.get());
    why += warnings_of(*data);
  }
  return why;
}

bool has_mujoco() { return true; }

std::string mujoco_version() { return mj_versionString(); }

}  // namespace prehensile::mjcf
