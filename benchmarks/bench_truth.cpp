/// Real pushes against the same mechanics that plans are checked with: public experiments
/// in which a plate slides on a board under its known weight, as an object slides between
/// pads under a known grip force. No number is fitted unless the row says so.
///
/// Sets, each a folder of DATA: pin_push (a plate on three pins, pushed by a finger),
/// mcube_push (six steel plates, two boards), line_push (two fingers: stuck or not).
/// Further parts: friction and pressure calibrated on half of the mcube pushes and tested
/// on the other half; stated intervals and how many measured ends they cover.
/// Prints tables, and with -o one CSV line per push and model. `--help` shows the
/// options.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/csv_file.h"
#include "benchmarks/measure.h"
#include "benchmarks/options.h"
#include "benchmarks/truth_runs.h"
#include "benchmarks/truth_scores.h"
#include "mechanics/limit_surface.h"
#include "mechanics/planar_instant.h"

namespace prehensile::benchmarks {
namespace {

constexpr double kPinFriction = 0.5;
constexpr double kLineConeFriction = 0.5;
constexpr double kLinePushFriction = 0.4;

void run_pins(const TruthOptions& options, std::FILE* csv) {
  const TipPushes data = read_pin_pushes(options.data / "pin_push");
  const auto every = static_cast<std::size_t>(options.every);
  const Tips tips{.count = 1, .radius = 0.0, .mu = kPinFriction};
  Scores scores("pin_push", csv);
  int failures = 0;
  for (std::size_t i = 0; i < data.pushes.size(); i += every) {
    const TipPush& push = data.pushes[i];
    if (push.recording.find(options.recording) == std::string::npos) continue;
    const auto add = [&](const char* model, const PlanarPose& end) {
      scores.add(model, push.recording, "", static_cast<int>(i), end, push.X_WO_end);
    };
    const auto end = [&](SupportModel model) {
      return predicted_end(data.plates[push.plate], push, model, tips, Vec2::Zero(),
                           failures);
    };
    add("points", end(SupportModel::kPoints));
    add("ellipsoid", end(SupportModel::kEllipsoid));
    add("no motion", push.X_WO_start);
  }
  scores.print();
  std::printf("finger friction %.2f, tip radius 0, nothing fitted; %d steps unsolved\n",
              kPinFriction, failures);
}

void run_mcube(const TruthOptions& options, std::FILE* csv) {
  const TipPushes data = select_mcube(options).data;
  const Tips raw{.count = 1, .radius = kMcubeTipRadius, .mu = kMcubeFriction};
  const Tips registered{
      .count = 1, .radius = kMcubeTipRadius, .mu = kMcubeFrictionRegistered};
  const std::vector<Vec2> offsets = offsets_of_other_half(data);
  Scores scores("mcube_push", csv);
  int failures = 0;
  for (std::size_t i = 0; i < data.pushes.size(); ++i) {
    const TipPush& push = data.pushes[i];
    const auto add = [&](const char* model, const PlanarPose& end) {
      scores.add(model, push.recording, "", static_cast<int>(i), end, push.X_WO_end);
    };
    const auto end = [&](SupportModel model, const Tips& tips, const Vec2& offset) {
      return predicted_end(data.plates[push.plate], push, model, tips, offset, failures);
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
         std::abs(wrapped(end.theta - commanded.theta)) <= 2.0 / kDegPerRad;
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

void run_lines(const TruthOptions& options, std::FILE* csv) {
  const LinePushes data = read_line_pushes(options.data / "line_push");
  const Tips fingers{.count = 2, .radius = 0.0, .mu = kLinePushFriction};
  Verdicts points, ellipsoid, whole, never;
  Errors pose;
  int failures = 0;
  const auto every = static_cast<std::size_t>(options.every);
  for (std::size_t i = 0; i < data.pushes.size(); i += every) {
    const LinePush& push = data.pushes[i];
    const bool stuck = follows(push.measured, push.commanded);
    const bool by_points = sticks_at_start(data.plate, SupportModel::kPoints, push);
    points.add(by_points, stuck);
    ellipsoid.add(sticks_at_start(data.plate, SupportModel::kEllipsoid, push), stuck);
    const PushedPlate end =
        push_plate(data.plate, SupportModel::kPoints, fingers, {}, path_of(push));
    failures += end.failures;
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
      "end pose of the whole push, mm / deg: mean %.2f / %.2f, median %.2f / %.2f; "
      "%d steps unsolved\n",
      mean(pose.distance_mm), mean(pose.angle_deg), quantile(pose.distance_mm, 0.5),
      quantile(pose.angle_deg, 0.5), failures);
}

/// How many of the sets asked for are there.
int run(const TruthOptions& options, std::FILE* csv) {
  int sets = 0;
  struct Part {
    const char* name;
    const char* folder;
    void (*run)(const TruthOptions&, std::FILE*);
    bool only_if_named = false;  // it takes minutes
  };
  for (const Part& part : {Part{"pin_push", "pin_push", run_pins},
                           Part{"mcube_push", "mcube_push", run_mcube},
                           Part{"calibrated", "mcube_push", run_mcube_calibrated},
                           Part{"few", "mcube_push", run_mcube_few, true},
                           Part{"intervals", "mcube_push", run_mcube_intervals},
                           Part{"line_push", "line_push", run_lines}}) {
    const bool is_named = options.set == part.name;
    if (!is_named && (!options.set.empty() || part.only_if_named)) continue;
    if (!std::filesystem::is_directory(options.data / part.folder)) {
      std::printf("\n%s: skipped: no folder %s\n", part.name,
                  (options.data / part.folder).c_str());
      continue;
    }
    part.run(options, csv);
    ++sets;
  }
  return sets;
}

int usage(std::FILE* out) {
  std::fprintf(
      out,
      "usage: bench_truth DATA [--set pin_push|mcube_push|calibrated|few|intervals|"
      "line_push]\n"
      "  [--recording TEXT] [--every N] [--points N] [--samples N] [--quick] "
      "[-o FILE]\n"
      "DATA: a folder with the sets (docs/benchmarks.md says where from)\n"
      "few only if it is named. --recording: only recordings whose name holds the text; "
      "--every: one of "
      "N pushes,\nof mcube_push one of N pairs of contact positions; --quick: "
      "every 8, 20 samples\n");
  return out == stdout ? 0 : 2;
}

bool is_set(const std::string& name) {
  for (const char* known :
       {"", "pin_push", "mcube_push", "calibrated", "few", "intervals", "line_push"}) {
    if (name == known) return true;
  }
  return false;
}

}  // namespace
}  // namespace prehensile::benchmarks

int main(int argc, char** argv) {
  using namespace prehensile::benchmarks;
  if (argc > 1 && std::string(argv[1]) == "--help") return usage(stdout);
  if (argc < 2 || argv[1][0] == '-') return usage(stderr);
  TruthOptions options;
  options.data = argv[1];
  const bool taken = take_options(argc - 1, argv + 1,
                                  {{"--set", &options.set},
                                   {"--recording", &options.recording},
                                   {"--every", &options.every, 1},
                                   {"--points", &options.points, 4},
                                   {"--samples", &options.samples, 10},
                                   {"-o", &options.file}},
                                  [&] {
                                    options.every = 8;
                                    options.samples = 20;
                                  });
  if (!taken || options.points > 80 || !is_set(options.set)) return usage(stderr);
  std::optional<CsvFile> csv;
  if (!options.file.empty()) {
    csv.emplace(options.file.c_str());
    if (!csv->get()) return 2;
    std::fprintf(csv->get(), "set,recording,push,model,distance_mm,angle_deg\n");
  }
  try {
    if (run(options, csv ? csv->get() : nullptr) == 0) {
      std::fprintf(stderr, "%s: holds none of the sets asked for\n",
                   options.data.c_str());
      return 2;
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
  return !csv || csv->close() ? 0 : 1;
}
