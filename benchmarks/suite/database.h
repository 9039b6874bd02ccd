/// SQLite, as far as the results need it. Internal to the suite.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

struct sqlite3;
struct sqlite3_stmt;

namespace prehensile::suite {

class Database;

/// A prepared statement. Parameters and columns count from 0.
class Statement {
 public:
  Statement(Database& database, const std::string& sql);
  ~Statement();
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  void bind(int parameter, double value);  ///< not finite: NULL
  void bind(int parameter, std::int64_t value);
  void bind(int parameter, const std::string& value);

  /// The next row; false at the end, after which the statement may be used again.
  bool step();

  bool is_null(int column) const;
  double real(int column) const;  ///< NaN for NULL
  std::int64_t integer(int column) const;
  std::string text(int column) const;

 private:
  Database& database_;
  sqlite3_stmt* statement_ = nullptr;
};

/// An open database. Every failure is a BadInput that names the file and says why.
class Database {
 public:
  enum class Open {
    kCreate,  ///< a file that is not there yet
    kAppend,  ///< an existing one, for this process alone
    kRead
  };
  Database(const std::filesystem::path& file, Open how);
  ~Database();
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;

  void run(const std::string& sql);
  /// Everything since the last call becomes permanent, or nothing of it.
  void begin();
  void commit();
  void roll_back() noexcept;
  std::int64_t last_id() const;
  int changes() const;

  /// Ends the use of side files; the file then holds everything.
  void close();

  [[noreturn]] void fail(const std::string& doing) const;
  sqlite3* handle() const { return handle_; }

 private:
  std::filesystem::path file_;
  sqlite3* handle_ = nullptr;
};

}  // namespace prehensile::suite
