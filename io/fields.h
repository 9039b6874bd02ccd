/// The vocabulary in which the fields of a file are listed, once (scene_fields.h,
/// plan_fields.h). Three visitors walk the lists: FieldReader, FieldWriter and
/// FieldSchema. Internal to the io layer.
///
/// A visitor has, with `key` in the map at hand and one line of documentation each:
///
///   version(number)                      the version of the format
///   text(key, string)                    words for people
///   number(key, double)                  also optional<double>: absent if unset
///   measured(key, double)                NaN is written as null
///   count(key, integer)                  whole number >= 0
///   whole(key, integer, low, high)       whole number in a range, ends included
///   angle(key, double)                   radians under `key`, or degrees under
///   `key`_deg;
///                                        also optional<double>
///   vector(key, fixed size)              also optional<Vec2>
///   place(key, Vec2, double)             two numbers, or three; the last is 0 if absent;
///                                        also optional<Vec2>
///   one_or_two(key, two numbers)         one number stands for both
///   word(key, value, words)              one of a closed set
///   word_if_not(initial, key, value, words)  likewise, not written if it is the initial
///   names(key, strings)                  a list of words
///   numbers(key, map)                    a map from words to numbers
///   points(key, vertices)                a list of pairs of numbers
///   group(key, value, visit)             a map; also optional<T>: absent if unset
///   group_if_set(key, value, visit)      a map, written only if not as the struct starts
///   list(key, vector, visit)             a list of maps
///   choice(variant, alternatives...)     exactly one of several keys
#pragma once

#include <limits>
#include <numbers>
#include <string_view>

namespace prehensile::internal {

/// Absent optional fields keep the value that the struct starts with.
enum class Need { kRequired, kOptional };
using enum Need;

/// Range of a number, ends included.
struct Bounds {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  const char* unit = "";
};

inline constexpr double kRadPerDeg = std::numbers::pi / 180.0;

/// How many members a list may have.
struct Length {
  std::size_t least = 0;
  std::size_t most = 0;
};

/// One of a closed set of values, as it is called in files.
template <typename T>
struct Word {
  T value;
  std::string_view text;
};

/// One member T of a variant: its key and the fields of its map.
template <typename T, typename Visit>
struct Alternative {
  using Type = T;
  const char* key;
  const char* doc;
  Visit visit;
};

template <typename T, typename Visit>
Alternative<T, Visit> alternative(const char* key, const char* doc, Visit visit) {
  return {key, doc, visit};
}

/// For structs without fields.
inline constexpr auto kNoFields = [](auto&, auto&) {};

}  // namespace prehensile::internal
