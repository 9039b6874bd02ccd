#include "apps/uncertainty_options.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <set>

#include <CLI/CLI.hpp>

#include "apps/table.h"
#include "io/scene_file.h"

namespace prehensile::apps {
namespace {

struct Entry {
  const char* key;
  Unknown first;
  int count;          ///< coordinates of this width, from the first on
  double unit;        ///< SI units per unit of the option
  const char* shown;  ///< unit in reports
};

constexpr double kDegree = std::numbers::pi / 180.0;

constexpr std::array<Entry, 12> kEntries = {{
    {"friction", Unknown::kFriction, 1, 1.0, ""},
    {"finger_friction", Unknown::kFingerFriction, 1, 1.0, ""},
    {"grip_force", Unknown::kGripForce, 1, 1.0, "N"},
    {"mass", Unknown::kMass, 1, 1.0, "kg"},
    {"torque_radius", Unknown::kTorqueRadius, 1, 1.0, "m"},
    {"centre_of_mass_mm", Unknown::kCentreOfMassX, 2, 1e-3, "mm"},
    {"place_mm", Unknown::kPlace, 1, 1e-3, "mm"},
    {"travel_mm", Unknown::kTravel, 1, 1e-3, "mm"},
    {"direction_deg", Unknown::kDirection, 1, kDegree, "deg"},
    {"grasp_mm", Unknown::kGraspX, 2, 1e-3, "mm"},
    {"grasp_deg", Unknown::kGraspAngle, 1, kDegree, "deg"},
    {"tilt_deg", Unknown::kTilt, 1, kDegree, "deg"},
}};

constexpr const char* kKnown =
    "friction, finger_friction, grip_force, mass, torque_radius (shares, or numbers with "
    "abs behind), centre_of_mass_mm, place_mm, travel_mm, direction_deg, grasp_mm, "
    "grasp_deg, tilt_deg";

[[noreturn]] void refuse(const std::string& entry, const std::string& what) {
  throw BadInput("--vary " + entry + ": " + what);
}

void read_entry(const std::string& text, UncertaintyBox& box) {
  const std::size_t equals = text.find('=');
  const std::string key = text.substr(0, equals);
  for (const Entry& entry : kEntries) {
    if (key != entry.key || equals == std::string::npos) continue;
    double width = 0.0;
    const char* const end = text.data() + text.size();
    const auto [last, error] = std::from_chars(text.data() + equals + 1, end, width);
    const std::string_view rest(last, static_cast<std::size_t>(end - last));
    const bool absolute = rest == "abs" && may_be_relative(entry.first);
    if (error != std::errc() || !(width >= 0.0) || !std::isfinite(width) ||
        !(rest.empty() || absolute)) {
      refuse(text, "expected a half width of at least 0");
    }
    const bool relative = may_be_relative(entry.first) && !absolute;
    if (relative && width >= 1.0) {
      refuse(text, "expected a share below 1 (0.2 is 20 %)");
    }
    for (int k = 0; k < entry.count; ++k) {
      const auto i = static_cast<std::size_t>(entry.first) + static_cast<std::size_t>(k);
      box.half_width[i] = width * entry.unit;
      box.is_absolute[i] = absolute;
    }
    return;
  }
  refuse(text, "expected name=half width, name one of " + std::string(kKnown));
}

}  // namespace

CLI::Option& add_vary_option(CLI::App& command, std::vector<std::string>& entries) {
  return *command
              .add_option("--vary", entries,
                          "half widths of what is uncertain: " + std::string(kKnown))
              ->delimiter(',');
}

UncertaintyBox parse_box(const std::vector<std::string>& entries,
                         const UncertaintyBox& otherwise) {
  if (entries.empty()) return otherwise;
  UncertaintyBox box;
  std::set<std::string> keys;
  for (const std::string& entry : entries) {
    read_entry(entry, box);
    if (!keys.insert(entry.substr(0, entry.find('='))).second) {
      refuse(entry, "given twice: expected one half width for each");
    }
  }
  return box;
}

std::string box_text(const UncertaintyBox& box) {
  std::string out;
  for (const Entry& entry : kEntries) {
    const double width = box[entry.first];
    if (width == 0.0) continue;
    const bool relative = may_be_relative(entry.first) &&
                          !box.is_absolute[static_cast<std::size_t>(entry.first)];
    std::string key = entry.key;
    for (const char* end : {"_mm", "_deg"}) {
      if (key.ends_with(end)) key.resize(key.rfind('_'));
    }
    for (char& c : key) c = c == '_' ? ' ' : c;
    if (!out.empty()) out += ", ";
    out += key;
    out += relative ? text(" ±%.4g %%", 100.0 * width)
                    : text(" ±%.4g %s", width / entry.unit, entry.shown);
  }
  return out.empty() ? "nothing" : out;
}

nlohmann::ordered_json to_json(const UncertaintyBox& box) {
  nlohmann::ordered_json out = nlohmann::ordered_json::object();
  for (const Unknown unknown : box.active()) {
    const auto i = static_cast<std::size_t>(unknown);
    const bool relative = may_be_relative(unknown) && !box.is_absolute[i];
    std::string key(name(unknown));
    std::replace(key.begin(), key.end(), ' ', '_');
    out[key] = {{"half_width", box.half_width[i]}, {"relative", relative}};
  }
  return out;
}

}  // namespace prehensile::apps
