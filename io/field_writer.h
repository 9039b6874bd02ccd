/// Writes every field of a struct into a map of values. Internal to the io layer; the
/// vocabulary is described in fields.h.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "io/document.h"
#include "io/fields.h"

namespace prehensile::internal {

class FieldWriter {
 public:
  template <typename T, typename Visit>
  static Value write(T& from, const Visit& visit) {
    FieldWriter writer;
    visit(writer, from);
    return std::move(writer.map_);
  }

  void version(int number) { map_.add("version", Value::plain(std::to_string(number))); }
  void text(const char* key, const std::string& from, Need, const char*) {
    map_.add(key, Value::quoted(from));
  }
  void number(const char* key, double from, const Bounds&, Need, const char*) {
    map_.add(key, Value::plain(number_text(from)));
  }
  void number(const char* key, const std::optional<double>& from, const Bounds&,
              const char*) {
    if (from) map_.add(key, Value::plain(number_text(*from)));
  }
  void measured(const char* key, double from, const Bounds&, const char*);
  void count(const char* key, std::uint64_t from, const char*) {
    map_.add(key, Value::plain(std::to_string(from)));
  }
  /// In degrees where they give the same number of radians again, else in radians.
  void angle(const std::string& key, double from, const Bounds&, const char*);
  void angle(const std::string& key, const std::optional<double>& from,
             const Bounds& bounds, const char* doc) {
    if (from) angle(key, *from, bounds, doc);
  }
  void one_or_two(const char* key, const std::array<double, 2>& from, const Bounds&,
                  const char*) {
    map_.add(key, numbers(from));
  }
  void names(const char* key, const std::vector<std::string>& from, Length, const char*);
  void points(const char* key, const std::vector<Vec2>& from, Length, const Bounds&,
              const char*);

  template <typename Vector>
  void vector(const char* key, const Vector& from, const Bounds&, Need, const char*) {
    map_.add(key, numbers(from));
  }
  template <typename Vector>
  void vector(const char* key, const std::optional<Vector>& from, const Bounds&,
              const char*) {
    if (from) map_.add(key, numbers(*from));
  }

  void place(const char* key, const Vec2& from, double z, const Bounds&, const char*) {
    map_.add(key, z == 0.0 ? numbers(from) : numbers(Vec3(from.x(), from.y(), z)));
  }
  void place(const char* key, const std::optional<Vec2>& from, double z,
             const Bounds& bounds, const char* doc) {
    if (from) place(key, *from, z, bounds, doc);
  }

  template <typename T, std::size_t N>
  void word(const char* key, const T& from, const std::array<Word<T>, N>& words, Need,
            const char*) {
    for (const Word<T>& word : words) {
      if (word.value == from) map_.add(key, Value::plain(std::string(word.text)));
    }
  }

  template <typename T, std::size_t N>
  void word_if_not(T initial, const char* key, const T& from,
                   const std::array<Word<T>, N>& words, const char* doc) {
    if (from != initial) word(key, from, words, kOptional, doc);
  }

  template <typename T, typename Visit>
  void group(const char* key, T& from, Need, const char*, const Visit& visit) {
    map_.add(key, write(from, visit));
  }
  template <typename T, typename Visit>
  void group(const char* key, std::optional<T>& from, const char*, const Visit& visit) {
    if (from) map_.add(key, write(*from, visit));
  }

  template <typename T, typename Visit>
  void group_if_set(const char* key, T& from, const char* doc, const Visit& visit) {
    if (!(from == T{})) group(key, from, kOptional, doc, visit);
  }

  template <typename T, typename Visit>
  void list(const char* key, std::vector<T>& from, Length, Need, const char*,
            const Visit& visit) {
    Value list = Value::list();
    for (T& member : from) list.items.push_back(write(member, visit));
    map_.add(key, std::move(list));
  }

  template <typename Variant, typename... Alternatives>
  void choice(Variant& from, const Alternatives&... alternatives) {
    static_assert(sizeof...(Alternatives) == std::variant_size_v<Variant>,
                  "a kind without a key in files");
    const auto write_if_chosen = [&](const auto& candidate) {
      using T = typename std::decay_t<decltype(candidate)>::Type;
      if (T* value = std::get_if<T>(&from)) {
        map_.add(candidate.key, write(*value, candidate.visit));
      }
    };
    (write_if_chosen(alternatives), ...);
  }

 private:
  template <typename Numbers>
  static Value numbers(const Numbers& from) {
    Value list = Value::list();
    for (const double number : from) {
      list.items.push_back(Value::plain(number_text(number)));
    }
    return list;
  }

  Value map_ = Value::map();
};

}  // namespace prehensile::internal
