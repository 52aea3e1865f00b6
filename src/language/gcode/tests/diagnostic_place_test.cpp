// The error, its exact place, and the correction. One line for each case, with code, column and length.
#include "parsed_line.hpp"

namespace passo {
namespace {

struct Case {
  const char* line;
  const char* fault;     // code, column, length
  const char* expected;  // part of what was expected
};

void PrintTo(const Case& test, std::ostream* out) {
  *out << test.line;
}

class Faults : public testing::TestWithParam<Case> {};

TEST_P(Faults, are_placed_exactly_and_say_what_was_expected) {
  const ParsedLine line(GetParam().line);
  ASSERT_FALSE(line.good);
  EXPECT_EQ(line.diagnostics.errors(), 1U);
  EXPECT_EQ(line.fault_at(), GetParam().fault) << render(line.diagnostics, false);
  EXPECT_THAT(line.fault().expected, testing::HasSubstr(GetParam().expected));
  EXPECT_EQ(line.fault().place.line, 7U);
  EXPECT_EQ(line.fault().file, "part.ngc");
  EXPECT_EQ(line.fault().text, GetParam().line);
}

constexpr Case values[] = {
    {"G1 X", "gcode.missing-value 4 1", "a number"},
    {"G1 X Y5", "gcode.missing-value 4 1", "a number"},
    {"G1 X(1+2)", "gcode.missing-value 4 1", "square brackets"},
    {"G1 X ;", "gcode.missing-value 4 1", "a number"},
    {"X=5", "gcode.missing-value 2 1", "right after the letter"},
    {"X*2", "gcode.missing-value 2 1", "a number"},
    {"X,5", "gcode.bad-character 2 1", "decimal point"},
    {"#1=", "gcode.missing-value 3 1", "a number"},
    {"#=1", "gcode.missing-value 2 1", "right after"},
    {"X#", "gcode.missing-value 2 1", "a number"},
    {"X-", "gcode.missing-value 2 1", "a number"},
    {"X[]", "gcode.missing-value 2 1", "a number"},
    {"X[1+]", "gcode.missing-value 4 1", "a number"},
    {"X[1 AND]", "gcode.missing-value 5 3", "a number"},
    {"N X5", "gcode.missing-value 1 1", "digits"},
    {"N-5 X5", "gcode.missing-value 1 1", "digits"},
    {"G1 XO.5", "gcode.bad-o-word 5 1", "digit 0"},
    {"GO1 X5", "gcode.bad-o-word 2 1", "digit 0"},
    {"G1 X1O Y5", "gcode.bad-o-word 6 1", "digit 0"},
    {"Gl X5", "gcode.missing-value 2 1", "the digit 1"},
    {"GI X5", "gcode.missing-value 2 1", "the digit 1"},
    {"G1 Xl", "gcode.missing-value 5 1", "the digit 1"},
    {"G2 XI5", "gcode.missing-value 4 1", "a number"},
};
INSTANTIATE_TEST_SUITE_P(Values, Faults, testing::ValuesIn(values));

constexpr Case characters[] = {
    {"G1 X1,5", "gcode.bad-character 6 1", "a decimal point"},
    {"G1 X[1,5]", "gcode.bad-character 7 1", "a decimal point"},
    {"G1 X\xE2\x88\x92"
     "5",
     "gcode.bad-character 5 3", "'-'"},
    {"G1 X\xE2\x80\x94"
     "5",
     "gcode.bad-character 5 3", "'-'"},
    {"G1 X[2\xE2\x80\x93"
     "5]",
     "gcode.bad-character 7 3", "'-'"},
    {"G1\xC2\xA0X5", "gcode.bad-character 3 2", "a plain space"},
    {"G1 \xD0\xA5"
     "5",
     "gcode.bad-character 4 2", "'X'"},
    {"G1 \xEF\xBC\xB8"
     "5",
     "gcode.bad-character 4 3", "'X'"},
    {"G2 X5\xC2\xB0", "gcode.bad-character 6 2", "degrees"},
    {"G1 X5 \x07", "gcode.bad-character 7 1", ""},
    {"G1 X5 \xE9", "gcode.bad-character 7 1", ""},
    {"G1 X5 \"a\"", "gcode.bad-character 7 1", ""},
    {"G1 X5 !", "gcode.bad-character 7 1", ""},
};
INSTANTIATE_TEST_SUITE_P(Characters, Faults, testing::ValuesIn(characters));

constexpr Case expressions[] = {
    {"X[1+[2]", "gcode.unclosed-bracket 2 1", "']'"},
    {"X[1+[2", "gcode.unclosed-bracket 5 1", "']'"},
    {"XSIN[30", "gcode.unclosed-bracket 5 1", "']'"},
    {"X[1 G 2]", "gcode.unexpected-text 5 1", "an operator"},
    {"X[1;2]", "gcode.unexpected-text 4 1", "an operator"},
    {"X[1 (c) +2]", "gcode.unexpected-text 5 1", "square brackets"},
    {"X[1+2)", "gcode.unexpected-text 6 1", "square brackets"},
    {"X[1=2]", "gcode.unexpected-text 4 1", "EQ"},
    {"X1+2", "gcode.unexpected-text 3 1", "X[1+2]"},
    {"#1=#2*3", "gcode.unexpected-text 6 1", "square brackets"},
    {"X1/2", "gcode.unexpected-text 3 1", "X[1/2]"},
    {"X1 // a remark", "gcode.unexpected-text 4 2", "';'"},
    {"X1 # a remark", "gcode.missing-value 4 1", "a comment starts with ';'"},
    {"X1]", "gcode.unexpected-text 3 1", "a letter"},
    {"XSNI[3]", "gcode.unknown-function 2 3", "SIN, perhaps"},
    {"X[1+ROUNT[3]]", "gcode.unknown-function 5 5", "ROUND, perhaps"},
    {"XFLOOR[3]", "gcode.unknown-function 2 5", "ABS"},
    {"XSIN(30)", "gcode.unexpected-text 2 3", "square brackets"},
    {"XSIN 30", "gcode.unexpected-text 2 3", "SIN[30]"},
    {"XATAN[1]", "gcode.unexpected-text 2 7", "ATAN[y]/[x]"},
    {"XEXISTS[1]", "gcode.unexpected-text 2 7", "EXISTS[#<name>]"},
    {"XEXISTS[#1+1]", "gcode.unexpected-text 2 9", "']'"},
};
INSTANTIATE_TEST_SUITE_P(Expressions, Faults, testing::ValuesIn(expressions));

constexpr Case items[] = {
    {"5 X1", "gcode.unexpected-text 1 1", "a letter"},
    {"G1 N5", "gcode.unexpected-text 4 1", "N as the first word"},
    {"N5 N6", "gcode.unexpected-text 4 1", "N as the first word"},
    {"N1.2.3", "gcode.unexpected-text 5 1", "one decimal point"},
    {"G0 / X1", "gcode.unexpected-text 4 1", "block delete"},
    {"//X1", "gcode.unexpected-text 2 1", "block delete"},
    {"G0 %", "gcode.unexpected-text 4 1", "a letter"},
    {"G0 = 1", "gcode.unexpected-text 4 1", "a letter"},
    {"#1 5", "gcode.unexpected-text 1 4", "'='"},
    {"#<a> 5", "gcode.unexpected-text 1 4", "'='"},
    {"X[#1 LT ]", "gcode.missing-value 6 2", "a number"},
    {"#<a=5", "gcode.bad-parameter-name 2 1", "'>'"},
    {"#< >=5", "gcode.bad-parameter-name 2 2", "a name"},
    {"#<a<b>=5", "gcode.bad-parameter-name 4 1", "letters"},
    {"X#<a(b)>", "gcode.bad-parameter-name 5 1", "letters"},
};
INSTANTIATE_TEST_SUITE_P(Items, Faults, testing::ValuesIn(items));

TEST(Messages, name_what_was_found) {
  EXPECT_EQ(ParsedLine("G2 X5\xC2\xB0").fault().message, "U+00B0 '\xC2\xB0' has no meaning in G-code");
  EXPECT_EQ(ParsedLine("G1 \x07").fault().message, "control character U+0007 has no meaning in G-code");
  EXPECT_EQ(ParsedLine("G1 \xE9").fault().message, "byte 0xE9, which is not UTF-8, has no meaning in G-code");
  EXPECT_EQ(ParsedLine("G1 X").fault().message, "'X' has no value");
  EXPECT_EQ(ParsedLine("xsni[3]").fault().message, "there is no function SNI");
  EXPECT_EQ(ParsedLine("X[#1 lt ]").fault().message, "'lt' has no value after it");
  EXPECT_EQ(ParsedLine("X[2**]").fault().message, "'**' has no value after it");
}

TEST(Messages, stay_short_where_the_line_is_long) {
  EXPECT_LT(ParsedLine("X" + std::string(50'000, 'Q') + "[1]").fault().message.size(), 100U);
  EXPECT_LT(ParsedLine("O1 " + std::string(50'000, 'Q')).fault().message.size(), 100U);
  EXPECT_LT(ParsedLine("#<" + std::string(1000, 'a') + "> 5").fault().message.size(), 100U);
}

}  // namespace
}  // namespace passo
