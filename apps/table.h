/// Text tables and number formats for people.
#pragma once

#include <string>
#include <vector>

namespace prehensile::apps {

/// printf-style formatting into a string; "-0.00" becomes "0.00".
[[gnu::format(printf, 1, 2)]] std::string text(const char* format, ...);

double to_mm(double metres);
double to_deg(double radians);

/// Right-aligned columns under a header.
class Table {
 public:
  explicit Table(std::vector<std::string> header) : rows_{std::move(header)} {}
  void add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }
  std::string str() const;

 private:
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace prehensile::apps
