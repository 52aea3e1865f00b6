#include "passo/job/job_identity.hpp"

#include <filesystem>
#include <fstream>

#include "kit/folder_test.hpp"

namespace passo {
namespace {

const JobIdentity identity{.made_by = "1.2.3",
                           .program = {.name = "/part.ngc", .size = 12, .fingerprint = 34},
                           .machine = {.name = "/router.toml", .size = 56, .fingerprint = 78}};

JournalHead head_of(const JobIdentity& job) {
  JournalHead head;
  head.made_by = job.made_by;
  head.program = job.program;
  head.machine = job.machine;
  return head;
}

std::string change(const JobIdentity& now) {
  const auto changed = change_since(head_of(identity), now);
  return changed ? std::string(code_of(*changed)) : "";
}

TEST(JobIdentities, are_the_same_or_tell_what_has_changed) {
  EXPECT_EQ(change(identity), "");
  JobIdentity now = identity;
  now.machine.size = 57;
  EXPECT_EQ(change(now), "resume.machine-changed");
  now.program.name = "/other.ngc";
  EXPECT_EQ(change(now), "resume.program-changed");
  now.made_by = "1.2.4";
  EXPECT_EQ(change(now), "resume.other-version");
}

class FileStamps : public test::FolderTest {};

TEST_F(FileStamps, are_of_the_text_and_the_name) {
  const std::string file = path("part.ngc");
  const std::string text(1000, 'G');
  std::ofstream(file, std::ios::binary) << text;
  const FileStamp stamp = stamp_of_file(file);
  EXPECT_EQ(stamp.name, file);
  EXPECT_EQ(stamp.size, text.size());
  EXPECT_EQ(stamp, stamp_of_text(file, text)) << "whether the file was read, or its text";
  EXPECT_NE(stamp, stamp_of_text(file, text + "1"));
  EXPECT_NE(stamp, stamp_of_text(path("copy.ngc"), text));
  std::ofstream(file, std::ios::binary) << std::string(1000, 'M');
  EXPECT_NE(stamp, stamp_of_file(file));
}

TEST_F(FileStamps, have_no_name_where_the_text_can_be_read_only_once) {
  EXPECT_EQ(stamp_of_file("-"), FileStamp());
  EXPECT_EQ(stamp_of_file("/dev/null"), FileStamp());
  EXPECT_EQ(stamp_of_file(path("none")), FileStamp());
  EXPECT_EQ(stamp_of_text("", "G0 X1\n").name, "");
}

}  // namespace
}  // namespace passo
