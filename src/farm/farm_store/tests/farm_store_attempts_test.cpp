// Offers and attempts, on each engine: no part is made twice.
#include <atomic>
#include <thread>

#include "farm_store_kit.hpp"
#include <fmt/format.h>
#include <gmock/gmock.h>

namespace passo {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class FarmAttempts : public test::FarmStoreTest {
 protected:
  std::vector<std::int64_t> offered(const std::string& machine = "mill") {
    std::vector<std::int64_t> ids;
    for (const Offer& offer : value(store().offers(machine))) ids.push_back(offer.job);
    return ids;
  }
  std::optional<StoreRefusal> change(const std::string& id, AttemptState to, double now = 50) {
    return refusal(store().change(id, to, "", now));
  }
};
INSTANTIATE_TEST_SUITE_P(Each, FarmAttempts, test::each_engine, test::engine_name);

TEST_P(FarmAttempts, a_job_is_offered_only_where_its_check_is_good) {
  const FarmJob one = job();
  const std::int64_t id = value(store().add_job(one));
  EXPECT_THAT(offered(), IsEmpty());
  EXPECT_EQ(refusal(store().claim(attempt("x", id), 1)), StoreRefusal::not_proven);
  value(store().want_checks());
  ASSERT_TRUE(store().finish_check({one.program, mill_file_}, {.good = false}));
  EXPECT_THAT(offered(), IsEmpty());
  ASSERT_TRUE(store().finish_check({one.program, mill_file_}, {.good = true, .planned_s = 42}));
  ASSERT_THAT(offered(), ElementsAre(id));
  EXPECT_EQ(value(store().offers("mill")).front().planned_s, 42);
}

TEST_P(FarmAttempts, a_job_is_offered_only_to_machines_that_are_set_up_for_it) {
  const auto with = [&](auto set) {
    FarmJob one = job();
    set(one);
    return proven(one);
  };
  const std::int64_t fits = with([](FarmJob& one) {
    one.material = "acrylic";
    one.tools = {"6 mm", "3 mm"};
    one.labels = {"vacuum"};
    one.stock = "plywood 300 x 200";
  });
  const std::int64_t wrong[] = {with([](FarmJob& one) { one.material = "steel"; }), with([](FarmJob& one) {
                                  one.tools = {"6 mm", "1 mm"};
                                }),
                                with([](FarmJob& one) { one.labels = {"lathe"}; }),
                                with([](FarmJob& one) { one.stock = "acrylic 300 x 200"; })};
  EXPECT_THAT(offered(), ElementsAre(fits));
  for (const std::int64_t id : wrong) {
    EXPECT_EQ(refusal(store().claim(attempt("x", id), 1)), StoreRefusal::unsuitable);
  }
}

TEST_P(FarmAttempts, the_most_urgent_job_comes_first) {
  const auto with = [&](std::int64_t priority, double due) {
    FarmJob one = job();
    one.priority = priority;
    one.due_at = due;
    return proven(one);
  };
  const std::int64_t some_time = with(0, 0);
  const std::int64_t tomorrow = with(0, 200);
  const std::int64_t today = with(0, 100);
  const std::int64_t first = with(1, 0);
  EXPECT_THAT(offered(), ElementsAre(first, today, tomorrow, some_time));
}

TEST_P(FarmAttempts, a_part_is_made_and_the_job_ends) {
  const std::int64_t id = proven(job(2));
  EXPECT_FALSE(refusal(store().claim(attempt("a", id), 10)));
  EXPECT_FALSE(change("a", AttemptState::started, 11));
  EXPECT_FALSE(change("a", AttemptState::done, 12));
  const Attempt made = value(store().attempt("a"));
  EXPECT_EQ(made.started_at, 11);
  EXPECT_EQ(made.ended_at, 12);
  EXPECT_THAT(offered(), ElementsAre(id));
  EXPECT_FALSE(refusal(store().claim(attempt("b", id), 20)));
  EXPECT_THAT(offered(), IsEmpty()) << "all parts are made or being made";
  EXPECT_FALSE(change("b", AttemptState::started));
  EXPECT_FALSE(change("b", AttemptState::done));
  EXPECT_THAT(value(store().jobs(FarmJobState::open)), IsEmpty());
  EXPECT_EQ(value(store().jobs(FarmJobState::done)).front().parts_done, 2);
  EXPECT_EQ(refusal(store().claim(attempt("c", id), 30)), StoreRefusal::job_ended);
}

TEST_P(FarmAttempts, the_same_id_is_the_same_attempt) {
  const std::int64_t id = proven(job());
  const std::int64_t other = proven(job());
  value(store().claim(attempt("a", id), 10));
  EXPECT_EQ(value(store().claim(attempt("a", id), 99)).claimed_at, 10);
  EXPECT_EQ(refusal(store().claim(attempt("a", other), 10)), StoreRefusal::other_attempt);
  EXPECT_EQ(value(store().attempts_of(id)).size(), 1U);
}

TEST_P(FarmAttempts, a_machine_makes_one_part_at_a_time) {
  const std::int64_t id = proven(job(5));
  value(store().claim(attempt("a", id), 10));
  EXPECT_EQ(refusal(store().claim(attempt("b", id), 11)), StoreRefusal::machine_is_taken);
  ASSERT_TRUE(store().put_machine(mill("twin")));
  EXPECT_FALSE(refusal(store().claim(attempt("b", id, "twin"), 12)));
}

// An unknown attempt may have cut the part: it counts until the machine's history says that it has not.
TEST_P(FarmAttempts, an_unknown_attempt_is_not_made_again_by_guess) {
  const std::int64_t id = proven(job());
  ASSERT_TRUE(store().put_machine(mill("twin")));
  ASSERT_TRUE(store().hear("mill", "{}", 10));
  value(store().claim(attempt("a", id), 10));
  change("a", AttemptState::started);
  EXPECT_EQ(value(store().doubt_silent(10)), 0);
  EXPECT_EQ(value(store().doubt_silent(20)), 1);
  EXPECT_EQ(value(store().attempt("a")).state, AttemptState::unknown);
  EXPECT_THAT(offered("twin"), IsEmpty());
  EXPECT_EQ(refusal(store().claim(attempt("b", id, "twin"), 30)), StoreRefusal::job_ended);
  EXPECT_FALSE(change("a", AttemptState::never_started));
  EXPECT_THAT(offered("twin"), ElementsAre(id));
  EXPECT_EQ(change("a", AttemptState::done), StoreRefusal::wrong_state) << "an ended attempt never changes";
}

TEST_P(FarmAttempts, go_from_state_to_state_as_the_table_says) {
  using enum AttemptState;
  const std::int64_t id = proven(job(1000));
  const std::vector<AttemptState> all = {claimed, started, unknown, done, failed, never_started};
  const std::vector<std::vector<AttemptState>> after = {{started, unknown, failed, never_started},
                                                        {unknown, done, failed},
                                                        {started, done, failed, never_started},
                                                        {},
                                                        {},
                                                        {}};
  const std::vector<std::vector<AttemptState>> way = {{},       {started},      {unknown}, {started, done},
                                                      {failed}, {never_started}};
  int number = 0;
  for (const AttemptState from : all) {
    for (const AttemptState to : all) {
      SCOPED_TRACE(fmt::format("{} to {}", name_of(from), name_of(to)));
      const std::string name = fmt::format("try {}", ++number);
      ASSERT_FALSE(refusal(store().claim(attempt(name, id), 1)));
      for (const AttemptState step : way[static_cast<std::size_t>(from)]) EXPECT_FALSE(change(name, step));
      const auto& next = after[static_cast<std::size_t>(from)];
      const bool may = from == to || std::find(next.begin(), next.end(), to) != next.end();
      EXPECT_EQ(change(name, to), may ? std::nullopt : std::optional(StoreRefusal::wrong_state));
      if (is_open(value(store().attempt(name)).state)) {
        static_cast<void>(change(name, started));
        EXPECT_FALSE(change(name, failed));
      }
    }
  }
}

TEST_P(FarmAttempts, of_a_cancelled_job_go_on) {
  const std::int64_t id = proven(job(3));
  value(store().claim(attempt("a", id), 1));
  EXPECT_FALSE(refusal(store().cancel_job(id)));
  EXPECT_THAT(offered(), IsEmpty());
  EXPECT_FALSE(change("a", AttemptState::started));
  EXPECT_FALSE(change("a", AttemptState::done));
  EXPECT_EQ(value(store().jobs(FarmJobState::cancelled)).front().parts_done, 1);
  EXPECT_EQ(refusal(store().cancel_job(77)), StoreRefusal::no_such_job);
}

// Eight machines, each with its own connection and thread, and fewer parts than machines want.
TEST_P(FarmAttempts, never_exceed_the_quantity_whoever_claims_at_the_same_time) {
  constexpr int machines = 8;
  constexpr int parts = 20;
  const std::int64_t id = proven(job(parts));
  for (int i = 0; i < machines; ++i) ASSERT_TRUE(store().put_machine(mill(fmt::format("m{}", i))));
  std::atomic<int> claimed = 0;
  std::vector<std::thread> threads;
  for (int i = 0; i < machines; ++i) {
    threads.emplace_back([&, i] {
      const auto own = connect();
      FarmStore beside = open_store(*own);
      for (int k = 0; k < 6; ++k) {
        const std::string name = fmt::format("{}-{}", i, k);
        const auto begun = beside.claim(attempt(name, id, fmt::format("m{}", i)), k);
        if (!begun) {
          EXPECT_EQ(begun.error().refusal, StoreRefusal::job_ended) << begun.error().text;
          continue;
        }
        ++claimed;
        value(beside.change(name, AttemptState::started, "", k));
        value(beside.change(name, k % 3 == 2 ? AttemptState::failed : AttemptState::done, "", k));
      }
    });
  }
  for (std::thread& one : threads) one.join();
  std::int64_t made = 0;
  for (const Attempt& one : value(store().attempts_of(id))) made += one.state == AttemptState::done ? 1 : 0;
  EXPECT_LE(made, parts);
  EXPECT_GT(claimed, parts) << "some failed and were made again";
  const bool ended = value(store().jobs(FarmJobState::open)).empty();
  EXPECT_EQ(ended, made == parts);
}

}  // namespace
}  // namespace passo
