/// What is looked at: pages, pictures and exports of plans and pushes. Builds without the
/// viewer refuse.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/scene_file.h"
#include "planner/plan.h"
#include "scene/object_surface.h"

namespace CLI {
class App;
}

namespace prehensile::apps {

/// One plan to show. `is_plan` false: a single push, or a scene alone, which states
/// nothing that a replay could confirm.
struct Shown {
  Model model;
  Plan plan;
  bool is_plan = true;
  std::vector<Grasp> outcomes;           ///< ends of sampled members of the uncertainty
  std::optional<ObjectSurface> surface;  ///< of an object from a mesh, where it is known
  std::string file;  ///< tells it apart from another one of this scene; may be empty
};

/// --view FILE, of a command that makes a plan or a push.
void add_view_option(CLI::App& command, std::string& file);

/// Throws BadInput where `file` is set and this build has no viewer: before any work.
void check_view_option(const std::string& file);

/// Where the files go; empty: not written.
struct ViewFiles {
  std::string page;    ///< HTML
  std::string frames;  ///< SVG: key frames of the first plan
  std::string glb;     ///< animated GLB of the first plan
  std::string mjcf;    ///< MJCF of the first plan
};

/// Throws BadInput for files that this build cannot write: before any work.
void check_view_files(const ViewFiles& files);

/// Writes the files. False if a plan does not stand up to its replay.
bool write_view(const ViewFiles& files, const std::vector<Shown>& shown);

/// Writes a page that says why nothing is shown, where one is wanted and no file stands:
/// what is there may be a page that somebody needs.
void write_refusal(const ViewFiles& files, const std::string& why);

}  // namespace prehensile::apps
