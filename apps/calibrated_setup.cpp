#include "apps/calibrated_setup.h"

#include <algorithm>
#include <cmath>

#include "apps/parallel.h"
#include "apps/spread.h"
#include "apps/table.h"

namespace prehensile::apps {
namespace {

/// What is assumed of what was not calibrated, shares and [m]; as in `query spread`.
constexpr double kUsualFriction = 0.25;
constexpr double kUsualFingerFriction = 0.2;
constexpr double kUsualTorqueRadius = 0.25;
constexpr double kUsualPlace = 1e-3;
constexpr double kFloorShare = 0.07;

/// A residual beyond so many scales is an outlier.
constexpr double kOutlier = 6.0;
constexpr std::size_t kMostListed = 10;

double torque_radius(const Scene& scene) {
  return ContactRegion(scene, 64).torque_radius();
}

int index_of(const SceneFit& fit, Target target) {
  for (std::size_t j = 0; j < fit.targets.size(); ++j) {
    if (fit.targets[j].target == target) return static_cast<int>(j);
  }
  return -1;
}

/// Half width over value of the told parameters of this kind, the greatest; `otherwise`
/// if none is told. `to_90` takes the half widths to those of 90 %.
double share_of(const CalibratedSetup& setup, Target target, double otherwise,
                double to_90) {
  double most = -1.0;
  for (std::size_t j = 0; j < setup.fit.targets.size(); ++j) {
    const CalibratedParameter& parameter = setup.calibration.parameters[j];
    if (setup.fit.targets[j].target != target || !parameter.told) continue;
    const FitInterval& interval = parameter.profile.interval;
    most = std::max({most, interval.high / parameter.value - 1.0,
                     1.0 - interval.low / parameter.value});
  }
  return most < 0.0 ? otherwise : std::min(1.0, to_90 * most);
}

double torque_radius_share(const CalibratedSetup& setup, double to_90) {
  const int j = index_of(setup.fit, Target::kEdgeLoad);
  if (j < 0 || !setup.calibration.parameters[static_cast<std::size_t>(j)].told) {
    return share_of(setup, Target::kTorqueRadius, kUsualTorqueRadius, to_90);
  }
  const FitInterval& interval =
      setup.calibration.parameters[static_cast<std::size_t>(j)].profile.interval;
  double most = 0.0;
  for (const double end : {interval.low, interval.high}) {
    Eigen::VectorXd at = setup.calibration.fit.at;
    at[j] = end;
    const double c = torque_radius(with_values(setup.before, setup.fit.targets, at));
    most = std::max(most, std::abs(c / setup.c_after - 1.0));
  }
  return std::min(1.0, to_90 * most);
}

double place_width(const CalibratedSetup& setup, double to_90) {
  double most = 0.0;
  for (const Target target : {Target::kRegistrationX, Target::kRegistrationY}) {
    const int j = index_of(setup.fit, target);
    if (j < 0) return kUsualPlace;
    const CalibratedParameter& parameter =
        setup.calibration.parameters[static_cast<std::size_t>(j)];
    const double told = to_90 * parameter.profile.interval.half_width();
    most = std::max(most, parameter.told ? told : kUsualPlace);
  }
  return std::min(1.0, most);
}

CalibrationRecord record_of(const CalibratedSetup& setup, const std::string& source) {
  const int freedom =
      std::max(3, static_cast<int>(setup.data.size()) - setup.calibration.told());
  const double to_90 = student_quantile(0.95, freedom) /
                       student_quantile(0.5 + 0.5 * setup.options.level, freedom);
  CalibrationRecord record;
  record.data = source;
  record.pushes = setup.data.size();
  record.registration = registration_of(setup.fit.targets, setup.calibration.fit.at);
  record.friction = share_of(setup, Target::kPusherFriction, kUsualFriction, to_90);
  record.finger_friction =
      share_of(setup, Target::kFingerFriction, kUsualFingerFriction, to_90);
  record.torque_radius = torque_radius_share(setup, to_90);
  record.place = place_width(setup, to_90);
  if (setup.is_of_pushes()) {
    const std::vector<double>& scale = setup.calibration.fit.scale;
    record.scatter = std::min(1.0, std::max(scale[0], scale[1]));
    record.scatter_angle = std::min(4.0, scale[2]);
  }
  return record;
}

/// The factors that intervals of the box need to cover the measured ends: each push in
/// the scene that was fitted without it.
class Factors {
 public:
  Factors(const CalibratedSetup& setup, const CalibrationRecord& record)
      : setup_(setup), record_(record) {
    for (const Eigen::VectorXd& at : setup.calibration.fold_at) {
      models_.push_back(prepare(with_values(setup.before, setup.fit.targets, at)));
    }
  }

