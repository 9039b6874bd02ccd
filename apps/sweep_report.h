/// Sweeps as text, JSON, CSV and picture. `shown` are indices of columns, at least one.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "apps/sweep.h"

namespace prehensile::apps {

std::string describe(const Sweep& sweep, const std::vector<int>& shown);
nlohmann::ordered_json to_json(const Sweep& sweep);

/// One line per row, numbers in full; empty where there is none.
std::string to_csv(const Sweep& sweep);

/// Over one field, or over a second one of few values, lines; else a map of the first
/// column shown.
std::string to_svg(const Sweep& sweep, const std::vector<int>& shown,
                   const std::string& title);

}  // namespace prehensile::apps
