#include "passo/journal/journal.hpp"

#include <cstdint>
#include <string>
#include <vector>

#include "kit/memory_store.hpp"
#include <gtest/gtest.h>

namespace passo {
namespace {

ProbeOutcome touched_at(double z) {
  return {.refused = false, .touched = true, .contact = {{{1, 1.0 / 3, z}}}, .rest = {{{1, 1.0 / 3, z - 0.05}}}};
}

JournalHead some_head() {
  return {.made_by = "1.2.3",
          .program = {.name = "/parts/100% odd\nname.ngc", .size = 12, .fingerprint = 0xFEDCBA9876543210U},
          .machine = {.name = "/m.toml", .size = 1, .fingerprint = 2},
          .path = 77,
          .job_counts = {5, -2'000'000'000, 0},
          .start = {{{1.0 / 3, -2}}},
          .numbers = {.session_before = 11, .executed_before = 65'000, .greeting = 200, .session = 300},
          .place = {.item = 40, .s = Mm(0.1 + 0.2)},
          .probes = {touched_at(0.1)}};
}

BoardStatus status(std::uint16_t session, ItemNumber executed, std::uint8_t motors = 3) {
  return {.session = session, .executed = executed, .state = board_trusted, .motors = motors};
}

class Journals : public testing::Test {
 protected:
  Journals() { writer_.begin(some_head()); }
  // What a new host reads.
  Journal journal() const {
    auto read = Journal::read(store_.bytes);
    EXPECT_TRUE(read);
    return read.value_or(Journal());
  }
  void note(ItemNumber executed, std::uint64_t item, double s = 0) {
    writer_.record({.executed = executed, .place = {.item = item, .s = Mm(s)}});
  }

  test::MemoryStore store_;
  JournalWriter writer_{store_};
};

TEST_F(Journals, give_back_what_was_written_to_the_last_bit) {
  EXPECT_EQ(journal().head(), some_head());
  note(201, 41, 1.0 / 3);
  EXPECT_EQ(journal().place_of(status(300, 201)), (PathPosition{.item = 41, .s = Mm(1.0 / 3)}));
}

TEST_F(Journals, give_back_what_probe_moves_have_found_before_the_session_and_in_it) {
  writer_.record(touched_at(-1.0 / 7));
  note(201, 41);
  ProbeOutcome refused;
  refused.refused = true;
  writer_.record(refused);
  const std::vector<ProbeOutcome> all = {touched_at(0.1), touched_at(-1.0 / 7), refused};
  EXPECT_EQ(journal().head().probes, all);
  EXPECT_EQ(journal().place_of(status(300, 201)), (PathPosition{.item = 41}));
}

// What is torn is the last outcome, behind which nothing has moved.
TEST_F(Journals, know_only_outcomes_that_are_whole) {
  const std::size_t first = store_.bytes.size();
  writer_.record(touched_at(2));
  const std::size_t second = store_.bytes.size();
  writer_.record(touched_at(3));
  const std::string whole = store_.bytes;
  for (std::size_t size = first; size <= whole.size(); ++size) {
    const auto torn = Journal::read(whole.substr(0, size));
    ASSERT_TRUE(torn);
    const std::size_t known = size < second ? 1 : size < whole.size() ? 2 : 3;
    ASSERT_EQ(torn->head().probes.size(), known) << size - first;
  }
  for (std::size_t at = first; at < second; ++at) {
    std::string damaged = whole;
    damaged[at] = damaged[at] == '0' ? '1' : '0';
    ASSERT_FALSE(Journal::read(damaged)) << at - first;
  }
}

TEST_F(Journals, know_the_rests_of_their_session_and_no_others) {
  EXPECT_EQ(journal().place_of(status(300, 200)), some_head().place) << "nothing has arrived";
  note(230, 41, 0.5);
  note(260, 42, 0.25);
  EXPECT_EQ(journal().place_of(status(300, 230)), (PathPosition{.item = 41, .s = Mm(0.5)}));
  EXPECT_EQ(journal().place_of(status(300, 260)), (PathPosition{.item = 42, .s = Mm(0.25)}));
  EXPECT_FALSE(journal().place_of(status(300, 250))) << "amid a refill";
  EXPECT_FALSE(journal().place_of(status(301, 230)));
}

TEST_F(Journals, know_what_is_surely_executed) {
  EXPECT_EQ(journal().done(), some_head().place);
  writer_.record({.executed = 230, .place = {.item = 44, .s = Mm(1)}, .done = {.item = 41, .s = Mm(0.25)}});
  EXPECT_EQ(journal().done(), some_head().place) << "a refill later";
  writer_.record({.executed = 260, .place = {.item = 46, .s = Mm(0)}, .done = {.item = 43, .s = Mm(0)}});
  EXPECT_EQ(journal().done(), (PathPosition{.item = 41, .s = Mm(0.25)}));
  EXPECT_EQ(journal().farthest(), (PathPosition{.item = 46, .s = Mm(0)}));
}

TEST_F(Journals, know_a_board_that_has_not_heard_all_of_the_greeting) {
  EXPECT_EQ(journal().place_of(status(11, 65'000)), some_head().place) << "no hello came through";
  EXPECT_EQ(journal().place_of(status(0, 200)), some_head().place) << "but no session";
  EXPECT_FALSE(journal().is_of(status(11, 64'999)));
  EXPECT_FALSE(journal().is_of(status(0, 0, 0))) << "it was reset";
}

TEST_F(Journals, take_a_board_for_reset_that_had_heard_the_session_and_has_forgotten_it) {
  JournalHead head = some_head();
  head.numbers.session_before = head.numbers.executed_before = 0;
  writer_.begin(head);
  EXPECT_TRUE(journal().is_of(status(0, 0, 0))) << "as it was, and nothing was sent";
  note(201, 1);
  EXPECT_FALSE(journal().is_of(status(0, 0, 0)));
  EXPECT_FALSE(journal().is_of(status(0, 200)));
}

TEST_F(Journals, do_not_grow_and_keep_the_latest) {
  const std::size_t size = store_.bytes.size();
  constexpr unsigned many = 20'000;
  for (unsigned i = 1; i <= many; ++i) note(static_cast<ItemNumber>(200 + 9 * i), i, i * 0.001);
  EXPECT_EQ(store_.bytes.size(), size);
  const Journal read = journal();
  EXPECT_EQ(read.torn(), 0U);
  for (unsigned i = many - JournalWriter::rests + 1; i <= many; ++i) {
    EXPECT_EQ(read.place_of(status(300, static_cast<ItemNumber>(200 + 9 * i))),
              (PathPosition{.item = i, .s = Mm(i * 0.001)}));
  }
}

TEST_F(Journals, that_were_torn_anywhere_say_so_and_never_tell_another_place) {
  note(230, 41, 0.5);
  note(260, 42, 0.25);
  const std::string whole = store_.bytes;
  const std::size_t end_of_lines = whole.find_last_not_of(" \n") + 1;
  for (std::size_t at = 0; at < end_of_lines; ++at) {
    std::string torn = whole;
    torn[at] = torn[at] == '7' ? '8' : '7';
    const auto read = Journal::read(torn);
    if (!read) continue;
    EXPECT_EQ(read->head(), some_head());
    EXPECT_EQ(read->torn(), 1U) << at;
    EXPECT_EQ(read->place_of(status(300, 230)).value_or(PathPosition{.item = 41, .s = Mm(0.5)}).item, 41U);
    EXPECT_EQ(read->place_of(status(300, 260)).value_or(PathPosition{.item = 42, .s = Mm(0.25)}).item, 42U);
    EXPECT_FALSE(read->place_of(status(300, 230)) && read->place_of(status(300, 260))) << at;
  }
  for (std::size_t size = 0; size < end_of_lines; ++size) {
    const auto read = Journal::read(std::string_view(whole).substr(0, size));
    EXPECT_FALSE(read && read->place_of(status(300, 260))) << size;
  }
}

TEST_F(Journals, that_cannot_be_written_are_not_relied_on) {
  EXPECT_FALSE(writer_.failed());
  store_.works = false;
  note(230, 41);
  EXPECT_TRUE(writer_.failed());
  store_.works = true;
  note(260, 42);
  EXPECT_TRUE(writer_.failed());
  EXPECT_FALSE(journal().place_of(status(300, 260))) << "one was lost: what comes behind is not written either";
}

}  // namespace
}  // namespace passo
