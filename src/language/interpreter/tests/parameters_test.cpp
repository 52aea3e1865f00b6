#include "../parameters.hpp"

#include <array>

#include "interpreted.hpp"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace passo {
namespace {

using testing::HasSubstr;

// What (debug,…) says at the end of the program.
std::string says(const std::string& program) {
  const Interpreted result = interpret_text(program + "M2\n");
  EXPECT_FALSE(result.diagnostics.any_error()) << result.rendered();
  const std::string calls = result.calls();
  const std::size_t start = calls.rfind("MESSAGE(\"");
  if (start == std::string::npos) return {};
  return calls.substr(start + 9, calls.find("\")", start) - start - 9);
}

TEST(Comments, say_values_in_the_form_that_stands_before_them) {
  EXPECT_THAT(interpret_text("#1=3.14159 #2=-7.6\n(debug,#1 %d#1 #2 %f#1 %.2f#2 100% %x #1)\nM2\n").calls(),
              testing::HasSubstr("MESSAGE(\"3.141590 3 -8 3.1416 -7.60 100% %x 3.14\")"));
}

TEST(Parameters, are_zero_until_they_are_set) {
  EXPECT_EQ(says("(debug,#1 #5601)\n"), "0.000000 0.000000");
}

TEST(Parameters, of_a_block_keep_their_old_values_until_its_end) {
  EXPECT_EQ(says("#1=5\n#1=7 #2=#1\n(debug,#1 #2)\n"), "7.000000 5.000000");
  const Interpreted result = interpret_text("#1=5\nG0 X#1 #1=7\nM2\n");
  EXPECT_EQ(result.last<operation::StraightTraverse>().end[Axis::x], 5);
}

TEST(Parameters, may_be_chosen_by_a_number_that_is_computed) {
  EXPECT_EQ(says("#1=10\n#[#1+1]=4\n##1=6\n(debug,#11 #10)\n"), "4.000000 6.000000");
}

TEST(Parameters, names_are_told_apart_neither_by_case_nor_by_spaces) {
  EXPECT_EQ(says("#<My Name>=4\n(debug,#<myname>)\n"), "4.000000");
}

TEST(Parameters, exist_when_they_were_set) {
  EXPECT_EQ(says("#<a>=1\n#1=EXISTS[#<a>] #2=EXISTS[#<b>] #3=EXISTS[#<_x>] #4=EXISTS[#9999]\n(debug,#1 #2 #3 #4)\n"),
            "1.000000 0.000000 1.000000 0.000000");
}

TEST(Parameters, of_a_sub_are_its_own_and_those_of_the_caller_come_back) {
  EXPECT_EQ(says("o1 sub\n#<local>=[#1*2]\n#1=99\n#40=#<local>\n#<_global>=8\no1 endsub\n"
                 "#1=3\n#<local>=7\no1 call [5]\n(debug,#1 #<local> #40 #<_global>)\n"),
            "3.000000 7.000000 10.000000 8.000000");
}

TEST(Parameters, local_names_of_a_caller_are_not_seen_in_a_sub) {
  EXPECT_EQ(says("o1 sub\n#40=EXISTS[#<mine>]\no1 endsub\n#<mine>=7\no1 call\n(debug,#40 #<mine>)\n"),
            "0.000000 7.000000");
}

TEST(Parameters, of_a_recursive_sub_are_those_of_each_call) {
  EXPECT_EQ(says("o<factorial> sub\n#<n>=#1\no1 if [#<n> LE 1]\no<factorial> return [1]\no1 endif\n"
                 "o<factorial> call [#<n>-1]\n#<r>=[#<n>*#<_value>]\no<factorial> endsub [#<r>]\n"
                 "o<factorial> call [6]\n(debug,#<_value> #<_value_returned>)\n"),
            "720.000000 1.000000");
}

TEST(Parameters, tell_the_modal_state) {
  EXPECT_EQ(says("G20 G91 G19 G56 G93\nM3 S250 M7 T4 M6\n"
                 "(debug,#<_imperial> #<_incremental> #<_plane> #<_coord_system> #<_inverse_time> #<_rpm> "
                 "#<_mist> #<_current_tool> #5400 #<_spindle_on> #<_line>)\n"),
            "1.000000 1.000000 190.000000 560.000000 1.000000 250.000000 1.000000 4.000000 4.000000 1.000000 3.000000");
}

TEST(Parameters, a_hash_without_a_parameter_behind_it_is_only_a_hash) {
  EXPECT_EQ(says("(debug,# 5 #a #<unclosed #99999)\n"), "# 5 #a #<unclosed ######");
}

TEST(Parameters, nested_subs_undo_their_names_in_order) {
  SymbolTable symbols;
  ProgramState state;
  Parameters parameters(symbols, state);
  const Symbol name = symbols.intern("name");
  const std::array<double, 2> arguments = {1, 2};
  for (state.call_depth = 0; state.call_depth < 5; ++state.call_depth) {
    if (state.call_depth > 0) parameters.enter_sub(arguments);
    ASSERT_TRUE(parameters.set_named(name, state.call_depth * 10));
  }
  --state.call_depth;
  for (; state.call_depth > 0;) {
    double value = -1;
    EXPECT_TRUE(parameters.named(name, value));
    EXPECT_EQ(value, state.call_depth * 10);
    parameters.leave_sub();
    --state.call_depth;
  }
  double value = -1;
  EXPECT_TRUE(parameters.named(name, value));
  EXPECT_EQ(value, 0);
}

}  // namespace
}  // namespace passo
