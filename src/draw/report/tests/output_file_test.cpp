#include "passo/report/output_file.hpp"

#include <csignal>
#include <filesystem>
#include <fstream>

#include "kit/folder_test.hpp"
#include <sys/wait.h>
#include <unistd.h>

namespace passo {
namespace {

namespace fs = std::filesystem;

class OutputFileTest : public test::FolderTest {
 protected:
  static void create(const std::string& path, std::string_view text) { std::ofstream(path) << text; }
};

TEST_F(OutputFileTest, appears_under_its_name_at_commit_only) {
  auto file = OutputFile::open(path("part.vcd"));
  ASSERT_TRUE(file);
  file->write("one ");
  file->write("two");
  EXPECT_FALSE(fs::exists(path("part.vcd")));
  ASSERT_TRUE(file->commit());
  EXPECT_EQ(content(path("part.vcd")), "one two");
  EXPECT_EQ(files(), 1U);
}

TEST_F(OutputFileTest, leaves_nothing_behind_without_commit_and_keeps_the_older_file) {
  create(path("part.vcd"), "older");
  {
    auto file = OutputFile::open(path("part.vcd"));
    ASSERT_TRUE(file);
    file->write(std::string(3 * OutputFile::buffer_size, 'x'));
    EXPECT_EQ(files(), 1U);
  }
  EXPECT_EQ(files(), 1U);
  EXPECT_EQ(content(path("part.vcd")), "older");
}

TEST_F(OutputFileTest, writes_more_than_its_buffer_byte_for_byte) {
  std::string expected;
  auto file = OutputFile::open(path("long"));
  ASSERT_TRUE(file);
  for (int i = 0; i < 200'000; ++i) {
    const std::string line = std::to_string(i) + "\n";
    file->write(line);
    expected += line;
  }
  file->write(std::string_view("\0\xff", 2));
  expected.append("\0\xff", 2);
  EXPECT_EQ(file->size(), expected.size());
  ASSERT_TRUE(file->commit());
  EXPECT_EQ(content(path("long")), expected);
}

TEST_F(OutputFileTest, a_replaced_file_keeps_its_permissions_and_a_symbolic_link_its_target) {
  create(path("target"), "older");
  fs::permissions(path("target"), fs::perms::owner_read | fs::perms::owner_write | fs::perms::group_read);
  fs::create_symlink("target", path("link"));
  auto file = OutputFile::open(path("link"));
  ASSERT_TRUE(file);
  file->write("newer");
  ASSERT_TRUE(file->commit());
  EXPECT_TRUE(fs::is_symlink(path("link")));
  EXPECT_EQ(content(path("target")), "newer");
  EXPECT_EQ(fs::status(path("target")).permissions(),
            fs::perms::owner_read | fs::perms::owner_write | fs::perms::group_read);
}

TEST_F(OutputFileTest, several_files_in_one_directory_do_not_disturb_each_other) {
  auto first = OutputFile::open(path("a"));
  auto second = OutputFile::open(path("b"));
  ASSERT_TRUE(first && second);
  first->write("A");
  second->write("B");
  ASSERT_TRUE(first->commit());
  ASSERT_TRUE(second->commit());
  EXPECT_EQ(content(path("a")) + content(path("b")), "AB");
}

TEST_F(OutputFileTest, says_why_a_file_cannot_be_opened) {
  EXPECT_EQ(OutputFile::open(path("none/part.svg")).error().message,
            "cannot write " + path("none/part.svg") + ": no such directory");
  EXPECT_EQ(OutputFile::open(directory_.string()).error().message,
            "cannot write " + directory_.string() + ": it is a directory");
  create(path("plain"), "");
  EXPECT_EQ(OutputFile::open(path("plain/part.svg")).error().message,
            "cannot write " + path("plain/part.svg") + ": a part of the path is not a directory");
  EXPECT_EQ(OutputFile::open("").error().message, "cannot write a file without a name");
}

TEST_F(OutputFileTest, does_not_replace_a_write_protected_file) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write everything";
  create(path("kept"), "kept");
  fs::permissions(path("kept"), fs::perms::owner_read);
  EXPECT_EQ(OutputFile::open(path("kept")).error().message, "cannot write " + path("kept") + ": permission denied");
}

TEST_F(OutputFileTest, a_full_disk_is_told_at_commit_and_stops_the_writing) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  auto file = OutputFile::open("/dev/full");
  ASSERT_TRUE(file);
  file->write("a little");
  EXPECT_FALSE(file->failed());  // still buffered
  file->write(std::string(2 * OutputFile::buffer_size, 'x'));
  EXPECT_TRUE(file->failed());
  const auto done = file->commit();
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().message, "cannot write /dev/full: the disk is full");
}

TEST_F(OutputFileTest, nothing_stays_of_a_program_that_is_killed) {
  create(path("older"), "older");
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    auto fresh = OutputFile::open(path("fresh"));
    auto older = OutputFile::open(path("older"));
    if (!fresh || !older) ::_exit(2);
    fresh->write(std::string(2 * OutputFile::buffer_size, 'x'));
    older->write(std::string(2 * OutputFile::buffer_size, 'x'));
    ::raise(SIGKILL);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_EQ(WTERMSIG(status), SIGKILL);
  EXPECT_EQ(files(), 1U);
  EXPECT_EQ(content(path("older")), "older");
}

}  // namespace
}  // namespace passo
