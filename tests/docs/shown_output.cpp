#include "tests/docs/shown_output.h"

#include <cctype>
#include <cmath>
#include <regex>
#include <vector>

#include "tests/docs/page.h"

namespace prehensile::testing {
namespace {

constexpr double kRelative = 1e-3;
constexpr double kRest = 1e-6;

/// A line taken apart: words and numbers in turn, words first.
struct Line {
  std::vector<std::string> words;
  std::vector<std::string> numbers;
};

std::string with_single_blanks(const std::string& text) {
  std::string out;
  for (const char c : text) {
    const char plain = c == '\t' ? ' ' : c;
    if (plain == ' ' && (out.empty() || out.back() == ' ')) continue;
    out += plain;
  }
  while (out.ends_with(' ')) out.pop_back();
  return out;
}

Line taken_apart(const std::string& text) {
  static const std::regex kNumber(R"([-+]?\d+(\.\d+)?([eE][-+]?\d+)?)");
  Line line;
  const std::string plain = with_single_blanks(text);
  auto from = plain.cbegin();
  for (std::sregex_iterator it(plain.begin(), plain.end(), kNumber), end; it != end;
       ++it) {
    auto begin = (*it)[0].first;
    const bool in_word = begin != plain.cbegin() &&
                         (std::isalnum(static_cast<unsigned char>(begin[-1])) != 0);
    if (in_word && (*begin == '-' || *begin == '+')) ++begin;
    line.words.emplace_back(from, begin);
    line.numbers.emplace_back(begin, (*it)[0].second);
    from = (*it)[0].second;
  }
  line.words.emplace_back(from, plain.cend());
  return line;
}

/// One in the last digit.
double last_digit(const std::string& number) {
  const std::size_t e = number.find_first_of("eE");
  const std::string mantissa = number.substr(0, e);
  const double exponent = e == std::string::npos ? 0.0 : std::stod(number.substr(e + 1));
  const std::size_t point = mantissa.find('.');
  const double decimals =
      point == std::string::npos ? 0.0 : static_cast<double>(mantissa.size() - point - 1);
  return std::pow(10.0, exponent - decimals);
}

bool same_number(const std::string& shown, const std::string& printed) {
  if (shown == printed) return true;
  const double a = std::stod(shown);
  const double b = std::stod(printed);
  const bool whole = shown.find_first_of(".eE") == std::string::npos;
  if (std::abs(a) < kRest && std::abs(b) < kRest) return true;
  const double off = std::abs(a - b);
  if (off <= kRelative * std::abs(a)) return true;
  return !whole && off <= 1.01 * last_digit(shown);
}

bool is_time(const Line& line, std::size_t number) {
  static const std::regex kUnit(R"(^ (ms|us|min)\b[^\n]*)");
  return std::regex_match(line.words[number + 1], kUnit);
}

bool is_head_with_time(const std::string& line) {
  return with_single_blanks(line).ends_with(" time us");
}

/// Lines of a table whose last column is a time differ in it.
bool same_line(const std::string& shown, const std::string& printed, bool ends_in_time) {
  const Line a = taken_apart(shown);
  const Line b = taken_apart(printed);
  if (a.words != b.words) return false;
  for (std::size_t i = 0; i < a.numbers.size(); ++i) {
    const bool is_last = i + 1 == a.numbers.size() && a.words.back().empty();
    if (is_time(a, i) || (ends_in_time && is_last)) continue;
    if (!same_number(a.numbers[i], b.numbers[i])) return false;
  }
  return true;
}

}  // namespace

std::string without_progress(const std::string& printed) {
  static const std::regex kProgress(R"(.* tests/s, [\d.]+ s)");
  std::string rest;
  for (const std::string& line : lines_of(printed)) {
    if (!std::regex_match(line, kProgress)) rest += line + '\n';
  }
  return rest;
}

std::string difference(const std::string& shown, const std::string& printed) {
  const std::vector<std::string> a = lines_of(shown);
  const std::vector<std::string> b = lines_of(without_progress(printed));
  std::size_t next = 0;
  bool ends_in_time = false;
  const auto same = [&ends_in_time](const std::string& one, const std::string& other) {
    return same_line(one, other, ends_in_time);
  };
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i] == "...") {
      if (i + 1 == a.size()) return "";
      while (next < b.size() && !same(a[i + 1], b[next])) ++next;
      if (next == b.size()) return "never printed: " + a[i + 1];
      continue;
    }
    if (next == b.size()) return "shown and not printed: " + a[i];
    if (!same(a[i], b[next])) return "shown: " + a[i] + "\nprinted: " + b[next];
    ++next;
    if (taken_apart(a[i]).numbers.empty()) ends_in_time = is_head_with_time(a[i]);
  }
  if (next < b.size()) return "printed and not shown: " + b[next];
  return "";
}

}  // namespace prehensile::testing