  int set(CalibrationRecord& record) {
    for (std::size_t i = 0; i < setup_.data.pushes.size(); ++i) score(i);
    record.factors_50 = factors(0);
    record.factors_90 = factors(1);
    return static_cast<int>(needed_[0][0].size());
  }

 private:
  static constexpr std::array<double, 2> kLevels = {0.5, 0.9};

  void score(std::size_t i) {
    const MeasuredPush& measured = setup_.data.pushes[i];
    const auto fold = static_cast<std::size_t>(setup_.calibration.fold[i]);
    Model model = models_[fold];
    if (measured.grip_force && *measured.grip_force != model.scene.gripper.grip_force) {
      Scene scene = model.scene;
      scene.gripper.grip_force = *measured.grip_force;
      model = prepare(scene);
    }
    const Vec2 registration =
        registration_of(setup_.fit.targets, setup_.calibration.fold_at[fold]);
    const std::optional<LinearPush> push = push_of(model, measured, registration);
    if (!push) return;
    const Ensemble ensemble = run_ensemble(model, {measured.X_HO_start, 0.0}, *push,
                                           {.box = box_of(record_),
                                            .samples = setup_.options.samples,
                                            .seed = setup_.options.seed + i,
                                            .jobs = setup_.options.jobs,
                                            .tolerance = 1e-5});
    if (ensemble.completed() == 0) return;
    const Vec2 n = rotated(measured.X_HO_start.theta, model.contacts[push->contact].n);
    const PlanarPose& nominal = ensemble.nominal.end.X_HO;
    const Vec2 off = translation(measured.X_HO_end) - translation(nominal);
    const Vec3 happened(off.dot(n), off.dot(perp(n)),
                        wrapped(measured.X_HO_end.theta - nominal.theta));
    const Deviation& motion = ensemble.nominal_motion;
    const double moved = std::hypot(
        kFloorShare * std::hypot(motion.normal, motion.tangential), record_.scatter);
    const double turned = std::hypot(kFloorShare * motion.angle, record_.scatter_angle);
    for (std::size_t level = 0; level < kLevels.size(); ++level) {
      for (int part = 0; part < kDeviations; ++part) {
        const SpreadQuantiles spread = spread_quantiles(
            ensemble.sorted(&EnsembleMember::end, kDeviationParts[part]), kLevels[level]);
        needed_[level][part].push_back(
            factor_needed(spread, part == 2 ? turned : moved, happened[part]));
      }
    }
  }

  std::optional<Vec3> factors(std::size_t level) const {
    Vec3 out = Vec3::Zero();
    for (int part = 0; part < kDeviations; ++part) {
      out[part] = conformal_factor(needed_[level][part], kLevels[level]);
    }
    // What no file can hold says that some push is beyond any interval.
    if (!out.allFinite() || out.maxCoeff() > 1e3) return std::nullopt;
    return out;
  }

