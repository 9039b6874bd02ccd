/// Which contact, where, and from which pose: shared by the queries about one push.
#pragma once

#include <string>
#include <vector>

#include "apps/commands.h"
#include "mechanics/solvers.h"
#include "primitives/push.h"

namespace prehensile::apps {

struct PushOptions {
  std::string pusher;  ///< empty: the first of the scene
  std::string face;    ///< empty: the first that it may touch
  double place_mm = 0.0;
  double direction_deg = 0.0;  ///< from the normal of the face, positive towards t
  std::vector<double> at;      ///< x mm, y mm, theta deg[, roll deg]; empty: the start
};
void add_push_options(CLI::App& command, PushOptions& options);

/// --solver, of an instant.
void add_solver_option(CLI::App& command, std::string& solver);

/// By its name; throws BadInput for one that this build lacks.
Solver solver_called(const std::string& word);

/// Index in Model::contacts; throws BadInput naming what exists.
int chosen_contact(const Model& model, const PushOptions& options);
Grasp chosen_grasp(const Model& model, const PushOptions& options);

/// Says on stderr which part of the answer is one of the pad plane, where the scene needs
/// the spatial mechanics: nothing for scenes that do not.
void note_pad_plane(const Model& model, const char* what);

/// Unit direction in O.
Vec2 chosen_direction(const Model& model, int contact, const PushOptions& options);

/// How far a push goes, and how it is followed.
struct PathOptions {
  std::string kind = "push";
  double travel_mm = 10.0;
  double turn_deg = 0.0;
  double bend_deg = 0.0;
  double tolerance_um = 1.0;
  int points = 16;
};
void add_path_options(CLI::App& command, PathOptions& options);

/// Throws BadInput for a path that the kind does not allow.
Push chosen_push(const Model& model, int contact, const PushOptions& options,
                 const PathOptions& path);

}  // namespace prehensile::apps
