/// Real pushes against the same mechanics that plans are checked with: public experiments
/// in which a plate slides on a board under its known weight, as an object slides between
/// pads under a known grip force. No number is fitted unless the row says so.
///
/// Sets, each a folder of DATA: pin_push (a plate on three pins, pushed by a finger),
/// mcube_push (six steel plates, two boards), line_push (two fingers: stuck or not).
/// Prints tables, and with -o one CSV line per push and model. `--help` shows the
/// options.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Cholesky>

#include "benchmarks/csv_file.h"
#include "benchmarks/measure.h"
#include "benchmarks/truth_data.h"
#include "mechanics/limit_surface.h"
#include "mechanics/planar_instant.h"

namespace prehensile::benchmarks {
namespace {

namespace fs = std::filesystem;

struct Options {
  fs::path data;
  std::string set;  // empty: all
  int points = 48;  // of a plate that lies flat
  std::string file;
};

constexpr double kPinFriction = 0.5;
constexpr double kMcubeFriction = 0.25;           // as in the published models
constexpr double kMcubeFrictionRegistered = 0.2;  // of steel on steel, for corrected tips
constexpr double kMcubeTipRadius = 4.75e-3;       // [m]
constexpr double kLineConeFriction = 0.5;
constexpr double kLinePushFriction = 0.4;

/// Errors of one model over many pushes.
struct Errors {
  std::vector<double> distance_mm, angle_deg;

  void add(const PlanarPose& predicted, const PlanarPose& measured) {
    distance_mm.push_back(1e3 * (translation(predicted) - translation(measured)).norm());
    angle_deg.push_back(57.29577951308232 *
                        std::abs(wrapped(predicted.theta - measured.theta)));
  }
};

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

/// All results of a set: model by model, overall and per recording.
class Scores {
 public:
  Scores(std::string set, std::FILE* csv) : set_(std::move(set)), csv_(csv) {}

  void add(const std::string& model, const std::string& recording, int push,
           const PlanarPose& predicted, const PlanarPose& measured) {
    if (errors_.find(model) == errors_.end()) order_.push_back(model);
    errors_[model][""].add(predicted, measured);
    errors_[model][recording].add(predicted, measured);
    if (!csv_) return;
    const Errors& last = errors_[model][recording];
    std::fprintf(csv_, "%s,%s,%d,%s,%.6f,%.6f\n", set_.c_str(), field(recording).c_str(),
                 push, field(model).c_str(), last.distance_mm.back(),
                 last.angle_deg.back());
  }

  void print() const {
    std::printf("\n%s: error of the end pose, mm / deg\n", set_.c_str());
    std::printf("%-34s %6s %15s %15s %15s\n", "model", "pushes", "mean", "median", "p90");
    for (const std::string& model : order_) print_row(model, errors_.at(model).at(""));
    std::printf("mean per recording:\n%-34s", "");
    for (const std::string& model : order_) std::printf(" %24s", model.c_str());
    std::printf("\n");
    for (const auto& [recording, unused] : errors_.at(order_[0])) {
      if (recording.empty()) continue;
      std::printf("%-34s", recording.c_str());
      for (const std::string& model : order_) {
        const Errors& errors = errors_.at(model).at(recording);
        std::printf("            %5.2f / %5.2f", mean(errors.distance_mm),
                    mean(errors.angle_deg));
      }
      std::printf("\n");
    }
  }

 private:
  static void print_row(const std::string& model, const Errors& errors) {
    std::printf("%-34s %6zu   %5.2f / %5.2f   %5.2f / %5.2f   %5.2f / %5.2f\n",
                model.c_str(), errors.distance_mm.size(), mean(errors.distance_mm),
                mean(errors.angle_deg), quantile(errors.distance_mm, 0.5),
                quantile(errors.angle_deg, 0.5), quantile(errors.distance_mm, 0.9),
                quantile(errors.angle_deg, 0.9));
  }

