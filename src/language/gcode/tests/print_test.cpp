#include <filesystem>
#include <random>

#include "block_equality.hpp"
#include "kit/seed.hpp"
#include "parsed_line.hpp"

#include "passo/gcode/program_reader.hpp"

namespace passo {
namespace {

TEST(Print, has_one_spelling_for_all_that_mean_the_same) {
  const auto printed = [](const char* text) { return ParsedLine(text).printed(); };
  EXPECT_EQ(printed("/n 10 g01x+1.50(a)y.5;b"), "/N10 G1 X1.5 Y0.5 (a) ;b");
  EXPECT_EQ(printed("x[[1]+[2*3]]"), "X[1 + 2 * 3]");
  EXPECT_EQ(printed("x[[1+2]*3]"), "X[[1 + 2] * 3]");
  EXPECT_EQ(printed("x[1-[2-3]]"), "X[1 - [2 - 3]]");
  EXPECT_EQ(printed("x[[1-2]-3]"), "X[1 - 2 - 3]");
  EXPECT_EQ(printed("x-[1+2]"), "X-[1 + 2]");
  EXPECT_EQ(printed("x atan [#1] / [2]"), "XATAN[#1]/[2]");
  EXPECT_EQ(printed("x##<Ab c>"), "X##<abc>");
  EXPECT_EQ(printed("( msg ,hi)"), "(MSG,hi)");
  EXPECT_EQ(printed("o007 while[1]"), "O7 WHILE [1]");
  EXPECT_EQ(printed("O1234 (part)"), "O1234 ;part");
  EXPECT_EQ(printed(" % "), "%");
}

// Random lines by the grammar, in odd spellings.
class RandomLine {
 public:
  explicit RandomLine(std::uint64_t seed) : random_(seed) {}

  std::string make() {
    std::string line = one_in(6) ? "/" : "";
    if (one_in(4)) line += "N" + digits() + (one_in(3) ? "." + digits() : "");
    if (one_in(5)) {
      line += control();
    } else {
      for (auto items = below(8); items > 0; --items) line += blank() + item();
    }
    if (one_in(5)) line += blank() + ";" + any_text();
    return any_case(line);
  }

 private:
  std::uint64_t below(std::uint64_t n) { return random_() % n; }
  bool one_in(std::uint64_t n) { return below(n) == 0; }
  template <std::size_t N>
  const char* any_of(const char* const (&choices)[N]) {
    return choices[below(N)];
  }
  std::string blank() { return any_of({"", "", " ", "\t", "  "}); }
  std::string digits() { return std::to_string(below(one_in(3) ? 1'000'000'000'000 : 100)); }
  std::string number() {
    const char* const sign = any_of({"", "-", "+"});
    switch (below(3)) {
      case 0: return sign + digits();
      case 1: return sign + digits() + blank() + "." + digits();
      default: return std::string(sign) + "." + digits();
    }
  }
  std::string name() { return "<" + std::string(any_of({"a", "_x", "Feed Rate", "t1", "1", "_ini[a]b"})) + ">"; }
  std::string brackets(int depth) {
    std::string text = "[" + value(depth - 1);
    for (auto more = below(4); more > 0; --more) {
      text +=
          blank() + any_of({"+", "-", "*", "/", "**", "mod", "and", "or", "xor", "eq", "ne", "gt", "ge", "lt", "le"});
      text += blank() + value(depth - 1);
    }
    return text + blank() + "]";
  }
  std::string value(int depth) {
    if (depth <= 0) return number();
    switch (below(9)) {
      case 0: return brackets(depth);
      case 1: return "#" + value(depth - 1);
      case 2: return "#" + name();
      case 3:
        return any_of({"abs", "acos", "asin", "cos", "exp", "fix", "fup", "ln", "round", "sin", "sqrt", "tan"}) +
               blank() + brackets(depth);
      case 4: return "atan" + brackets(depth) + "/" + brackets(depth);
      case 5: return "exists[#" + (one_in(2) ? name() : value(depth - 1)) + "]";
      case 6: return any_of({"-", "+", "--"}) + value(depth - 1);
      default: return number();
    }
  }
  std::string item() {
    switch (below(7)) {
      case 0: return "#" + (one_in(2) ? name() : value(2)) + blank() + "=" + value(3);
      case 1:
        return "(" +
               std::string(any_of({"", "msg,", "Debug ,", "PRINT,", "probeopen ", "logclose", "LOG,", "LogOpen,",
                                   "LOGAPPEND,", "abort,", "PROBECLOSE", "msg"})) +
               "text #1" + ")";
      default:
        return any_of({"G", "M", "X", "Y", "Z", "A", "B", "C", "D", "E", "F", "H", "I", "J",
                       "K", "L", "P", "Q", "R", "S", "T", "U", "V", "W", "@", "^", "$"}) +
               blank() + value(3);
    }
  }
  std::string control() {
    std::string text = "O" + blank() +
                       (one_in(2)   ? name()
                        : one_in(2) ? digits().substr(0, 8)
                                    : "[#1+" + brackets(2) + "]");
    switch (below(4)) {
      case 0: return text + " call" + brackets(3) + blank() + "(c)" + brackets(2);
      case 1: return text + any_of({" if", "while", " elseif ", "repeat"}) + brackets(3);
      case 2: return text + "return" + (one_in(2) ? brackets(3) : "");
      default:
        return text +
               any_of({"sub", "endsub", "else", "endif", "do", "endwhile", "endrepeat", "break", "continue", ""});
    }
  }
  std::string any_text() {
    std::string text;
    for (auto n = below(12); n > 0; --n) text += static_cast<char>(' ' + below(95));
    return text;
  }
  std::string any_case(std::string text) {
    for (char& c : text) {
      if (c >= 'a' && c <= 'z' && one_in(2)) c = static_cast<char>(c - 'a' + 'A');
    }
    return text;
  }

