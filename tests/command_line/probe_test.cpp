// Probing as a user sees it: docs/manual/probing.md shows what the program prints.
#include "kit/command_line.hpp"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace {

using passo::test::checkout;
using passo::test::on_router;
using passo::test::Outcome;
using passo::test::read;
using testing::HasSubstr;

class Probe : public passo::test::CommandLine {
 protected:
  Outcome run_text(const std::string& text, const std::string& options) const {
    return passo("run " + write("p.ngc", text) + on_router + options);
  }
};

TEST_F(Probe, finds_the_corner_as_the_manual_shows) {
  const std::string manual = read(checkout + "/docs/manual/probing.md");
  const std::string block = " --touch X42.3:90,Y31.75:70,Z-50:-11.2 ";
  ASSERT_THAT(manual, HasSubstr(block));
  const Outcome outcome = passo("run " + checkout + "/examples/probe-corner.ngc" + on_router + block + "--parameters " +
                                path("corner.var"));
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  ASSERT_THAT(outcome.out, HasSubstr("\nProbe, mm\n"));
  EXPECT_THAT(manual, HasSubstr(outcome.out.substr(outcome.out.find("Probe, mm"))));
  const std::string offsets = "5221\t42.300000\n5222\t31.750000\n5223\t-11.200000\n";
  EXPECT_THAT(read(path("corner.var")), HasSubstr(offsets));
  EXPECT_THAT(manual, HasSubstr(offsets));
}

TEST_F(Probe, touches_surfaces_in_files) {
  const std::string plane = write("plane.csv", "x,y,z\n-50,-50,-2\n50,-50,-1\n-50,50,-3\n50,50,-2\n");
  const std::string program =
      "G21 G90 F600\nG38.2 Z-20\n(PRINT,#5063)\nG0 Z0\nG0 X10 Y-20\nG38.2 Z-20\n(PRINT,#5063)\nM2\n";
  const Outcome flat = run_text(program, "--touch " + plane);
  ASSERT_EQ(flat.code, 0) << flat.err;
  EXPECT_THAT(flat.err, HasSubstr("-2.000000"));
  EXPECT_THAT(flat.err, HasSubstr("-1.700000"));
  const std::string roof =
      write("roof.stl",
            "solid roof\nfacet normal 0 0 1\nouter loop\nvertex -1 -1 3\nvertex 4 -1 3\nvertex -1 4 3\n"
            "endloop\nendfacet\nendsolid roof\n");
  const Outcome stl = run_text("G21 G90 F600\nG38.2 Z-20\n(PRINT,#5063)\nM2\n", "--touch " + roof + "@X1,Y0,Z-8");
  ASSERT_EQ(stl.code, 0) << stl.err;
  EXPECT_THAT(stl.err, HasSubstr("-5.000000"));
  const Outcome wrong = run_text(program, "--touch " + write("bad.csv", "0,0,1\n0,x,2\n"));
  EXPECT_EQ(wrong.code, 2);
  EXPECT_THAT(wrong.err, HasSubstr("bad.csv:2:3: error: 'x' is not a valid length"));
}

TEST_F(Probe, tells_what_it_found_in_the_json) {
  const Outcome outcome = run_text("G21 G90 F600\nG38.2 Z-20\nM2\n", "--json --touch Z:-1.5");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto probes = nlohmann::json::parse(outcome.out)["probes"];
  EXPECT_EQ(probes["touched"], 1);
  EXPECT_DOUBLE_EQ(probes["last_contact_mm"]["Z"], -1.5);
  EXPECT_LT(probes["last_rest_mm"]["Z"], -1.5);
  EXPECT_LT(probes["farthest_overrun_mm"], 0.17 + 2.0 / 640) << "as the manual promises";
}

TEST_F(Probe, that_finds_nothing_ends_the_run_with_1_and_leaves_no_file) {
  const Outcome outcome = run_text("G21 G90 F600\nG38.2 Z-3\nM2\n", "--touch Z:-5 --report " + path("r.json"));
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("p.ngc:2:1: error: G38.2 finished"));
  EXPECT_THAT(outcome.err, HasSubstr("stopped at X0.000 Y0.000 Z-3.000"));
  EXPECT_TRUE(files().empty());
}

TEST_F(Probe, with_a_hold_and_an_override_finds_the_same) {
  const Outcome outcome =
      run_text("G21 G90 F600\nG38.2 Z-20\nM2\n", "--json --touch Z:-1.5 --hold-at 0.1:1 --override 150@0.05");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto json = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(json["holds"].size(), 1U);
  EXPECT_DOUBLE_EQ(json["probes"]["last_contact_mm"]["Z"], -1.5);
}

TEST_F(Probe, over_a_line_that_is_cut_finds_the_same) {
  for (const char* cut : {"9999:1", "0.05:0.5", "0.12:0.5"}) {
    const Outcome outcome =
        run_text("G21 G90 F600\nG38.2 Z-20\nM2\n", "--json --touch Z:-1.5 --cut-cable-at " + std::string(cut));
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const auto probes = nlohmann::json::parse(outcome.out)["probes"];
    EXPECT_EQ(probes["touched"], 1);
    EXPECT_DOUBLE_EQ(probes["last_contact_mm"]["Z"], -1.5);
    EXPECT_LT(probes["farthest_overrun_mm"], 0.6) << "as the manual promises";
  }
}

TEST_F(Probe, refuses_what_is_no_box_of_the_machine) {
  for (const char* wrong : {"Z", "Z-1.5", "A:3", "Z:x", "Z2:1", "X1:2,", "3:4", "Znan:"}) {
    const Outcome outcome = run_text("M2\n", "--touch " + std::string(wrong));
    EXPECT_EQ(outcome.code, 2) << wrong;
    EXPECT_THAT(outcome.err, HasSubstr("expected --touch")) << wrong;
  }
}

}  // namespace
