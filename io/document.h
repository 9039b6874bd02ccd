/// A file as a tree of values with their places, whatever its syntax: readers of YAML and
/// JSON make it, the field readers take it apart, the writers build it the other way
/// round. Internal to the io layer.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "io/scene_file.h"

namespace prehensile::internal {

/// Where a value stands: a line of the file, or an option of the command line.
struct Place {
  int line = 0;     ///< from 1; 0: unknown
  int option = -1;  ///< index of the override that set it
};

struct Entry;

struct Value {
  enum class Kind {
    kNull,
    kPlain,  ///< number, truth value or bare word, as written
    kText,   ///< quoted
    kList,
    kMap,
  };
  Kind kind = Kind::kNull;
  std::string text;
  Place place;
  std::vector<Value> items;
  std::vector<Entry> entries;  ///< keys are unique

  static Value plain(std::string text);
  static Value quoted(std::string text);
  static Value list();
  static Value map();

  const Value* find(std::string_view key) const;
  Value& add(std::string key, Value value);

 private:
  static Value of_kind(Kind kind);
};

struct Entry {
  std::string key;
  Place place;
  Value value;
};

/// Deeper nesting than any file of ours needs is refused while it is read.
inline constexpr int kDeepest = 12;

/// Likewise more keys in one map, each of which is compared with all the others.
inline constexpr int kMostKeys = 1000;

/// The number that the whole of `text` spells, NaN and infinity refused.
bool to_number(std::string_view text, double& value);

/// The shortest text that reads back as the same number; `value` must be finite.
std::string number_text(double value);

/// A value for a message: short, on one line, without control characters.
std::string shown(const Value& value);
std::string shown(std::string_view text);

/// The deepest value on a dotted path that exists.
const Value& deepest(const Value& root, std::string_view path);

/// Where a fault of the field at this path stands: an override of a part of it, or the
/// deepest value that exists.
Place place_of(const Value& root, std::string_view path);

/// Path of a child.
std::string join(const std::string& path, std::string_view key);

/// Collects what is wrong with one input.
class Faults {
 public:
  /// `label` names the file; `options` are the overrides that places refer to.
  explicit Faults(std::string label, std::vector<std::string> options = {});

  /// For the value of one override, which has no lines.
  static Faults of_option(const std::string& option);

  void add(const Place& place, const std::string& field, const std::string& what);

  /// Counts a field as faulty without a message of its own.
  void pass_over(const std::string& field) { fields_.push_back(field); }

  /// A fault of this field, of a part of it or of what contains it is known.
  bool concerns(const std::string& field) const;

  /// Throws BadInput if there are any.
  void raise() const;

  /// Adds a fault after which there is nothing left to read, and throws.
  [[noreturn]] void fail(const Place& place, const std::string& field,
                         const std::string& what);

 private:
  std::string label_;
  std::vector<std::string> options_;
  bool has_lines_ = true;
  std::vector<std::string> fields_;
  std::vector<std::string> messages_;
  int unlisted_ = 0;
};

/// Parsers: syntax errors, doubled keys and whatever the format forbids become faults.
Value parse_yaml(const std::string& text, Faults& faults);
Value parse_json(const std::string& text, Faults& faults);

std::string to_yaml(const Value& value);
std::string to_json(const Value& value);

/// FNV-1a, 64 bits (Fowler, Noll, Vo), in hex.
std::string digest_of(const std::string& text);

/// Refuses bytes that are not UTF-8, and control characters.
void check_characters(const std::string& text, Faults& faults);

/// What a text holds behind the byte order mark that some editors write first.
std::string_view without_mark(std::string_view text);

/// Reads a regular file of at most `limit` bytes; throws BadInput.
std::string read_text(const std::filesystem::path& file, std::size_t limit);

inline constexpr std::size_t kLargestScene = 1'000'000;  // bytes
inline constexpr std::size_t kLargestPlan = 10'000'000;  // bytes

/// Applies `path=value` overrides to a scene's tree.
void apply_overrides(Value& root, const std::vector<std::string>& overrides,
                     Faults& faults);

}  // namespace prehensile::internal
