#include <array>
#include <cstdio>
#include <memory>
#include <numbers>

#include <CLI/CLI.hpp>

#include "apps/commands.h"
#include "apps/option_checks.h"
#include "apps/parallel.h"
#include "apps/plan_report.h"
#include "apps/push_options.h"
#include "apps/spread_report.h"
#include "apps/table.h"
#include "apps/uncertainty_options.h"
#include "io/plan_file.h"

namespace prehensile::apps {
namespace {

struct Options {
  SceneOptions scene;
  PushOptions push;
  PathOptions path;
  std::vector<std::string> vary;
  int samples = 400;
  std::uint64_t seed = 1;
  int jobs = 0;
  double level = 0.9;
  double floor_percent = 7.0;
  std::vector<double> factors;
  std::string csv;
  std::string plot;
};

/// Friction, pressure and registration as far as they are usually known, from pushes of
/// plates measured with care.
UncertaintyBox usual_box() {
  UncertaintyBox box;
  box[Unknown::kFriction] = 0.25;
  box[Unknown::kFingerFriction] = 0.2;
  box[Unknown::kGripForce] = 0.05;
  box[Unknown::kTorqueRadius] = 0.25;
  box[Unknown::kPlace] = box[Unknown::kTravel] = 1e-3;
  box[Unknown::kGraspX] = box[Unknown::kGraspY] = 1e-3;
  box[Unknown::kGraspAngle] = 0.3 * std::numbers::pi / 180.0;
  return box;
}

/// Splits a box into what belongs to the mechanics and what to the registration.
void split(const UncertaintyBox& box, SpreadReport& report) {
  for (const Unknown unknown : box.active()) {
    const bool mechanics = unknown <= Unknown::kCentreOfMassY;
    (mechanics ? report.mechanics : report.registration)[unknown] = box[unknown];
  }
  report.mechanics.is_absolute = box.is_absolute;
}

/// Factors learnt by split conformal prediction on pushes of plates with a box like the
/// usual one: bench_truth DATA --set intervals --samples 240, docs/benchmarks.md.
constexpr std::array<double, 3> kPlateFactors50 = {0.9, 1.1, 1.8};
constexpr std::array<double, 3> kPlateFactors90 = {1.9, 2.9, 2.5};

void set_factors(const Options& options, const Scene& scene, SpreadReport& report) {
  const auto take = [&](const auto& factors, std::string source) {
    report.has_factor = true;
    for (std::size_t i = 0; i < report.factor.size(); ++i) report.factor[i] = factors[i];
    if (!options.vary.empty()) source += "; with another box than that of --vary";
    report.factor_source = std::move(source);
  };
  if (!options.factors.empty()) {
    take(options.factors, "given by --factors");
    if (!options.vary.empty()) report.factor_source = "given by --factors";
    return;
  }
  const bool is_50 = options.level == 0.5;
  if (!is_50 && options.level != 0.9) {
    report.factor_source =
        "none is known for this level (0.5 and 0.9 are): the interval covers less than "
        "it says";
    return;
  }
  if (scene.calibration) {
    const auto& own =
        is_50 ? scene.calibration->factors_50 : scene.calibration->factors_90;
    if (own) {
      take(*own, text("calibrated on %llu pushes of this set-up (",
                      static_cast<unsigned long long>(scene.calibration->pushes)) +
                     scene.calibration->data + "), for pushes like them");
      return;
    }
  }
  take(is_50 ? kPlateFactors50 : kPlateFactors90,
       "measured on 4,806 pushes of six plates (mcube_push), learnt on three shapes and "
       "held by the other three; not measured on this gripper");
}

int run(const Options& options) {
  if (!options.factors.empty() && options.factors.size() != kDeviations) {
    throw BadInput("--factors: expected three: normal, tangential, angle");
  }
  const SceneFile file = read_scene(options.scene.file, options.scene.overrides);
  const Model model =
      prepare(file.scene, {.points_per_pad = options.path.points, .other_grips = false});
  const int contact = chosen_contact(model, options.push);
  const Grasp grasp = chosen_grasp(model, options.push);
  const Push push = chosen_push(model, contact, options.push, options.path);
  SpreadReport report;
  report.question = options.path.kind + " by " + contact_text(model, contact) +
                    text(" at place %.2f mm, %.4g mm, turning %.4g deg; object at ",
                         options.push.place_mm,
                         options.path.kind == "pivot" ? 0.0 : options.path.travel_mm,
                         options.path.turn_deg) +
                    pose_text(model, grasp);
  report.level = options.level;
  report.floor_share = 0.01 * options.floor_percent;
  set_factors(options, file.scene, report);
  const UncertaintyBox box =
      parse_box(options.vary,
                file.scene.calibration ? box_of(*file.scene.calibration) : usual_box());
  if (file.scene.calibration) {
    report.scatter = file.scene.calibration->scatter;
    report.scatter_angle = file.scene.calibration->scatter_angle;
  }
  report.box_source = !options.vary.empty()    ? "given by --vary"
                      : file.scene.calibration ? "left uncertain by the calibration"
                                               : "as usual where nobody has measured";
  split(box, report);
  EnsembleOptions ensemble{.box = box,
                           .samples = options.samples,
                           .seed = options.seed,
                           .jobs = number_of_jobs(options.jobs),
                           .tolerance = 1e-6 * options.path.tolerance_um};
  report.from_both = run_ensemble(model, grasp, push, ensemble);
  ensemble.box = report.mechanics;
  report.from_mechanics = run_ensemble(model, grasp, push, ensemble);
  ensemble.box = report.registration;
  report.from_registration = run_ensemble(model, grasp, push, ensemble);
  if (!options.csv.empty()) write_atomically(options.csv, to_csv(report));
  if (!options.plot.empty()) write_atomically(options.plot, to_svg(report));
  const std::string out =
      options.scene.json ? to_json(report).dump(2) + '\n' : describe(report);
  std::fputs(out.c_str(), stdout);
  return report.from_both.nominal.completed() ? kDone : kNegative;
}

}  // namespace

Command add_query_spread(CLI::App& query) {
  auto options = std::make_shared<Options>();
  CLI::App& command =
      *query.add_subcommand("spread", "how uncertain the end of one push is, and why");
  add_scene_options(command, options->scene);
  add_push_options(command, options->push);
  add_path_options(command, options->path);
  add_vary_option(command, options->vary);
  command.add_option("--samples", options->samples, "pushes drawn from each box")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  command.add_option("--seed", options->seed, "of the drawn pushes")
      ->check(is_seed())
      ->capture_default_str();
  command.add_option("--jobs", options->jobs, "threads; default: one per core")
      ->check(CLI::Range(0, 1024));
  command.add_option("--level", options->level, "of the intervals, two-sided")
      ->check(in_range(0.01, 0.999))
      ->capture_default_str();
  command
      .add_option("--floor-percent", options->floor_percent,
                  "of the motion: friction that differs from spot to spot")
      ->check(in_range(0.0, 100.0))
      ->capture_default_str();
  command
      .add_option("--factors", options->factors,
                  "on the interval: normal, tangential, angle; default: measured ones "
                  "for the levels 0.5 and 0.9")
      ->delimiter(',')
      ->check(in_range(0.0, 1e3));
  command.add_option("--csv", options->csv, "write every push to this file")
      ->check(is_output());
  command.add_option("--plot", options->plot, "write a picture (SVG) to this file")
      ->check(is_output());
  command.footer(
      "Example:\n  prehensile query spread problems/paper/slide.yaml --travel-mm 20 "
      "--samples 1000");
  return [options] { return run(*options); };
}

}  // namespace prehensile::apps
