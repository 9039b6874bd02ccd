#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>
#include <optional>

#include <CLI/CLI.hpp>

#include "apps/commands.h"
#include "apps/instant_report.h"
#include "apps/option_checks.h"
#include "apps/plan_report.h"
#include "apps/push_options.h"
#include "apps/solver_comparison.h"
#include "apps/spatial_report.h"
#include "apps/table.h"
#include "io/scene_file.h"
#include "mechanics/solvers.h"
#include "mechanics/spatial_sensitivity.h"
#include "primitives/roll.h"

namespace prehensile::apps {
namespace {

struct Options {
  SceneOptions scene;
  PushOptions push;
  double speed_mm_s = 10.0;
  double turn_deg_s = 0.0;
  double rise_mm_s = 0.0;
  std::vector<double> tilt_deg_s;
  std::optional<double> height_mm;
  double acceleration = 0.0;
  std::string solver = "auto";
  int generators = 8;
  int points = 16;
  bool compare = false;
  bool sensitivity = false;
  bool probe = false;
  bool rigid_limit = false;
  bool roll = false;

  bool moves() const {
    return speed_mm_s != 0.0 || turn_deg_s != 0.0 || rise_mm_s != 0.0 ||
           !tilt_deg_s.empty();
  }
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

/// Twist of the pusher in H: the direction is given in O, rates of turn about the finger
/// axis. With an acceleration the same motion begins from rest.
SpatialTwist pusher_rate(const Options& options, const Grasp& grasp, const Vec2& e_O) {
  constexpr double kRadPerDeg = std::numbers::pi / 180.0;
  const Vec2 v = 1e-3 * options.speed_mm_s * rotated(grasp.X_HO.theta, e_O);
  SpatialTwist V_HP;
  V_HP << v.x(), v.y(), 1e-3 * options.rise_mm_s, 0.0, 0.0,
      kRadPerDeg * options.turn_deg_s;
  if (!options.tilt_deg_s.empty()) {
    V_HP[3] = kRadPerDeg * options.tilt_deg_s[0];
    V_HP[4] = kRadPerDeg * options.tilt_deg_s[1];
  }
  if (options.acceleration > 0.0) {
    V_HP *= options.acceleration / (1e-3 * options.speed_mm_s);
  }
  return V_HP;
}

/// Refuses combinations that ask for what nothing can answer.
void check_options(const Options& options) {
  if (!options.moves()) {
    throw BadInput(
        "--speed-mm-s 0: expected a pusher that moves: a speed, --turn-deg-s, "
        "--rise-mm-s or --tilt-deg-s");
  }
  if (options.acceleration > 0.0 && options.speed_mm_s == 0.0) {
    throw BadInput("--speed-mm-s 0: expected more than 0 with --acceleration");
  }
  if (options.sensitivity && (options.compare || options.acceleration > 0.0)) {
    throw BadInput("--sensitivity: expected one solver in the quasi-static limit");
  }
}

std::string question_text(const Options& options, const Model& model, int contact,
                          const Grasp& grasp) {
  std::string out = text("%s at place %.2f mm", contact_text(model, contact).c_str(),
                         options.push.place_mm);
  const PushContact& touched = model.contacts[contact];
  const double height =
      options.height_mm.value_or(to_mm(0.5 * (touched.z_low + touched.z_high)));
  if (height != 0.0) out += text(", %.2f mm off the mid-plane", height);
  out += text(", direction %.2f deg from its normal, ", options.push.direction_deg);
  out += options.acceleration > 0.0
             ? text("acceleration %.4g m/s^2", options.acceleration)
             : text("%.4g mm/s", options.speed_mm_s);
  if (options.rise_mm_s != 0.0) {
    out += text(" and %.4g mm/s along the closing direction", options.rise_mm_s);
  }
  out += text(", turning %.4g deg/s", options.turn_deg_s);
  if (!options.tilt_deg_s.empty()) {
    out += text(", tilting (%.4g, %.4g) deg/s", options.tilt_deg_s[0],
                options.tilt_deg_s[1]);
  }
  return out + "; object at " + pose_text(model, grasp);
}

/// The question, in the terms of a scene.
struct Asked {
  const Model* model = nullptr;
  int contact_index = 0;
  double place = 0.0;  ///< [m]
  PlanarPose X_HO;
  SpatialTwist V_HP = SpatialTwist::Zero();
  SpatialQuestionOptions how;

