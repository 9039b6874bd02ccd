/// One name, one type: two headers that define different types by the same full name may
/// each be right where they are included, and wrong where they are linked together.
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace prehensile {
namespace {

namespace fs = std::filesystem;

const std::regex kNamespace(R"(^namespace ([A-Za-z_:]+) \{)");
const std::regex kEndOfNamespace(R"(^\}  // namespace)");
const std::regex kType(R"(^(?:struct|class|enum class|union) ([A-Za-z_]+)(?: [:{].*)?$)");

/// Full names of the types that a header defines outside of other types.
std::vector<std::string> types_of(std::istream& header) {
  std::vector<std::string> types;
  std::vector<std::string> spaces;
  for (std::string line; std::getline(header, line);) {
    std::smatch match;
    if (std::regex_search(line, match, kNamespace)) {
      spaces.push_back(match[1]);
    } else if (std::regex_search(line, kEndOfNamespace)) {
      if (!spaces.empty()) spaces.pop_back();
    } else if (std::regex_match(line, match, kType)) {
      std::string name;
      for (const std::string& space : spaces) name += space + "::";
      types.push_back(name + match[1].str());
    }
  }
  return types;
}

TEST(Names, EachIsThatOfOneType) {
  const fs::path root = PREHENSILE_SOURCE_DIR;
  std::map<std::string, std::string> header_of;
  for (const char* folder :
       {"scene", "optimisation", "mechanics", "primitives", "planner", "problems", "mesh",
        "io", "plot", "viewer", "mjcf", "apps", "benchmarks", "tests"}) {
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      if (entry.path().extension() != ".h") continue;
      std::ifstream header(entry.path());
      const std::string path = entry.path().lexically_relative(root).string();
      for (const std::string& type : types_of(header)) {
        const auto [first, is_new] = header_of.emplace(type, path);
        EXPECT_TRUE(is_new) << type << " in " << first->second << " and " << path;
      }
    }
  }
  EXPECT_GT(header_of.size(), 300U);
}

TEST(Names, AreFoundInTheirNamespaces) {
  std::istringstream header(
      "namespace a {\nclass Forward;\nstruct One {\n  struct Inner {\n};\n"
      "namespace b {\nenum class Two { kX };\n}  // namespace b\nclass Three : One {\n"
      "}  // namespace a\nclass Four\n");
  EXPECT_EQ(types_of(header),
            (std::vector<std::string>{"a::One", "a::b::Two", "a::Three", "Four"}));
}

}  // namespace
}  // namespace prehensile
