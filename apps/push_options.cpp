#include "apps/push_options.h"

#include <algorithm>
#include <cstdio>
#include <numbers>

#include <CLI/CLI.hpp>

#include "apps/option_checks.h"
#include "apps/plan_report.h"
#include "apps/table.h"
#include "io/scene_file.h"

namespace prehensile::apps {
namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180.0;

std::string contacts_of(const Model& model) {
  std::string known;
  for (std::size_t i = 0; i < model.contacts.size(); ++i) {
    known += (i == 0 ? "" : ", ") + contact_text(model, static_cast<int>(i));
  }
  return known;
}

}  // namespace

void add_push_options(CLI::App& command, PushOptions& options) {
  command.add_option("--pusher", options.pusher,
                     "name of the pusher; default: the first");
  command.add_option("--face", options.face, "face it touches; default: its first");
  command
      .add_option("--place-mm", options.place_mm,
                  "of the pusher's centre along the face, from the face's centre")
      ->check(in_range(-1e4, 1e4));
  command
      .add_option("--direction-deg", options.direction_deg,
                  "of the push, from the face's normal, counter-clockwise")
      ->check(in_range(-360.0, 360.0));
  command
      .add_option(
          "--at", options.at,
          "pose of the object in the hand: x_mm,y_mm,theta_deg[,roll_deg]; default: the "
          "scene's start")
      ->delimiter(',')
      ->expected(3, 4)
      ->check(in_range(-1e4, 1e4));
}

void add_solver_option(CLI::App& command, std::string& solver) {
  command
      .add_option("--solver", solver,
                  "auto: the exact one that the question needs; exact and closed (limit "
                  "surface): in the pad plane; ipopt: the paper's formulation there; "
                  "spatial; pivoting and spatial-ipopt: polyhedral cones in space")
      ->check(CLI::IsMember(
          {"auto", "exact", "closed", "ipopt", "spatial", "pivoting", "spatial-ipopt"}))
      ->capture_default_str();
}

Solver solver_called(const std::string& word) {
  for (const Solver solver : built_solvers()) {
    if (name(solver) == word) return solver;
  }
  if (word == name(Solver::kChoose)) return Solver::kChoose;
  throw BadInput("--solver " + word + ": not part of this build");
}

int chosen_contact(const Model& model, const PushOptions& options) {
  if (model.contacts.empty()) {
    throw BadInput("pushers: none touches a face of the object: expected at least one");
  }
  std::string pusher = options.pusher;
  if (pusher.empty()) {
    pusher = model.scene.pushers[model.contacts.front().pusher].name;
  }
  const int contact = find_contact(model, pusher, options.face);
  if (contact >= 0) return contact;
  const std::string face = options.face.empty() ? "" : " --face " + options.face;
  throw BadInput("--pusher " + pusher + face +
                 ": no such contact: expected one of: " + contacts_of(model));
}

Grasp chosen_grasp(const Model& model, const PushOptions& options) {
  if (options.at.empty()) return model.scene.start;
  Grasp grasp{{1e-3 * options.at[0], 1e-3 * options.at[1], kRadPerDeg * options.at[2]},
              0.0};
  if (options.at.size() > 3) grasp.psi = kRadPerDeg * options.at[3];
  if (!pads_on_object(model, grasp.X_HO)) {
    throw BadInput("--at " +
                   text("%g,%g,%g", options.at[0], options.at[1], options.at[2]) +
                   ": expected a pose with the pads on the object");
  }
  return grasp;
}

void add_path_options(CLI::App& command, PathOptions& options) {
  command
      .add_option("--kind", options.kind, "slide, pivot, roll, or push: the general one")
      ->check(CLI::IsMember({"slide", "pivot", "roll", "push"}))
      ->capture_default_str();
  command.add_option("--travel-mm", options.travel_mm, "of the pusher (not for pivot)")
      ->check(in_range(-1e4, 1e4))
      ->capture_default_str();
  command.add_option("--turn-deg", options.turn_deg, "of the pusher (pivot and push)")
      ->check(in_range(-3600.0, 3600.0))
      ->capture_default_str();
  command
      .add_option("--bend-deg", options.bend_deg,
                  "by which the direction turns along the push (push only); the negative "
                  "of --turn-deg: a screw")
      ->check(in_range(-3600.0, 3600.0))
      ->capture_default_str();
  command
      .add_option("--tolerance-um", options.tolerance_um,
                  "accepted error of the end pose")
      ->check(in_range(1e-6, 1e3))
      ->capture_default_str();
  command.add_option("--points", options.points, "contact points per pad")
      ->check(CLI::IsMember({1, 4, 8, 16, 32, 64}))
      ->capture_default_str();
}

Push chosen_push(const Model& model, int contact, const PushOptions& options,
                 const PathOptions& path) {
  const double place = 1e-3 * options.place_mm;
  const double travel = 1e-3 * path.travel_mm;
  if (travel < 0.0 && path.kind != "roll") {
    throw BadInput(
        text("--travel-mm %g: expected at least 0 (turn the direction instead)",
             path.travel_mm));
  }
  const double turn = kRadPerDeg * path.turn_deg;
  const Vec2 e = chosen_direction(model, contact, options);
  if (path.kind == "slide") {
    return Slide{.contact = contact, .place = place, .e = e, .travel = travel};
  }
  if (path.kind == "pivot") {
    return Pivot{.contact = contact, .place = place, .turn = turn};
  }
  if (path.kind == "roll") return Roll{.contact = contact, .travel = travel};
  return LinearPush{.contact = contact,
                    .place = place,
                    .e = e,
                    .travel = travel,
                    .turn = turn,
                    .bend = kRadPerDeg * path.bend_deg};
}

void note_pad_plane(const Model& model, const char* what) {
  const bool any = std::any_of(
      model.contacts.begin(), model.contacts.end(),
      [&model](const PushContact& contact) { return model.push_needs_space(contact); });
  if (any) std::fprintf(stderr, "note: %s\n", what);
}

Vec2 chosen_direction(const Model& model, int contact, const PushOptions& options) {
  return rotated(kRadPerDeg * options.direction_deg, model.contacts[contact].n);
}

}  // namespace prehensile::apps
