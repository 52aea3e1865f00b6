// How messages and summaries say what they say: nouns in their number, numbers with sensible digits, and a name before
// each finding. And what becomes of lines that files for grbl's senders have.
#include <algorithm>
#include <regex>
#include <vector>

#include "kit/command_line.hpp"
#include <gmock/gmock.h>

namespace {

namespace fs = std::filesystem;
using passo::test::Outcome;
using passo::test::router_file;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

const fs::path machines = fs::path(PASSO_SOURCE_DIR) / "examples" / "machines";

// The first part of the text that the expression fits; empty: none.
std::string found(const std::string& text, const std::string& expression) {
  std::smatch match;
  return std::regex_search(text, match, std::regex(expression)) ? match.str() : std::string();
}

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

std::string svg(const std::string& figure) {
  return R"(<svg xmlns="http://www.w3.org/2000/svg" width="100mm" height="100mm" viewBox="0 0 100 100">)" + figure +
         "</svg>";
}

class Sayings : public passo::test::CommandLine {
 protected:
  std::string all(const std::string& arguments) const {
    const Outcome outcome = passo(arguments);
    return outcome.out + outcome.err;
  }
};

TEST_F(Sayings, one_of_a_thing_has_no_plural) {
  const std::string line = write("line.ngc", "G0 X1\n");
  const std::string once =
      write("once.ngc", "G21 F100 M3 S100\nG2 X2 I1 P1\nG99 G81 X1 Z-1 R1 L1\nG0 A1\nG4 P-1\nM98 P1 L1\nM2\nO1\nM99\n");
  const std::string hole = write("hole.drl", "M48\nMETRIC,TZ\nT1C0.8\n%\nT1\nX10.0Y10.0\nM30\n");
  const std::string bar = write("bar.svg", svg(R"(<rect x="10" y="10" width="30" height="50"/>)"));
  const std::string map = write("map.csv", "x,y,z\n1,1,0\n");
  for (const std::string& arguments :
       {"explain " + line + ":9", "explain " + once + ":1-9", "canon " + once, "check " + once + " -m " + router_file,
        "cam drill " + hole + " -o " + path("d.ngc"), "cam pocket " + bar + " --tool 6 -o " + path("p.ngc"),
        "cam profile " + bar + " --tool 6 --tabs 1 -o " + path("p.ngc"), "level --map " + map,
        "run " + line + " -m " + router_file, std::string("interpolate --to 1,0"),
        std::string("ramp --limit --table-size 1 --steps-per-rev 1 --accel 20"),
        std::string("ramp --steps 1 --limit")}) {
    const std::string words = found(all(arguments), R"((^|[^.,0-9A-Za-z])1 (?!has |was )[a-z]{2,}s\b)");
    EXPECT_THAT(words, IsEmpty()) << arguments;
  }
  EXPECT_THAT(all("explain " + line + ":9"), HasSubstr("line.ngc has 1 line: expected"));
  EXPECT_THAT(all("explain " + once + ":2"), HasSubstr("1 turn, where the last turn"));
}

TEST_F(Sayings, numbers_have_sensible_digits) {
  const std::string limit = "ramp --limit --table-size 256 --steps-per-rev 100 ";
  EXPECT_THAT(all(limit + "--max-rate 280"), HasSubstr("280 Hz needs an acceleration of at least 9.62113 rad"));
  EXPECT_THAT(all(limit + "--accel 20"), HasSubstr("reaches 403.701 Hz"));
  EXPECT_THAT(all(limit + "--max-rate 1234567.891"), HasSubstr("1234568 Hz needs"));
  const std::string table = all("ramp --print-table 256 --format asm --clock 2e6 --steps-per-rev 400 --accel 33.3");
  EXPECT_THAT(table, HasSubstr("f = 2000000 Hz"));
  EXPECT_THAT(all("machine " + (machines / "bench.toml").string()), HasSubstr("to 1000000 events/s"));
  const std::string sheet = write("sheet.svg", svg(R"(<rect width="100" height="100"/>)"));
  EXPECT_THAT(all("cam pocket " + sheet + " --tool 6 -o " + path("p.ngc")), HasSubstr("1 pocket of 10000 mm²"));
  const std::string thirds = all("canon " + write("t.ngc", "G4 P[-1/3]\nT[10/3]\n#[1/3]=1\nM2\n"));
  EXPECT_THAT(thirds, HasSubstr("a dwell of -0.333333 seconds"));
  EXPECT_THAT(thirds, HasSubstr("T is 3.333333, which"));
  for (const std::string& text : {all(limit + "--max-rate 1234567.891 --accel 33.3333333"), table, thirds}) {
    EXPECT_THAT(found(text, R"(\d\.\d{7,}|\d(\.\d+)?e\+\d+)"), IsEmpty()) << text;
  }
}

// Also where there is no name to give.
TEST_F(Sayings, a_finding_begins_with_a_name) {
  const std::string nothing = write("nothing.svg", svg(""));
  const std::string none = write("none.svg", svg(""));
  const std::string narrow = write("narrow.svg", svg(R"(<rect x="10" y="10" width="1" height="50"/>)"));
  const std::string to = " -o " + path("o.ngc");
  const struct {
    std::string arguments;
    std::string begins;
  } cases[] = {{"check '' -m " + router_file, "passo: error: there is no such file"},
               {"check - -m " + router_file + " < /dev/null", "standard input: error: "},
               {"canon ''", "passo: error: "},
               {"machine ''", "passo: error: "},
               {"level --map ''", "passo: error: "},
               {"cam show ''", "passo: error: "},
               {"cam board '' -o " + path("job"), "passo: error: expected a folder"},
               {"cam drill ''" + to, "passo: error: "},
               {"cam drill " + nothing + to, nothing + ": error: there is no hole"},
               {"cam drill " + nothing + " " + none + to, nothing + ", " + none + ": error: there is no hole"},
               {"cam pocket " + nothing + " --tool 3" + to, nothing + ": error: these files have no closed contour"},
               {"cam pocket " + narrow + " --tool 3" + to, narrow + ": warning: the area at X10.5"},
               {"cam profile " + nothing + " --tool 3" + to, nothing + ": error: "},
               {"cam engrave " + nothing + to, nothing + ": error: "},
               {"cam engrave " + nothing + " --on-line" + to, nothing + ": error: "},
               {"cam engrave --text ' ' --font simplex" + to, "--text: error: "},
               {"cam isolate " + nothing + " --tool 0.2" + to, nothing + ": error: there is no copper"},
               {"cam outline " + nothing + " --tool 2" + to, nothing + ": error: "},
               {"cam wire " + nothing + " --kerf 1" + to, nothing + ": error: "}};
  for (const auto& one : cases) {
    const Outcome outcome = passo(one.arguments);
    EXPECT_THAT(outcome.err, StartsWith(one.begins)) << one.arguments;
    EXPECT_THAT(found("\n" + outcome.err, R"(\n *: )"), IsEmpty()) << one.arguments << "\n" << outcome.err;
  }
}

TEST_F(Sayings, lines_for_grbl_itself_are_named_and_percent_signs_passed_over) {
  const std::string framed = write("f.nc", "%\nG21 G90\nG0 X1\nM30\n%\n");
  EXPECT_THAT(passo("canon " + framed + " --dialect grbl").err, IsEmpty());
  const std::string program = write("h.nc", "$H\n$32=1\n%\nG21 G90\nG0 X1\nM30\n%\n");
  for (const char* const dialect : {"", " --dialect grbl"}) {
    const Outcome outcome = passo("check " + program + " -m " + router_file + dialect);
    EXPECT_EQ(outcome.code, 2);
    EXPECT_THAT(outcome.err,
                HasSubstr("h.nc:1:1: error: $H homes the machine: a system command of Grbl cannot be part of"));
    EXPECT_THAT(outcome.err, HasSubstr("passo home"));
    EXPECT_THAT(outcome.err, HasSubstr("h.nc:2:1: error: $32= changes a Grbl setting"));
    EXPECT_THAT(outcome.err, HasSubstr("\n2 errors\n"));
  }
  std::string settings;
  for (int number = 0; number < 40; ++number) settings += "$" + std::to_string(number) + "=1 (of a machine)\r\n";
  const Outcome listed = passo("canon " + write("s.nc", settings));
  EXPECT_THAT(listed.err, HasSubstr("s.nc: error: this is a list of Grbl settings"));
  EXPECT_THAT(listed.err, HasSubstr("\n1 error\n"));
}

TEST_F(Sayings, half_a_pass_of_the_collection_is_rounded_as_rs274_does) {
  const fs::path program = fs::path(PASSO_SOURCE_DIR) / "../shared/cases/language/repeat-half.ngc";
  if (!fs::exists(program)) GTEST_SKIP() << "no ../shared/cases beside this checkout";
  const Outcome outcome = passo("canon " + program.string());
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(count_of(outcome.out, "STRAIGHT_TRAVERSE"), 2U) << outcome.out;
}

}  // namespace
