/// Charts of error against cost, on logarithmic axes, as one SVG sheet.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace prehensile::benchmarks {

struct ErrorChart {
  struct Line {
    std::string label;
    std::vector<std::array<double, 2>> points;  ///< cost, error [m]
  };
  std::string title;
  std::vector<Line> lines;
};

/// Writes to a temporary and renames; says on standard error if it cannot.
bool write_error_charts(const std::vector<ErrorChart>& charts, const char* cost_label,
                        const std::string& file);

}  // namespace prehensile::benchmarks
