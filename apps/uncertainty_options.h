/// The option --vary: a box of uncertainty on the command line.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "primitives/uncertainty.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace prehensile::apps {

/// Adds --vary name=width,... to a command.
CLI::Option& add_vary_option(CLI::App& command, std::vector<std::string>& entries);

/// "friction=0.2" is a share of the nominal value, "friction=0.05abs" a number in the
/// unit of the field; lengths and angles are always absolute: place_mm, travel_mm,
/// direction_deg, grasp_mm, grasp_deg, tilt_deg, centre_of_mass_mm. Empty: `otherwise`.
/// Throws BadInput.
UncertaintyBox parse_box(const std::vector<std::string>& entries,
                         const UncertaintyBox& otherwise);

/// "friction +-20 %, place +-1 mm"
std::string box_text(const UncertaintyBox& box);
nlohmann::ordered_json to_json(const UncertaintyBox& box);

}  // namespace prehensile::apps