  std::string set_;
  std::FILE* csv_;
  std::vector<std::string> order_;
  std::map<std::string, std::map<std::string, Errors>> errors_;
};

PlanarPose predicted_end(const TipPushes& data, const TipPush& push, SupportModel model,
                         const Tips& tips, const Vec2& tip_offset, int& failures) {
  std::vector<TipPlaces> path = push.path;
  for (TipPlaces& places : path) places[0] += tip_offset;
  const PushedPlate end =
      push_plate(data.plates[push.plate], model, tips, push.X_WO_start, path);
  failures += end.failures;
  return end.X_WO;
}

void run_pins(const Options& options, std::FILE* csv) {
  const TipPushes data = read_pin_pushes(options.data / "pin_push");
  const Tips tips{.count = 1, .radius = 0.0, .mu = kPinFriction};
  Scores scores("pin_push", csv);
  int failures = 0;
  for (std::size_t i = 0; i < data.pushes.size(); ++i) {
    const TipPush& push = data.pushes[i];
    const auto add = [&](const char* model, const PlanarPose& end) {
      scores.add(model, push.recording, static_cast<int>(i), end, push.X_WO_end);
    };
    add("points",
        predicted_end(data, push, SupportModel::kPoints, tips, Vec2::Zero(), failures));
    add("ellipsoid", predicted_end(data, push, SupportModel::kEllipsoid, tips,
                                   Vec2::Zero(), failures));
    add("no motion", push.X_WO_start);
  }
  scores.print();
  std::printf("finger friction %.2f, tip radius 0, nothing fitted; %d steps unsolved\n",
              kPinFriction, failures);
}

/// Place of the tip frame in the object frame's world, from pushes that end in contact:
/// there the measured distance of tip and outline is the tip radius. Iteratively
/// reweighted least squares of the gap on (1, normal).
Vec2 tip_offset(const TipPushes& data, const std::vector<const TipPush*>& pushes) {
  std::vector<Vec3> rows;
  std::vector<double> gaps;
  const Tips tips{.count = 1, .radius = kMcubeTipRadius, .mu = kMcubeFrictionRegistered};
  for (const TipPush* push : pushes) {
    const Plate& plate = data.plates[push->plate];
    const PushedPlate end =
        push_plate(plate, SupportModel::kEllipsoid, tips, push->X_WO_start, push->path);
    const Vec2 p_OTip = transform(inverse(push->X_WO_end), push->path.back()[0]);
    const TipGap gap = tip_gap(plate, p_OTip, kMcubeTipRadius);
    if (!end.touched || !end.kept_contact || std::abs(gap.gap) > 5e-3) continue;
    const Vec2 n_W = rotated(push->X_WO_end.theta, gap.n_O);
    rows.emplace_back(1.0, n_W.x(), n_W.y());
    gaps.push_back(gap.gap);
  }
  Vec3 fit = Vec3::Zero();
  for (int round = 0; round < 20; ++round) {
    Eigen::Matrix3d A = 1e-9 * Eigen::Matrix3d::Identity();
    Vec3 b = Vec3::Zero();
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const double weight = 1.0 / std::max(5e-4, std::abs(gaps[i] - rows[i].dot(fit)));
      A += weight * rows[i] * rows[i].transpose();
      b += weight * gaps[i] * rows[i];
    }
    fit = A.ldlt().solve(b);
  }
  return fit.tail<2>();
}

/// The offset of each push's recording, estimated from the recording's other half.
std::vector<Vec2> offsets_of_other_half(const TipPushes& data) {
  std::map<std::string, std::array<std::vector<const TipPush*>, 2>> halves;
  std::map<std::string, std::size_t> seen;
  std::vector<std::size_t> half_of(data.pushes.size());
  for (std::size_t i = 0; i < data.pushes.size(); ++i) {
    const TipPush& push = data.pushes[i];
    half_of[i] = seen[push.recording]++ % 2;
    halves[push.recording][half_of[i]].push_back(&push);
  }
  std::map<std::string, std::array<Vec2, 2>> offsets;
  for (const auto& [recording, half] : halves) {
    offsets[recording] = {tip_offset(data, half[1]), tip_offset(data, half[0])};
  }
  std::vector<Vec2> result;
  for (std::size_t i = 0; i < data.pushes.size(); ++i) {
    result.push_back(offsets[data.pushes[i].recording][half_of[i]]);
  }
  return result;
}

void run_mcube(const Options& options, std::FILE* csv) {
  const TipPushes data = read_mcube_pushes(options.data / "mcube_push", options.points);
  const Tips raw{.count = 1, .radius = kMcubeTipRadius, .mu = kMcubeFriction};
  const Tips registered{
      .count = 1, .radius = kMcubeTipRadius, .mu = kMcubeFrictionRegistered};
  const std::vector<Vec2> offsets = offsets_of_other_half(data);
  Scores scores("mcube_push", csv);
  int failures = 0;
  for (std::size_t i = 0; i < data.pushes.size(); ++i) {
    const TipPush& push = data.pushes[i];
    const auto add = [&](const char* model, const PlanarPose& end) {
      scores.add(model, push.recording, static_cast<int>(i), end, push.X_WO_end);
    };
    const auto end = [&](SupportModel model, const Tips& tips, const Vec2& offset) {
      return predicted_end(data, push, model, tips, offset, failures);
    };
    add("points raw", end(SupportModel::kPoints, raw, Vec2::Zero()));
    add("ellipsoid raw", end(SupportModel::kEllipsoid, raw, Vec2::Zero()));
    add("points registered", end(SupportModel::kPoints, registered, offsets[i]));
    add("ellipsoid registered", end(SupportModel::kEllipsoid, registered, offsets[i]));
    add("published ellipsoid fit", push.published[0]);
    add("published quartic fit", push.published[1]);
    add("no motion", push.X_WO_start);
  }
  scores.print();
  std::printf(
      "tip radius %.2f mm; raw: friction %.2f, nothing fitted; registered: friction "
      "%.2f, "
      "place of the tip\nestimated from the other half of each recording; published: "
      "fitted by their authors to these recordings; %d steps unsolved\n",
      1e3 * kMcubeTipRadius, kMcubeFriction, kMcubeFrictionRegistered, failures);
}

/// Verdicts "the line sticks" against what the plate did.
struct Verdicts {
  int right = 0, stuck_right = 0, said_stuck = 0, was_stuck = 0, total = 0;

