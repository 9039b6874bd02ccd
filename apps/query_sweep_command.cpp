#include <algorithm>
#include <cstdio>
#include <memory>

#include <CLI/CLI.hpp>

#include "apps/commands.h"
#include "apps/option_checks.h"
#include "apps/parallel.h"
#include "apps/sweep_report.h"
#include "apps/table.h"
#include "io/plan_file.h"

namespace prehensile::apps {
namespace {

struct Options {
  SceneOptions scene;
  SweepQuestion question;
  std::string of = "instant";
  std::vector<std::string> over;
  std::vector<std::string> show;
  int jobs = 0;
  std::string csv;
  std::string plot;
};

std::vector<int> shown_columns(const Options& options, SweepOf of) {
  const auto& columns = sweep_columns(of);
  std::string known;
  for (const SweepColumn& column : columns) {
    known += known.empty() ? "" : ", ";
    known += column.key;
  }
  std::vector<int> shown;
  for (const std::string& key : options.show) {
    const auto found =
        std::find_if(columns.begin(), columns.end(),
                     [&](const SweepColumn& column) { return key == column.key; });
    if (found == columns.end()) {
      throw BadInput("--show " + key + ": expected one of: " + known);
    }
    shown.push_back(static_cast<int>(found - columns.begin()));
  }
  if (shown.empty()) shown.push_back(0);
  return shown;
}

int run(const Options& options) {
  Sweep sweep;
  sweep.question = options.question;
  sweep.question.of = options.of == "instant" ? SweepOf::kInstant
                      : options.of == "push"  ? SweepOf::kPush
                                              : SweepOf::kRoll;
  const std::vector<int> shown = shown_columns(options, sweep.question.of);
  std::size_t rows = 1;
  for (const std::string& over : options.over) {
    sweep.fields.push_back(parse_swept_field(over));
    rows *= sweep.fields.back().values.size();
  }
  if (rows > 1000000) {
    throw BadInput(text("--over: %zu rows: expected at most 1000000", rows));
  }
  const SceneFile file = read_scene(options.scene.file, options.scene.overrides);
  run_sweep(sweep, file, options.scene, number_of_jobs(options.jobs));
  if (!options.csv.empty()) write_atomically(options.csv, to_csv(sweep));
  if (!options.plot.empty()) {
    write_atomically(options.plot, to_svg(sweep, shown, file.scene.name));
  }
  const std::string out =
      options.scene.json ? to_json(sweep).dump(2) + '\n' : describe(sweep, shown);
  std::fputs(out.c_str(), stdout);
  const bool any = std::any_of(sweep.rows.begin(), sweep.rows.end(),
                               [](const SweepRow& row) { return row.answered; });
  return any ? kDone : kNegative;
}

}  // namespace

Command add_query_sweep(CLI::App& query) {
  auto options = std::make_shared<Options>();
  CLI::App& command = *query.add_subcommand(
      "sweep", "an instant, a push or a roll over ranges of values");
  add_scene_options(command, options->scene);
  SweepQuestion& question = options->question;
  add_push_options(command, question.push);
  add_path_options(command, question.path);
  command
      .add_option("--over", options->over,
                  "path=from:to:count[:log] or path=value,value,...; one or two; any "
                  "field of the scene, or place_mm, direction_deg, speed_mm_s, "
                  "turn_deg_s, height_mm, rise_mm_s, travel_mm, turn_deg")
      ->required()
      ->expected(1, 2)
      ->allow_extra_args(false);
  command.add_option("--of", options->of, "what is asked for every row")
      ->check(CLI::IsMember({"instant", "push", "roll"}))
      ->capture_default_str();
  command.add_option("--show", options->show, "columns of table and picture")
      ->delimiter(',');
  command
      .add_option("--speed-mm-s", question.speed_mm_s,
                  "of the pusher (instant) or support (roll)")
      ->check(in_range(0.0, 1e6))
      ->capture_default_str();
  command
      .add_option("--turn-deg-s", question.turn_deg_s,
                  "of the pusher about the finger axis (instant)")
      ->check(in_range(-1e6, 1e6));
  command
      .add_option("--height-mm", question.height_mm,
                  "of the pusher off the mid-plane (instant); default: as in the scene")
      ->check(in_range(-1e4, 1e4));
  command
      .add_option("--rise-mm-s", question.rise_mm_s,
                  "of the pusher along the closing direction (instant)")
      ->check(in_range(-1e6, 1e6));
  add_solver_option(command, question.solver);
  command.add_option("--jobs", options->jobs, "threads; default: one per core")
      ->check(CLI::Range(0, 1024));
  command.add_option("--csv", options->csv, "write the rows to this file")
      ->check(is_output());
  command.add_option("--plot", options->plot, "write a picture (SVG) to this file")
      ->check(is_output());
  command.footer(
      "Example:\n  prehensile query sweep problems/paper/slide.yaml --over "
      "gripper.grip_force=2:40:20 --plot force.svg");
  return [options] { return run(*options); };
}

}  // namespace prehensile::apps
