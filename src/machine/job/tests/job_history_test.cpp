#include "passo/job/job_history.hpp"

#include <csignal>
#include <filesystem>
#include <fstream>
#include <random>

#include "kit/seed.hpp"
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace passo {
namespace {

namespace fs = std::filesystem;

class JobHistoryTest : public testing::Test {
 protected:
  JobHistoryTest() { fs::create_directories(folder_); }
  ~JobHistoryTest() override { fs::remove_all(folder_); }

  std::string file(const std::string& name = "history.sqlite") const { return (folder_ / name).string(); }
  std::unique_ptr<JobHistory> open() const {
    auto opened = JobHistory::open(file());
    EXPECT_TRUE(opened) << opened.error();
    return std::move(*opened);
  }

 private:
  fs::path folder_ = fs::temp_directory_path() / ("passo-history-" + std::to_string(getpid()));
};

TEST_F(JobHistoryTest, adds_an_attempt_once) {
  {
    const auto history = open();
    const auto added = history->add_attempt("a-1", "a.ngc", "linuxcnc", "M2\n", 10);
    EXPECT_TRUE(added.is_new);
    EXPECT_EQ(added.job, 1);
  }
  const auto history = open();
  const auto again = history->add_attempt("a-1", "a.ngc", "linuxcnc", "M2\n", 20);
  EXPECT_FALSE(again.is_new || again.other_program);
  EXPECT_EQ(again.job, 1);
  EXPECT_TRUE(history->add_attempt("a-1", "a.ngc", "grbl", "M2\n", 20).other_program);
  EXPECT_TRUE(history->add_attempt("a-1", "a.ngc", "linuxcnc", "M2\n\n", 20).other_program);
  EXPECT_TRUE(history->add_attempt("a-2", "a.ngc", "linuxcnc", "M2\n", 20).is_new);
  EXPECT_EQ(history->queue().size(), 2U);
  EXPECT_EQ(history->queue()[1].attempt, "a-2");
  EXPECT_EQ(history->find_attempt("a-1")->queued_at, 10);
  EXPECT_FALSE(history->find_attempt("a-3"));
  history->add("b.ngc", "linuxcnc", "M2\n", 30);
  EXPECT_EQ(history->queue()[2].attempt, "");
  // The program is deleted at the end, but not what it was.
  history->begin(1, 40);
  history->end(1, HistoryState::done, "", 50);
  EXPECT_TRUE(history->add_attempt("a-1", "a.ngc", "linuxcnc", "M30\n", 60).other_program);
  EXPECT_EQ(history->find_attempt("a-1")->state, HistoryState::done);
}

TEST_F(JobHistoryTest, has_no_attempt_without_a_place_in_the_queue) {
  const auto history = open();
  for (std::size_t i = 0; i < JobHistory::most_queued; ++i) history->add("a.ngc", "linuxcnc", "M2\n", 10);
  EXPECT_FALSE(history->add_attempt("a-1", "a.ngc", "linuxcnc", "M2\n", 20).job);
  ASSERT_TRUE(history->remove(1));
  EXPECT_TRUE(history->add_attempt("a-1", "a.ngc", "linuxcnc", "M2\n", 30).is_new);
}

TEST_F(JobHistoryTest, keeps_where_a_job_has_waited) {
  const HistoryWait tool{.at = 21, .code = "M6", .line = 12, .tool = 0, .words = "6 mm\ndrill"};
  const HistoryWait stop{.at = 22, .code = "M0", .line = 13, .tool = {}, .words = ""};
  {
    const auto history = open();
    history->add("a.ngc", "linuxcnc", "M2\n", 10);
    history->add("b.ngc", "linuxcnc", "M2\n", 10);
    history->begin(1, 20);
    EXPECT_TRUE(history->record_wait(1, tool));
    EXPECT_TRUE(history->record_wait(1, stop));
    for (int i = 0; i < 40; ++i) history->record_wait(2, stop);
    history->end(1, HistoryState::done, "", 30);
  }
  const auto history = open();
  EXPECT_EQ(history->find(1)->waits, (std::vector<HistoryWait>{tool, stop}));
  EXPECT_EQ(history->find(2)->waits.size(), std::size_t{JobHistory::most_waits});
}

TEST_F(JobHistoryTest, keeps_the_sentence_beside_the_words) {
  {
    const auto history = open();
    history->add_running("a.ngc", "linuxcnc", "M2\n", 10);
    EXPECT_TRUE(history->end(1, HistoryState::failed, "stopped", 20, R"({"code":"job.stopped"})"));
    EXPECT_TRUE(history->record_alarm("lost", 21, R"({"code":"link.no-answer"})"));
    history->add_running("b.ngc", "linuxcnc", "M2\n", 30);  // and the server is killed
  }
  const auto history = open();
  EXPECT_EQ(history->find(1)->why_sentence, R"({"code":"job.stopped"})");
  EXPECT_EQ(history->alarms(1)[0].sentence, R"({"code":"link.no-answer"})");
  EXPECT_NE(history->find(2)->why_sentence.find(R"("code":"job.killed")"), std::string::npos);
  EXPECT_TRUE(history->begin(1, 40));
  EXPECT_EQ(history->find(1)->why_sentence, "");
}

TEST_F(JobHistoryTest, gives_each_of_many_jobs_its_own_waits) {
  const auto history = open();
  for (std::uint32_t job = 1; job <= 20; ++job) {
    history->add_running("part.ngc", "linuxcnc", "M0\n", job);
    for (std::uint32_t line = 0; line < job % 4; ++line) {
      EXPECT_TRUE(history->record_wait(job, {.at = 1.0 * job, .code = "M0", .line = 10 * job + line, .words = ""}));
    }
    EXPECT_TRUE(history->end(job, HistoryState::done, "", job));
  }
  const std::vector<HistoryJob> ended = history->ended(12);
  ASSERT_EQ(ended.size(), 12U);
  for (const HistoryJob& job : ended) {
    ASSERT_EQ(job.waits.size(), static_cast<std::size_t>(job.id % 4)) << job.id;
    for (std::size_t i = 0; i < job.waits.size(); ++i) {
      EXPECT_EQ(job.waits[i].line, static_cast<std::size_t>(10 * job.id) + i) << job.id;
    }
  }
}

TEST_F(JobHistoryTest, keeps_few_stills_of_each_job) {
  const std::string jpeg("\xff\xd8\0\xff\xd9", 5);
  {
    const auto history = open();
    history->add_running("a.ngc", "linuxcnc", "M2\n", 10);
    history->add_running("b.ngc", "linuxcnc", "M2\n", 10);
    EXPECT_TRUE(history->record_still(1, "start", 11, jpeg));
    EXPECT_TRUE(history->record_still(2, "start", 12, jpeg + "2"));
    EXPECT_TRUE(history->record_still(1, "end", 13, std::string(JobHistory::largest_still, 'x')));
    EXPECT_FALSE(history->record_still(1, "end", 14, std::string(JobHistory::largest_still + 1, 'x')));
    EXPECT_FALSE(history->record_still(3, "start", 15, jpeg)) << "there is no such job";
    for (int i = 0; i < 20; ++i) history->record_still(2, "end", 16, jpeg);
  }
  const auto history = open();
  const std::vector<HistoryStill> stills = history->find(1)->stills;
  ASSERT_EQ(stills.size(), 2U);
  EXPECT_EQ(stills[0].moment, "start");
  EXPECT_EQ(stills[0].at, 11);
  EXPECT_EQ(stills[1].moment, "end");
  EXPECT_EQ(history->still(stills[0].id), jpeg);
  EXPECT_EQ(history->still(stills[1].id)->size(), JobHistory::largest_still);
  EXPECT_EQ(history->find(2)->stills.size(), std::size_t{JobHistory::most_stills});
  EXPECT_FALSE(history->still(999));
}

TEST_F(JobHistoryTest, deletes_old_stills) {
  const auto history = open();
  for (std::int64_t job = 1; job <= JobHistory::most_kept_stills / 2 + 5; ++job) {
    history->add_running("part.ngc", "linuxcnc", "M2\n", 1);
    EXPECT_TRUE(history->record_still(job, "start", 1, "jpeg"));
    EXPECT_TRUE(history->record_still(job, "end", 1, "jpeg"));
  }
  EXPECT_EQ(history->find(5)->stills.size(), 0U);
  EXPECT_EQ(history->find(6)->stills.size(), 2U);
  EXPECT_FALSE(history->still(1));
}

TEST_F(JobHistoryTest, keeps_what_waits_and_what_has_ended) {
  {
    const auto history = open();
    EXPECT_EQ(history->add("a.ngc", "linuxcnc", "G0 X1\n", 10), 1);
    EXPECT_EQ(history->add("b.ngc", "grbl", std::string("\0\xff", 2), 11), 2);
    EXPECT_EQ(history->add("c.ngc", "grbl", "M2\n", 12), 3);
    EXPECT_TRUE(history->begin(1, 20));
    EXPECT_TRUE(history->end(1, HistoryState::done, "", 30));
    EXPECT_TRUE(history->remove(3));
    EXPECT_TRUE(history->record_alarm("the board was lost", 31));
  }
  const auto history = open();
  const auto queue = history->queue();
  ASSERT_EQ(queue.size(), 1U);
  EXPECT_EQ(queue[0].name, "b.ngc");
  EXPECT_EQ(queue[0].bytes, 2U);
  EXPECT_EQ(history->program_of(2), std::string("\0\xff", 2));
  const auto ended = history->ended(10);
  ASSERT_EQ(ended.size(), 1U);
  EXPECT_EQ(ended[0].state, HistoryState::done);
  EXPECT_EQ(ended[0].begun_at, 20);
  EXPECT_EQ(ended[0].ended_at, 30);
  EXPECT_EQ(history->program_of(1), std::nullopt) << "it is done";
  ASSERT_EQ(history->alarms(10).size(), 1U);
  EXPECT_EQ(history->alarms(10)[0].words, "the board was lost");
  EXPECT_EQ(history->add("d.ngc", "grbl", "M2\n", 12), 4) << "a number is given once";
}

TEST_F(JobHistoryTest, refuses_what_does_not_fit_the_state) {
  const auto history = open();
  history->add("a", "grbl", "", 1);
  history->begin(1, 2);
  EXPECT_FALSE(history->remove(1));
  EXPECT_FALSE(history->begin(7, 2));
  EXPECT_FALSE(history->end(7, HistoryState::done, "", 2));
  EXPECT_FALSE(history->find(7));
  for (std::size_t i = 0; i < JobHistory::most_queued; ++i) ASSERT_TRUE(history->add("x", "grbl", "", 1));
  EXPECT_FALSE(history->add("x", "grbl", "", 1));
}

TEST_F(JobHistoryTest, is_opened_by_one_program_at_a_time) {
  const auto first = open();
  const auto second = JobHistory::open(file());
  ASSERT_FALSE(second);
  EXPECT_NE(second.error().find("locked"), std::string::npos) << second.error();
}

TEST_F(JobHistoryTest, says_what_is_wrong_with_a_file) {
  std::ofstream(file("text")) << std::string(5000, 'x');
  EXPECT_FALSE(JobHistory::open(file("text")));
  EXPECT_FALSE(JobHistory::open(file("missing/history")));
  fs::create_symlink(file("text"), file("link"));
  EXPECT_FALSE(JobHistory::open(file("link")));
}

// A file cut or changed at any place opens with whole jobs, or is refused.
TEST_F(JobHistoryTest, a_damaged_file_gives_whole_jobs_or_none) {
  {
    const auto history = open();
    for (int i = 0; i < 20; ++i) history->add("part " + std::to_string(i), "grbl", std::string(500, 'G'), i);
  }
  std::ifstream in(file(), std::ios::binary);
  const std::string whole{std::istreambuf_iterator<char>(in), {}};
  std::mt19937_64 random(test::seed());
  for (int trial = 0; trial < 200; ++trial) {
    std::string bytes = whole;
    if (trial % 2 == 0) {
      bytes.resize(random() % bytes.size());
    } else {
      for (int i = 0; i < 5; ++i) bytes[random() % bytes.size()] = static_cast<char>(random());
    }
    for (const char* end : {"", "-wal", "-shm"}) fs::remove(file() + end);
    std::ofstream(file(), std::ios::binary) << bytes;
    const auto opened = JobHistory::open(file());
    if (!opened) continue;
    for (const HistoryJob& job : (*opened)->queue()) static_cast<void>((*opened)->program_of(job.id));
    static_cast<void>((*opened)->add("more", "grbl", "M2\n", 1));
  }
}

// A program that is killed loses no job that it was told of, and its running job is interrupted.
TEST_F(JobHistoryTest, a_killed_program_loses_nothing) {
  for (int trial = 0; trial < 20; ++trial) {
    for (const char* end : {"", "-wal", "-shm"}) fs::remove(file() + end);
    int told[2];
    ASSERT_EQ(pipe(told), 0);
    const pid_t child = fork();
    if (child == 0) {
      const auto history = std::move(*JobHistory::open(file()));
      history->add_running("runs", "grbl", "M2\n", 0);
      for (char i = 0;; ++i) {
        if (history->add("job", "grbl", std::string(2000, 'x'), 0) && write(told[1], &i, 1) != 1) _exit(1);
        if (i % 7 == 3) history->keep();
        if (i == 100) pause();
      }
    }
    usleep(static_cast<useconds_t>(3000 + 2500 * trial));
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    close(told[1]);
    std::size_t heard = 0;
    for (char i = 0; ::read(told[0], &i, 1) == 1;) ++heard;
    close(told[0]);
    const auto history = open();
    EXPECT_GE(history->queue().size(), heard);
    EXPECT_LE(history->queue().size(), heard + 1);
    if (heard > 0) {
      EXPECT_EQ(history->find(1)->state, HistoryState::interrupted);
    }
    for (const HistoryJob& job : history->queue()) EXPECT_EQ(history->program_of(job.id)->size(), 2000U);
  }
}

// A job that a kill has broken off has no time of its end. It stands where it began, however many are shown.
TEST_F(JobHistoryTest, shows_the_newest_first_also_those_broken_off) {
  {
    const auto history = open();
    for (int i = 1; i <= 5; ++i) {
      EXPECT_EQ(history->add_running("part", "grbl", "M2\n", 10.0 * i), i);
      if (i != 4) history->end(i, HistoryState::done, "", 10.0 * i + 5);
    }
    EXPECT_EQ(history->find(4)->state, HistoryState::running);
    EXPECT_EQ(history->find(4)->begun_at, 40);
  }
  const auto history = open();
  std::vector<std::int64_t> shown;
  for (const HistoryJob& job : history->ended(2)) shown.push_back(job.id);
  EXPECT_EQ(shown, (std::vector<std::int64_t>{5, 4}));
}

// Each file may have no more bytes than it has: a disk that is full, for this program alone.
class FullDisk {
 public:
  FullDisk() : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    rlimit none = before_;
    none.rlim_cur = 0;
    setrlimit(RLIMIT_FSIZE, &none);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;
  ~FullDisk() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit before_{};
  void (*handler_)(int);
};

TEST_F(JobHistoryTest, writes_what_has_happened_when_the_disk_has_room_again) {
  auto history = open();
  const auto first = history->add_running("a", "grbl", "M2\n", 1);
  const auto second = history->add("b", "grbl", "M2\n", 1);
  ASSERT_TRUE(first && second);
  {
    const FullDisk full;
    EXPECT_FALSE(history->add("c", "grbl", "M2\n", 2));
    EXPECT_NE(history->trouble(), "");
    EXPECT_FALSE(history->add_running("c", "grbl", "M2\n", 2));
    EXPECT_FALSE(history->begin(*second, 2));
    EXPECT_FALSE(history->remove(*second));
    EXPECT_FALSE(history->end(*first, HistoryState::failed, "why", 3));
    EXPECT_FALSE(history->record_alarm("lost", 3));
    EXPECT_FALSE(history->keep());
    EXPECT_TRUE(history->is_behind());
    ASSERT_EQ(history->ended(1).size(), 1U) << "it is shown meanwhile";
    EXPECT_EQ(history->ended(1)[0].why, "why");
    EXPECT_EQ(history->alarms(1)[0].words, "lost");
  }
  EXPECT_TRUE(history->keep());
  EXPECT_FALSE(history->is_behind());
  EXPECT_EQ(history->trouble(), "");
  history.reset();
  history = open();
  EXPECT_EQ(history->find(*first)->state, HistoryState::failed);
  EXPECT_EQ(history->find(*first)->ended_at, 3);
  EXPECT_EQ(history->find(*second)->state, HistoryState::queued);
  EXPECT_EQ(history->alarms(9).size(), 1U);
  EXPECT_EQ(history->ended(9).size(), 1U);
}

}  // namespace
}  // namespace passo
