#include "benchmarks/suite/database.h"

#include <cerrno>
#include <cmath>
#include <cstring>
#include <limits>
#include <sqlite3.h>

#include "io/scene_file.h"

namespace prehensile::suite {
namespace {

namespace fs = std::filesystem;

int flags_of(Database::Open how) {
  switch (how) {
    case Database::Open::kCreate:
      return SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE;
    case Database::Open::kAppend:
    case Database::Open::kRead:
      break;
  }
  // Reading may have to take in what a killed writer left beside the file.
  return SQLITE_OPEN_READWRITE;
}

}  // namespace

Database::Database(const fs::path& file, Open how) : file_(file) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (how == Open::kCreate && fs::exists(status)) {
    throw BadInput(file.string() +
                   ": exists: expected a new file, or --resume to go on with this one");
  }
  if (how != Open::kCreate && !fs::exists(status)) {
    throw BadInput(file.string() + ": cannot be opened: no such file");
  }
  if (how != Open::kCreate && !fs::is_regular_file(status)) {
    throw BadInput(file.string() + ": expected a file of results");
  }
  int opened = sqlite3_open_v2(file.c_str(), &handle_, flags_of(how), nullptr);
  if (opened != SQLITE_OK && how == Open::kRead) {  // a folder without leave to write
    sqlite3_close(handle_);
    opened = sqlite3_open_v2(file.c_str(), &handle_, SQLITE_OPEN_READONLY, nullptr);
  }
  try {
    if (opened != SQLITE_OK) fail("cannot be opened");
    sqlite3_extended_result_codes(handle_, 1);
    sqlite3_busy_timeout(handle_, how == Open::kRead ? 2000 : 0);
    if (how != Open::kRead) {
      // One writer, which needs no shared memory and so no local disk; a row survives the
      // death of the process as soon as it is committed.
      run("PRAGMA locking_mode = EXCLUSIVE");
      run("PRAGMA journal_mode = WAL");
      run("PRAGMA synchronous = NORMAL");
      run("PRAGMA foreign_keys = ON");
    } else {
      run("SELECT count(*) FROM sqlite_master");
    }
  } catch (...) {
    sqlite3_close(handle_);
    throw;
  }
}

Database::~Database() { sqlite3_close(handle_); }

void Database::run(const std::string& sql) {
  if (sqlite3_exec(handle_, sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK) {
    fail("cannot be written or read");
  }
}

void Database::begin() { run("BEGIN IMMEDIATE"); }

void Database::commit() { run("COMMIT"); }

void Database::roll_back() noexcept {
  sqlite3_exec(handle_, "ROLLBACK", nullptr, nullptr, nullptr);
}

std::int64_t Database::last_id() const { return sqlite3_last_insert_rowid(handle_); }

int Database::changes() const { return sqlite3_changes(handle_); }

void Database::close() {
  run("PRAGMA journal_mode = DELETE");
  sqlite3_close(handle_);
  handle_ = nullptr;
}

void Database::fail(const std::string& doing) const {
  const int code = handle_ ? sqlite3_errcode(handle_) & 0xff : SQLITE_NOMEM;
  const int reason = handle_ ? sqlite3_system_errno(handle_) : 0;
  std::string what = handle_ ? sqlite3_errmsg(handle_) : "out of memory";
  if (code == SQLITE_BUSY || code == SQLITE_LOCKED) {
    what = "another process is using it";
  } else if (code == SQLITE_NOTADB || code == SQLITE_CORRUPT) {
    what += ": expected a file of results";
  } else if (reason != 0) {
    what += std::string(" (") + std::strerror(reason) + ')';
  }
  throw BadInput(file_.string() + ": " + doing + ": " + what);
}

Statement::Statement(Database& database, const std::string& sql) : database_(database) {
  const int done =
      sqlite3_prepare_v2(database.handle(), sql.c_str(), -1, &statement_, nullptr);
  if (done != SQLITE_OK) database.fail("is no file of results of this program");
}

Statement::~Statement() { sqlite3_finalize(statement_); }

void Statement::bind(int parameter, double value) {
  if (std::isfinite(value)) {
    sqlite3_bind_double(statement_, parameter + 1, value);
  } else {
    sqlite3_bind_null(statement_, parameter + 1);
  }
}

void Statement::bind(int parameter, std::int64_t value) {
  sqlite3_bind_int64(statement_, parameter + 1, value);
}

void Statement::bind(int parameter, const std::string& value) {
  sqlite3_bind_text(statement_, parameter + 1, value.data(),
                    static_cast<int>(value.size()), SQLITE_TRANSIENT);
}

bool Statement::step() {
  const int done = sqlite3_step(statement_);
  if (done == SQLITE_ROW) return true;
  if (done != SQLITE_DONE) {
    sqlite3_reset(statement_);
    database_.fail("cannot be written or read");
  }
  sqlite3_reset(statement_);
  sqlite3_clear_bindings(statement_);
  return false;
}

bool Statement::is_null(int column) const {
  return sqlite3_column_type(statement_, column) == SQLITE_NULL;
}

double Statement::real(int column) const {
  return is_null(column) ? std::numeric_limits<double>::quiet_NaN()
                         : sqlite3_column_double(statement_, column);
}

std::int64_t Statement::integer(int column) const {
  return sqlite3_column_int64(statement_, column);
}

std::string Statement::text(int column) const {
  const auto* words =
      reinterpret_cast<const char*>(sqlite3_column_text(statement_, column));
  const int size = sqlite3_column_bytes(statement_, column);
  return words ? std::string(words, static_cast<std::size_t>(size)) : std::string();
}

}  // namespace prehensile::suite
