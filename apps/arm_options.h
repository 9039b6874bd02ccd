/// The options of `plan` that write what the robot has to do.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/arm_file.h"

namespace CLI {
class App;
}

namespace prehensile::apps {

struct ArmOptions {
  std::vector<std::string> files;  ///< format by extension: see arm_format
  ArmLimits limits;
  double push_speed_mm = 20.0, approach_speed_mm = 30.0, transit_speed_mm = 100.0;
  double turn_speed_deg = 30.0;
  std::optional<double> clearance_mm;  ///< unset: the approach of the scene's obstacles,
                                       ///< or that of ArmLimits
};
void add_arm_options(CLI::App& command, ArmOptions& options);

/// Throws BadInput for what no plan of this scene could make right, before anything is
/// planned: a file whose format is unknown, limits that do not suit the scene.
void check_arm_options(const ArmOptions& options, const Scene& scene);

struct ArmTexts {
  struct File {
    std::string name, text;
  };
  std::vector<File> files;
  std::string report;  ///< for people, a line for each
};

/// What goes into the files. Throws BadInput for a motion of too many samples.
ArmTexts arm_texts(const ArmOptions& options, const Model& model, const PlanFile& plan);

}  // namespace prehensile::apps
