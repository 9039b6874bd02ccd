/// Lines of comma-separated values (RFC 4180).
#pragma once

#include <string>
#include <vector>

namespace prehensile::apps {

/// The shortest decimal form that reads back as the same number; empty if not finite.
std::string csv_number(double value);

/// Quoted where commas, quotes or line ends need it.
std::string csv_text(const std::string& text);

/// Cells with commas between and a line end behind; cells as made by the above.
std::string csv_line(const std::vector<std::string>& cells);

}  // namespace prehensile::apps
