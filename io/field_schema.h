/// Describes the fields of a struct as a JSON Schema (draft 7). Internal to the io layer;
/// the vocabulary is described in fields.h.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <nlohmann/json.hpp>

#include "io/fields.h"
#include "scene/frames.h"

namespace prehensile::internal {

class FieldSchema {
 public:
  using Json = nlohmann::ordered_json;

  /// The schema of a map whose defaults are the values of `example`.
  template <typename T, typename Visit>
  static Json describe(T& example, const Visit& visit) {
    FieldSchema schema;
    visit(schema, example);
    return schema.take();
  }

  /// A whole schema file.
  template <typename T, typename Visit>
  static std::string document(const char* title, const char* description, T& example,
                              const Visit& visit) {
    Json schema = {{"$schema", "http://json-schema.org/draft-07/schema#"},
                   {"title", title},
                   {"description", description}};
    schema.update(describe(example, visit));
    return schema.dump(2) + '\n';
  }

  void version(int number) {
    add("version", {{"const", number}}, kRequired, "Version of this format.");
  }
  void text(const char* key, const std::string& initial, Need need, const char* doc) {
    add(key, with_default({{"type", "string"}}, initial, need), need, doc);
  }
  void number(const char* key, double initial, const Bounds& bounds, Need need,
              const char* doc) {
    add(key, with_default(number_schema(bounds), initial, need), need,
        with_unit(doc, bounds));
  }
  void number(const char* key, const std::optional<double>&, const Bounds& bounds,
              const char* doc) {
    add(key, number_schema(bounds), kOptional, with_unit(doc, bounds));
  }
  void measured(const char* key, double, const Bounds& bounds, const char* doc) {
    Json schema = number_schema(bounds);
    schema["type"] = {"number", "null"};
    add(key, schema, kRequired, with_unit(doc, bounds));
  }
  void count(const char* key, std::uint64_t, const char* doc) {
    add(key, {{"type", "integer"}, {"minimum", 0}}, kRequired, doc);
  }
  void whole(const char* key, int initial, int low, int high, Need need,
             const char* doc) {
    Json schema = {{"type", "integer"}, {"minimum", low}, {"maximum", high}};
    if (need == kOptional) schema["default"] = initial;
    add(key, schema, need, doc);
  }
  void angle(const std::string& key, double initial, const Bounds& bounds,
             const char* doc);
  void angle(const std::string& key, const std::optional<double>&, const Bounds& bounds,
             const char* doc) {
    add_angle(key, bounds, doc, std::nullopt);
  }
  void one_or_two(const char* key, const std::array<double, 2>&, const Bounds& bounds,
                  const char* doc) {
    add(key, {{"oneOf", {number_schema(bounds), numbers_schema(2, bounds)}}}, kRequired,
        with_unit(doc, bounds));
  }
  void names(const char* key, const std::vector<std::string>&, Length length,
             const char* doc) {
    add(key, list_schema({{"type", "string"}}, length), kOptional, doc);
  }
  void numbers(const char* key, const std::map<std::string, double>&, const char* doc) {
    add(key, {{"type", "object"}, {"additionalProperties", {{"type", "number"}}}},
        kOptional, doc);
  }
  void points(const char* key, const std::vector<Vec2>&, Length length,
              const Bounds& bounds, const char* doc) {
    add(key, list_schema(numbers_schema(2, bounds), length), kRequired,
        with_unit(doc, bounds));
  }

  template <typename Vector>
  void vector(const char* key, const Vector& initial, const Bounds& bounds, Need need,
              const char* doc) {
    Json values = Json::array();
    for (const double value : initial) values.push_back(value);
    add(key,
        with_default(numbers_schema(static_cast<std::size_t>(initial.size()), bounds),
                     values, need),
        need, with_unit(doc, bounds));
  }
  template <typename Vector>
  void vector(const char* key, const std::optional<Vector>&, const Bounds& bounds,
              const char* doc) {
    add(key, numbers_schema(Vector::SizeAtCompileTime, bounds), kOptional,
        with_unit(doc, bounds));
  }

  void place(const char* key, const Vec2& initial, double, const Bounds& bounds,
             const char* doc) {
    add(key,
        with_default(two_or_three_schema(bounds), {initial.x(), initial.y()}, kOptional),
        kOptional, with_unit(doc, bounds));
  }
  void place(const char* key, const std::optional<Vec2>&, double, const Bounds& bounds,
             const char* doc) {
    add(key, two_or_three_schema(bounds), kOptional, with_unit(doc, bounds));
  }

  template <typename T, std::size_t N>
  void word(const char* key, const T& initial, const std::array<Word<T>, N>& words,
            Need need, const char* doc) {
    Json schema = {{"enum", Json::array()}};
    for (const Word<T>& word : words) {
      schema["enum"].push_back(word.text);
      if (need == kOptional && word.value == initial) schema["default"] = word.text;
    }
    add(key, schema, need, doc);
  }

  template <typename T, std::size_t N>
  void word_if_not(T, const char* key, const T& into, const std::array<Word<T>, N>& words,
                   const char* doc) {
    word(key, into, words, kOptional, doc);
  }

  template <typename T, typename Visit>
  void group(const char* key, T& example, Need need, const char* doc,
             const Visit& visit) {
    add(key, describe(example, visit), need, doc);
  }
  template <typename T, typename Visit>
  void group(const char* key, const std::optional<T>&, const char* doc,
             const Visit& visit) {
    T example{};
    add(key, describe(example, visit), kOptional, doc);
  }

  template <typename T, typename Visit>
  void group_if_set(const char* key, T& example, const char* doc, const Visit& visit) {
    group(key, example, kOptional, doc, visit);
  }

  template <typename T, typename Visit>
  void list(const char* key, const std::vector<T>&, Length length, Need need,
            const char* doc, const Visit& visit) {
    T example{};
    add(key, list_schema(describe(example, visit), length), need, doc);
  }

  template <typename Variant, typename... Alternatives>
  void choice(const Variant&, const Alternatives&... alternatives) {
    Json one_of = Json::array();
    const auto add_alternative = [&](const auto& candidate) {
      typename std::decay_t<decltype(candidate)>::Type example{};
      add(candidate.key, describe(example, candidate.visit), kOptional, candidate.doc);
      one_of.push_back({{"required", {candidate.key}}});
    };
    (add_alternative(alternatives), ...);
    rules_.push_back({{"oneOf", one_of}});
  }

 private:
  void add(const std::string& key, const Json& schema, Need need, const std::string& doc);
  void add_angle(const std::string& key, const Bounds& bounds, const char* doc,
                 std::optional<double> initial);
  Json take() const;

  static Json number_schema(const Bounds& bounds);
  static Json numbers_schema(std::size_t count, const Bounds& bounds);
  static Json two_or_three_schema(const Bounds& bounds);
  static Json list_schema(const Json& member, Length length);
  static Json with_default(Json schema, const Json& initial, Need need);
  static std::string with_unit(const std::string& doc, const Bounds& bounds);

  Json properties_ = Json::object();
  Json required_ = Json::array();
  Json rules_ = Json::array();  // that concern several keys
};

}  // namespace prehensile::internal
