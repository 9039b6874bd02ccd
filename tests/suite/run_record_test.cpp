#include "benchmarks/suite/run_record.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/random.h"

namespace prehensile::suite {
namespace {

RunRecord random_record(testing::Random& random) {
  RunRecord record;
  record.status = static_cast<RunStatus>(static_cast<int>(random.in(0.0, 9.99)));
  visit_columns(record, [&random](const char*, auto& value) {
    using T = std::decay_t<decltype(value)>;
    if constexpr (std::is_same_v<T, std::string>) {
      value = "words; with 100 % of \"marks\", é";
    } else if constexpr (std::is_same_v<T, double>) {
      value = random.in(0.0, 1.0) < 0.2 ? kNothing : random.in(-1.0, 1.0) * 1e3;
    } else {
      value = static_cast<T>(random.in(0.0, 1.9));
    }
  });
  const int points = static_cast<int>(random.in(0.0, 4.0));
  for (int i = 0; i < points; ++i) {
    record.progress.push_back({random.in(0.0, 1.0), i == 0 ? kNothing : 1.5});
  }
  return record;
}

TEST(RunRecord, ComesBackFromText) {
  testing::Random random(1);
  for (int i = 0; i < 200; ++i) {
    const RunRecord record = random_record(random);
    RunRecord back;
    ASSERT_TRUE(from_text(to_text(record), back));
    EXPECT_EQ(to_text(back), to_text(record));
    EXPECT_EQ(back.status, record.status);
    EXPECT_EQ(back.message, record.message);
    EXPECT_EQ(back.progress.size(), record.progress.size());
  }
}

TEST(RunRecord, IsNotTakenFromPartOfAText) {
  testing::Random random(2);
  RunRecord record = random_record(random);
  record.progress = {{0.1, 2.0}, {0.2, 1.0}};
  const std::string text = to_text(record);
  // The last line end may be missing, nothing else.
  for (std::size_t size = 0; size + 1 < text.size(); ++size) {
    RunRecord back;
    EXPECT_FALSE(from_text(text.substr(0, size), back)) << size;
  }
}

TEST(RunRecord, KeepsAMessageOnOneLine) {
  RunRecord record;
  record.message = "two\nlines\tand a bell\a";
  RunRecord back;
  ASSERT_TRUE(from_text(to_text(record), back));
  EXPECT_EQ(back.message, "two lines and a bell ");
}

}  // namespace
}  // namespace prehensile::suite
