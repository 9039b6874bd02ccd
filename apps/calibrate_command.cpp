#include <cstdio>
#include <map>
#include <memory>

#include <CLI/CLI.hpp>

#include "apps/calibration_report.h"
#include "apps/commands.h"
#include "apps/option_checks.h"
#include "apps/parallel.h"
#include "io/plan_file.h"

namespace prehensile::apps {
namespace {

struct Options {
  SceneOptions scene;
  std::string data;
  std::string output;
  std::string plot;
  std::string pressure = "edge_load";
  bool no_registration = false;
  CalibrateOptions how;
};

PressureFit pressure_called(const std::string& word) {
  if (word == "none") return PressureFit::kNone;
  return word == "radius" ? PressureFit::kTorqueRadius : PressureFit::kEdgeLoad;
}

int run(const Options& options) {
  const SceneFile file = read_scene(options.scene.file, options.scene.overrides);
  Measurements data =
      read_measurements(options.data, prepare(file.scene, {.other_grips = false}));
  CalibrateOptions how = options.how;
  how.pressure = pressure_called(options.pressure);
  how.registration = !options.no_registration;
  how.jobs = number_of_jobs(how.jobs);
  const CalibratedSetup setup =
      calibrate_setup(file.scene, std::move(data), options.data, how);
  const bool writes = setup.is_usable() && !options.output.empty();
  if (writes) write_atomically(options.output, scene_to_yaml(setup.after));
  if (!options.plot.empty()) write_atomically(options.plot, to_svg(setup));
  if (options.scene.json) {
    nlohmann::ordered_json out = to_json(setup);
    if (writes) {
      out["scene"] = options.output;
    } else {
      out["scene"] = nullptr;
    }
    std::printf("%s\n", out.dump(2).c_str());
  } else {
    std::fputs(describe(setup).c_str(), stdout);
    if (writes) std::printf("scene file: %s\n", options.output.c_str());
    if (!setup.is_usable()) std::printf("no scene is written: nothing was learnt\n");
  }
  return setup.is_usable() ? kDone : kNegative;
}

}  // namespace

Command add_calibrate(CLI::App& app) {
  auto options = std::make_shared<Options>();
  CLI::App& command = *app.add_subcommand(
      "calibrate", "frictions, pressure and registration from measured pushes");
  add_scene_options(command, options->scene);
  command
      .add_option("DATA", options->data,
                  "measured pushes or readings of slip forces (CSV; docs/files.md)")
      ->required();
  command.add_option("-o,--output", options->output, "write the calibrated scene here")
      ->check(is_output());
  command.add_option("--plot", options->plot, "write a picture (SVG) to this file")
      ->check(is_output());
  command
      .add_option("--pressure", options->pressure,
                  "how pressure is described: edge_load, radius (pads larger or smaller "
                  "by k), or none: as in the scene")
      ->check(CLI::IsMember({"edge_load", "radius", "none"}))
      ->capture_default_str();
  command.add_flag("--no-registration", options->no_registration,
                   "the places of pushers are exact");
  command.add_option("--level", options->how.level, "of the intervals, two-sided")
      ->check(in_range(0.5, 0.999))
      ->capture_default_str();
  command
      .add_option("--folds", options->how.folds,
                  "each measurement is predicted once by a fit without its fold")
      ->check(CLI::Range(2, 100))
      ->capture_default_str();
  command.add_option("--seed", options->how.seed, "of the folds and of what is drawn")
      ->check(is_seed())
      ->capture_default_str();
  command
      .add_option("--samples", options->how.samples,
                  "pushes drawn for each measured one, for the factors of intervals")
      ->check(CLI::Range(10, 10000))
      ->capture_default_str();
  options->how.jobs = 0;
  command.add_option("--jobs", options->how.jobs, "threads; default: one per core")
      ->check(CLI::Range(0, 1024));
  command.footer(
      "Example:\n  prehensile calibrate problems/calibration/tip.yaml "
      "problems/calibration/tip_pushes.csv -o tip_calibrated.yaml\n"
      "Exit code: 0 done, 1 nothing was learnt, 2 bad input, 3 internal fault.");
  return [options] { return run(*options); };
}

}  // namespace prehensile::apps
