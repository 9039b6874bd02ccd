/// Questions to SQLite itself, past our own reader.
#pragma once

#include <filesystem>
#include <sqlite3.h>
#include <string>

#include <gtest/gtest.h>

namespace prehensile::suite::testing {

/// The one number that a question gives.
inline double asked(const std::filesystem::path& file, const std::string& sql) {
  sqlite3* handle = nullptr;
  double value = -1.0;
  EXPECT_EQ(sqlite3_open(file.c_str(), &handle), SQLITE_OK);
  sqlite3_stmt* statement = nullptr;
  EXPECT_EQ(sqlite3_prepare_v2(handle, sql.c_str(), -1, &statement, nullptr), SQLITE_OK)
      << sqlite3_errmsg(handle);
  if (sqlite3_step(statement) == SQLITE_ROW) value = sqlite3_column_double(statement, 0);
  sqlite3_finalize(statement);
  sqlite3_close(handle);
  return value;
}

}  // namespace prehensile::suite::testing
