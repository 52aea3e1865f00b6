// Machines, jobs and checks of a farm, on each engine.
#include "farm_store_kit.hpp"

namespace passo {
namespace {

class FarmStoreOf : public test::FarmStoreTest {};
INSTANTIATE_TEST_SUITE_P(Each, FarmStoreOf, test::each_engine, test::engine_name);

TEST_P(FarmStoreOf, keeps_contents_by_their_sha_256) {
  const std::string hash = value(store().add_contents("abc"));
  EXPECT_EQ(hash, "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad") << "FIPS 180-4, example";
  EXPECT_EQ(value(store().add_contents("abc")), hash);
  EXPECT_EQ(value(store().contents(hash)), "abc");
  EXPECT_EQ(value(store().contents("none")), std::nullopt);
}

TEST_P(FarmStoreOf, keeps_what_it_was_given_when_it_is_opened_again) {
  FarmJob given = job(7);
  given.tools = {"6 mm", "3 mm", "6 mm"};
  given.priority = -3;
  given.due_at = 1.75e9;
  given.owner = "ada";
  const std::int64_t id = value(store().add_job(given));
  const auto other = connect();
  FarmStore again = open_store(*other);
  const FarmJob kept = value(again.jobs(FarmJobState::open)).front();
  EXPECT_EQ(kept.id, id);
  EXPECT_EQ(kept.tools, (Words{"3 mm", "6 mm"}));
  EXPECT_EQ(kept.quantity, 7);
  EXPECT_EQ(kept.priority, -3);
  EXPECT_EQ(kept.due_at, 1.75e9);
  EXPECT_EQ(kept.owner, "ada");
  const FarmMachine machine = value(again.machines()).front();
  EXPECT_EQ(machine.labels, (Words{"room 2", "vacuum"}));
  EXPECT_EQ(machine.stock, "plywood 300 x 200");
}

TEST_P(FarmStoreOf, refuses_tables_of_a_newer_program) {
  ASSERT_TRUE(database_->execute("INSERT INTO farm_migrations (number, name) VALUES (99, 'later')"));
  const auto refused = FarmStore::open(*database_, "1.0");
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().text.find("version 99"), std::string::npos) << refused.error().text;
}

TEST_P(FarmStoreOf, hears_machines_that_it_knows) {
  EXPECT_FALSE(refusal(store().hear("mill", "{}", 5)));
  EXPECT_EQ(value(store().machines()).front().heard_at, 5);
  EXPECT_EQ(refusal(store().hear("lathe", "{}", 5)), StoreRefusal::no_such_machine);
  FarmMachine twin = mill("twin");
  twin.url = "http://mill";
  EXPECT_EQ(refusal(store().put_machine(twin)), StoreRefusal::url_in_use);
}

TEST_P(FarmStoreOf, checks_each_program_on_each_machine_file_once) {
  ASSERT_TRUE(store().put_machine(mill("twin"))) << "the same file, so no check more";
  const FarmJob one = job();
  value(store().add_job(one));
  value(store().add_job(one));
  EXPECT_EQ(value(store().want_checks()), 1);
  EXPECT_EQ(value(store().want_checks()), 0);
  FarmStore of_newer = *FarmStore::open(*database_, "1.1");
  EXPECT_EQ(value(of_newer.want_checks()), 1) << "another version of Passo judges anew";
}

TEST_P(FarmStoreOf, gives_a_check_to_one_worker_until_its_time_is_over) {
  value(store().add_job(job()));
  value(store().want_checks());
  EXPECT_TRUE(value(store().take_check("a", 100, 30)));
  EXPECT_FALSE(value(store().take_check("b", 129, 30)));
  const auto again = value(store().take_check("b", 130, 30));
  ASSERT_TRUE(again) << "worker a has died";
  ASSERT_TRUE(store().finish_check(*again, {.good = false, .findings = "[]"}));
  EXPECT_FALSE(value(store().take_check("a", 1e9, 30)));
}

// Two connections at the same time: the second worker gets the second check and does not wait for the first.
TEST_P(FarmStoreOf, gives_workers_different_checks) {
  FarmJob second = job();
  second.program = value(store().add_contents("G1 X2"));
  value(store().add_job(job()));
  value(store().add_job(second));
  EXPECT_EQ(value(store().want_checks()), 2);
  const auto other = connect();
  FarmStore beside = open_store(*other);
  const auto one = value(store().take_check("a", 0, 30));
  const auto two = value(beside.take_check("b", 0, 30));
  ASSERT_TRUE(one && two);
  EXPECT_NE(one->program, two->program);
}

}  // namespace
}  // namespace passo