  void add(bool said, bool was) {
    right += said == was;
    stuck_right += said && was;
    said_stuck += said;
    was_stuck += was;
    ++total;
  }
  void print(const char* model) const {
    std::printf("%-46s %6d   %8.3f   %9.3f   %6.3f\n", model, total,
                static_cast<double>(right) / total,
                static_cast<double>(stuck_right) / std::max(1, said_stuck),
                static_cast<double>(stuck_right) / std::max(1, was_stuck));
  }
};

/// The label of the experiment: within 3 mm and 2 deg of the command.
bool follows(const PlanarPose& end, const PlanarPose& commanded) {
  return (translation(end) - translation(commanded)).norm() <= 3e-3 &&
         std::abs(wrapped(end.theta - commanded.theta)) <= 2.0 / 57.29577951308232;
}

bool sticks_at_start(const Plate& plate, SupportModel model, const LinePush& push) {
  PlanarDrive drive;
  drive.count = 2;
  drive.p_HC = push.fingers;
  drive.n_H = -perp((push.fingers[1] - push.fingers[0]).normalized());
  drive.mu = kLineConeFriction;
  drive.V_HP = push.V_OP;
  PlanarGrasp grasp;
  grasp.count = static_cast<int>(plate.support.size());
  for (int j = 0; j < grasp.count; ++j) {
    grasp.x[j] = plate.support[j].x();
    grasp.y[j] = plate.support[j].y();
    grasp.bound[j] = plate.shares[j];
  }
  const PlanarInstant answer = model == SupportModel::kPoints
                                   ? solve_planar(grasp, drive)
                                   : solve_limit_surface({1.0, plate.torque_radius()},
                                                         PlanarWrench::Zero(), drive);
  return usable(answer.status) && answer.pusher[0].mode == ContactMode::kStick &&
         answer.pusher[1].mode == ContactMode::kStick;
}

/// The fingers along the commanded motion.
std::vector<TipPlaces> path_of(const LinePush& push) {
  constexpr int kPieces = 60;
  std::vector<TipPlaces> path;
  for (int i = 0; i <= kPieces; ++i) {
    const double s = static_cast<double>(i) / kPieces;
    TipPlaces places = push.fingers;
    for (Vec2& p : places) {
      p = push.turn == 0.0 ? Vec2(p + s * push.V_OP.head<2>())
                           : Vec2(push.centre + rotated(s * push.turn, p - push.centre));
    }
    path.push_back(places);
  }
  return path;
}

void run_lines(const Options& options, std::FILE* csv) {
  const LinePushes data = read_line_pushes(options.data / "line_push");
  const Tips fingers{.count = 2, .radius = 0.0, .mu = kLinePushFriction};
  Verdicts points, ellipsoid, whole, never;
  Errors pose;
  for (std::size_t i = 0; i < data.pushes.size(); ++i) {
    const LinePush& push = data.pushes[i];
    const bool stuck = follows(push.measured, push.commanded);
    const bool by_points = sticks_at_start(data.plate, SupportModel::kPoints, push);
    points.add(by_points, stuck);
    ellipsoid.add(sticks_at_start(data.plate, SupportModel::kEllipsoid, push), stuck);
    const PushedPlate end =
        push_plate(data.plate, SupportModel::kPoints, fingers, {}, path_of(push));
    whole.add(follows(end.X_WO, push.commanded), stuck);
    pose.add(end.X_WO, push.measured);
    never.add(false, stuck);
    if (csv) {
      std::fprintf(csv,
                   "line_push,%s,%zu,whole push (stuck %d; cone says %d),%.6f,%.6f\n",
                   field(push.recording).c_str(), i, stuck, by_points,
                   pose.distance_mm.back(), pose.angle_deg.back());
    }
  }
  std::printf("\nline_push: does the line stick?\n%-46s %6s   %8s   %9s   %6s\n", "model",
              "pushes", "accuracy", "precision", "recall");
  points.print("cone at the start, points, friction 0.5");
  ellipsoid.print("cone at the start, ellipsoid, friction 0.5");
  whole.print("whole push, points, friction 0.4");
  never.print("never");
  std::printf(
      "end pose of the whole push, mm / deg: mean %.2f / %.2f, median %.2f / %.2f\n",
      mean(pose.distance_mm), mean(pose.angle_deg), quantile(pose.distance_mm, 0.5),
      quantile(pose.angle_deg, 0.5));
}

void run(const Options& options, std::FILE* csv) {
  struct Set {
    const char* name;
    void (*run)(const Options&, std::FILE*);
  };
  for (const Set& set : {Set{"pin_push", run_pins}, Set{"mcube_push", run_mcube},
                         Set{"line_push", run_lines}}) {
    if (!options.set.empty() && options.set != set.name) continue;
    if (!fs::is_directory(options.data / set.name)) {
      std::printf("\n%s: skipped: no folder %s\n", set.name,
                  (options.data / set.name).c_str());
      continue;
    }
    set.run(options, csv);
  }
}

int usage(std::FILE* out) {
  std::fprintf(out,
               "usage: bench_truth DATA [--set pin_push|mcube_push|line_push]\n"
               "                   [--points N] [-o FILE]\n"
               "DATA: a folder with the sets (docs/benchmarks.md says where from)\n");
  return out == stdout ? 0 : 2;
}

}  // namespace
}  // namespace prehensile::benchmarks

int main(int argc, char** argv) {
  using namespace prehensile::benchmarks;
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const bool has_value = i + 1 < argc;
    if (word == "--help") return usage(stdout);
    if (word == "--set" && has_value) {
      options.set = argv[++i];
    } else if (word == "--points" && has_value) {
      options.points = std::atoi(argv[++i]);
    } else if (word == "-o" && has_value) {
      options.file = argv[++i];
    } else if (word[0] != '-' && options.data.empty()) {
      options.data = word;
    } else {
      return usage(stderr);
    }
  }
  if (options.data.empty() || options.points < 4 || options.points > 80) {
    return usage(stderr);
  }
  std::optional<CsvFile> csv;
  if (!options.file.empty()) {
    csv.emplace(options.file.c_str());
    if (!csv->get()) return 2;
    std::fprintf(csv->get(), "set,recording,push,model,distance_mm,angle_deg\n");
  }
  try {
    run(options, csv ? csv->get() : nullptr);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
  return !csv || csv->close() ? 0 : 1;
}
