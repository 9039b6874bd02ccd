/// What is left out under the sanitizers is there to be left out, and no file of tests is
/// left out as a whole.
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>

#include <gtest/gtest.h>

namespace prehensile {
namespace {

namespace fs = std::filesystem;

const fs::path kTests = fs::path(PREHENSILE_SOURCE_DIR) / "tests";

std::string text_of(const fs::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// "Suite.Name" of each test that the list names.
std::set<std::string> costly() {
  const std::string list = text_of(kTests / "support" / "costly_when_sanitized.cmake");
  const std::regex name("\n  (\\w+\\.\\w+)");
  std::set<std::string> names;
  for (std::sregex_iterator it(list.begin(), list.end(), name), end; it != end; ++it) {
    names.insert(it->str(1));
  }
  return names;
}

/// Those of label `default` that a source holds.
std::set<std::string> tests_of(const std::string& source) {
  const std::regex test("\nTEST(?:_F)?\\((\\w+), (\\w+)\\)");
  std::set<std::string> names;
  for (std::sregex_iterator it(source.begin(), source.end(), test), end; it != end;
       ++it) {
    const std::string name = it->str(1) + '.' + it->str(2);
    if (name.find("Full") == std::string::npos) names.insert(name);
  }
  return names;
}

TEST(CostlyTests, AreTestsAndLeaveOthersInTheirFiles) {
  std::set<std::string> unknown = costly();
  ASSERT_GT(unknown.size(), 20U);
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(kTests)) {
    if (entry.path().extension() != ".cpp") continue;
    const std::set<std::string> tests = tests_of(text_of(entry.path()));
    std::size_t left_out = 0;
    for (const std::string& name : tests) left_out += unknown.erase(name);
    EXPECT_TRUE(left_out == 0 || left_out < tests.size()) << entry.path();
  }
  for (const std::string& name : unknown) ADD_FAILURE() << "no test " << name;
}

}  // namespace
}  // namespace prehensile
