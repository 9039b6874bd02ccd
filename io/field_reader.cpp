#include "io/field_reader.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>

namespace prehensile::internal {
namespace {

constexpr const char* kWholeNumber = "a whole number >= 0";

std::string brief(double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.10g", value);
  return buffer;
}

std::string expected_number(const Bounds& bounds) {
  std::string out = "a number";
  if (std::isfinite(bounds.low)) out += " from " + brief(bounds.low);
  if (std::isfinite(bounds.high)) out += " to " + brief(bounds.high);
  return *bounds.unit ? out + ' ' + bounds.unit : out;
}

std::string expected_list(Length length) {
  return "a list of " + std::to_string(length.least) + " to " +
         std::to_string(length.most) + " members";
}

template <typename Texts>
std::string listed(const Texts& texts) {
  std::string out;
  for (const auto& text : texts) out += (out.empty() ? "" : ", ") + std::string(text);
  return out;
}

/// Least number of letters changed, added, left out or swapped with their
/// neighbour.
int typing_distance(std::string_view a, std::string_view b) {
  std::vector<std::vector<int>> d(a.size() + 1, std::vector<int>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = static_cast<int>(i);
  for (std::size_t j = 0; j <= b.size(); ++j) d[0][j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const int changed = d[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      d[i][j] = std::min({changed, d[i - 1][j] + 1, d[i][j - 1] + 1});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  }
  return d[a.size()][b.size()];
}

/// What the writer of an unknown key may have meant, or empty.
std::string nearest(std::string_view key, const std::vector<std::string>& known) {
  constexpr std::size_t kLongest = 40;
  if (key.size() > kLongest) return {};
  std::string best;
  int least = 3;
  for (const std::string& candidate : known) {
    const bool starts_alike =
        key.size() >= 3 && (candidate.starts_with(key) || key.starts_with(candidate));
    const int distance = starts_alike ? 1 : typing_distance(key, candidate);
    if (distance < least && distance < static_cast<int>(candidate.size())) {
      least = distance;
      best = candidate;
    }
  }
  return best;
}

/// Words that YAML and JSON read as something else than text.
bool is_no_text(const Value& value) {
  double number = 0.0;
  return value.text == "true" || value.text == "false" || to_number(value.text, number);
}

}  // namespace

const Value* FieldReader::take(const char* key, Need need, const std::string& expected) {
  known_.emplace_back(key);
  const Value* value = map_.find(key);
  if (!value && need == kRequired) {
    missing_.push_back({{key}, child(key), "missing: expected " + expected});
  }
  return value;
}

const Value* FieldReader::choose(const std::vector<const char*>& keys) {
  std::vector<std::string> present;
  const Value* chosen = nullptr;
  for (const char* key : keys) {
    if (const Value* value = take(key, kOptional, {})) {
      present.emplace_back(key);
      chosen = value;
    }
  }
  const std::string expected = ": expected exactly one of " + listed(keys);
  if (chosen == nullptr) {
    missing_.push_back({{keys.begin(), keys.end()}, path_, "missing" + expected});
  } else if (present.size() > 1) {
    faults_.add(chosen->place, path_, listed(present) + expected);
  }
  return present.size() == 1 ? chosen : nullptr;
}

void FieldReader::finish() {
  for (const Entry& entry : map_.entries) {
    if (std::find(known_.begin(), known_.end(), entry.key) != known_.end()) continue;
    std::string what = "unknown key: expected ";
    what += known_.empty() ? "no key" : "one of " + listed(known_);
    const std::string meant = nearest(entry.key, known_);
    if (!meant.empty()) what += "; did you mean " + meant + '?';
    faults_.add(entry.place, child(entry.key), what);
    std::erase_if(missing_, [&](const Missing& missing) {
      const bool is_meant = std::find(missing.keys.begin(), missing.keys.end(), meant) !=
                            missing.keys.end();
      if (is_meant) faults_.pass_over(missing.field);
      return is_meant;
    });
  }
  for (const Missing& missing : missing_) {
    faults_.add(map_.place, missing.field, missing.what);
  }
}

std::string FieldReader::numbers_of(std::size_t count) {
  return "a list of " + std::to_string(count) + " numbers";
}

std::string FieldReader::one_of(std::span<const std::string_view> words) {
  return "one of " + listed(words);
}

bool FieldReader::is_map(const Value& value, const std::string& path, Faults& faults) {
  if (value.kind == Value::Kind::kMap) return true;
  faults.add(value.place, path, shown(value) + ": expected a map of keys and values");
  return false;
}

bool FieldReader::is_list(const Value& value, const std::string& path, Length length) {
  const std::size_t size = value.items.size();
  if (value.kind == Value::Kind::kList && size >= length.least && size <= length.most) {
    return true;
  }
  faults_.add(value.place, path, shown(value) + ": expected " + expected_list(length));
  return false;
}

bool FieldReader::read_number(const Value& value, const std::string& path,
                              const Bounds& bounds, double& into) {
  double number = 0.0;
  const bool sound = value.kind == Value::Kind::kPlain && to_number(value.text, number) &&
                     number >= bounds.low && number <= bounds.high;
  if (sound) {
    into = number;
  } else {
    faults_.add(value.place, path,
                shown(value) + ": expected " + expected_number(bounds));
  }
  return sound;
}

void FieldReader::read_numbers(const Value& value, const std::string& path,
                               const Bounds& bounds, std::span<double> into) {
  if (value.kind != Value::Kind::kList || value.items.size() != into.size()) {
    faults_.add(value.place, path,
                shown(value) + ": expected " + numbers_of(into.size()));
    return;
  }
  for (std::size_t i = 0; i < into.size(); ++i) {
    read_number(value.items[i], join(path, std::to_string(i)), bounds, into[i]);
  }
}

bool FieldReader::read_text(const Value& value, const std::string& path,
                            std::string& into) {
  const bool is_text = value.kind == Value::Kind::kText ||
                       (value.kind == Value::Kind::kPlain && !is_no_text(value));
  if (!is_text) {
    faults_.add(value.place, path,
                shown(value) + ": expected text, in quotes if it looks like a number");
    return false;
  }
  const bool printable = std::none_of(value.text.begin(), value.text.end(), [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return (byte < 0x20 && c != '\n' && c != '\t') || byte == 0x7f;
  });
  if (!printable) {
    faults_.add(value.place, path,
                shown(value) + ": expected text without control characters");
    return false;
  }
  into = value.text;
  return true;
}

int FieldReader::find_word(const Value& value, const std::string& path,
                           std::span<const std::string_view> words) {
  const bool is_text =
      value.kind == Value::Kind::kText || value.kind == Value::Kind::kPlain;
  const auto found = std::find(words.begin(), words.end(), value.text);
  if (is_text && found != words.end()) return static_cast<int>(found - words.begin());
  faults_.add(value.place, path, shown(value) + ": expected " + one_of(words));
  return -1;
}

void FieldReader::version(int number) {
  const Value* value = take("version", kRequired, std::to_string(number));
  if (!value) return;
  double found = 0.0;
  const bool right = value->kind == Value::Kind::kPlain &&
                     to_number(value->text, found) && found == number;
  if (!right) {
    faults_.add(value->place, child("version"),
                shown(*value) + ": expected " + std::to_string(number));
  }
}

void FieldReader::text(const char* key, std::string& into, Need need, const char*) {
  if (const Value* value = take(key, need, "text")) read_text(*value, child(key), into);
}

void FieldReader::number(const char* key, double& into, const Bounds& bounds, Need need,
                         const char*) {
  if (const Value* value = take(key, need, expected_number(bounds))) {
    read_number(*value, child(key), bounds, into);
  }
}

void FieldReader::number(const char* key, std::optional<double>& into,
                         const Bounds& bounds, const char*) {
  double number = 0.0;
  const Value* value = take(key, kOptional, {});
  if (value && read_number(*value, child(key), bounds, number)) into = number;
}

void FieldReader::measured(const char* key, double& into, const Bounds& bounds,
                           const char*) {
  const Value* value = take(key, kRequired, expected_number(bounds) + ", or null");
  if (!value) return;
  if (value->kind == Value::Kind::kNull) {
    into = std::numeric_limits<double>::quiet_NaN();
  } else {
    read_number(*value, child(key), bounds, into);
  }
}

void FieldReader::count(const char* key, std::uint64_t& into, const char*) {
  const Value* value = take(key, kRequired, kWholeNumber);
  if (!value) return;
  std::uint64_t number = 0;
  const char* const end = value->text.data() + value->text.size();
  const auto [last, error] = std::from_chars(value->text.data(), end, number);
  if (value->kind == Value::Kind::kPlain && error == std::errc() && last == end) {
    into = number;
  } else {
    faults_.add(value->place, child(key),
                shown(*value) + ": expected " + std::string(kWholeNumber));
  }
}

void FieldReader::whole(const char* key, int& into, int low, int high, Need need,
                        const char*) {
  const std::string expected =
      "a whole number from " + std::to_string(low) + " to " + std::to_string(high);
  const Value* value = take(key, need, expected);
  if (!value) return;
  int number = 0;
  const char* const end = value->text.data() + value->text.size();
  const auto [last, error] = std::from_chars(value->text.data(), end, number);
  if (value->kind == Value::Kind::kPlain && error == std::errc() && last == end &&
      number >= low && number <= high) {
    into = number;
  } else {
    faults_.add(value->place, child(key), shown(*value) + ": expected " + expected);
  }
}

void FieldReader::angle(const std::string& key, double& into, const Bounds& bounds,
                        const char* doc) {
  std::optional<double> given;
  angle(key, given, bounds, doc);
  if (given) into = *given;
}

void FieldReader::angle(const std::string& key, std::optional<double>& into,
                        const Bounds& bounds, const char*) {
  const std::string key_deg = key + "_deg";
  const Value* in_degrees = take(key_deg.c_str(), kOptional, {});
  const Value* in_radians = take(key.c_str(), kOptional, {});
  if (in_degrees && in_radians) {
    faults_.add(in_radians->place, child(key),
                "given as " + key + " and as " + key_deg + ": expected one unit");
    return;
  }
  double number = 0.0;
  if (in_radians && read_number(*in_radians, child(key), bounds, number)) into = number;
  const Bounds degrees{bounds.low / kRadPerDeg, bounds.high / kRadPerDeg, "degrees"};
  if (in_degrees && read_number(*in_degrees, child(key_deg), degrees, number)) {
    into = number * kRadPerDeg;
  }
}

void FieldReader::one_or_two(const char* key, std::array<double, 2>& into,
                             const Bounds& bounds, const char*) {
  const Value* value = take(key, kRequired, expected_number(bounds) + ", or two");
  if (!value) return;
  if (value->kind == Value::Kind::kList) {
    read_numbers(*value, child(key), bounds, into);
  } else if (read_number(*value, child(key), bounds, into[0])) {
    into[1] = into[0];
  }
}

void FieldReader::place(const char* key, Vec2& into, double& z, const Bounds& bounds,
                        const char*) {
  const Value* value = take(key, kOptional, {});
  if (!value) return;
  if (value->kind != Value::Kind::kList ||
      (value->items.size() != 2 && value->items.size() != 3)) {
    faults_.add(value->place, child(key),
                shown(*value) + ": expected a list of 2 or 3 numbers");
    return;
  }
  std::array<double, 3> numbers{into.x(), into.y(), 0.0};
  read_numbers(*value, child(key), bounds, {numbers.data(), value->items.size()});
  into = {numbers[0], numbers[1]};
  z = numbers[2];
}

void FieldReader::numbers(const char* key, std::map<std::string, double>& into,
                          const char*) {
  const Value* value = take(key, kOptional, {});
  if (!value || !is_map(*value, child(key), faults_)) return;
  for (const Entry& entry : value->entries) {
    read_number(entry.value, join(child(key), entry.key), {}, into[entry.key]);
  }
}

void FieldReader::names(const char* key, std::vector<std::string>& into, Length length,
                        const char*) {
  const Value* value = take(key, kOptional, {});
  if (!value || !is_list(*value, child(key), length)) return;
  for (std::size_t i = 0; i < value->items.size(); ++i) {
    const std::string path = join(child(key), std::to_string(i));
    read_text(value->items[i], path, into.emplace_back());
  }
}

void FieldReader::points(const char* key, std::vector<Vec2>& into, Length length,
                         const Bounds& bounds, const char*) {
  const Value* value = take(key, kRequired, expected_list(length));
  if (!value || !is_list(*value, child(key), length)) return;
  for (std::size_t i = 0; i < value->items.size(); ++i) {
    Vec2& point = into.emplace_back(Vec2::Zero());
    read_numbers(value->items[i], join(child(key), std::to_string(i)), bounds,
                 {point.data(), 2});
  }
}

}  // namespace prehensile::internal
