// The same statements on both engines.
#include "passo/database/database.hpp"

#include <cstdint>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "kit/database_server.hpp"
#include <gtest/gtest.h>

namespace passo {
namespace {

using Kind = DatabaseError::Kind;

class EachDatabase : public test::OnEachEngine {
 protected:
  std::unique_ptr<Database> with_table() {
    auto database = connect();
    EXPECT_TRUE(database->execute_all("CREATE TABLE things (id " + std::string(database->identity_column()) +
                                      ", name TEXT UNIQUE, size DOUBLE PRECISION, data BYTEA, number BIGINT)"));
    return database;
  }
};
INSTANTIATE_TEST_SUITE_P(Of, EachDatabase, test::each_engine, test::engine_name);

TEST_P(EachDatabase, returns_what_was_written) {
  const auto database = with_table();
  const std::string bytes("\0\\'\xff$1\n", 7);
  const std::string name = "d'été; \"$2\" \\x41";
  const auto added =
      database->execute("INSERT INTO things (name, size, data, number) VALUES ($1, $2, $3, $4) RETURNING id",
                        {name, 0.1, Bytes{bytes}, INT64_MIN});
  ASSERT_TRUE(added) << added.error().text;
  EXPECT_EQ(added->front().number(0), 1);
  const auto rows = database->execute("SELECT name, size, data, number FROM things WHERE name = $1", {name});
  ASSERT_TRUE(rows);
  ASSERT_EQ(rows->size(), 1U);
  EXPECT_EQ(rows->front().text(0), name);
  EXPECT_EQ(rows->front().real(1), 0.1);
  EXPECT_EQ(rows->front().bytes(2), bytes);
  EXPECT_EQ(rows->front().number(3), INT64_MIN);
}

TEST_P(EachDatabase, returns_null_as_an_empty_value) {
  const auto database = with_table();
  ASSERT_TRUE(database->execute("INSERT INTO things (name) VALUES ($1)", {Null{}}));
  const auto rows = database->execute("SELECT name, size, data, number FROM things");
  ASSERT_TRUE(rows);
  EXPECT_TRUE(rows->front().is_null(0));
  EXPECT_EQ(rows->front().text(0), "");
  EXPECT_EQ(rows->front().real(1), 0);
  EXPECT_EQ(rows->front().bytes(2), "");
  EXPECT_EQ(rows->front().number(3), 0);
}

TEST_P(EachDatabase, tells_a_duplicate_from_a_wrong_statement) {
  const auto database = with_table();
  ASSERT_TRUE(database->execute("INSERT INTO things (name) VALUES ($1)", {std::string("a")}));
  const auto again = database->execute("INSERT INTO things (name) VALUES ($1)", {std::string("a")});
  ASSERT_FALSE(again);
  EXPECT_EQ(again.error().kind, Kind::duplicate) << again.error().text;
  const auto wrong = database->execute("SELEC 1");
  ASSERT_FALSE(wrong);
  EXPECT_EQ(wrong.error().kind, Kind::other);
  EXPECT_NE(wrong.error().text, "");
}

TEST_P(EachDatabase, rolls_back_what_fails) {
  const auto database = with_table();
  const auto done = database->transact([](Database& within) -> Database::Done {
    EXPECT_TRUE(within.execute("INSERT INTO things (name) VALUES ('a')"));
    return Failure{DatabaseError{Kind::other, "on purpose"}};
  });
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().text, "on purpose");
  EXPECT_TRUE(database->execute("SELECT id FROM things")->empty());
}

// Even if `work` does not notice that a statement has failed.
TEST_P(EachDatabase, rolls_back_after_a_statement_that_failed_on_postgresql) {
  if (!is_postgres()) GTEST_SKIP() << "SQLite goes on after a failed statement";
  const auto database = with_table();
  const auto done = database->transact([](Database& within) -> Database::Done {
    EXPECT_TRUE(within.execute("INSERT INTO things (name) VALUES ('a')"));
    EXPECT_FALSE(within.execute("SELECT nothing"));
    return Unit{};
  });
  EXPECT_FALSE(done);
  EXPECT_TRUE(database->execute("SELECT id FROM things")->empty());
}

// Read, add, write: without a lock, or without another try, increments would be lost.
TEST_P(EachDatabase, loses_no_increment_of_several_threads) {
  const auto database = with_table();
  ASSERT_TRUE(database->execute("INSERT INTO things (name, number) VALUES ('sum', 0)"));
  constexpr int threads = 4;
  constexpr int times = 25;
  std::vector<std::thread> all;
  for (int i = 0; i < threads; ++i) {
    all.emplace_back([this] {
      const auto own = connect();
      for (int k = 0; k < times; ++k) {
        const auto done = own->transact([](Database& within) -> Database::Done {
          const auto rows =
              within.execute("SELECT number FROM things WHERE name = 'sum'" + std::string(within.lock_rows()));
          if (!rows) return Failure{rows.error()};
          const auto set = within.execute("UPDATE things SET number = $1", {rows->front().number(0) + 1});
          return set ? Database::Done(Unit{}) : Database::Done(Failure{set.error()});
        });
        EXPECT_TRUE(done) << done.error().text;
      }
    });
  }
  for (std::thread& one : all) one.join();
  EXPECT_EQ(database->execute("SELECT number FROM things")->front().number(0), threads * times);
}

TEST_P(EachDatabase, connects_again_after_a_restart_of_the_server) {
  if (!is_postgres()) GTEST_SKIP() << "SQLite has no server";
  const auto database = with_table();
  const auto interrupted = database->transact([](Database& within) -> Database::Done {
    EXPECT_TRUE(within.execute("INSERT INTO things (name) VALUES ('lost')"));
    test::DatabaseServer::get()->kill_and_start();
    const auto next = within.execute("INSERT INTO things (name) VALUES ('half')");
    EXPECT_FALSE(next) << "the first half is gone";
    return next ? Database::Done(Unit{}) : Database::Done(Failure{next.error()});
  });
  ASSERT_FALSE(interrupted);
  EXPECT_EQ(interrupted.error().kind, Kind::unreachable) << interrupted.error().text;
  EXPECT_TRUE(database->execute("INSERT INTO things (name) VALUES ('kept')"));
  const auto rows = database->execute("SELECT name FROM things");
  ASSERT_TRUE(rows) << rows.error().text;
  ASSERT_EQ(rows->size(), 1U);
  EXPECT_EQ(rows->front().text(0), "kept");
}

TEST(Database, says_why_it_cannot_be_opened) {
  const auto nowhere = open_database("/nonexistent/farm.db");
  ASSERT_FALSE(nowhere);
  EXPECT_EQ(nowhere.error().kind, Kind::unreachable);
  const auto no_server = open_database("postgresql:///farm?host=/nonexistent");
  ASSERT_FALSE(no_server);
  EXPECT_EQ(no_server.error().kind, Kind::unreachable);
  EXPECT_NE(no_server.error().text, "");
}

}  // namespace
}  // namespace passo
