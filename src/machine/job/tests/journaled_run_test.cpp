#include "passo/job/journaled_run.hpp"

#include "kit/memory_store.hpp"
#include <gtest/gtest.h>

#include "passo/job/interrupted_job.hpp"
#include "passo/job/job_end.hpp"

namespace passo {
namespace {

JournalHead some_head() {
  JournalHead head;
  head.job_counts = {1000, -50};
  head.numbers.greeting = 7;
  head.numbers.session = 99;
  return head;
}

BoardStatus status_at_rest() {
  BoardStatus status{.session = 99, .executed = 20, .state = board_trusted, .motors = 2};
  status.positions[0] = 1300;
  return status;
}

request::Start some_start() {
  return {.program = ProgramReader::from_text("t", "G1 X1 F60\nM2\n"), .options = {}};
}

TEST(JournaledRuns, note_the_rests_and_probe_moves_of_the_run) {
  test::MemoryStore store;
  JournaledRun run(store);
  ASSERT_TRUE(run.begin(some_head()));
  request::Start start = some_start();
  run.add_to(start);
  EXPECT_FALSE(start.from) << "it begins at the beginning";
  start.watchers.rests({.executed = 20, .place = {.item = 4, .s = Mm(2)}});
  start.watchers.probe(ProbeOutcome());
  const auto journal = Journal::read(store.bytes);
  ASSERT_TRUE(journal);
  EXPECT_EQ(journal->place_of(status_at_rest()), (PathPosition{.item = 4, .s = Mm(2)}));
  EXPECT_EQ(journal->head().probes.size(), 1U);
  store.works = false;
  start.watchers.probe(ProbeOutcome());
  EXPECT_FALSE(run.is_written());
  EXPECT_FALSE(run.begin(some_head()));
}

TEST(JournaledRuns, enter_the_path_where_the_job_goes_on) {
  test::MemoryStore store;
  JournaledRun run(store);
  JobEntry entry;
  entry.at.place = {.item = 4, .s = Mm(2)};
  entry.stands = Point();
  entry.probes.resize(2);
  ASSERT_TRUE(run.begin(some_head(), entry));
  request::Start start = some_start();
  run.add_to(start);
  ASSERT_TRUE(start.from);
  EXPECT_EQ(start.from->place, entry.at.place);
  EXPECT_EQ(start.stands, entry.stands);
  EXPECT_EQ(start.known_probes.size(), 2U);
  ASSERT_TRUE(run.begin(some_head()));
  EXPECT_FALSE(run.entry()) << "the next job begins at its beginning";
}

class TakenUpJobs : public testing::Test, public JobKeeper {
 protected:
  TakenUpJobs() {
    JournalWriter writer(store_);
    writer.begin(some_head());
    writer.record(BoardStop{.executed = 20, .place = {.item = 4, .s = Mm(2)}});
  }
  std::optional<BrokenOff> take(bool outlives_host = true) {
    return resume_job(*this, run_, status_, {.session = 123, .number = 9}, outlives_host);
  }
  JournalStore& store() override { return store_; }
  std::string read() override { return store_.bytes; }
  double noted_at() override { return 5; }
  void remove() override { store_.bytes.clear(); }
  std::uint16_t new_number() override { return 1; }
  void name_session(std::uint16_t /*number*/) override {}

  test::MemoryStore store_;
  JournaledRun run_{store_};
  BoardStatus status_ = status_at_rest();
};

TEST_F(TakenUpJobs, rest_where_the_journal_knows_it_and_hear_of_the_greeting) {
  const auto found = take();
  ASSERT_TRUE(found);
  EXPECT_FALSE(found->refused);
  EXPECT_EQ(found->noted_at, 5);
  EXPECT_EQ(found->done, (PathPosition{.item = 4, .s = Mm(2)}));
  EXPECT_EQ(found->farthest, found->done);
  // The next host knows the board before and after the greeting.
  const auto journal = Journal::read(store_.bytes);
  ASSERT_TRUE(journal);
  EXPECT_EQ(journal->head(), found->head);
  EXPECT_TRUE(journal->is_of(status_));
  EXPECT_EQ(journal->head().numbers.session, 123);
  EXPECT_EQ(journal->head().numbers.greeting, 9);
}

TEST_F(TakenUpJobs, are_refused_and_not_written_where_the_board_moves_or_died_with_its_host) {
  const std::string before = store_.bytes;
  status_.state |= board_moves;
  EXPECT_EQ(take()->refused, ResumeRefusal::rest_unknown);
  status_ = status_at_rest();
  EXPECT_EQ(take(false)->refused, ResumeRefusal::board_reset);
  status_.session = 98;
  EXPECT_EQ(take()->refused, ResumeRefusal::other_session);
  EXPECT_EQ(store_.bytes, before);
  EXPECT_TRUE(run_.is_written());
}

TEST_F(TakenUpJobs, are_none_without_a_journal_and_tell_when_it_cannot_be_written) {
  store_.works = false;
  EXPECT_TRUE(take());
  EXPECT_FALSE(run_.is_written());
  store_.bytes.clear();
  EXPECT_FALSE(take());
}

TEST(JobEnds, decide_what_becomes_of_the_journal) {
  const auto end = [](const Answered& answered, std::optional<LinkError> trouble = {}, bool is_resumed = false) {
    return end_of_run(answered, trouble, is_resumed);
  };
  const Answered done;
  EXPECT_EQ(end(done), JobEnd::over);
  EXPECT_EQ(end(done, LinkError::no_answer), JobEnd::board_silent) << "the end may not have been executed";
  const Answered stopped{.outcome = Outcome::stopped};
  EXPECT_EQ(end(stopped), JobEnd::interrupted);
  EXPECT_EQ(end(stopped, LinkError::was_reset), JobEnd::board_in_fault);
  const Answered wrong{.outcome = Outcome::failed, .fault = ActivityFault{MachineFault::program_wrong}};
  EXPECT_EQ(end(wrong), JobEnd::over);
  EXPECT_EQ(end(wrong, LinkError::no_answer, true), JobEnd::over);
  const Answered refused{.outcome = Outcome::failed, .refused = Refusal{RefusalReason::motors_stopped}};
  EXPECT_EQ(end(refused), JobEnd::over) << "it did not begin";
  EXPECT_EQ(end(refused, {}, true), JobEnd::interrupted) << "the earlier job stays";
  const Answered lost{.outcome = Outcome::failed, .refused = Refusal{RefusalReason::unknown_so_home}};
  EXPECT_EQ(end(lost), JobEnd::interrupted);
  EXPECT_EQ(refused.message(), refused.refused->message());
}

TEST(JobEnds, are_stopped_without_an_answer_to_the_request) {
  MachineChange other;
  other.kind = MachineChange::Kind::answered;
  other.ticket = 4;
  EXPECT_EQ(answer_of({other}, 5).outcome, Outcome::stopped);
  MachineChange own = other;
  own.ticket = 5;
  own.outcome = Outcome::failed;
  own.fault = ActivityFault{MachineFault::program_wrong};
  const Answered answered = answer_of({other, own}, 5);
  EXPECT_EQ(answered.outcome, Outcome::failed);
  EXPECT_EQ(answered.message(), own.fault->message());
}

}  // namespace
}  // namespace passo
