#include "apps/table.h"

#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <numbers>
#include <string_view>

namespace prehensile::apps {
namespace {

/// Characters as shown: UTF-8 continuation bytes take no column.
std::size_t columns(const std::string& s) {
  const auto is_lead = [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
  };
  return static_cast<std::size_t>(std::count_if(s.begin(), s.end(), is_lead));
}

/// Rounding leaves "-0.00" of small numbers: a zero without a sign, as wide where columns
/// are.
void drop_signs_of_zeros(std::string& words) {
  for (std::size_t at = words.find('-'); at != std::string::npos;
       at = words.find('-', at + 1)) {
    if (at > 0 && words[at - 1] != ' ' && words[at - 1] != '(') continue;
    std::size_t end = at + 1;
    while (end < words.size() && (words[end] == '0' || words[end] == '.')) ++end;
    if (end == at + 1) continue;
    constexpr std::string_view kAfter = " ,;)%\n";
    if (end < words.size() && kAfter.find(words[end]) == std::string_view::npos) continue;
    if (at > 1 && words[at - 1] == ' ' && words[at - 2] == ' ') {
      words[at] = ' ';
    } else {
      words.erase(at, 1);
    }
  }
}

}  // namespace

std::string text(const char* format, ...) {
  std::va_list args;
  va_start(args, format);
  char buffer[512];
  std::vsnprintf(buffer, sizeof buffer, format, args);
  va_end(args);
  std::string words = buffer;
  drop_signs_of_zeros(words);
  return words;
}

double to_mm(double metres) { return 1e3 * metres; }

double to_deg(double radians) { return 180.0 / std::numbers::pi * radians; }

std::string Table::str() const {
  std::vector<std::size_t> widths(rows_.front().size(), 0);
  for (const auto& row : rows_) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      widths[i] = std::max(widths[i], columns(row[i]));
    }
  }
  std::string out;
  for (const auto& row : rows_) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      out += std::string(widths[i] - columns(row[i]) + 2, ' ') + row[i];
    }
    out += '\n';
  }
  return out;
}

}  // namespace prehensile::apps
