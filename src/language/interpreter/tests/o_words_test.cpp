// Flow of control.
#include <filesystem>
#include <fstream>

#include "interpreted.hpp"
#include "kit/scratch_folder.hpp"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace passo {
namespace {

// The plain comments that the program reaches, joined.
std::string path(const std::string& program) {
  const Interpreted result = interpret_text(program + "M2\n");
  EXPECT_FALSE(result.diagnostics.any_error()) << result.rendered();
  std::string joined;
  const std::string calls = result.calls();
  for (std::size_t at = calls.find("COMMENT(\""); at != std::string::npos; at = calls.find("COMMENT(\"", at + 1)) {
    const std::size_t text = at + 9;
    joined += calls.substr(text, calls.find('"', text) - text);
  }
  return joined;
}

TEST(OWords, if_takes_one_branch) {
  for (const auto& [value, expected] : {std::pair{"1", "a."}, {"2", "b."}, {"3", "c."}, {"4", "d."}}) {
    EXPECT_EQ(path(std::string("#1=") + value +
                   "\no1 if [#1 EQ 1]\n(a)\no1 elseif [#1 EQ 2]\n(b)\no1 elseif [#1 EQ 3]\n(c)\n"
                   "o1 else\n(d)\no1 endif\n(.)\n"),
              expected);
  }
}

TEST(OWords, a_branch_that_is_skipped_is_not_even_read) {
  EXPECT_EQ(path("o1 if [0]\nthis is no G-code\n#1=[1/0]\no2 while [1]\no2 endwhile\no1 endif\n(.)\n"), ".");
}

TEST(OWords, while_asks_before_each_pass_and_do_after) {
  EXPECT_EQ(path("#1=0\no1 while [#1 LT 3]\n(x)\n#1=[#1+1]\no1 endwhile\n"), "xxx");
  EXPECT_EQ(path("o1 while [0]\n(x)\no1 endwhile\n"), "");
  EXPECT_EQ(path("o1 do\n(x)\no1 while [0]\n(.)\n"), "x.");
  EXPECT_EQ(path("#1=0\no1 do\n(x)\n#1=[#1+1]\no1 while [#1 LT 3]\n"), "xxx");
}

TEST(OWords, a_while_may_stand_in_a_do) {
  EXPECT_EQ(
      path("#1=0\no1 do\n#2=0\no2 while [#2 LT 2]\n(x)\n#2=[#2+1]\no2 endwhile\n(-)\n#1=[#1+1]\no1 while [#1 LT 2]\n"),
      "xx-xx-");
}

// Halves to even, as LinuxCNC rounds them.
TEST(OWords, repeat_counts_rounded) {
  EXPECT_EQ(path("o1 repeat [2.5]\n(x)\no1 endrepeat\n"), "xx");
  EXPECT_EQ(path("o1 repeat [3.5]\n(x)\no1 endrepeat\n"), "xxxx");
  EXPECT_EQ(path("o1 repeat [0.5]\n(x)\no1 endrepeat\n"), "");
  EXPECT_EQ(path("o1 repeat [2.6]\n(x)\no1 endrepeat\n"), "xxx");
  EXPECT_EQ(path("o1 repeat [0]\n(x)\no1 endrepeat\n"), "");
  EXPECT_EQ(path("o1 repeat [-2]\n(x)\no1 endrepeat\n"), "");
  EXPECT_EQ(path("o1 repeat [2]\no2 repeat [3]\n(x)\no2 endrepeat\n(.)\no1 endrepeat\n"), "xxx.xxx.");
}

TEST(OWords, break_and_continue_go_out_of_ifs_to_the_loop_they_name) {
  EXPECT_EQ(path("#1=0\no1 while [1]\n#1=[#1+1]\no2 if [#1 EQ 2]\no1 continue\no2 endif\no3 if [#1 GT 3]\no1 break\n"
                 "o3 endif\n(x)\no1 endwhile\n(.)\n"),
            "xx.");
  EXPECT_EQ(path("#1=0\no1 repeat [5]\no2 do\n#1=[#1+1]\no3 if [#1 EQ 3]\no1 break\no3 endif\n(x)\no2 while [0]\no1 "
                 "endrepeat\n(.)\n"),
            "xx.");
  EXPECT_EQ(path("#1=0\no1 do\n#1=[#1+1]\no3 if [#1 EQ 2]\no1 continue\no3 endif\n(x)\no1 while [#1 LT 4]\n(.)\n"),
            "xxx.");
  EXPECT_EQ(path("#1=0\no1 repeat [4]\n#1=[#1+1]\no3 if [#1 EQ 2]\no1 continue\no3 endif\n(x)\no1 endrepeat\n(.)\n"),
            "xxx.");
}

TEST(OWords, labels_may_be_numbers_names_and_computed) {
  EXPECT_EQ(path("#1=5\no[#1*2] repeat [2]\n(x)\no10 endrepeat\no<A Name> if [1]\n(y)\no<aname> endif\n"), "xxy");
}

TEST(OWords, subs_may_be_called_before_and_behind_their_place) {
  EXPECT_EQ(path("o1 call\no1 sub\n(a)\no1 endsub\no1 call\no2 call\nM2\no2 sub\n(b)\no2 endsub\n"), "aab");
}

TEST(OWords, a_sub_returns_from_inside_its_loops) {
  EXPECT_EQ(path("o1 sub\no2 while [1]\n(x)\no3 if [1]\no1 return\no3 endif\no2 endwhile\no1 endsub\n"
                 "o1 call\no4 repeat [2]\n(.)\no4 endrepeat\n"),
            "x..");
}

TEST(OWords, the_same_labels_may_be_used_in_several_subs) {
  EXPECT_EQ(path("o1 sub\no9 if [0]\n(a)\no9 else\n(b)\no9 endif\no1 endsub\no2 sub\no9 repeat [2]\n(c)\no1 call\no9 "
                 "endrepeat\n"
                 "o2 endsub\no2 call\n"),
            "cbcb");
}

TEST(OWords, a_construct_inside_another_of_the_same_label_is_passed_over_whole) {
  EXPECT_EQ(path("o1 if [0]\no1 if [1]\n(a)\no1 endif\n(b)\no1 else\n(c)\no1 endif\n"), "c");
}

TEST(OWords, m2_inside_a_sub_ends_the_program) {
  const Interpreted result = interpret_text("o1 sub\nM2\no1 endsub\no1 call\nG0 X1\n");
  EXPECT_EQ(result.all<operation::ProgramEnd>().size(), 1U);
  EXPECT_TRUE(result.all<operation::StraightTraverse>().empty());
}

TEST(OWords, calls_nest_a_hundred_deep) {
  const std::string program = "o1 sub\n(x)\no2 if [#1 GT 1]\no1 call [#1-1]\no2 endif\no1 endsub\no1 call [100]\n";
  EXPECT_EQ(path(program), std::string(100, 'x'));
}

TEST(OWords, a_sub_is_found_in_a_file_beside_the_program) {
  const std::filesystem::path folder = test::scratch_folder();
  std::ofstream(folder / "main.ngc") << "o<other> call [4]\no<other> call [5]\n(debug,#<_value>)\nM2\n";
  std::ofstream(folder / "other.ngc")
      << "(a file with a sub)\no<other> sub\nG0 X#1\no<inner> call\no<other> endsub [#1]\n"
         "o<inner> sub\nG0 Y1\no<inner> endsub\n";
  auto reader = ProgramReader::open((folder / "main.ngc").string());
  ASSERT_TRUE(reader);
  Interpreted result;
  interpret(std::move(*reader), {}, result);
  EXPECT_FALSE(result.diagnostics.any_error()) << result.rendered();
  EXPECT_EQ(result.all<operation::StraightTraverse>().size(), 4U);
  EXPECT_THAT(result.calls(), testing::HasSubstr("MESSAGE(\"5.000000\")"));
}

TEST(OWords, errors_in_a_sub_of_another_file_name_that_file) {
  const std::filesystem::path folder = test::scratch_folder();
  std::ofstream(folder / "main.ngc") << "o<faulty> call\nG0 X[1/0]\nM2\n";
  std::ofstream(folder / "faulty.ngc") << "o<faulty> sub\nG0 K1\no<faulty> endsub\n";
  auto reader = ProgramReader::open((folder / "main.ngc").string());
  ASSERT_TRUE(reader);
  Interpreted result;
  interpret(std::move(*reader), {}, result);
  ASSERT_EQ(result.diagnostics.errors(), 2U) << result.rendered();
  EXPECT_THAT(result.diagnostics.all()[0].file, testing::EndsWith("faulty.ngc"));
  EXPECT_EQ(result.diagnostics.all()[0].place.line, 2U);
  EXPECT_THAT(result.diagnostics.all()[1].file, testing::EndsWith("main.ngc"));
}

// "o<inner> main.ngc:3", the innermost call first.
std::string stack_of(const Diagnostic& diagnostic) {
  std::string stack;
  for (const CallLocation& call : diagnostic.calls) {
    stack += call.sub + " " + std::filesystem::path(call.file).filename().string() + ":" + std::to_string(call.line);
    stack += " ";
  }
  return stack;
}

Interpreted run_files(const std::vector<std::pair<const char*, const char*>>& files) {
  const std::filesystem::path folder = test::scratch_folder();
  for (const auto& [name, text] : files) std::ofstream(folder / name) << text;
  Interpreted result;
  auto reader = ProgramReader::open((folder / files.front().first).string());
  if (reader) interpret(std::move(*reader), {}, result);
  return result;
}

TEST(OWords, an_error_tells_through_which_calls_the_program_came_there) {
  const Interpreted result = interpret_text(
      "o<outer> sub\n\no<inner> call\nM98 P9\no<outer> endsub\n"
      "o<inner> sub\nG0 X1 K1\nwrong line\no<inner> endsub\n"
      "G0 K1\no<outer> call\nG0 K2\nM2\nO9\nG4\nM99\n");
  const auto& found = result.diagnostics.all();
  ASSERT_EQ(found.size(), 5U) << result.rendered();
  EXPECT_EQ(stack_of(found[0]), "");
  EXPECT_EQ(stack_of(found[1]), "o<inner> test.ngc:3 o<outer> test.ngc:11 ");
  EXPECT_EQ(stack_of(found[2]), stack_of(found[1])) << "a line that is no G-code";
  EXPECT_EQ(stack_of(found[3]), "O9 test.ngc:4 o<outer> test.ngc:11 ");
  EXPECT_EQ(stack_of(found[4]), "");
}

TEST(OWords, the_calls_of_an_error_name_the_files_they_stand_in) {
  const Interpreted result = run_files({{"main.ngc", "G0 X1\no<one> call\nM2\n"},
                                        {"one.ngc", "o<one> sub\no<two> call\no<one> endsub\n"},
                                        {"two.ngc", "o<two> sub\no1 while [1]\no<two> endsub\n"}});
  ASSERT_EQ(result.diagnostics.errors(), 1U) << result.rendered();
  const Diagnostic& error = result.diagnostics.all().front();
  EXPECT_THAT(error.file, testing::EndsWith("two.ngc"));
  EXPECT_EQ(error.place.line, 2U);
  EXPECT_EQ(stack_of(error), "o<two> one.ngc:2 o<one> main.ngc:2 ");
}

TEST(OWords, what_is_never_closed_is_told_at_its_opener) {
  for (const char* const opener : {"o5 if [1]", "o5 while [1]", "o5 do", "o5 repeat [2]"}) {
    const Interpreted in_main = interpret_text("G0 X1\n" + std::string(opener) + "\nG0 X2\n");
    ASSERT_EQ(in_main.diagnostics.errors(), 1U) << opener << in_main.rendered();
    EXPECT_EQ(in_main.diagnostics.all()[0].code, "gcode.unclosed-o-word") << opener;
    EXPECT_EQ(in_main.diagnostics.all()[0].place.line, 2U) << opener;
    const Interpreted in_sub =
        interpret_text("o1 call\nG0 K1\nM2\no1 sub\n" + std::string(opener) + "\nG0 X2\no1 endsub\n");
    ASSERT_EQ(in_sub.diagnostics.errors(), 2U) << opener << in_sub.rendered();
    EXPECT_EQ(in_sub.diagnostics.all()[0].place.line, 5U) << opener;
  }
}

TEST(OWords, a_sub_that_is_nowhere_tells_where_it_was_looked_for_and_the_run_goes_on) {
  const Interpreted result = run_files({{"main.ngc", "o<half> call\no<lost> call\nM98 P8\nM98 P\nG0 X1 K1\nM2\n"},
                                        {"half.ngc", "o<other> sub\no<other> endsub\n"}});
  const auto& found = result.diagnostics.all();
  ASSERT_EQ(found.size(), 5U) << result.rendered();
  EXPECT_THAT(found[0].expected, testing::AllOf(testing::HasSubstr("o<half> sub in this file"),
                                                testing::EndsWith("half.ngc exists, but does not contain it")));
  EXPECT_THAT(found[1].expected, testing::HasSubstr("in a file lost.ngc next to the program"));
  EXPECT_THAT(found[2].expected, testing::HasSubstr("O8 in this file"));
  EXPECT_EQ(found[4].code, "gcode.unused-word");
}

TEST(OWords, a_recursion_with_calls_that_lead_nowhere_ends) {
  const Interpreted result = interpret_text(
      "o1 sub\n#31=[#31+1]\nG0 X#31\no[#31+9] call\no2 if [#1 GT 0]\no1 call [#1-1]\no1 call [#1-1]\no2 endif\n"
      "o1 endsub\no1 call [60]\nM2\n");
  EXPECT_EQ(result.diagnostics.errors(), 1U) << result.rendered();
  EXPECT_EQ(result.all<operation::StraightTraverse>().size(), 1000U);
}

TEST(OWords, a_sub_ended_in_the_other_style_ends_all_the_same) {
  const Interpreted result =
      interpret_text("M98 P7\nG0 X1 K1\no8 call\nG0 X2 K2\nM2\nO7\no7 endsub\no8 sub\nM99\no8 endsub\n");
  ASSERT_EQ(result.diagnostics.errors(), 4U) << result.rendered();
  EXPECT_EQ(result.diagnostics.all()[0].code, "gcode.mixed-subs");
  EXPECT_EQ(result.diagnostics.all()[2].code, "gcode.mixed-subs");
}

TEST(OWords, comments_and_lines_may_be_as_long_as_64_KiB) {
  const std::string words(64 * 1024 - 20, 'x');
  const Interpreted result = interpret_text("(" + words + ")\nG0 X1 (" + words + ")\n(msg," + words + ")\nM2\n");
  EXPECT_FALSE(result.diagnostics.any_error()) << result.rendered();
  EXPECT_THAT(result.canon, testing::HasSubstr("MESSAGE(\"" + words));
  const Interpreted longer = interpret_text("G0 X1 (" + words + words + ")\nG0 X2 K2\nM2\n");
  ASSERT_EQ(longer.diagnostics.errors(), 2U);
  EXPECT_EQ(longer.diagnostics.all()[0].code, "gcode.line-too-long");
}

TEST(OWords, a_long_loop_is_not_idle_while_it_does_something) {
  InterpreterOptions options;
  options.idle_passes = 10;
  const Interpreted result = interpret_text(
      "#1=0\no1 while [#1 LT 100]\n#1=[#1+1]\no2 if [#1 MOD 8 EQ 0]\nG0 X#1\no2 endif\no1 endwhile\nM2\n", options);
  EXPECT_FALSE(result.diagnostics.any_error()) << result.rendered();
  EXPECT_EQ(result.all<operation::StraightTraverse>().size(), 12U);
}

}  // namespace
}  // namespace passo
