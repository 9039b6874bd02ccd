/// Which planner searches, and how: the options of the command line that say it.
#pragma once

#include <string>
#include <vector>

#include "planner/planner.h"

namespace CLI {
class App;
}

namespace prehensile::apps {

struct PlannerChoice {
  std::string planner = PlanOptions{}.planner;
  std::vector<std::string> settings;  ///< name=value
};

/// Adds --planner, --planner-option and --list-planners, which prints what there is and
/// ends the program.
void add_planner_options(CLI::App& command, PlannerChoice& choice);

/// Puts the choice into the options of a plan. Throws BadInput that says what is expected
/// for an unknown planner or option, or a value that is no number or out of range.
void set_planner(const PlannerChoice& choice, PlanOptions& options);

}  // namespace prehensile::apps
