/// Geometries of contact compared by how well they funnel one push: the less the motion
/// depends on what is uncertain, the better (paper section VIII).
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "apps/spread.h"

namespace prehensile::apps {

struct ContactVariant {
  std::string pusher;  ///< "point", "line 20 mm", "wall"
  std::string pad;     ///< "disc 10 mm", ...
  bool is_scenes_own = false;
  std::string refusal;          ///< why this geometry cannot be asked; empty: it was
  double torque_radius = kNan;  ///< [m] of the pads
  Ensemble ensemble;

  /// Half width [m, rad] of the middle share `level` of the motions.
  double half_width(double Deviation::*part, double level) const;
  /// Root mean square over the completed members of the displacement of a point at this
  /// distance from the object's centre [m], all directions.
  double spread(double reach) const;
};

struct ContactReport {
  std::string question;
  UncertaintyBox box;
  double level = 0.9;
  double reach = 0.0;  ///< [m] half the longer side of the object
  std::vector<ContactVariant> variants;

  /// Indices, best first: whoever completes more than 0.99 of what the best one
  /// completes, by spread; then the others, by share completed; refused ones last.
  std::vector<int> ranking() const;
};

std::string describe(const ContactReport& report);
nlohmann::ordered_json to_json(const ContactReport& report);
std::string to_csv(const ContactReport& report);
std::string to_svg(const ContactReport& report);

}  // namespace prehensile::apps
