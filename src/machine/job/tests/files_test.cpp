#include <cerrno>
#include <fstream>

#include "kit/example_machine.hpp"
#include "kit/folder_test.hpp"

#include "passo/job/journal_file.hpp"
#include "passo/job/state_file.hpp"
#include "passo/job/stored_position.hpp"

namespace passo {
namespace {

void put(const std::string& path, std::string_view text) {
  std::ofstream(path, std::ios::binary) << text;
}

class JournalFiles : public test::FolderTest {
 protected:
  using Kind = FoundJournal::Kind;

  std::string path_ = path("job.journal");
};

TEST_F(JournalFiles, keep_what_a_writer_writes) {
  JournalFile file(path_);
  ASSERT_TRUE(file.claim()) << "there is none yet";
  EXPECT_EQ(file.written_at(), 0);
  JournalWriter writer(file);
  JournalHead head;
  head.made_by = "1.2.3";
  head.job_counts = {5, -7};
  head.numbers.greeting = 7;
  head.numbers.session = 99;
  writer.begin(head);
  writer.record(BoardStop{.executed = 20, .place = {.item = 4, .s = Mm(2)}});
  ProbeOutcome touched;
  touched.touched = true;
  writer.record(touched);
  EXPECT_FALSE(writer.failed());
  const FoundJournal found = JournalFile(path_).find();
  ASSERT_EQ(found.kind, Kind::whole);
  EXPECT_EQ(found.journal->head().job_counts, head.job_counts);
  EXPECT_EQ(found.journal->head().probes.size(), 1U);
  const BoardStatus status{.session = 99, .executed = 20, .state = board_trusted, .motors = 2};
  EXPECT_EQ(found.journal->place_of(status), (PathPosition{.item = 4, .s = Mm(2)}));
  EXPECT_GT(file.written_at(), 1e9);
  file.remove();
  EXPECT_EQ(file.find().kind, Kind::none);
  EXPECT_EQ(file.text(), "");
}

TEST_F(JournalFiles, are_of_one_writer_only) {
  JournalFile first(path_);
  ASSERT_TRUE(first.claim());
  ASSERT_TRUE(first.replace("text"));
  JournalFile second(path_);
  const auto refused = second.claim();
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error(), EWOULDBLOCK);
  EXPECT_FALSE(second.overwrite(0, "T"));
  EXPECT_FALSE(second.append("T"));
  EXPECT_EQ(first.text(), "text");
}

TEST_F(JournalFiles, tell_a_torn_journal_from_a_foreign_file) {
  const JournalFile file(path_);
  EXPECT_EQ(file.find().kind, Kind::none);
  put(path_, "");
  EXPECT_EQ(file.find().kind, Kind::empty);
  put(path_, "a letter to my aunt\n");
  EXPECT_EQ(file.find().kind, Kind::foreign);
  JournalFile written(path("other"));
  JournalHead head;
  head.numbers.session = 300;
  JournalWriter(written).begin(head);
  const std::string text = written.text();
  put(path_, text.substr(0, text.find("\ncheck ")));
  EXPECT_EQ(file.find().kind, Kind::torn);
  EXPECT_FALSE(file.find().journal);
  put(path_, std::string((1U << 24U) + 1, 'x'));
  EXPECT_EQ(file.find().kind, Kind::foreign) << "too long for a journal";
}

TEST_F(JournalFiles, say_why_they_cannot_be_written) {
  put(path("file"), "");
  JournalFile file(path("file") + "/job.journal");
  EXPECT_FALSE(file.replace("text"));
  EXPECT_EQ(file.trouble(), "Not a directory");
}

class KeptPlaces : public test::FolderTest {
 protected:
  std::string board_ = path("passo/serial--dev-ttyACM0.place");
  MachineDescription machine_ = test::example_machine("router");
  SessionNumbers numbers_{.session_before = 11, .executed_before = 3, .greeting = 200, .session = 300};
  MotorSteps zero_counts_{1000, -20, 7};
  // 4 mm up in X.
  BoardStatus status() const {
    BoardStatus status{.session = 300, .executed = 4, .state = board_trusted, .motors = 3};
    for (std::size_t m = 0; m < 3; ++m) status.positions[m] = static_cast<std::int32_t>(zero_counts_[m]);
    status.positions[0] += static_cast<std::int32_t>(4 * machine_.axes[0].steps_per_unit);
    return status;
  }
};

TEST_F(KeptPlaces, are_known_to_the_next_program) {
  StoredPosition kept(board_);
  EXPECT_EQ(kept.place(machine_, status()).error(), PositionDoubt::no_record);
  EXPECT_TRUE(kept.keep(machine_, {.place = Point(), .trust = Trust::homed}, zero_counts_, numbers_));
  const StoredPosition next(board_);
  const auto place = next.place(machine_, status());
  ASSERT_TRUE(place);
  EXPECT_EQ(place->trust, Trust::homed);
  EXPECT_EQ(place->place[Axis::x], 4);
  EXPECT_EQ(next.counted(machine_, status()), *place);
}

TEST_F(KeptPlaces, are_counted_and_not_trusted_where_nobody_knows_machine_zero) {
  StoredPosition kept(board_);
  EXPECT_TRUE(kept.keep(machine_, {.place = Point(), .trust = Trust::unknown}, zero_counts_, numbers_));
  EXPECT_EQ(kept.place(machine_, status()).error(), PositionDoubt::no_record);
  const KnownPosition counted = kept.counted(machine_, status());
  EXPECT_EQ(counted.trust, Trust::unknown);
  EXPECT_EQ(counted.place[Axis::x], 4);
  EXPECT_FALSE(counted.is_lost) << "the counts have gone on";
}

TEST_F(KeptPlaces, are_lost_where_the_counts_have_not_gone_on) {
  StoredPosition kept(board_);
  EXPECT_TRUE(kept.keep(machine_, {.place = Point(), .trust = Trust::homed}, zero_counts_, numbers_));
  BoardStatus stopped = status();
  stopped.state = 0;
  EXPECT_EQ(kept.counted(machine_, stopped),
            (KnownPosition{.place = Point{{{4}}}, .trust = Trust::unknown, .is_lost = true}));
  BoardStatus other = status();
  other.session = 301;
  EXPECT_EQ(kept.place(machine_, other).error(), PositionDoubt::other_session);
  EXPECT_EQ(kept.counted(machine_, other), (KnownPosition{.place = Point(), .trust = Trust::unknown, .is_lost = true}));
}

TEST_F(KeptPlaces, are_machine_zero_where_nothing_is_known) {
  const KnownPosition nothing = StoredPosition(board_).counted(machine_, status());
  EXPECT_EQ(nothing, (KnownPosition{.place = Point(), .trust = Trust::unknown, .is_lost = false}));
}

TEST_F(KeptPlaces, say_when_they_cannot_be_written_and_know_the_place_nevertheless) {
  put(path("passo"), "a file in the place of the folder");
  StoredPosition kept(board_);
  EXPECT_FALSE(kept.keep(machine_, {.place = Point(), .trust = Trust::homed}, zero_counts_, numbers_));
  EXPECT_TRUE(kept.place(machine_, status()));
  EXPECT_TRUE(kept.keep(machine_, {.place = Point(), .trust = Trust::homed}, zero_counts_, numbers_))
      << "nothing is new";
}

TEST_F(KeptPlaces, are_in_no_file_without_a_folder_for_state) {
  StoredPosition kept("");
  EXPECT_TRUE(kept.keep(machine_, {.place = Point(), .trust = Trust::homed}, zero_counts_, numbers_));
  EXPECT_EQ(files(), 0U);
}

TEST(StateFiles, have_the_boards_address_in_their_names) {
  EXPECT_EQ(state_file("/state/passo", "tcp:x.y:1", ".journal"), "/state/passo/tcp-x-y-1.journal");
  EXPECT_EQ(state_file("", "tcp:x.y:1", ".journal"), "");
}

}  // namespace
}  // namespace passo
