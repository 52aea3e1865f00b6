// Flow of control.
#include <filesystem>
#include <fstream>

#include "interpreted.hpp"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace passo {
namespace {

// The plain comments that are reached, joined.
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

TEST(OWords, repeat_counts_rounded) {
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
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "passo_subs";
  std::filesystem::create_directories(folder);
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
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "passo_wrong_sub";
  std::filesystem::create_directories(folder);
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