  const CalibratedSetup& setup_;
  CalibrationRecord record_;
  std::vector<Model> models_;
  std::array<std::array<std::vector<double>, kDeviations>, kLevels.size()> needed_;
};

std::string range_of(const FitInterval& interval) {
  std::string out = interval.open_low && interval.open_high ? "nothing at all"
                    : interval.open_low ? text("at most %.4g", interval.high)
                    : interval.open_high
                        ? text("at least %.4g", interval.low)
                        : text("%.4g to %.4g", interval.low, interval.high);
  return out;
}

void warn_untold(CalibratedSetup& setup) {
  for (std::size_t j = 0; j < setup.calibration.parameters.size(); ++j) {
    const CalibratedParameter& parameter = setup.calibration.parameters[j];
    if (parameter.told) continue;
    const FitParameter& it = setup.fit.problem.parameters[j];
    std::string warning = "the data cannot tell " + it.name;
    warning += ": they say " + range_of(parameter.profile.interval) +
               text(
                   ", no more than is known without them (%.4g +-%.4g); it stays at "
                   "%.4g",
                   it.start, it.known, parameter.value);
    if (parameter.confused_with >= 0) {
      warning += text(
          "; it can be exchanged with %s (correlation %.2f)",
          setup.fit.problem.parameters[static_cast<std::size_t>(parameter.confused_with)]
              .name.c_str(),
          parameter.correlation);
    }
    setup.warnings.push_back(warning);
  }
}

void warn_outliers(CalibratedSetup& setup) {
  std::vector<int> rows;
  const Eigen::MatrixXd& r = setup.calibration.after;
  for (Eigen::Index row = 0; row < r.cols(); ++row) {
    bool is_outlier = false;
    for (Eigen::Index part = 0; part < r.rows(); ++part) {
      const double scale = setup.calibration.fit.scale[static_cast<std::size_t>(part)];
      is_outlier = is_outlier || std::abs(r(part, row)) > kOutlier * scale;
    }
    if (is_outlier) rows.push_back(static_cast<int>(row) + 1);
  }
  if (rows.empty()) return;
  std::string list;
  for (std::size_t i = 0; i < std::min(rows.size(), kMostListed); ++i) {
    list += text("%s%d", i ? ", " : "", rows[i]);
  }
  setup.warnings.push_back(
      text("outliers, more than %g times the scatter off and hardly counted: number ",
           kOutlier) +
      list + (rows.size() > kMostListed ? ", ..." : "") + " of the data");
}

void warn(CalibratedSetup& setup) {
  const int count = static_cast<int>(setup.data.size());
  warn_untold(setup);
  if (setup.misses > 0) {
    setup.warnings.push_back(
        text("%d of %d pushes meet no face that their pusher may touch, or are not "
             "possible where they start: no motion is predicted for them",
             setup.misses, count));
  }
  warn_outliers(setup);
  if (setup.is_of_pushes() && index_of(setup.fit, Target::kFingerFriction) < 0) {
    setup.warnings.push_back(
        "no forces were measured: the friction of the fingers cannot be told and stays");
  }
  if (!setup.is_better) {
    setup.warnings.push_back(
        "measurements that the fit did not see are predicted no better than by the scene "
        "as it was");
  }
  if (setup.is_of_pushes() && !setup.after.calibration->factors_90) {
    setup.warnings.push_back(
        "too few pushes, or none that intervals could hold, to learn factors of 90 % "
        "intervals: 9 are the least");
  }
}

}  // namespace

double mean_error(const Eigen::MatrixXd& residuals, int part) {
  double sum = 0.0;
  int count = 0;
  for (const double r : residuals.row(part)) {
    if (std::isnan(r)) continue;
    sum += std::abs(r);
    ++count;
  }
  return count > 0 ? sum / count : kNan;
}

CalibratedSetup calibrate_setup(const Scene& scene, Measurements data,
                                const std::string& source,
                                const CalibrateOptions& options) {
  CalibratedSetup out;
  out.before = scene;
  out.data = std::move(data);
  out.options = options;
  if (out.is_of_pushes()) {
    out.fit = push_fit(scene, out.data.pushes,
                       {.pressure = options.pressure,
                        .registration = options.registration,
                        .for_each = [jobs = options.jobs](
                                        int count, const std::function<void(int)>& work) {
                          for_each_index(count, jobs, work);
                        }});
  } else {
    out.fit = slip_fit(scene, out.data.readings);
  }
  const int least = least_rows(static_cast<int>(out.fit.targets.size()));
  if (static_cast<int>(out.data.size()) < least) {
    throw BadInput(source + text(": %zu measurements: expected at least %d for the %zu "
                                 "parameters that they are to tell",
                                 out.data.size(), least, out.fit.targets.size()));
  }
  out.calibration =
      calibrate(out.fit.problem,
                {.level = options.level, .folds = options.folds, .seed = options.seed});
  const Eigen::VectorXd& at = out.calibration.fit.at;
  out.after = with_values(scene, out.fit.targets, at);
  out.c_before = torque_radius(scene);
  out.c_after = torque_radius(out.after);
  Scene uniform = scene;
  uniform.gripper.pressure.edge_load = 0.0;
  uniform.gripper.pressure.profile = PressureProfile::kUniform;
  const double c_uniform = torque_radius(uniform);
  if (c_uniform > 0.0) out.k = out.c_after / c_uniform;
  double sum = 0.0;
  int parts = 0;
  for (int part = 0; part < out.fit.problem.parts(); ++part) {
    const double was = mean_error(out.calibration.before, part);
    if (!(was > 0.0)) continue;
    sum += mean_error(out.calibration.held_out, part) / was;
    ++parts;
  }
  out.is_better = parts > 0 && sum < parts;
  CalibrationRecord record = record_of(out, source);
  if (out.is_of_pushes()) {
    const Model model = prepare(out.after);
    for (const MeasuredPush& push : out.data.pushes) {
      const TransitionStatus status =
          predict(model, push, record.registration, {.tolerance = 1e-5}).status;
      out.misses +=
          status == TransitionStatus::kNotRun || status == TransitionStatus::kRefused;
    }
    out.scored = Factors(out, record).set(record);
  }
  out.after.calibration = record;
  warn(out);
  return out;
}

}  // namespace prehensile::apps
