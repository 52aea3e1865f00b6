#include "passo/base/nameless_file.hpp"

#include <csignal>
#include <filesystem>
#include <fstream>

#include "kit/folder_test.hpp"
#include <sys/wait.h>
#include <unistd.h>

namespace passo {
namespace {

namespace fs = std::filesystem;
using FileKind = NamelessFile::Kind;
constexpr mode_t usual_mode = 0644;

class NamelessFileTest : public test::FolderTest {
 protected:
  static void put(const NamelessFile& file, std::string_view text) {
    ASSERT_EQ(::write(file.descriptor(), text.data(), text.size()), static_cast<ssize_t>(text.size()));
  }
  // Another program begins a file and is killed.
  void leave_over(FileKind kind) const {
    const pid_t child = ::fork();
    if (child == 0) {
      const auto file = NamelessFile::open(path("left"), usual_mode, kind);
      if (file) put(**file, "half");
      ::raise(SIGKILL);
      ::_exit(1);
    }
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_EQ(WTERMSIG(status), SIGKILL);
  }
};

class NamelessFileOfKind : public NamelessFileTest, public testing::WithParamInterface<FileKind> {};

TEST_P(NamelessFileOfKind, gets_its_name_in_one_step_in_the_place_of_an_older_file_or_of_none) {
  for (const char* const text : {"first", "second"}) {
    auto file = NamelessFile::open(path("a"), usual_mode, GetParam());
    ASSERT_TRUE(file);
    put(**file, text);
    EXPECT_NE(content(path("a")), text);
    EXPECT_EQ((*file)->publish(path("a")), 0);
    EXPECT_EQ(content(path("a")), text);
    EXPECT_EQ(files(), 1U);
  }
}

TEST_P(NamelessFileOfKind, leaves_nothing_where_it_gets_no_name) {
  {
    auto file = NamelessFile::open(path("a"), usual_mode, GetParam());
    ASSERT_TRUE(file);
    auto other = NamelessFile::open(path("a"), usual_mode, GetParam());
    ASSERT_TRUE(other);
    fs::create_directory(path("folder"));
    EXPECT_NE((*other)->publish(path("folder")), 0);
  }
  EXPECT_EQ(files(), 1U) << "the folder";
}

TEST_P(NamelessFileOfKind, of_a_program_that_lives_is_left_alone) {
  const auto one = NamelessFile::open(path("a"), usual_mode, GetParam());
  const auto two = NamelessFile::open(path("b"), usual_mode, GetParam());
  ASSERT_TRUE(one && two);
  put(**one, "one");
  put(**two, "two");
  EXPECT_EQ((*one)->publish(path("a")), 0);
  EXPECT_EQ((*two)->publish(path("b")), 0);
  EXPECT_EQ(content(path("a")) + content(path("b")), "onetwo");
}

TEST_P(NamelessFileOfKind, a_left_over_of_a_program_that_was_killed_is_gone_after_the_next_one) {
  leave_over(GetParam());
  auto file = NamelessFile::open(path("a"), usual_mode, GetParam());
  ASSERT_TRUE(file);
  EXPECT_EQ((*file)->publish(path("a")), 0);
  EXPECT_EQ(files(), 1U);
}

INSTANTIATE_TEST_SUITE_P(Of, NamelessFileOfKind, testing::Values(FileKind::nameless, FileKind::named));

TEST_F(NamelessFileTest, nothing_stays_after_a_kill) {
  leave_over(FileKind::nameless);
  EXPECT_EQ(files(), 0U);
}

TEST_F(NamelessFileTest, a_signal_handler_can_remove_what_has_a_temporary_name) {
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    const auto file = NamelessFile::open(path("interrupted"), usual_mode, FileKind::named);
    const bool there = file && files() == 1;
    NamelessFile::remove_unfinished();
    ::_exit(there ? 0 : 3);  // a handler ends the program like this: no destructor runs
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_EQ(status, 0);
  EXPECT_EQ(files(), 0U);
}

}  // namespace
}  // namespace passo
