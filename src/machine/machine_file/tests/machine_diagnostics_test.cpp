#include <ostream>

#include "machine_text.hpp"

namespace passo {
namespace {

struct Mistake {
  const char* name;
  const char* from;
  const char* to;
  const char* code;
  SourceLocation place;
  const char* message;
  const char* expected;
};

void PrintTo(const Mistake& mistake, std::ostream* out) {
  *out << mistake.name;
}

// Each mistake spoils the sound file in one place, and one diagnostic answers it.
const Mistake mistakes[] = {
    {"a_second_equals_sign",
     "clock_hz = 1",
     "clock_hz == 1",
     "machine.syntax",
     {5, 11, 1},
     "this is not TOML",
     "lines"},
    {"a_decimal_comma", "2.5", "2,5", "machine.syntax", {7, 18, 1}, "saw ','", "a decimal point"},
    {"a_unit_after_a_number", "25\n", "25 mm/s\n", "machine.syntax", {17, 24, 1}, "saw 'm'", "only the number"},
    {"an_open_text",
     "\"Spindle\"",
     "\"Spindle",
     "machine.syntax",
     {10, 16, 1},
     "this is not TOML",
     "a quote at the end of the text"},
    {"an_open_list", "150]", "150", "machine.syntax", {17, 1, 1}, "expected comma or closing ']'", "lines"},
    {"a_key_given_twice", "max_rpm", "name", "machine.duplicate", {11, 1, 12}, "'name' is given twice", "once"},
    {"an_axis_given_twice", "[axis.A]", "[axis.X]", "machine.duplicate", {20, 1, 8}, "'axis.X' is given twice", "once"},
    {"a_misspelt_key",
     "step_pulse_us",
     "step_puls_us",
     "machine.unknown-key",
     {7, 1, 12},
     "board.step_puls_us",
     "perhaps step_pulse_us"},
    {"a_key_without_its_unit",
     "max_velocity_mm_s",
     "max_velocity",
     "machine.unknown-key",
     {17, 1, 12},
     "axis.X.max_velocity",
     "perhaps max_velocity_mm_s"},
    {"swapped_letters", "name = \"Test", "naem = \"Test", "machine.unknown-key", {1, 1, 4}, "naem", "perhaps name"},
    {"a_key_of_no_kind",
     "diameter_mm",
     "colour",
     "machine.unknown-key",
     {12, 1, 6},
     "tool.colour",
     "one of name, max_rpm, diameter_mm"},
    {"a_key_below_the_wrong_table",
     "step_pulse_us = 2.5",
     "path_tolerance_mm = 1",
     "machine.unknown-key",
     {7, 1, 17},
     "board.path_tolerance_mm",
     "at the top of the file"},
    {"a_misspelt_table", "[tool]", "[tol]", "machine.unknown-table", {9, 2, 3}, "no table tol", "perhaps tool"},
    {"a_letter_without_axis", "[axis.X]", "[axis.Q]", "machine.unknown-axis", {14, 7, 1}, "no axis Q", "X, Y, Z"},
    {"a_small_letter", "[axis.X]", "[axis.x]", "machine.unknown-axis", {14, 7, 1}, "no axis x", "[axis.X]"},
    {"text_for_a_number",
     "10000",
     "\"fast\"",
     "machine.wrong-type",
     {11, 11, 6},
     "tool.max_rpm is the text \"fast\"",
     "a number, e.g. max_rpm = 10000"},
    {"a_number_for_text",
     "\"Test machine\"",
     "5",
     "machine.wrong-type",
     {1, 8, 1},
     "name is the number 5",
     "a string in quotes"},
    {"a_number_for_a_flag",
     "true",
     "1",
     "machine.wrong-type",
     {27, 12, 1},
     "axis.A.inverted is the number 1",
     "inverted = true"},
    {"one_number_for_two",
     "[-150, 150]",
     "150",
     "machine.wrong-type",
     {16, 13, 3},
     "axis.X.travel_mm is the number 150",
     "two numbers"},
    {"three_numbers_for_two",
     "[-150, 150]",
     "[-150, 0, 150]",
     "machine.wrong-type",
     {16, 13, 14},
     "a list of 3 values",
     "two numbers"},
    {"text_in_a_list",
     "[-150, 150]",
     "[-150, 'x']",
     "machine.wrong-type",
     {16, 20, 3},
     "the text \"x\" in its list",
     "two numbers"},
    {"a_number_for_a_table", "[tool]\n", "[[tool]]\n", "machine.wrong-type", {9, 1, 8}, "tool is a list", "[tool]"},
    {"a_missing_key",
     "clock_hz = 16_000_000\n",
     "",
     "machine.missing-key",
     {4, 2, 5},
     "[board] lacks clock_hz",
     "clock_hz = 16_000_000"},
    {"several_missing_keys",
     "max_velocity_mm_s = 25\nmax_acceleration_mm_s2 = 200\n",
     "",
     "machine.missing-key",
     {14, 7, 1},
     "[axis.X] lacks max_velocity_mm_s, max_acceleration_mm_s2",
     "max_velocity_mm_s = 25; max_accel"},
    {"no_scale",
     "steps_per_mm = 100\n",
     "",
     "machine.missing-key",
     {14, 7, 1},
     "[axis.X] lacks steps_per_mm",
     "or steps_per_turn and screw_pitch_mm"},
    {"half_a_gear",
     "gear_ratio = 36\n",
     "",
     "machine.missing-key",
     {20, 7, 1},
     "[axis.A] lacks gear_ratio",
     "gear_ratio = 36"},
    {"no_name", "name = \"Test machine\"\n", "", "machine.missing-key", {0, 0, 1}, "the file lacks name", "name ="},
    {"zero",
     "step_pulse_us = 2.5",
     "step_pulse_us = 0",
     "machine.out-of-range",
     {7, 17, 1},
     "board.step_pulse_us is 0",
     "a number from 0.05 to 1000"},
    {"a_negative_number", "= 200", "= -200", "machine.out-of-range", {18, 26, 4}, "is -200", "a number from 0.001"},
    {"not_a_number", "0.02", "nan", "machine.out-of-range", {2, 21, 3}, "path_tolerance_mm is nan", "0.0001 to 10"},
    {"infinity",
     "-180, 180",
     "-inf, 180",
     "machine.out-of-range",
     {24, 15, 4},
     "axis.A.travel_deg is -inf",
     "a number"},
    {"half_a_microstep",
     "microsteps = 8",
     "microsteps = 8.5",
     "machine.out-of-range",
     {22, 14, 3},
     "axis.A.microsteps is 8.5",
     "a whole number from 1 to 1024"},
    {"a_radius_of_nothing",
     "microsteps = 8",
     "microsteps = 8\nradius_mm = 0",
     "machine.out-of-range",
     {23, 13, 1},
     "axis.A.radius_mm is 0",
     "a number from 0.01"},
    {"a_radius_in_other_words",
     "microsteps = 8",
     "microsteps = 8\nradius_mm = \"Z\"",
     "machine.radius",
     {23, 13, 3},
     "axis.A.radius_mm is \"Z\"",
     "a radius in millimetres, or \"tool\""},
    {"a_radius_of_a_slide",
     "steps_per_mm = 100",
     "steps_per_mm = 100\nradius_mm = 20",
     "machine.unknown-key",
     {16, 1, 9},
     "radius_mm",
     ""},
    {"travel_back_to_front", "-150, 150", "150, -150", "machine.travel", {16, 13, 11}, "goes from 150 to -150", "low"},
    {"empty_travel", "-150, 150", "0, 0", "machine.travel", {16, 13, 6}, "goes from 0 to 0", "low"},
    {"a_scale_beside_a_gear",
     "microsteps = 8",
     "steps_per_deg = 160",
     "machine.two-scales",
     {21, 18, 3},
     "axis.A.steps_per_turn and steps_per_deg are both given",
     "either steps_per_deg, or steps_per_turn"},
    {"too_fast_for_the_board",
     "= 25\n",
     "= 501\n",
     "machine.too-fast",
     {17, 21, 3},
     "axis X needs 50100 steps/s for 501 mm/s",
     "max_velocity_mm_s = 500 or less"},
    {"starting_faster_than_the_axis",
     "= 25\n",
     "= 25\nstart_stop_velocity_mm_s = 25.5\n",
     "machine.start-stop",
     {18, 28, 4},
     "the start-stop velocity of axis X, 25.5 mm/s, is above its maximum velocity of 25 mm/s",
     "start_stop_velocity_mm_s = 25 or less"},
    {"too_many_events",
     "50_000",
     "1_000_001",
     "machine.event-rate",
     {6, 21, 9},
     "1000001 events/s",
     "from 489 to 1000000"},
    {"too_few_events", "50_000", "488", "machine.event-rate", {6, 21, 3}, "488 events/s", "from 489 to 1000000"},
    {"a_long_step_pulse",
     "2.5",
     "10.5",
     "machine.step-pulse",
     {7, 17, 4},
     "a step pulse of 10.5 us",
     "step_pulse_us = 10 or less"},
    {"a_default_pulse_that_is_too_long",
     "50_000\nstep_pulse_us = 2.5",
     "500_000",
     "machine.step-pulse",
     {4, 2, 5},
     "a step pulse of 2.5 us",
     "step_pulse_us = 1 or less"},
    {"a_motor_for_one_axis_only",
     "inverted",
     "motor = 0\ninverted",
     "machine.motor",
     {14, 7, 1},
     "[axis.X] has no key motor",
     "or for none"},
};

class MachineMistake : public testing::TestWithParam<Mistake> {};

TEST_P(MachineMistake, is_answered_at_its_place_with_its_code) {
  const Mistake& mistake = GetParam();
  Diagnostics diagnostics;
  EXPECT_FALSE(parse_machine(replaced(sound_machine, mistake.from, mistake.to), "m.toml", diagnostics));
  ASSERT_EQ(diagnostics.all().size(), 1U) << render(diagnostics, false);
  const Diagnostic& found = diagnostics.all()[0];
  EXPECT_EQ(found.code, mistake.code);
  EXPECT_EQ(found.file, "m.toml");
  EXPECT_EQ(found.place, mistake.place) << render(found, false);
  EXPECT_THAT(found.message, testing::HasSubstr(mistake.message));
  EXPECT_THAT(found.expected, testing::HasSubstr(mistake.expected));
  EXPECT_FALSE(found.expected.empty());
}
INSTANTIATE_TEST_SUITE_P(All, MachineMistake, testing::ValuesIn(mistakes),
                         [](const auto& mistake) { return mistake.param.name; });

std::string all_codes(const Diagnostics& diagnostics) {
  std::string codes;
  for (const Diagnostic& diagnostic : diagnostics.all()) {
    codes += std::to_string(diagnostic.place.line) + " " + diagnostic.code + "\n";
  }
  return codes;
}

TEST(MachineDiagnostics, a_file_with_many_mistakes_shows_them_all_at_once_from_the_top) {
  std::string text = sound_machine;
  text = replaced(text, "0.02", "-1");
  text = replaced(text, "max_rpm", "max_rmp");
  text = replaced(text, "\nstep_pulse_us = 2.5", "\nstep_pulse_us = 2,5\njust some words");
  text = replaced(text, "16_000_000", "'fast'");
  text = replaced(text, "microsteps = 8", "microsteps = 0");
  Diagnostics diagnostics;
  EXPECT_FALSE(parse_machine(text, "m.toml", diagnostics));
  EXPECT_EQ(all_codes(diagnostics),
            "2 machine.out-of-range\n5 machine.wrong-type\n7 machine.syntax\n8 machine.syntax\n"
            "12 machine.unknown-key\n23 machine.out-of-range\n");
}

TEST(MachineDiagnostics, what_a_line_with_a_syntax_error_may_have_given_is_not_called_missing) {
  Diagnostics diagnostics;
  EXPECT_FALSE(parse_machine(replaced(sound_machine, "= 16_000_000", "16_000_000"), "m.toml", diagnostics));
  EXPECT_EQ(all_codes(diagnostics), "5 machine.syntax\n");
}

TEST(MachineDiagnostics, two_axes_with_one_motor_and_a_gap_in_the_numbers_are_refused) {
  const std::string with_x = replaced(sound_machine, "[axis.X]\n", "[axis.X]\nmotor = 1\n");
  Diagnostics one_motor;
  EXPECT_FALSE(parse_machine(replaced(with_x, "[axis.A]\n", "[axis.A]\nmotor = 1\n"), "m.toml", one_motor));
  EXPECT_EQ(all_codes(one_motor), "22 machine.motor\n");
  EXPECT_EQ(one_motor.all()[0].message, "motor 1 is already assigned to axis X");
  Diagnostics gap;
  EXPECT_FALSE(parse_machine(replaced(with_x, "[axis.A]\n", "[axis.A]\nmotor = 2\n"), "m.toml", gap));
  EXPECT_EQ(all_codes(gap), "22 machine.motor\n");
}

TEST(MachineDiagnostics, a_machine_without_an_axis_and_one_with_nine_are_refused) {
  Diagnostics none;
  EXPECT_FALSE(parse_machine(sound_machine.substr(0, sound_machine.find("[axis.X]")) + "[axis]\n", "m.toml", none));
  EXPECT_EQ(all_codes(none), "14 machine.no-axis\n");

  std::string text = sound_machine.substr(0, sound_machine.find("[axis.X]"));
  for (const Axis axis : all_axes) {
    const std::string unit = is_rotary(axis) ? "deg" : "mm";
    text += std::string("[axis.") + letter_of(axis) + "]\nsteps_per_" + unit + " = 1\ntravel_" + unit +
            " = [0, 1]\nmax_velocity_" + unit + "_s = 1\nmax_acceleration_" + unit + "_s2 = 1\n";
  }
  Diagnostics nine;
  EXPECT_FALSE(parse_machine(text, "m.toml", nine));
  EXPECT_EQ(all_codes(nine), "54 machine.too-many-axes\n");
}

TEST(MachineDiagnostics, what_is_no_text_file_at_all_is_refused_by_name) {
  const auto code_of = [](const std::string& text) {
    Diagnostics diagnostics;
    EXPECT_FALSE(parse_machine(text, "m.toml", diagnostics));
    return all_codes(diagnostics);
  };
  using namespace std::string_literals;
  EXPECT_EQ(code_of(""), "0 machine.empty\n");
  EXPECT_EQ(code_of(" \n\r\n"), "0 machine.empty\n");
  EXPECT_EQ(code_of("a = 1\n\x7f"s + "ELF\0\0"s), "2 machine.binary\n");
  EXPECT_EQ(code_of(sound_machine + "# \xff\n"), "28 machine.syntax\n");
  EXPECT_EQ(code_of(std::string((1U << 20U) + 1, '#')), "0 machine.too-big\n");
  EXPECT_EQ(code_of("\n" + std::string(5000, '#')), "2 machine.long-line\n");
  EXPECT_EQ(code_of(sound_machine + "# Fräse \"x\nname = 'Fräse' # é\nnote = \"\\\"é\" é\n"), "30 machine.syntax\n");
}

std::string repeated(const std::string& text, int times) {
  std::string all;
  for (int i = 0; i < times; ++i) all += text;
  return all;
}

TEST(MachineDiagnostics, deep_nesting_is_refused_without_harm) {
  const std::string dots = repeated("a.", 16) + "a";
  const std::string too_many = repeated("a.", 1000) + "a";
  const std::string deepest =
      dots + " = [\n" + repeated(std::string("{").append(dots).append(" = [\n"), 120) + repeated("]}\n", 120) + "]\n";
  for (const std::string& text :
       {too_many + " = 1\n", std::string("[").append(too_many).append("]\n"), repeated("1.", 1000) + "1 = 1\n",
        repeated("1.2 .", 500) + "1 = 1\n", "a = {" + repeated("1 . ", 500) + "1 = 1}\n",
        std::string("a = ").append(4000, '['), std::string("[").append(dots).append("]\n").append(deepest),
        std::string("a = \"\"\"\n# \"\"\"\n"), repeated("a = [\n", 100'000)}) {
    Diagnostics diagnostics;
    EXPECT_FALSE(parse_machine(text, "m.toml", diagnostics));
    EXPECT_TRUE(diagnostics.any_error());
  }
  // The deepest file that reaches the parser must be read to its end.
  Diagnostics deep;
  EXPECT_FALSE(parse_machine(sound_machine + "[q]\n" + deepest, "m.toml", deep));
  EXPECT_EQ(all_codes(deep), "28 machine.unknown-table\n");
  Diagnostics diagnostics;
  EXPECT_FALSE(parse_machine(sound_machine + too_many + " = 1 # a.b\n", "m.toml", diagnostics));
  EXPECT_EQ(all_codes(diagnostics), "28 machine.too-deep\n");
}

TEST(MachineDiagnostics, dots_in_a_comment_are_no_depth) {
  Diagnostics diagnostics;
  EXPECT_TRUE(parse_machine(sound_machine + "# ................................ \"\"\"\n", "m.toml", diagnostics));
  EXPECT_EQ(render(diagnostics, false), "");
}

TEST(MachineDiagnostics, a_file_that_cannot_be_read_is_told_with_the_reason) {
  const auto message_of = [](const std::string& path) {
    Diagnostics diagnostics;
    EXPECT_FALSE(load_machine_file(path, diagnostics));
    EXPECT_EQ(all_codes(diagnostics), "0 machine.cannot-read\n");
    return diagnostics.all().empty() ? "" : diagnostics.all()[0].message;
  };
  EXPECT_THAT(message_of("no/such/machine.toml"), testing::HasSubstr("No such file"));
  EXPECT_THAT(message_of(PASSO_SOURCE_DIR), testing::HasSubstr("directory"));
}

TEST(MachineDiagnostics, columns_count_bytes_after_letters_outside_ascii) {
  Diagnostics diagnostics;
  EXPECT_FALSE(
      parse_machine(replaced(sound_machine, "max_rpm = 10000", "\"dr\xC3\xBC\xC3\xBC\" = 1"), "m.toml", diagnostics));
  ASSERT_EQ(diagnostics.all().size(), 1U);
  EXPECT_EQ(diagnostics.all()[0].place, (SourceLocation{11, 1, 8}));
  Diagnostics value;
  EXPECT_FALSE(
      parse_machine(replaced(sound_machine, "[tool]", "[tool]\n'\xC3\xBC' = {max_rpm='\xC3\xBC'}\n"), "m.toml", value));
  EXPECT_EQ(value.all()[0].place, (SourceLocation{10, 1, 4}));
}

TEST(MachineDiagnostics, what_a_file_says_cannot_steer_the_terminal) {
  Diagnostics diagnostics;
  EXPECT_FALSE(parse_machine(replaced(sound_machine, "10000", "\"\\u001b[31m\""), "m.toml", diagnostics));
  EXPECT_EQ(render(diagnostics, false).find('\x1b'), std::string::npos);
}

}  // namespace
}  // namespace passo
