#include "passo/sender/board_files.hpp"

#include <string>
#include <vector>

#include "kit/file_receivers.hpp"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "passo/sender/file_upload.hpp"

namespace passo {
namespace {

using testing::HasSubstr;

GrblMachine machine_of(const char* firmware, const char* options) {
  GrblMachine machine;
  machine.hear(std::string("[FIRMWARE:") + firmware + "]");
  machine.hear(std::string("[NEWOPT:") + options + "]");
  return machine;
}

GrblMachine grblhal_with_card() {
  return machine_of("grblHAL", "ENUMS,RT+,SED,SD,YM");
}

TEST(BoardFiles, of_grblhal_are_listed_with_their_paths) {
  auto files = BoardFiles::of(grblhal_with_card());
  ASSERT_TRUE(files);
  ASSERT_EQ(files->questions(), std::vector<std::string>{"$F+"});
  const std::vector<std::string> said = {"[FILE:/part.nc|SIZE:1234]", "[FILE:/jobs/a b.gcode|SIZE:5]",
                                         "[FILE:/what?.nc|SIZE:7|UNUSABLE]", "[MSG:Caution]"};
  files->hear("$F+", said);
  const std::vector<StoredFile> expected = {{.path = "/part.nc", .bytes = 1234},
                                            {.path = "/jobs/a b.gcode", .bytes = 5},
                                            {.path = "/what?.nc", .bytes = 7, .can_run = false}};
  EXPECT_EQ(files->all(), expected);
  EXPECT_EQ(*files->run_line("/part.nc"), "$F=/part.nc");
  EXPECT_EQ(*files->run_line("part.nc"), "$F=/part.nc");
  EXPECT_FALSE(files->run_line("/what?.nc")) << "the board would take the question mark out of the line";
  EXPECT_FALSE(files->run_line("/a\nG0X100"));
}

TEST(BoardFiles, of_fluidnc_are_in_two_places_with_folders) {
  auto files = BoardFiles::of(machine_of("FluidNC", ""));
  ASSERT_TRUE(files);
  const std::vector<std::string> card = {"[FILE: part.nc|SIZE:12]",
                                         "[DIR:jobs]",
                                         "[FILE:  deep.nc|SIZE:3]",
                                         "[DIR: more]",
                                         "[FILE:   deeper.nc|SIZE:4]",
                                         "[FILE: last.nc|SIZE:5]",
                                         "[/sd Free:3.6 GB Used:1.2 MB Total:3.7 GB]"};
  files->hear("$SD/List", card);
  const std::vector<std::string> flash = {"[FILE: config.yaml|SIZE:900]"};
  files->hear("$LocalFS/List", flash);
  std::vector<std::string> paths;
  for (const StoredFile& one : files->all()) paths.push_back(one.path);
  EXPECT_EQ(paths, (std::vector<std::string>{"/sd/part.nc", "/sd/jobs/deep.nc", "/sd/jobs/more/deeper.nc",
                                             "/sd/last.nc", "/localfs/config.yaml"}));
  EXPECT_EQ(files->all().back().bytes, 900U);
  EXPECT_EQ(*files->run_line("/sd/jobs/deep.nc"), "$SD/Run=/jobs/deep.nc");
  EXPECT_EQ(*files->run_line("/localfs/a.nc"), "$LocalFS/Run=/a.nc");
  EXPECT_FALSE(files->run_line("part.nc"));
}

TEST(BoardFiles, are_missing_on_boards_without_a_card) {
  EXPECT_THAT(BoardFiles::of(GrblMachine()).error(), HasSubstr("Grbl cannot store any"));
  EXPECT_THAT(BoardFiles::of(machine_of("grblHAL", "ENUMS,RT+")).error(), HasSubstr("SD cards"));
}

TEST(BoardFiles, in_a_hostile_list_are_bounded) {
  auto files = BoardFiles::of(grblhal_with_card());
  std::vector<std::string> said(most_board_files + 10, "[FILE:/a|SIZE:99999999999999999999]");
  said.insert(said.begin(),
              {"[FILE:", "[FILE:]", "[FILE:/" + std::string(5000, 'a') + "|SIZE:1]", "[FILE:/\x1b[2J|SIZE:1]"});
  files->hear("$F+", said);
  EXPECT_EQ(files->all().size(), most_board_files);
  EXPECT_EQ(files->all().front().path, "/a");
  EXPECT_EQ(files->all().front().bytes, 0U);
  auto deep = BoardFiles::of(machine_of("FluidNC", ""));
  deep->hear("$SD/List", std::vector<std::string>{"[DIR:      far]", "[FILE:        a|SIZE:1]"});
  EXPECT_TRUE(deep->all().empty());
}

// Sends a file in virtual time. `answers_lost`: every so many answers of the board are lost.
std::string uploaded(test::FileReceiver& board, FileUpload& upload, int answers_lost = 0) {
  int answers = 0;
  double time = 0;
  for (int i = 0; i < 200'000 && !upload.ended(); ++i) {
    board.receive(upload.take_bytes(Seconds(time)));
    board.run(0.01);
    time += 0.01;
    std::string said = board.take_output();
    if (!said.empty() && answers_lost > 0 && ++answers % answers_lost == 0) said.clear();
    upload.receive(said, Seconds(time));
  }
  EXPECT_TRUE(upload.ended());
  board.receive(upload.take_bytes(Seconds(time)));
  return upload.trouble();
}

std::string content_of_bytes(std::size_t bytes) {
  std::string content;
  for (std::size_t i = 0; i < bytes; ++i) content += static_cast<char>(i * 7 + i / 256 + 1);
  if (content.ends_with('\x1A')) content.back() = 'x';
  return content;
}

struct Firmware {
  GrblMachine machine;
  bool is_fluidnc;
  const char* path;
  const char* name;
};

std::vector<Firmware> firmwares() {
  return {{grblhal_with_card(), false, "/part.nc", "/part.nc"},
          {machine_of("FluidNC", ""), true, "/sd/part.nc", "/sd/part.nc"},
          {machine_of("FluidNC", ""), true, "/localfs/config.yaml", "config.yaml"}};
}

TEST(FileUpload, arrives_whatever_its_size) {
  for (const Firmware& one : firmwares()) {
    for (const std::size_t size : {0U, 1U, 127U, 128U, 129U, 1023U, 1024U, 1025U, 2048U, 50'000U}) {
      test::FileReceiver board(one.is_fluidnc);
      const std::string content = content_of_bytes(size);
      auto upload = FileUpload::begin(one.machine, one.path, content);
      ASSERT_TRUE(upload) << upload.error();
      EXPECT_EQ(uploaded(board, *upload), "");
      EXPECT_EQ(board.files[one.name], content) << one.path << ", " << size << " bytes";
      EXPECT_EQ(upload->share(), 1);
      const std::string command = std::string("$Xmodem/Receive=") + one.name;
      EXPECT_EQ(board.command, one.is_fluidnc ? command : "");
    }
  }
}

TEST(FileUpload, arrives_over_a_bad_connection) {
  for (const Firmware& one : firmwares()) {
    test::FileReceiver board(one.is_fluidnc);
    int packets = 0;
    board.disturb = [&](std::string& packet) {
      if (++packets % 3 == 0) packet[7] = static_cast<char>(packet[7] ^ 4);
    };
    const std::string content = content_of_bytes(20'000);
    auto upload = FileUpload::begin(one.machine, one.path, content);
    ASSERT_TRUE(upload);
    EXPECT_EQ(uploaded(board, *upload, 5), "");
    EXPECT_EQ(board.files[one.name], content) << one.path;
  }
}

TEST(FileUpload, says_why_it_failed) {
  for (const Firmware& one : firmwares()) {
    test::FileReceiver board(one.is_fluidnc);
    board.refuses = true;
    auto upload = FileUpload::begin(one.machine, one.path, "G0X1\n");
    ASSERT_TRUE(upload);
    EXPECT_THAT(uploaded(board, *upload), HasSubstr("refuses the file"));
    EXPECT_TRUE(board.files.empty());

    test::FileReceiver noisy(one.is_fluidnc);
    noisy.disturb = [](std::string& packet) { packet[5] = static_cast<char>(packet[5] ^ 1); };
    auto lost = FileUpload::begin(one.machine, one.path, "G0X1\n");
    EXPECT_THAT(uploaded(noisy, *lost), HasSubstr("did not acknowledge"));
  }
  auto silent = FileUpload::begin(machine_of("FluidNC", ""), "/sd/a.nc", "x");
  static_cast<void>(silent->take_bytes(Seconds(0)));
  static_cast<void>(silent->take_bytes(Seconds(31)));
  EXPECT_THAT(silent->trouble(), HasSubstr("did not begin"));
}

TEST(FileUpload, is_refused_before_it_begins) {
  EXPECT_THAT(FileUpload::begin(machine_of("grblHAL", "SD"), "/a.nc", "x").error(), HasSubstr("without YMODEM"));
  EXPECT_THAT(FileUpload::begin(grblhal_with_card(), "/" + std::string(31, 'a'), "x").error(), HasSubstr("31"));
  EXPECT_THAT(FileUpload::begin(machine_of("FluidNC", ""), "/sd/a", "x\x1A").error(), HasSubstr("Ctrl-Z"));
  EXPECT_THAT(FileUpload::begin(machine_of("FluidNC", ""), "a", "x").error(), HasSubstr("/sd/"));
  EXPECT_THAT(FileUpload::begin(GrblMachine(), "a", "x").error(), HasSubstr("no files"));
}

}  // namespace
}  // namespace passo
