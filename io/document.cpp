#include "io/document.h"

#include <algorithm>
#include <charconv>
#include <cinttypes>
#include <cmath>
#include <cstdint>
#include <cstdio>

namespace prehensile::internal {
namespace {

constexpr std::size_t kMostShown = 60;  // characters of a value in a message
constexpr std::size_t kMostMessages = 20;

const Place* find_override(const Value& value) {
  if (value.place.option >= 0) return &value.place;
  for (const Value& item : value.items) {
    if (const Place* place = find_override(item)) return place;
  }
  for (const Entry& entry : value.entries) {
    if (const Place* place = find_override(entry.value)) return place;
  }
  return nullptr;
}

/// `a` is `b` or a part of it.
bool within(std::string_view a, std::string_view b) {
  return a.starts_with(b) && (a.size() == b.size() || b.empty() || a[b.size()] == '.');
}

}  // namespace

Value Value::of_kind(Kind kind) {
  Value value;
  value.kind = kind;
  return value;
}

Value Value::list() { return of_kind(Kind::kList); }

Value Value::map() { return of_kind(Kind::kMap); }

Value Value::plain(std::string text) {
  Value value = of_kind(Kind::kPlain);
  value.text = std::move(text);
  return value;
}

Value Value::quoted(std::string text) {
  Value value = of_kind(Kind::kText);
  value.text = std::move(text);
  return value;
}

const Value* Value::find(std::string_view key) const {
  for (const Entry& entry : entries) {
    if (entry.key == key) return &entry.value;
  }
  return nullptr;
}

Value& Value::add(std::string key, Value value) {
  entries.push_back({std::move(key), value.place, std::move(value)});
  return entries.back().value;
}

bool to_number(std::string_view text, double& value) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  const char* const end = text.data() + text.size();
  const auto [last, error] = std::from_chars(text.data(), end, value);
  return error == std::errc() && last == end && std::isfinite(value);
}

std::string number_text(double value) {
  char buffer[32];
  const double without_minus_zero = value + 0.0;
  const auto [last, error] =
      std::to_chars(buffer, buffer + sizeof buffer, without_minus_zero);
  return {buffer, error == std::errc() ? last : buffer};
}

std::string shown(std::string_view text) {
  std::string out;
  for (const char c : text.substr(0, kMostShown)) {
    const auto byte = static_cast<unsigned char>(c);
    out += byte < 0x20 || byte == 0x7f ? '?' : c;
  }
  if (text.size() <= kMostShown) return out;
  // Not in the middle of a character.
  std::size_t kept = out.size();
  while (kept > 0 && (static_cast<unsigned char>(text[kept]) & 0xc0) == 0x80) --kept;
  return out.substr(0, kept) + "...";
}

std::string shown(const Value& value) {
  switch (value.kind) {
    case Value::Kind::kNull:
      return "empty";
    case Value::Kind::kPlain:
      return shown(value.text);
    case Value::Kind::kText:
      return '"' + shown(value.text) + '"';
    case Value::Kind::kList:
      return value.items.empty() ? "an empty list"
                                 : "a list of " + std::to_string(value.items.size());
    case Value::Kind::kMap:
      return "a map";
  }
  return {};
}

const Value& deepest(const Value& root, std::string_view path) {
  const Value* value = &root;
  while (!path.empty()) {
    const std::size_t dot = std::min(path.find('.'), path.size());
    const std::string_view key = path.substr(0, dot);
    path.remove_prefix(std::min(dot + 1, path.size()));
    const Value* next = nullptr;
    if (value->kind == Value::Kind::kMap) next = value->find(key);
    std::size_t index = 0;
    const auto [last, error] =
        std::from_chars(key.data(), key.data() + key.size(), index);
    const bool is_index = error == std::errc() && last == key.data() + key.size();
    if (is_index && index < value->items.size()) next = &value->items[index];
    if (!next) break;
    value = next;
  }
  return *value;
}

Place place_of(const Value& root, std::string_view path) {
  const Value& value = deepest(root, path);
  const Place* overridden = find_override(value);
  return overridden ? *overridden : value.place;
}

std::string join(const std::string& path, std::string_view key) {
  return path.empty() ? std::string(key) : path + '.' + std::string(key);
}

Faults::Faults(std::string label, std::vector<std::string> options)
    : label_(std::move(label)), options_(std::move(options)) {}

Faults Faults::of_option(const std::string& option) {
  Faults faults("--set " + shown(option));
  faults.has_lines_ = false;
  return faults;
}

void Faults::add(const Place& place, const std::string& field, const std::string& what) {
  fields_.push_back(field);
  if (messages_.size() >= kMostMessages) {
    ++unlisted_;
    return;
  }
  std::string message;
  if (place.option >= 0) {
    message = "--set " + shown(options_[static_cast<std::size_t>(place.option)]);
  } else {
    message = label_;
    if (has_lines_ && place.line > 0) message += ':' + std::to_string(place.line);
  }
  if (!field.empty()) message += ": " + shown(field);
  messages_.push_back(message + ": " + what);
}

bool Faults::concerns(const std::string& field) const {
  return std::any_of(fields_.begin(), fields_.end(), [&](const std::string& known) {
    return within(field, known) || within(known, field);
  });
}

void Faults::raise() const {
  if (messages_.empty()) return;
  std::string all;
  for (const std::string& message : messages_) all += (all.empty() ? "" : "\n") + message;
  if (unlisted_ > 0) {
    all += '\n' + label_ + ": and " + std::to_string(unlisted_) + " more";
  }
  throw BadInput(all);
}

void Faults::fail(const Place& place, const std::string& field, const std::string& what) {
  add(place, field, what);
  raise();
  throw BadInput(what);
}

std::string digest_of(const std::string& text) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const char c : text) {
    hash ^= static_cast<unsigned char>(c);
    hash *= 0x100000001b3u;
  }
  char hex[17];
  std::snprintf(hex, sizeof hex, "%016" PRIx64, hash);
  return hex;
}

}  // namespace prehensile::internal