  const PushContact& contact() const {
    return model->contacts[static_cast<std::size_t>(contact_index)];
  }
};

Asked asked_of(const Options& options, const Model& model, int contact,
               const Grasp& grasp) {
  SpatialQuestionOptions how{.from_rest = options.acceleration > 0.0};
  if (options.height_mm) {
    const Face& face = model.faces[model.contacts[contact].face];
    const double low = to_mm(face.z_low);
    const double high = to_mm(face.z_high);
    if (*options.height_mm < low || *options.height_mm > high) {
      throw BadInput(text("--height-mm %g: expected %g to %g, where the object is",
                          *options.height_mm, low, high));
    }
    how.height = 1e-3 * *options.height_mm;
  }
  const Vec2 e = chosen_direction(model, contact, options.push);
  return {&model,
          contact,
          1e-3 * options.push.place_mm,
          grasp.X_HO,
          pusher_rate(options, grasp, e),
          how};
}

InstantReport planar_report(const InstantQuestion& question,
                            const PlanarInstant& instant) {
  InstantReport report;
  report.grasp = question.grasp;
  report.drive = question.drive;
  report.instant = instant;
  if (instant.finger_count > 0) {
    report.certificate = certify(report.grasp, report.drive, report.instant);
  }
  return report;
}

/// Derivatives of a planar answer to all parameters.
Sensitivities planar_sensitivities(const Asked& asked, const InstantReport& report) {
  const DifferentiatedInstant differentiated(report.grasp, report.drive, report.instant);
  Sensitivities changes{.mode_slack = differentiated.mode_slack()};
  for (int i = 0; i < static_cast<int>(InstantParameter::kCount); ++i) {
    const PlanarSensitivity change = differentiated.along(
        variation_of(*asked.model, asked.contact(), asked.place, asked.X_HO,
                     report.drive.V_HP, static_cast<InstantParameter>(i)));
    SpatialWrench w_push = SpatialWrench::Zero();
    w_push << change.w_push[0], change.w_push[1], 0.0, 0.0, 0.0, change.w_push[2];
    changes.rows.push_back({change.push_force, in_space(change.V_HO), w_push});
  }
  return changes;
}

Sensitivities spatial_sensitivities(const Asked& asked, const SpatialProblem& problem) {
  const SpatialInstant sharp = solve_spatial(problem, {.tolerance = 1e-11});
  const DifferentiatedSpatialInstant differentiated(problem, sharp);
  Sensitivities changes{.mode_slack = differentiated.mode_slack()};
  for (int i = 0; i < static_cast<int>(InstantParameter::kCount); ++i) {
    const SpatialSensitivity change = differentiated.along(
        spatial_variation_of(*asked.model, asked.contact(), asked.place, asked.X_HO,
                             asked.V_HP, asked.how, static_cast<InstantParameter>(i)));
    changes.rows.push_back({change.push_force, change.V_HO, change.w_push});
  }
  return changes;
}

/// No solver is needed to see that nothing balances.
int fall(const Options& options, const std::string& question_words) {
  const char* why = "the jaws cannot carry gravity along the closing direction";
  if (options.scene.json) {
    const nlohmann::ordered_json out = {
        {"question", question_words}, {"status", "dynamic"}, {"meaning", why}};
    std::printf("%s\n", out.dump(2).c_str());
  } else {
    std::printf("%s\ndynamic: %s: the object falls\n", question_words.c_str(), why);
  }
  return kNegative;
}

/// One solver's answer, as that solver can tell it.
int answer_one(const Options& options, const Asked& asked,
               const std::string& question_words, const InstantQuestion& question,
               const SolverOptions& how) {
  if (question.falls) return fall(options, question_words);
  const SolverChoice choice = chosen_solver(question);
  const bool chose = how.solver == Solver::kChoose;
  const Solver solver = chose ? choice.solver : how.solver;
  if (const char* why = refusal(solver, question)) {
    throw BadInput("--solver " + std::string(name(solver)) + ": " + why +
                   (solver == Solver::kSpatial ? "" : ": expected auto or spatial"));
  }
  if (options.sensitivity && solver != Solver::kPlanar && solver != Solver::kSpatial) {
    std::string message = "--sensitivity: expected an exact solver, not ";
    throw BadInput(message += name(solver));
  }
  const InstantAnswer answer = solve(question, how);
  if (const auto* planar = std::get_if<PlanarInstant>(&answer.detail)) {
    InstantReport report = planar_report(question, *planar);
    if (options.sensitivity) report.sensitivities = planar_sensitivities(asked, report);
    report.question = question_words;
    report.solver = name(solver);
    report.why_this_solver = chose ? choice.why : "";
    report.certificate_worst = answer.certificate;
    return print(report, options.scene.json);
  }
  if (const auto* spatial = std::get_if<SpatialInstant>(&answer.detail)) {
    SpatialReport report;
    report.question = question_words;
    report.why_this_solver = chose ? choice.why : "";
    report.problem =
        how.rigid_limit ? rigid_limit_of(question.spatial) : question.spatial;
    report.instant = *spatial;
    report.probed = how.probe_multiplicity;
    if (options.sensitivity) {
      report.sensitivities = spatial_sensitivities(asked, report.problem);
    }
    report.certificate = certify(report.problem, report.instant);
    return print(report, options.scene.json);
  }
  const std::vector<TimedAnswer> row = {timed_answer(question, how)};
  const std::string out = options.scene.json ? to_json(row).dump(2) + '\n'
                                             : question_words + '\n' + describe(row);
  std::fputs(out.c_str(), stdout);
  return usable(answer.status) ? kDone : kNegative;
}

int run(const Options& options) {
  const SceneFile file = read_scene(options.scene.file, options.scene.overrides);
  const Model model =
      prepare(file.scene, {.points_per_pad = options.points, .other_grips = false});
  const int contact = chosen_contact(model, options.push);
  if (options.roll) return ask_roll(options, model, contact);
  check_options(options);
  const Grasp grasp = chosen_grasp(model, options.push);
  const Asked asked = asked_of(options, model, contact, grasp);
  const InstantQuestion question =
      question_at(model, asked.contact(), asked.place, asked.X_HO, asked.V_HP, asked.how);
  const std::string words = question_text(options, model, contact, grasp);
  const SolverOptions how{.solver = solver_called(options.solver),
                          .generators = options.generators,
                          .probe_multiplicity = options.probe,
                          .rigid_limit = options.rigid_limit};
  if (!options.compare) {
    return answer_one(options, asked, words, question, how);
  }
  const std::vector<TimedAnswer> answers = compare_solvers(question, how);
  const std::string out = options.scene.json ? to_json(answers).dump(2) + '\n'
                                             : words + '\n' + describe(answers);
  std::fputs(out.c_str(), stdout);
  return kDone;
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
      ->check(in_range(0.0, 1e6))
      ->capture_default_str();
  command
      .add_option("--turn-deg-s", options->turn_deg_s,
                  "of the pusher about the finger axis")
      ->check(in_range(-1e6, 1e6));
  command
      .add_option("--acceleration", options->acceleration,
                  "[m/s^2] of the pusher from rest, instead of the quasi-static limit")
      ->check(in_range(0.0, 1e6));
  add_solver_option(command, options->solver);
  command
      .add_option("--generators", options->generators,
                  "friction generators g of polyhedral cones")
      ->check(CLI::IsMember({4, 8, 16, 32, 64}))
      ->capture_default_str();
  command.add_option("--points", options->points, "contact points per pad")
      ->check(CLI::IsMember({1, 4, 8, 16, 32, 64}))
      ->capture_default_str();
  command
      .add_option("--height-mm", options->height_mm,
                  "of the pusher along the closing direction, from the mid-plane of the "
                  "object; default: as in the scene")
      ->check(in_range(-1e4, 1e4));
  command
      .add_option("--rise-mm-s", options->rise_mm_s,
                  "of the pusher along the closing direction")
      ->check(in_range(-1e6, 1e6));
  command
      .add_option("--tilt-deg-s", options->tilt_deg_s,
                  "of the pusher about x,y of the hand, through the finger axis")
      ->delimiter(',')
      ->expected(2)
      ->check(in_range(-1e6, 1e6));
  command.add_flag("--probe", options->probe, "look for a second motion");
  command.add_flag("--rigid-limit", options->rigid_limit,
                   "pads as stiff as the spatial solver can resolve");
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
