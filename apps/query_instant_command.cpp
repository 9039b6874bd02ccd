#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>

#include <CLI/CLI.hpp>

#include "apps/commands.h"
#include "apps/instant_report.h"
#include "apps/plan_report.h"
#include "apps/push_options.h"
#include "apps/solver_comparison.h"
#include "apps/spatial_report.h"
#include "apps/table.h"
#include "io/scene_file.h"
#include "mechanics/planar_instant.h"
#include "mechanics/reference.h"
#include "mechanics/spatial_model.h"
#include "primitives/roll.h"

namespace prehensile::apps {
namespace {

struct Options {
  SceneOptions scene;
  PushOptions push;
  double speed_mm_s = 10.0;
  double turn_deg_s = 0.0;
  double acceleration = 0.0;
  std::string solver = "exact";
  int generators = 8;
  int points = 16;
  double height_mm = 0.0;
  double rise_mm_s = 0.0;
  bool compare = false;
  bool sensitivity = false;
  bool roll = false;

  bool in_plane() const { return height_mm == 0.0 && rise_mm_s == 0.0; }
};

template <typename Report>
int print(const Report& report, bool json) {
  if (json) {
    std::printf("%s\n", to_json(report).dump(2).c_str());
  } else {
    std::fputs(describe(report).c_str(), stdout);
  }
  return usable(report.instant.status) ? kDone : kNegative;
}

int ask_roll(const Options& options, const Model& model, int contact) {
  const Grasp grasp = chosen_grasp(model, options.push);
  const RollSection section = roll_section(model, contact, grasp);
  if (!section.possible) {
    throw BadInput("--roll: " + contact_text(model, contact) + ": " +
                   std::string(section.reason));
  }
  if (options.speed_mm_s == 0.0) {
    throw BadInput("--speed-mm-s 0: expected a support that moves");
  }
  const CrossSectionDrive drive{.mu = model.contacts[contact].mu,
                                .sheet_rate = 1e-3 * options.speed_mm_s,
                                .weight = section.weight};
  RollReport report;
  report.question =
      text("roll by %s, support moving at %.3g mm/s along the closing direction",
           contact_text(model, contact).c_str(), options.speed_mm_s);
  report.instant = solve_cross_section(*model.cross_section, drive);
  report.residual = cross_section_residual(*model.cross_section, drive, report.instant);
  report.threshold =
      rolling_threshold(*model.cross_section, drive.sheet_rate, drive.weight);
  return print(report, options.scene.json);
}

/// Twist of the pusher in H: the direction is given in O, the rate of turn about the
/// finger axis.
PlanarTwist pusher_rate(const Options& options, const Grasp& grasp, const Vec2& e_O) {
  const double turn = std::numbers::pi / 180.0 * options.turn_deg_s;
  const Vec2 v = 1e-3 * options.speed_mm_s * rotated(grasp.X_HO.theta, e_O);
  PlanarTwist V_HP(v.x(), v.y(), turn);
  if (options.acceleration > 0.0) {
    V_HP *= options.acceleration / (1e-3 * options.speed_mm_s);
  }
  return V_HP;
}

void solve(const Options& options, const Model& model, InstantReport& report) {
  if (options.solver == "closed") {
    report.instant = solve_limit_surface(model.surface(), report.grasp.w_g, report.drive);
    report.certificate_worst = limit_surface_residual(model.surface(), report.grasp.w_g,
                                                      report.drive, report.instant);
    return;
  }
  report.instant = options.solver == "ipopt"
                       ? solve_reference(report.grasp, report.drive,
                                         {.generators = options.generators})
                       : solve_planar(report.grasp, report.drive);
  report.certificate = certify(report.grasp, report.drive, report.instant);
  report.certificate_worst = report.certificate.worst;
}

void differentiate(const Options& options, const Model& model, int contact,
                   const Grasp& grasp, InstantReport& report) {
  const DifferentiatedInstant differentiated(report.grasp, report.drive, report.instant);
  report.mode_slack = differentiated.mode_slack();
  for (int i = 0; i < static_cast<int>(InstantParameter::kCount); ++i) {
    report.sensitivities.push_back(differentiated.along(
        variation_of(model, model.contacts[contact], 1e-3 * options.push.place_mm,
                     grasp.X_HO, report.drive.V_HP, static_cast<InstantParameter>(i))));
  }
}

/// Refuses combinations that ask for what a solver cannot answer.
void check_options(const Options& options) {
  const bool spatial = options.solver == "spatial";
  if (options.acceleration > 0.0 &&
      (options.solver == "closed" || spatial || options.compare)) {
    throw BadInput(
        "--acceleration: expected --solver exact or ipopt: the others are asked in the "
        "quasi-static limit");
  }
  if (options.sensitivity &&
      (options.solver != "exact" || options.compare || options.acceleration > 0.0)) {
    throw BadInput("--sensitivity: expected --solver exact in the quasi-static limit");
  }
  if (options.speed_mm_s == 0.0 && options.turn_deg_s == 0.0 &&
      options.rise_mm_s == 0.0) {
    throw BadInput(
        "--speed-mm-s 0: expected a pusher that moves: a speed, --turn-deg-s or "
        "--rise-mm-s");
  }
  if (options.acceleration > 0.0 && options.speed_mm_s == 0.0) {
    throw BadInput("--speed-mm-s 0: expected more than 0 with --acceleration");
  }
  if (!options.in_plane() && !spatial && !options.compare) {
    throw BadInput(
        "--height-mm, --rise-mm-s: expected --solver spatial or --compare: the others "
        "know the pad plane only");
  }
}

std::string question_text(const Options& options, const Model& model, int contact,
                          const Grasp& grasp) {
  std::string out = text("%s at place %.2f mm", contact_text(model, contact).c_str(),
                         options.push.place_mm);
  if (options.height_mm != 0.0) {
    out += text(", %.2f mm off the mid-plane", options.height_mm);
  }
  out += text(", direction %.2f deg from its normal, ", options.push.direction_deg);
  out += options.acceleration > 0.0
             ? text("acceleration %.4g m/s^2", options.acceleration)
             : text("%.4g mm/s", options.speed_mm_s);
  if (options.rise_mm_s != 0.0) {
    out += text(" and %.4g mm/s along the closing direction", options.rise_mm_s);
  }
  return out + text(", turning %.4g deg/s; object at ", options.turn_deg_s) +
         pose_text(model, grasp);
}

SpatialProblem spatial_question(const Options& options, const Model& model, int contact,
                                const Grasp& grasp, const PlanarTwist& V_HP) {
  const double most = to_mm(model.half_thickness);
  if (std::abs(options.height_mm) > most) {
    throw BadInput(text("--height-mm %g: expected -%g to %g, where the object is",
                        options.height_mm, most, most));
  }
  const SpatialProblem problem = spatial_problem_at(
      model, model.contacts[contact], 1e-3 * options.push.place_mm, grasp.X_HO, V_HP,
      {.height = 1e-3 * options.height_mm, .rate = 1e-3 * options.rise_mm_s});
  if (problem.count == 0) {
    throw BadInput(
        text("--points %d: expected fewer: both pads and the pusher may have %d points "
             "together, and the pads must lie on the object",
             options.points, SpatialProblem::kMaxPoints));
  }
  return problem;
}

int run(const Options& options) {
  const SceneFile file = read_scene(options.scene.file, options.scene.overrides);
  const Model model = prepare(file.scene, {.points_per_pad = options.points});
  const int contact = chosen_contact(model, options.push);
  if (options.roll) return ask_roll(options, model, contact);
  check_options(options);
  const Grasp grasp = chosen_grasp(model, options.push);
  const Vec2 e = chosen_direction(model, contact, options.push);
  const PlanarTwist V_HP = pusher_rate(options, grasp, e);
  const std::string question = question_text(options, model, contact, grasp);
  if (options.solver == "spatial" && !options.compare) {
    SpatialReport report;
    report.question = question;
    report.problem = spatial_question(options, model, contact, grasp, V_HP);
    report.instant = solve_spatial(report.problem);
    report.certificate = certify(report.problem, report.instant);
    return print(report, options.scene.json);
  }
  InstantReport report;
  report.solver = options.solver;
  report.question = question;
  report.grasp = grasp_at(model, grasp.X_HO, model.contacts[contact].g_O);
  if (options.acceleration > 0.0) add_inertia(model, grasp.X_HO, report.grasp);
  report.drive =
      drive_at(model.contacts[contact], 1e-3 * options.push.place_mm, grasp.X_HO, V_HP);
  if (options.compare) {
    const std::vector<SolverAnswer> answers = compare_solvers(
        {.in_plane = options.in_plane(),
         .surface = model.surface(),
         .grasp = report.grasp,
         .drive = report.drive,
         .spatial = spatial_question(options, model, contact, grasp, V_HP),
         .generators = options.generators});
    const std::string out = options.scene.json ? to_json(answers).dump(2) + '\n'
                                               : question + '\n' + describe(answers);
    std::fputs(out.c_str(), stdout);
    return kDone;
  }
  solve(options, model, report);
  if (options.sensitivity) differentiate(options, model, contact, grasp, report);
  return print(report, options.scene.json);
}

}  // namespace

Command add_query_instant(CLI::App& query) {
  auto options = std::make_shared<Options>();
  CLI::App& command = *query.add_subcommand(
      "instant", "least force that breaks the grasp, and how the object then moves");
  add_scene_options(command, options->scene);
  add_push_options(command, options->push);
  command
      .add_option("--speed-mm-s", options->speed_mm_s, "of the pusher at the finger axis")
      ->check(CLI::Range(0.0, 1e6))
      ->capture_default_str();
  command
      .add_option("--turn-deg-s", options->turn_deg_s,
                  "of the pusher about the finger axis")
      ->check(CLI::Range(-1e6, 1e6));
  command
      .add_option("--acceleration", options->acceleration,
                  "[m/s^2] of the pusher from rest, instead of the quasi-static limit")
      ->check(CLI::Range(0.0, 1e6));
  command
      .add_option("--solver", options->solver,
                  "exact, closed (limit surface), ipopt, or spatial")
      ->check(CLI::IsMember({"exact", "closed", "ipopt", "spatial"}))
      ->capture_default_str();
  command
      .add_option("--generators", options->generators,
                  "friction generators g for ipopt and for pivoting")
      ->check(CLI::IsMember({4, 8, 16, 32, 64}))
      ->capture_default_str();
  command.add_option("--points", options->points, "contact points per pad")
      ->check(CLI::IsMember({1, 4, 8, 16, 32, 64}))
      ->capture_default_str();
  command
      .add_option("--height-mm", options->height_mm,
                  "of the pusher along the closing direction, from the mid-plane of the "
                  "object; spatial solver")
      ->check(CLI::Range(-1e4, 1e4));
  command
      .add_option("--rise-mm-s", options->rise_mm_s,
                  "of the pusher along the closing direction; spatial solver")
      ->check(CLI::Range(-1e6, 1e6));
  command.add_flag("--sensitivity", options->sensitivity,
                   "how the answer changes with frictions, grip force, mass, place and "
                   "direction");
  command.add_flag("--compare", options->compare,
                   "all solvers of this build side by side");
  command.add_flag("--roll", options->roll,
                   "move the pusher along the closing direction");
  command.footer(
      "Example:\n  prehensile query instant problems/paper/slide.yaml --solver exact");
  return [options] { return run(*options); };
}

}  // namespace prehensile::apps
