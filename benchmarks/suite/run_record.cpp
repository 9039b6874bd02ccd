#include "benchmarks/suite/run_record.h"

#include <charconv>
#include <cstdio>
#include <sstream>
#include <type_traits>
#include <unistd.h>

namespace prehensile::suite {
namespace {

constexpr std::string_view kEnd = "end";

std::string exact(double value) {
  char buffer[40];
  std::snprintf(buffer, sizeof buffer, "%.17g", value);
  return buffer;
}

/// One line of text: what would end the line, or is no character, is a space.
std::string on_one_line(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  }
  return text;
}

template <typename T>
bool parse(const std::string& text, T& into) {
  if constexpr (std::is_same_v<T, std::string>) {
    into = text;
    return true;
  } else if constexpr (std::is_same_v<T, bool>) {
    into = text == "1";
    return text == "1" || text == "0";
  } else if constexpr (std::is_same_v<T, double>) {
    // std::from_chars reads "nan" and "inf" as well, whatever the locale.
    const auto [last, error] =
        std::from_chars(text.data(), text.data() + text.size(), into);
    return error == std::errc() && last == text.data() + text.size();
  } else {
    const auto [last, error] =
        std::from_chars(text.data(), text.data() + text.size(), into);
    return error == std::errc() && last == text.data() + text.size();
  }
}

}  // namespace

std::string host_name() {
  char host[256] = "unknown";
  if (::gethostname(host, sizeof host - 1) != 0) return "unknown";
  return host;
}

std::string to_text(const RunRecord& record) {
  std::string out = std::to_string(static_cast<int>(record.status)) + '\n';
  visit_columns(record, [&](const char*, const auto& value) {
    using T = std::decay_t<decltype(value)>;
    if constexpr (std::is_same_v<T, std::string>) {
      out += on_one_line(value);
    } else if constexpr (std::is_same_v<T, double>) {
      out += exact(value);
    } else {
      out += std::to_string(value);
    }
    out += '\n';
  });
  for (const ProgressPoint& point : record.progress) {
    out += exact(point.time) + '\n' + exact(point.best_cost) + '\n';
  }
  out += kEnd;
  return out + '\n';
}

bool from_text(const std::string& text, RunRecord& record) {
  std::istringstream in(text);
  std::string line;
  bool sound = true;
  const auto next = [&](auto& into) {
    sound = sound && std::getline(in, line) && parse(line, into);
  };
  int status = -1;
  next(status);
  if (!sound || status < 0 || status >= static_cast<int>(kRunStatusNames.size())) {
    return false;
  }
  record = {};
  record.status = static_cast<RunStatus>(status);
  visit_columns(record, [&](const char*, auto& value) { next(value); });
  while (sound && std::getline(in, line) && line != kEnd) {
    ProgressPoint point;
    sound = parse(line, point.time);
    next(point.best_cost);
    record.progress.push_back(point);
  }
  return sound && line == kEnd;
}

}  // namespace prehensile::suite
