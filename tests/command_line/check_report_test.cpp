// What `passo check` says of speed, of rapids near the work and of words without effect; and its page in HTML.
#include "kit/command_line.hpp"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace {

using passo::test::Outcome;
using passo::test::read;
using testing::HasSubstr;
using testing::Not;

const std::string machines = std::string(PASSO_SOURCE_DIR) + "/examples/machines/";

class CheckReport : public passo::test::CommandLine {
 protected:
  Outcome check(const std::string& text, const std::string& options = "",
                const std::string& machine = "router.toml") const {
    return passo("check " + write("p.ngc", text) + " -m " + machines + machine + " " + options);
  }
};

TEST_F(CheckReport, names_what_bounds_the_speed_and_the_slowest_line) {
  const std::string text = "G21 G90 S1000 M3\nF600\nG1 X50\nF60000\nG1 X300\nG0 X0\nM2\n";
  const Outcome outcome = check(text, "--json");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto speed = nlohmann::json::parse(outcome.out)["speed"];
  EXPECT_EQ(speed["bounds"][0]["limit"], "velocity");  // 5.5 m at 100 mm/s, and 50 mm at 10 mm/s
  EXPECT_EQ(speed["bounds"][0]["axis"], "X");
  EXPECT_EQ(speed["bounds"][0]["value"], 100);
  EXPECT_EQ(speed["bounds"][0]["first_line"], 5);
  EXPECT_EQ(speed["bounds"][1]["limit"], "feed");
  EXPECT_TRUE(speed["bounds"][1]["axis"].is_null());
  EXPECT_EQ(speed["slowest"][0]["line"], 5);
  EXPECT_EQ(speed["slowest"][0]["programmed_mm_s"], 1000);
  EXPECT_TRUE(speed["fastest"].back()["rapid"]);
  EXPECT_TRUE(speed["fastest"].back()["programmed_mm_s"].is_null());
  const Outcome words = check(text);
  EXPECT_THAT(words.out, HasSubstr("the velocity of X, 100 mm/s; first in line 5\n"));
  EXPECT_THAT(words.out, HasSubstr("slowest       line 5: "));
}

TEST_F(CheckReport, warns_of_rapids_below_what_was_cut) {
  const std::string begin = "G21 G90 S1000 M3\nG0 Z5\nG1 Z-1 F300\nX10\n";
  const Outcome low = check(begin + "G0 X20\nG0 Z5\nM2\n");
  EXPECT_EQ(low.code, 0);
  EXPECT_THAT(low.err, HasSubstr("p.ngc:5:1: warning: a rapid moves sideways at Z-1"));
  EXPECT_THAT(low.err, HasSubstr("[path.low-rapid]"));
  EXPECT_THAT(check(begin + "G0 Z5\nG0 Z-2\nG0 Z5\nM2\n").err, HasSubstr("[path.rapid-plunge]"));
  for (const char* good : {"G0 Z5\nX20\nM2\n", "G0 Z-0.5\nX20\nM2\n", "G0 Z5\nG0 Z-0.9\nG1 Z-2\nG0 Z5\nM2\n",
                           "G0 Z5\nG83 X20 Z-8 R2 Q1 F100\nX30\nG80\nM2\n", "G92 Z0\nG0 X20\nM2\n"}) {
    EXPECT_THAT(check(begin + good).err, Not(HasSubstr("rapid"))) << good;
  }
  EXPECT_THAT(check("G21 G90 S1000 M3\nG0 Z5\nG1 X10 F300\nG0 X0 Z4\nM2\n").err, Not(HasSubstr("rapid")))
      << "in the air";
}

TEST_F(CheckReport, warns_of_words_without_effect) {
  const std::string text = "G21 S1000 M3\nT3\nG1 X5 F300\nM2\n";
  const Outcome relay = check(text, "", "forty-eight.toml");
  EXPECT_THAT(relay.err, HasSubstr("p.ngc:1:5: warning: S has no effect here"));
  EXPECT_THAT(relay.err, HasSubstr("p.ngc:2:1: warning: T3 has no effect: the program has no tool change (M6)"));
  EXPECT_THAT(check(text).err, Not(HasSubstr("S has no effect")));
  EXPECT_THAT(check("G21 S1000 M3\nT3 M6\nG1 X5 F300\nT4\nM2\n").err, Not(HasSubstr("no effect")));
}

TEST_F(CheckReport, is_one_page_without_network_and_script) {
  const Outcome outcome =
      check("G21 G90 S1000 M3\nG1 X50 Y20 Z-3 F900\nX0 Y0\nM2\n", "--report " + path("r.html"), "strong-router.toml");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const std::string page = read(path("r.html"));
  EXPECT_THAT(page, HasSubstr("<!DOCTYPE html>"));
  for (const char* part :
       {">Axes<", ">Speed, and what limits it<", ">Motors<", "Torque needed along the program",
        ">The toolpath, darker where the torque margin is small<",
        "aria-label=\"The toolpath from the front, the right and above\"", "id=\"flat-", "@media print"}) {
    EXPECT_THAT(page, HasSubstr(part));
  }
  for (const char* foreign : {"<script", "<link", " src=\"http", "@import", "url(http"}) {
    EXPECT_THAT(page, Not(HasSubstr(foreign)));
  }
}

TEST_F(CheckReport, holds_what_a_hostile_program_brings) {
  write("<img src=x onerror=alert(1)>.ngc", "G21\n(</pre><script>alert(2)</script>\nG1 X<b>1\nM2\n");
  const Outcome outcome = passo("check '" + path("<img src=x onerror=alert(1)>.ngc") + "' -m " + machines +
                                "router.toml --report " + path("r.html"));
  EXPECT_EQ(outcome.code, 2);
  const std::string page = read(path("r.html"));
  EXPECT_THAT(page, HasSubstr("&lt;img src=x onerror=alert(1)&gt;.ngc"));
  EXPECT_THAT(page, HasSubstr("&lt;script&gt;"));
  for (const char* element : {"<img", "<script", "</pre><script", "<b>1"}) EXPECT_THAT(page, Not(HasSubstr(element)));
}

TEST_F(CheckReport, is_written_whole_or_not_at_all) {
  const std::string text = "G21\nG0 X5\nM2\n";
  EXPECT_EQ(check(text, "--report " + path("r.txt")).code, 2);
  EXPECT_EQ(check(text, "--motion --report " + path("r.html")).code, 2);
  EXPECT_EQ(check(text, "--report " + path("nowhere/r.html")).code, 1);
  EXPECT_TRUE(files().empty());
  EXPECT_EQ(check(text, "--report " + path("r.html")).code, 0);
  EXPECT_EQ(files(), std::vector<std::string>{"r.html"});
}

}  // namespace