  std::mt19937_64 random_;
};

TEST(Print, of_a_random_block_parses_to_the_same_block) {
  RandomLine random(test::seed());
  SymbolTable symbols;
  const BlockParser parser("part.ngc", symbols);
  Diagnostics diagnostics;
  Block block;
  Block again;
  for (int i = 0; i < 30'000; ++i) {
    const std::string text = random.make();
    ASSERT_TRUE(parser.parse(text, 1, block, diagnostics)) << render(diagnostics, false);
    const std::string printed = print(block, symbols);
    ASSERT_TRUE(parser.parse(printed, 1, again, diagnostics)) << text << '\n' << render(diagnostics, false);
    ASSERT_TRUE(same_meaning(block, again)) << text << '\n' << printed;
    ASSERT_EQ(print(again, symbols), printed) << text;
  }
}

std::vector<std::string> printed_program(const std::string& text, SymbolTable& symbols) {
  ProgramReader reader = ProgramReader::from_text("part.ngc", text);
  const BlockParser parser("part.ngc", symbols);
  Diagnostics diagnostics;
  Block block;
  std::vector<std::string> lines;
  std::string_view line_text;
  std::uint32_t line = 0;
  while (reader.next_line(line_text, line, diagnostics)) {
    EXPECT_TRUE(parser.parse(line_text, line, block, diagnostics)) << render(diagnostics, false);
    lines.push_back(print(block, symbols));
  }
  return lines;
}

// Line ends of all kinds, and '%' around the program. Nothing is kept from one line to the next.
TEST(Print, of_a_random_program_is_a_program_that_prints_the_same) {
  RandomLine random(test::seed() + 1);
  const std::string ends[] = {"\n", "\r\n", "\r"};
  for (std::size_t round = 0; round < 60; ++round) {
    const std::string& end = ends[round % 3];
    std::string text = "%" + end;
    for (int i = 0; i < 100; ++i) text += random.make() + end;
    SymbolTable symbols;
    const std::vector<std::string> lines = printed_program(text + "%" + end, symbols);
    ASSERT_EQ(lines.size(), 102U);
    std::string again;
    for (const std::string& line : lines) again += line + "\n";
    SymbolTable other_symbols;
    ASSERT_EQ(printed_program(again, other_symbols), lines);
  }
}

TEST(Print, of_real_programs_parses_to_the_same_blocks) {
  const std::filesystem::path peers = std::filesystem::path(PASSO_SOURCE_DIR) / "../shared/peers";
  if (!std::filesystem::exists(peers)) GTEST_SKIP() << "no programs of other projects at " << peers;
  std::size_t lines = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(peers)) {
    const std::string extension = entry.path().extension().string();
    if (extension != ".ngc" && extension != ".nc") continue;
    auto reader = ProgramReader::open(entry.path().string());
    if (!reader) continue;
    SymbolTable symbols;
    const BlockParser parser(entry.path().string(), symbols);
    Diagnostics diagnostics;
    Block block;
    Block again;
    std::string_view text;
    std::uint32_t line = 0;
    while (reader->next_line(text, line, diagnostics)) {
      if (!parser.parse(text, line, block, diagnostics)) continue;  // some are wrong on purpose
      const std::string printed = print(block, symbols);
      ASSERT_TRUE(parser.parse(printed, line, again, diagnostics)) << text << '\n' << printed;
      ASSERT_TRUE(same_meaning(block, again)) << text << '\n' << printed;
      ++lines;
    }
  }
  EXPECT_GT(lines, 1000U);
}

}  // namespace
}  // namespace passo
