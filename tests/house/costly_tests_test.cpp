/// What is left out under the sanitizers is there to be left out: a test that was renamed
/// would else come back unseen, or one of a new name be missed.
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
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

TEST(CostlyTests, AreTests) {
  std::string sources;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(kTests)) {
    if (entry.path().extension() == ".cpp") sources += text_of(entry.path());
  }
  const std::string list = text_of(kTests / "support" / "costly_when_sanitized.cmake");
  const std::regex name("\n  (\\w+)\\.(\\w+)");
  int names = 0;
  for (std::sregex_iterator it(list.begin(), list.end(), name), end; it != end; ++it) {
    const std::string test = "(" + it->str(1) + ", " + it->str(2) + ")";
    EXPECT_NE(sources.find(test), std::string::npos) << "no test " << test;
    ++names;
  }
  EXPECT_GT(names, 20);
}

}  // namespace
}  // namespace prehensile
