/// A calibrated set-up as text, JSON and picture.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "apps/calibrated_setup.h"

namespace prehensile::apps {

std::string describe(const CalibratedSetup& setup);
nlohmann::ordered_json to_json(const CalibratedSetup& setup);

/// Residuals before and after, what was predicted against what was measured, and the
/// profile of each parameter.
std::string to_svg(const CalibratedSetup& setup);

/// "a real calibration", ...: what so many measured pushes are worth.
std::string worth_of(const CalibratedSetup& setup);

/// Factor to the unit in which a parameter is shown, and the unit.
struct ShownUnit {
  double factor = 1.0;
  const char* unit = "";
};
ShownUnit shown_unit(Target target);

}  // namespace prehensile::apps
