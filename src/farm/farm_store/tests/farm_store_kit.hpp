// A store with two machines and jobs of a program that is proven on one of them.
#pragma once

#include <stdexcept>
#include <string>

#include "kit/database_server.hpp"
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "passo/farm_store/farm_store.hpp"

namespace passo::test {

class FarmStoreTest : public OnEachEngine {
 protected:
  void SetUp() override {
    OnEachEngine::SetUp();
    if (IsSkipped()) return;
    database_ = connect();
    store_.emplace(open_store(*database_));
    mill_file_ = value(store().add_contents("mill"));
    EXPECT_TRUE(store().put_machine(mill()));
  }
  static FarmStore open_store(Database& database) {
    auto store = FarmStore::open(database, "1.0");
    if (!store) throw std::runtime_error(store.error().text);
    return *store;
  }
  FarmStore& store() { return *store_; }
  FarmMachine mill(const std::string& name = "mill") {
    return {.name = name,
            .url = "http://" + name,
            .token = "t",
            .machine_file = mill_file_,
            .labels = {"room 2", "vacuum"},
            .materials = {"plywood", "acrylic"},
            .tools = {"6 mm", "3 mm"},
            .stock = "plywood 300 x 200"};
  }
  FarmJob job(std::int64_t quantity = 1) {
    return {.name = "coaster", .program = value(store().add_contents("G1 X1")), .quantity = quantity};
  }
  // Adds the job, and proves its program on the mill.
  std::int64_t proven(const FarmJob& job) {
    const std::int64_t id = value(store().add_job(job));
    EXPECT_TRUE(store().want_checks());
    EXPECT_TRUE(store().finish_check({job.program, mill_file_}, {.good = true, .planned_s = 60}));
    return id;
  }
  static Attempt attempt(const std::string& id, std::int64_t job, const std::string& machine = "mill") {
    return {.id = id, .job = job, .machine = machine, .operator_name = "ada"};
  }
  template <class T>
  static T value(const FarmStore::Answer<T>& answer) {
    if (!answer) {
      throw std::runtime_error(
          fmt::format("refusal {}: {}", static_cast<int>(answer.error().refusal), answer.error().text));
    }
    return *answer;
  }
  // What was refused, or nothing.
  template <class T>
  static std::optional<StoreRefusal> refusal(const FarmStore::Answer<T>& answer) {
    return answer ? std::nullopt : std::optional(answer.error().refusal);
  }

  std::unique_ptr<Database> database_;
  std::optional<FarmStore> store_;
  std::string mill_file_;
};

}  // namespace passo::test
