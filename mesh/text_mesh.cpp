#include "mesh/text_mesh.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string_view>
#include <vector>

#include "mesh/triangle_mesh.h"

namespace prehensile::internal {
namespace {

/// The library makes another number of one with more digits than it has room for.
constexpr double kMostCoordinate = 1e9;

/// The time to cut up a polygon grows with the square of its corners.
constexpr std::size_t kMostCorners = 1000;

constexpr std::string_view kSpace = " \t\r\v\f";

struct Line {
  std::string_view text;  ///< without its end
  int number = 0;         ///< the first is 1
  std::vector<std::string_view> words;
};

/// Runs `take(line)` for every line.
template <typename Take>
void for_each_line(std::string_view text, const Take& take) {
  Line line;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    line.text = text.substr(0, end);
    ++line.number;
    line.words.clear();
    for (std::size_t at = line.text.find_first_not_of(kSpace);
         at != std::string_view::npos;) {
      const std::size_t to =
          std::min(line.text.find_first_of(kSpace, at), line.text.size());
      line.words.push_back(line.text.substr(at, to - at));
      at = line.text.find_first_not_of(kSpace, to);
    }
    take(line);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
}

[[noreturn]] void refuse(const std::string& name, const Line& line,
                         const std::string& what) {
  constexpr std::size_t kMostShown = 60;
  std::string shown(line.text.substr(0, kMostShown));
  std::erase_if(shown, [](char c) { return c < ' ' || c > '~'; });
  throw BadMesh(name + ':' + std::to_string(line.number) + ": " + shown + ": expected " +
                what);
}

template <class Number>
bool reads(std::string_view word, Number& into) {
  if (word.starts_with('+')) word.remove_prefix(1);
  const auto [rest, fault] =
      std::from_chars(word.data(), word.data() + word.size(), into);
  return fault == std::errc() && rest == word.data() + word.size();
}

/// The numbers behind the first word of a line are a vertex's coordinates, and `more` of
/// something else.
std::string vertex_of(const std::string& name, const Line& line,
                      std::initializer_list<std::size_t> more) {
  std::array<double, 3> place{};
  const std::size_t numbers = line.words.size() - 1;
  bool sound = numbers >= place.size() &&
               std::ranges::find(more, numbers - place.size()) != more.end();
  for (std::size_t i = 0; sound && i < numbers; ++i) {
    double value = 0.0;
    sound = reads(line.words[1 + i], value) && std::abs(value) <= kMostCoordinate;
    if (i < place.size()) place[i] = value;
  }
  if (!sound) refuse(name, line, "a vertex of three numbers of at most 1e9");
  std::array<char, 96> text;
  const int size = std::snprintf(text.data(), text.size(), " %.9g %.9g %.9g\n", place[0],
                                 place[1], place[2]);
  return {text.data(), static_cast<std::size_t>(size)};
}

/// Vertex i of a corner such as i, i/j, i//k or i/j/k.
std::optional<long> vertex_named(std::string_view corner) {
  long vertex = 0;
  for (int part = 0; part < 3; ++part) {
    const std::size_t end = std::min(corner.find('/'), corner.size());
    const std::string_view word = corner.substr(0, end);
    long index = 0;
    if (part == 0 ? !reads(word, vertex) : !word.empty() && !reads(word, index)) break;
    if (end == corner.size()) return vertex;
    corner.remove_prefix(end + 1);
  }
  return std::nullopt;
}

}  // namespace

std::string bare_obj(const std::string& bytes, const std::string& name) {
  std::string out = "o body\n";
  long vertices = 0;
  std::size_t triangles = 0;
  const auto add_face = [&](const Line& line) {
    const std::size_t corners = line.words.size() - 1;
    if (corners > kMostCorners) {
      refuse(name, line,
             "a face of at most " + std::to_string(kMostCorners) + " corners");
    }
    out += 'f';
    for (std::size_t i = 0; i < corners; ++i) {
      const auto index = vertex_named(line.words[1 + i]);
      if (!index) refuse(name, line, "a face of indices such as 7, 7/1 or 7/1/3");
      const long vertex = *index < 0 ? vertices + *index + 1 : *index;
      if (vertex < 1 || vertex > vertices) {
        refuse(name, line,
               "one of the " + std::to_string(vertices) +
                   " vertices above it, not vertex " + std::to_string(*index));
      }
      out += ' ' + std::to_string(vertex);
    }
    out += '\n';
    triangles += std::max<std::size_t>(corners, 2) - 2;
    if (triangles > kMostTriangles) {
      refuse(name, line,
             "at most " + std::to_string(kMostTriangles) + " triangles in all");
    }
  };
  for_each_line(bytes, [&](const Line& line) {
    if (line.words.empty()) return;
    if (line.words.front() == "v") {
      out += 'v' + vertex_of(name, line, {0, 1, 3, 4});  // weight, colour
      ++vertices;
    } else if (line.words.front() == "f") {
      add_face(line);
    }
  });
  return out;
}

std::string bare_stl(const std::string& bytes, const std::string& name) {
  constexpr std::array<std::string_view, 4> kOthers = {"outer", "endloop", "endfacet",
                                                       "endsolid"};
  std::string out;
  for_each_line(bytes, [&](const Line& line) {
    if (line.words.empty()) return;
    const std::string_view word = line.words.front();
    if (word == "vertex") {
      out += "vertex" + vertex_of(name, line, {0});
    } else if (word == "facet") {
      out += "facet normal 0 0 0\n";  // the vertices tell which way it looks
    } else if (word == "solid") {
      out += "solid body\n";
    } else if (std::ranges::find(kOthers, word) != kOthers.end()) {
      out += std::string(word) + (word == "outer" ? " loop\n" : "\n");
    } else {
      refuse(
          name, line,
          "a text STL, or a binary one of the length that its count of triangles says");
    }
  });
  return out;
}

}  // namespace prehensile::internal
