#include "passo/report/signals.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>
#include <unistd.h>

namespace passo {
namespace {

namespace fs = std::filesystem;

template <class Write>
std::string text_of_signals(const Write& write) {
  const fs::path path = fs::temp_directory_path() / ("passo-signals-" + std::to_string(::getpid()));
  auto file = OutputFile::open(path.string());
  EXPECT_TRUE(file);
  write(*file);
  EXPECT_TRUE(file->commit());
  std::ifstream stream(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(stream), {}};
  fs::remove(path);
  return text;
}

Signals two_signals() {
  return {.title = "board",
          .signals = {{"x_F1", {{0, true}, {1'500'000, false}}}, {"relay", {{1'500'000, true}, {2'000'000, false}}}},
          .end = 3'000'000};
}

TEST(Signals, are_a_row_for_each_time_at_which_one_changes) {
  EXPECT_EQ(text_of_signals([](OutputFile& file) { write_signals_csv(two_signals(), file); }),
            "t,x_F1,relay\n0.000000000,1,0\n0.001500000,0,1\n0.002000000,0,0\n");
}

TEST(Signals, are_waves_from_the_start_to_the_end) {
  EXPECT_EQ(text_of_signals([](OutputFile& file) { write_signals_vcd(two_signals(), file); }),
            "$version Passo $end\n$timescale 1 ns $end\n$scope module board $end\n$var wire 1 !! x_F1 $end\n"
            "$var wire 1 !\" relay $end\n$upscope $end\n$enddefinitions $end\n"
            "#0\n$dumpvars\n1!!\n0!\"\n$end\n#1500000\n0!!\n1!\"\n#2000000\n0!\"\n#3000000\n");
}

TEST(Signals, are_drawn_a_lane_each) {
  const std::string svg = text_of_signals([](OutputFile& file) {
    EXPECT_TRUE(draw_signals(two_signals(), {.format = PictureFormat::svg, .program = "Board", .machine = ""}, file));
  });
  EXPECT_NE(svg.find("</svg>"), std::string::npos);
  Signals none;
  EXPECT_NE(text_of_signals([&](OutputFile& file) {
              EXPECT_TRUE(draw_signals(none, {.format = PictureFormat::svg, .program = "", .machine = ""}, file));
            }).find("</svg>"),
            std::string::npos);
}

}  // namespace
}  // namespace passo
