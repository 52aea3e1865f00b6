// The functions of SQLite that are used, loaded with the first history that is opened: by passo serve --data (decision
// 0120). Private to history/.
#pragma once

#include <sqlite3.h>

#include "passo/base/late_library.hpp"

namespace passo {

struct SqliteLibrary {
  LateLibrary library{PASSO_SQLITE_NAME};
  PASSO_FUNCTION(sqlite3_prepare_v2);
  PASSO_FUNCTION(sqlite3_finalize);
  PASSO_FUNCTION(sqlite3_bind_int64);
  PASSO_FUNCTION(sqlite3_bind_double);
  PASSO_FUNCTION(sqlite3_bind_text64);
  PASSO_FUNCTION(sqlite3_bind_blob64);
  PASSO_FUNCTION(sqlite3_step);
  PASSO_FUNCTION(sqlite3_column_int64);
  PASSO_FUNCTION(sqlite3_column_double);
  PASSO_FUNCTION(sqlite3_column_blob);
  PASSO_FUNCTION(sqlite3_column_bytes);
  PASSO_FUNCTION(sqlite3_open_v2);
  PASSO_FUNCTION(sqlite3_errmsg);
  PASSO_FUNCTION(sqlite3_db_config);
  PASSO_FUNCTION(sqlite3_close_v2);
  PASSO_FUNCTION(sqlite3_exec);
  PASSO_FUNCTION(sqlite3_last_insert_rowid);
  PASSO_FUNCTION(sqlite3_changes);
  PASSO_FUNCTION(sqlite3_wal_checkpoint_v2);
};

}  // namespace passo
