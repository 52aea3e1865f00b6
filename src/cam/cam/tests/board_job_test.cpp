#include "passo/cam/board_job.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

namespace passo {
namespace {

namespace fs = std::filesystem;

constexpr const char* small_gerber = "%FSLAX33Y33*%\n%MOMM*%\n%ADD10C,1*%\nD10*\nX0Y0D03*\nM02*\n";
constexpr const char* small_drills = "M48\nMETRIC\nT1C0.8\n%\nT1\nX1.0Y1.0\nM30\n";

std::string kind_of(const std::string& name) {
  return words_for(kind_by_name(name));
}

std::string little(std::uint32_t value, int bytes) {
  std::string text;
  for (int i = 0; i < bytes; ++i) text += static_cast<char>(value >> (8 * i) & 0xFFU);
  return text;
}

std::uint32_t crc_of(const std::string& bytes) {
  std::uint32_t crc = ~0U;
  for (const char c : bytes) {
    crc ^= static_cast<unsigned char>(c);
    for (int i = 0; i < 8; ++i) crc = crc >> 1U ^ ((crc & 1U) != 0 ? 0xEDB88320U : 0U);
  }
  return ~crc;
}

// An archive that packs nothing. `claimed` is the size that it tells of each file, 0 the true one.
std::string zip_of(const std::vector<std::pair<std::string, std::string>>& files, std::uint32_t crc_error = 0) {
  std::string body;
  std::string directory;
  for (const auto& [name, bytes] : files) {
    const auto size = static_cast<std::uint32_t>(bytes.size());
    const std::string common = little(0, 2) + little(0, 2) + little(0, 4) + little(crc_of(bytes) ^ crc_error, 4) +
                               little(size, 4) + little(size, 4) + little(static_cast<std::uint32_t>(name.size()), 2) +
                               little(0, 2);
    directory += "PK\x01\x02" + little(20, 2) + little(20, 2) + common + little(0, 2) + little(0, 2) + little(0, 2) +
                 little(0, 4) + little(static_cast<std::uint32_t>(body.size()), 4) + name;
    body += "PK\x03\x04" + little(20, 2) + common + name + bytes;
  }
  const auto count = static_cast<std::uint32_t>(files.size());
  return body + directory + "PK\x05\x06" + little(0, 4) + little(count, 2) + little(count, 2) +
         little(static_cast<std::uint32_t>(directory.size()), 4) + little(static_cast<std::uint32_t>(body.size()), 4) +
         little(0, 2);
}

class BoardJobFiles : public testing::Test {
 protected:
  BoardJobFiles() { fs::create_directories(folder_); }
  ~BoardJobFiles() override { fs::remove_all(folder_); }
  std::string write(const std::string& name, const std::string& bytes) const {
    fs::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return (folder_ / name).string();
  }
  fs::path folder_ = fs::temp_directory_path() / ("board-job-" + std::to_string(::getpid()));
  Diagnostics found_;
};

TEST(BoardFileKinds, names_of_many_layout_programs_are_known) {
  const std::vector<std::pair<const char*, const char*>> names = {{"board-F_Cu.gbr", "top copper"},
                                                                  {"board-B.Cu.gbr", "bottom copper"},
                                                                  {"board-In1_Cu.gbr", "inner copper 1"},
                                                                  {"board-F_Mask.gbr", "top mask"},
                                                                  {"board-B.SilkS.gbr", "bottom print"},
                                                                  {"board-F.Paste.gbr", "top paste"},
                                                                  {"board-Edge_Cuts.gbr", "outline"},
                                                                  {"board-F_Fab.gbr", "top drawing"},
                                                                  {"board.GTL", "top copper"},
                                                                  {"board.gbs", "bottom mask"},
                                                                  {"board.G1", "inner copper 1"},
                                                                  {"board.GP2", "inner copper 2"},
                                                                  {"board.GM13", "outline"},
                                                                  {"board.gko", "outline"},
                                                                  {"board.cmp", "top copper"},
                                                                  {"board.sol", "bottom copper"},
                                                                  {"board.stc", "top mask"},
                                                                  {"board.ly2", "inner copper 2"},
                                                                  {"copper_top.gbr", "top copper"},
                                                                  {"silkscreen_bottom.gbr", "bottom print"},
                                                                  {"soldermask_top.gbr", "top mask"},
                                                                  {"profile.gbr", "outline"},
                                                                  {"x.toplayer.ger", "top copper"},
                                                                  {"x.bcream.ger", "bottom paste"},
                                                                  {"x.internalplane1.ger", "inner copper 1"},
                                                                  {"BoardOutline.gbr", "outline"},
                                                                  {"TopMask.gbr", "top mask"},
                                                                  {"Bottom.gbr", "bottom copper"},
                                                                  {"Inner2.gbr", "inner copper 2"},
                                                                  {"Gerber_TopSolderMaskLayer.GTS", "top mask"},
                                                                  {"board.drl", "drill"},
                                                                  {"board.dim", "outline"},
                                                                  {"hello.gbr", "unknown"}};
  for (const auto& [name, kind] : names) EXPECT_EQ(kind_of(name), kind) << name;
}

TEST(BoardFileKinds, attributes_tell_what_a_file_is_for) {
  EXPECT_EQ(words_for(kind_by_function("Copper,L1,Top,Signal")), "top copper");
  EXPECT_EQ(words_for(kind_by_function("Copper,L3,Inr")), "inner copper 3");
  EXPECT_EQ(words_for(kind_by_function("Soldermask,Bot")), "bottom mask");
  EXPECT_EQ(words_for(kind_by_function("Legend,Top")), "top print");
  EXPECT_EQ(words_for(kind_by_function("Profile,NP")), "outline");
  EXPECT_EQ(words_for(kind_by_function("Plated,1,2,PTH")), "drill");
  EXPECT_EQ(words_for(kind_by_function("AssemblyDrawing,Top")), "top drawing");
  EXPECT_EQ(words_for(kind_by_function("")), "unknown");
}

TEST(BoardFileKinds, words_tell_the_kind_again) {
  for (const char* const words :
       {"top copper", "bottom copper", "inner copper", "outline", "drill", "top mask", "bottom print", "drawing"}) {
    ASSERT_TRUE(kind_of_words(words)) << words;
    EXPECT_EQ(words_for(*kind_of_words(words)), words);
  }
  EXPECT_EQ(kind_of_words("nothing")->role, BoardRole::unknown);
  for (const char* const words : {"copper", "unknown", "", "Top Copper"}) EXPECT_FALSE(kind_of_words(words)) << words;
}

TEST(BoardFileKinds, a_short_name_has_neither_folder_nor_archive) {
  EXPECT_EQ(short_name({.name = "job.zip: gerbers/b.gbr"}), "b.gbr");
  EXPECT_EQ(short_name({.name = "job.zip: b.gbr"}), "b.gbr");
  EXPECT_EQ(short_name({.name = "/a/b.gbr"}), "b.gbr");
}

TEST_F(BoardJobFiles, a_folder_is_read_in_the_order_of_layers) {
  write("b.GBL", small_gerber);
  write("b.GTL", small_gerber);
  write("sub/b.TXT", small_drills);
  write("README.md", "no board");
  const BoardJob job = read_board_job({folder_.string()}, found_);
  EXPECT_FALSE(found_.any_error());
  ASSERT_EQ(job.files.size(), 3U);
  EXPECT_EQ(words_for(job.files[0].kind), "top copper");
  EXPECT_EQ(words_for(job.files[1].kind), "bottom copper");
  EXPECT_EQ(words_for(job.files[2].kind), "drill");
  EXPECT_EQ(job.files[2].drills->holes.size(), 1U);
  EXPECT_EQ(job.left_out.size(), 1U);
}

TEST_F(BoardJobFiles, an_archive_is_a_folder) {
  const std::string path = write("b.zip", zip_of({{"x/b-F_Cu.gbr", small_gerber}, {"b.drl", small_drills}}));
  const BoardJob job = read_board_job({path}, found_);
  EXPECT_FALSE(found_.any_error()) << render(found_, false);
  ASSERT_EQ(job.files.size(), 2U);
  EXPECT_EQ(job.files[0].name, path + ": x/b-F_Cu.gbr");
  EXPECT_EQ(words_for(job.files[0].kind), "top copper");
}

TEST_F(BoardJobFiles, what_cannot_be_read_is_told) {
  const auto code_of = [](const std::string& path) {
    Diagnostics found;
    read_board_job({path}, found);
    return found.all().empty() ? "" : found.all().front().code;
  };
  const std::string zip = zip_of({{"b.drl", small_drills}});
  EXPECT_EQ(code_of(write("cut.zip", zip.substr(0, zip.size() / 2))), "board.bad-zip");
  EXPECT_EQ(code_of(write("false.zip", zip_of({{"b.drl", small_drills}}, 1))), "board.bad-zip");
  EXPECT_EQ(code_of(folder_ / "none"), "board.unreadable");
  EXPECT_EQ(code_of(write("words.txt", "hello")), "board.no-layers");
  std::vector<std::pair<std::string, std::string>> many;
  for (int i = 0; i < 1001; ++i) many.emplace_back(std::to_string(i), "x");
  EXPECT_EQ(code_of(write("many.zip", zip_of(many))), "board.too-large");
}

TEST_F(BoardJobFiles, a_folder_without_layers_is_named) {
  Diagnostics found;
  read_board_job({folder_}, found);
  ASSERT_EQ(found.all().size(), 1U);
  EXPECT_EQ(found.all().front().file, folder_);
}

TEST_F(BoardJobFiles, an_archive_whose_list_of_files_is_cut_off_is_broken) {
  const std::string zip = zip_of({{"b.drl", small_drills}});
  for (const std::size_t left_out : {10U, 21U, 23U, 40U}) {
    Diagnostics found;
    read_board_job({write("cut.zip", zip.substr(0, zip.size() - left_out))}, found);
    ASSERT_EQ(found.all().size(), 1U) << left_out;
    EXPECT_EQ(found.all().front().code, "board.bad-zip") << left_out;
  }
}

TEST_F(BoardJobFiles, a_board_of_kicad_and_layers_of_another_board_are_not_one) {
  const std::string kicad =
      "(kicad_pcb (version 20211014) (layers (0 \"F.Cu\" signal) (31 \"B.Cu\" signal))\n"
      "(segment (start 1 1) (end 9 1) (width 0.5) (layer \"F.Cu\") (net 1)))\n";
  const auto code_of = [](const std::vector<std::string>& paths, const std::string& nothing) {
    Diagnostics found;
    BoardJob job = read_board_job(paths, found);
    if (!nothing.empty()) {
      EXPECT_EQ(set_kind(job, nothing, "nothing"), "");
    }
    refuse_two_boards(job, found);
    return found.all().empty() ? "" : found.all().front().code;
  };
  const std::string board = write("a.kicad_pcb", kicad);
  const std::string other = write("b.kicad_pcb", kicad);
  const std::string layer = write("b-F_Cu.gbr", small_gerber);
  const std::string back = write("b-B_Cu.gbr", small_gerber);
  EXPECT_EQ(code_of({board}, ""), "");
  EXPECT_EQ(code_of({layer, back}, ""), "");
  EXPECT_EQ(code_of({board, other}, ""), "board.two-boards");
  EXPECT_EQ(code_of({board, layer}, ""), "board.two-boards");
  EXPECT_EQ(code_of({board, layer}, "b-F_Cu.gbr"), "");
}

TEST_F(BoardJobFiles, the_outline_surrounds_the_board) {
  write("b.gko",
        "%FSLAX33Y33*%\n%MOMM*%\n%ADD10C,0.1*%\nD10*\nX0Y0D02*X20000D01*Y10000D01*X0D01*Y0D01*\n"
        "X5000Y5000D02*X7000D01*Y6000D01*X5000D01*Y5000D01*\nM02*\n");
  const Region face = board_face(read_board_job({folder_.string()}, found_));
  EXPECT_NEAR(area_mm2(face), 20 * 10 - 2 * 1, 0.001);
}

}  // namespace
}  // namespace passo
