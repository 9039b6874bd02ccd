#include <algorithm>
#include <charconv>

#include "io/document.h"

namespace prehensile::internal {
namespace {

void set_option(Value& value, int option) {
  value.place = {0, option};
  for (Value& item : value.items) set_option(item, option);
  for (Entry& entry : value.entries) {
    entry.place = value.place;
    set_option(entry.value, option);
  }
}

/// The same angle in the other unit, which a new value replaces.
std::string other_unit(const std::string& key) {
  constexpr std::string_view kDegrees = "_deg";
  return key.ends_with(kDegrees) ? key.substr(0, key.size() - kDegrees.size())
                                 : key + std::string(kDegrees);
}

Value& child_of_map(Value& map, const std::string& key, const Place& place) {
  std::erase_if(map.entries,
                [&](const Entry& entry) { return entry.key == other_unit(key); });
  for (Entry& entry : map.entries) {
    if (entry.key != key) continue;
    entry.place = place;
    return entry.value;
  }
  Value absent = Value::map();
  absent.place = place;
  return map.add(key, std::move(absent));
}

Value* child_of_list(Value& list, const std::string& key) {
  std::size_t index = 0;
  const char* const end = key.data() + key.size();
  const auto [last, error] = std::from_chars(key.data(), end, index);
  const bool inside = error == std::errc() && last == end && index < list.items.size();
  return inside ? &list.items[index] : nullptr;
}

/// Why a path cannot go on below this value.
std::string dead_end(const Value& value) {
  if (value.kind != Value::Kind::kList) {
    return shown(value) + ": expected a path that ends here";
  }
  if (value.items.empty()) return "an empty list: expected a path that ends here";
  return "no such member: expected an index from 0 to " +
         std::to_string(value.items.size() - 1);
}

void set(Value& root, const std::string& path, Value value, Faults& faults) {
  const Place place = value.place;
  Value* at = &root;
  std::string done;
  for (std::size_t from = 0; from <= path.size();) {
    const std::size_t dot = std::min(path.find('.', from), path.size());
    const std::string key = path.substr(from, dot - from);
    from = dot + 1;
    Value* next = nullptr;
    if (at->kind == Value::Kind::kMap) next = &child_of_map(*at, key, place);
    if (at->kind == Value::Kind::kList) next = child_of_list(*at, key);
    if (!next) {
      faults.add(place, join(done, key), dead_end(*at));
      return;
    }
    done = join(done, key);
    at = next;
  }
  *at = std::move(value);
}

}  // namespace

void apply_overrides(Value& root, const std::vector<std::string>& overrides,
                     Faults& faults) {
  for (std::size_t i = 0; i < overrides.size(); ++i) {
    const Place place{0, static_cast<int>(i)};
    const std::size_t equals = overrides[i].find('=');
    if (equals == std::string::npos || equals == 0) {
      faults.add(place, "", "expected path=value, as in gripper.grip_force=30");
      continue;
    }
    const std::string path = overrides[i].substr(0, equals);
    Faults syntax = Faults::of_option(overrides[i]);
    Value value = parse_yaml(overrides[i].substr(equals + 1), syntax);
    syntax.raise();
    set_option(value, place.option);
    set(root, path, std::move(value), faults);
  }
}

}  // namespace prehensile::internal
