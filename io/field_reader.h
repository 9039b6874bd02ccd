/// Takes a map of values apart into fields and collects every fault on the way. Internal
/// to the io layer; the vocabulary is described in fields.h.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "io/document.h"
#include "io/fields.h"

namespace prehensile::internal {

class FieldReader {
 public:
  /// Reads the fields of `value`, which should be a map at `path`, by `visit`.
  template <typename T, typename Visit>
  static void read(const Value& value, const std::string& path, Faults& faults, T& into,
                   const Visit& visit) {
    if (!is_map(value, path, faults)) return;
    FieldReader reader(value, path, faults);
    visit(reader, into);
    reader.finish();
  }

  void version(int number);
  void text(const char* key, std::string& into, Need need, const char*);
  void number(const char* key, double& into, const Bounds& bounds, Need need,
              const char*);
  void number(const char* key, std::optional<double>& into, const Bounds& bounds,
              const char*);
  void measured(const char* key, double& into, const Bounds& bounds, const char*);
  void count(const char* key, std::uint64_t& into, const char*);
  void whole(const char* key, int& into, int low, int high, Need need, const char*);
  void angle(const std::string& key, double& into, const Bounds& bounds, const char*);
  void angle(const std::string& key, std::optional<double>& into, const Bounds& bounds,
             const char*);
  void one_or_two(const char* key, std::array<double, 2>& into, const Bounds& bounds,
                  const char*);
  void names(const char* key, std::vector<std::string>& into, Length length, const char*);
  void numbers(const char* key, std::map<std::string, double>& into, const char*);
  void points(const char* key, std::vector<Vec2>& into, Length length,
              const Bounds& bounds, const char*);

  template <typename Vector>
  void vector(const char* key, Vector& into, const Bounds& bounds, Need need,
              const char*) {
    const std::span<double> numbers(into.data(), static_cast<std::size_t>(into.size()));
    const Value* value = take(key, need, numbers_of(numbers.size()));
    if (value) read_numbers(*value, child(key), bounds, numbers);
  }
  template <typename Vector>
  void vector(const char* key, std::optional<Vector>& into, const Bounds& bounds,
              const char* doc) {
    Vector value = Vector::Zero();
    const bool present = map_.find(key) != nullptr;
    vector(key, value, bounds, kOptional, doc);
    if (present) into = value;
  }

  void place(const char* key, Vec2& into, double& z, const Bounds& bounds, const char*);
  void place(const char* key, std::optional<Vec2>& into, double& z, const Bounds& bounds,
             const char* doc) {
    Vec2 value = Vec2::Zero();
    const bool present = map_.find(key) != nullptr;
    place(key, value, z, bounds, doc);
    if (present) into = value;
  }

  template <typename T, std::size_t N>
  void word(const char* key, T& into, const std::array<Word<T>, N>& words, Need need,
            const char*) {
    std::array<std::string_view, N> texts;
    for (std::size_t i = 0; i < N; ++i) texts[i] = words[i].text;
    const Value* value = take(key, need, one_of(texts));
    if (!value) return;
    const int found = find_word(*value, child(key), texts);
    if (found >= 0) into = words[static_cast<std::size_t>(found)].value;
  }

  template <typename T, std::size_t N>
  void word_if_not(T, const char* key, T& into, const std::array<Word<T>, N>& words,
                   const char* doc) {
    word(key, into, words, kOptional, doc);
  }

  template <typename T, typename Visit>
  void group(const char* key, T& into, Need need, const char*, const Visit& visit) {
    if (const Value* value = take(key, need, "a map of keys and values")) {
      read(*value, child(key), faults_, into, visit);
    }
  }
  template <typename T, typename Visit>
  void group(const char* key, std::optional<T>& into, const char*, const Visit& visit) {
    if (const Value* value = take(key, kOptional, {})) {
      read(*value, child(key), faults_, into.emplace(), visit);
    }
  }

  template <typename T, typename Visit>
  void group_if_set(const char* key, T& into, const char* doc, const Visit& visit) {
    group(key, into, kOptional, doc, visit);
  }

  template <typename T, typename Visit>
  void list(const char* key, std::vector<T>& into, Length length, Need need, const char*,
            const Visit& visit) {
    const Value* value = take(key, need, "a list of maps");
    if (!value || !is_list(*value, child(key), length)) return;
    for (std::size_t i = 0; i < value->items.size(); ++i) {
      read(value->items[i], join(child(key), std::to_string(i)), faults_,
           into.emplace_back(), visit);
    }
  }

  template <typename Variant, typename... Alternatives>
  void choice(Variant& into, const Alternatives&... alternatives) {
    const Value* chosen = choose({alternatives.key...});
    if (!chosen) return;
    const auto read_if_chosen = [&](const auto& candidate) {
      if (map_.find(candidate.key) != chosen) return;
      using T = typename std::decay_t<decltype(candidate)>::Type;
      read(*chosen, child(candidate.key), faults_, into.template emplace<T>(),
           candidate.visit);
    };
    (read_if_chosen(alternatives), ...);
  }

 private:
  FieldReader(const Value& map, const std::string& path, Faults& faults)
      : map_(map), path_(path), faults_(faults) {}

  std::string child(std::string_view key) const { return join(path_, key); }

  /// The value of a key, or null if it is missing.
  const Value* take(const char* key, Need need, const std::string& expected);
  /// The one key of these that is there; none or several are a fault.
  const Value* choose(const std::vector<const char*>& keys);
  /// Faults of keys that are missing or unknown; a misspelt key is not missing as well.
  void finish();

  static std::string numbers_of(std::size_t count);
  static std::string one_of(std::span<const std::string_view> words);
  static bool is_map(const Value& value, const std::string& path, Faults& faults);
  bool is_list(const Value& value, const std::string& path, Length length);
  bool read_number(const Value& value, const std::string& path, const Bounds& bounds,
                   double& into);
  void read_numbers(const Value& value, const std::string& path, const Bounds& bounds,
                    std::span<double> into);
  bool read_text(const Value& value, const std::string& path, std::string& into);
  int find_word(const Value& value, const std::string& path,
                std::span<const std::string_view> words);

  const Value& map_;
  const std::string& path_;
  Faults& faults_;
  std::vector<std::string> known_;

  struct Missing {
    std::vector<std::string> keys;  // any of which would do
    std::string field;
    std::string what;
  };
  std::vector<Missing> missing_;
};

}  // namespace prehensile::internal
