// DatabaseServer: a PostgreSQL server of this test program alone, on a socket in a folder of its own. It is started
// when it is first needed, and stopped at the end. Databases: one new, empty database of each engine for a test.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>

#include "kit/scratch_folder.hpp"
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "passo/database/database.hpp"

namespace passo::test {

class DatabaseServer {
 public:
  // Null: there is no PostgreSQL server on this computer.
  static DatabaseServer* get() {
    static DatabaseServer server;
    return server.runs_ ? &server : nullptr;
  }
  std::string url(const std::string& database) const {
    return fmt::format("postgresql:///{}?host={}&user=passo", database, folder_.path().string());
  }
  std::string new_database() {
    const std::string name = fmt::format("test{}", ++databases_);
    const auto connection = open_database(url("postgres"));
    EXPECT_TRUE(connection && (*connection)->execute("CREATE DATABASE " + name));
    return url(name);
  }
  // As a power failure does.
  void kill_and_start() {
    EXPECT_EQ(run("pg_ctl stop --mode=immediate --silent" + data_and_log()), 0);
    EXPECT_EQ(run("pg_ctl start --wait --silent" + data_and_log()), 0);
  }

 private:
  DatabaseServer() {
    const std::filesystem::path versions = "/usr/lib/postgresql";
    if (std::filesystem::is_directory(versions)) {
      for (const auto& version : std::filesystem::directory_iterator(versions)) programs_ = version.path() / "bin";
    }
    if (programs_.empty()) return;
    // The server refuses to be root.
    if (::geteuid() == 0) as_user_ = "runuser -u postgres -- ";
    static_cast<void>(std::system(fmt::format("chmod 711 '{0}'; mkdir '{0}/data'", folder_.path().string()).c_str()));
    if (::geteuid() == 0) {
      const std::string owns = fmt::format("chown postgres '{0}' '{0}/data'", folder_.path().string());
      if (std::system(owns.c_str()) != 0) return;
    }
    runs_ = run(fmt::format("initdb --no-sync --auth=trust --username=passo --pgdata='{}/data' >/dev/null",
                            folder_.path().string())) == 0 &&
            run("pg_ctl start --wait --silent" + data_and_log()) == 0;
  }
  ~DatabaseServer() {
    if (runs_) static_cast<void>(run("pg_ctl stop --mode=immediate --silent" + data_and_log()));
  }
  std::string data_and_log() const {
    return fmt::format(" --pgdata='{0}/data' --log='{0}/log' -o \"-k '{0}' -c listen_addresses='' -c fsync=off\"",
                       folder_.path().string());
  }
  int run(const std::string& command) const {
    return std::system(fmt::format("cd / && {}'{}'/{}", as_user_, programs_.string(), command).c_str());
  }

  ScratchFolder folder_;
  std::filesystem::path programs_;
  std::string as_user_;
  int databases_ = 0;
  bool runs_ = false;
};

// A test for each engine.
class OnEachEngine : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    // A server takes seconds to start: all its tests share one, in one process.
    if (is_postgres() && std::getenv("PASSO_POSTGRESQL") == nullptr) GTEST_SKIP() << "PASSO_POSTGRESQL=1";
    if (is_postgres() && DatabaseServer::get() == nullptr) GTEST_SKIP() << "no PostgreSQL server is installed";
    where_ = is_postgres() ? DatabaseServer::get()->new_database() : (folder_.path() / "farm.db").string();
  }
  static bool is_postgres() { return std::string(GetParam()) == "postgresql"; }
  // A connection of its own to the test's database.
  std::unique_ptr<Database> connect() {
    auto database = open_database(where_);
    if (!database) throw std::runtime_error(database.error().text);
    return std::move(*database);
  }

 private:
  ScratchFolder folder_;
  std::string where_;
};
inline const auto each_engine = testing::Values("sqlite", "postgresql");
inline std::string engine_name(const testing::TestParamInfo<const char*>& info) {
  return info.param;
}

}  // namespace passo::test
