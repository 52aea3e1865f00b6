// Answers of right and of wrong programs, in the forms that students print.
#include "passo/grading/line_answer.hpp"

#include <cmath>
#include <cstdlib>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>

namespace passo {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr const char* table = "1 0\n2 1\n3 1\n4 2\n5 2\n6 2\n7 3\n8 3\n9 4\n10 4\n";  // the source's table
const LineCase ten_four{{10, 4}, ""};

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size()) {
    text.replace(at, what.size(), by);
  }
  return text;
}

// The positions in long integers: (2ks + m) / 2m, halves away from zero.
std::int64_t rounded(std::int64_t k, std::int64_t steps, std::int64_t longest) {
  const std::int64_t size = (2 * k * std::abs(steps) + longest) / (2 * longest);
  return steps < 0 ? -size : size;
}

TEST(LineCases, agree_with_rounding) {
  for (const LineCase& one : line_cases(0, true)) {
    std::int64_t longest = 0;
    for (const std::int64_t steps : one.steps) longest = std::max(longest, std::abs(steps));
    const std::vector<StepCounts> positions = line_positions(one.steps);
    ASSERT_EQ(std::ssize(positions), longest) << one.why;
    for (std::int64_t k = 1; k <= longest; ++k) {
      for (std::size_t motor = 0; motor < one.steps.size(); ++motor) {
        ASSERT_EQ(positions[static_cast<std::size_t>(k - 1)][motor], rounded(k, one.steps[motor], longest))
            << describe_steps(one.steps) << " at " << k;
      }
    }
  }
}

TEST(LineCases, suit_the_number_of_motors) {
  EXPECT_EQ(line_cases(0, false).size(), 30U);
  EXPECT_EQ(line_cases(2, false).size(), 19U);
  EXPECT_EQ(line_cases(2, true).size(), 27U);
  for (const LineCase& one : line_cases(3, true)) EXPECT_EQ(one.steps.size(), 3U);
}

TEST(LineAnswer, is_right_in_many_forms) {
  const std::string plain = table;
  const std::string prompts =
      "Inserisci il numero di passi per il motore 0 Inserisci il numero di passi per il motore 1 ";
  std::string numbered;
  std::string named;
  int pulse = 0;
  for (const StepCounts& position : line_positions({10, 4})) {
    numbered += fmt::format("{:3}: ({}, {})\n", ++pulse, position[0], position[1]);
    named += fmt::format("passo {} -> x={}.0; y={}.0\n", pulse, position[0], position[1]);
  }
  for (const std::string& form : {
           plain,
           prompts + replaced(replaced(plain, " ", "\t"), "\n", "\t\n"),  // the listing itself
           "Steps of motor 1: Steps of motor 2: Steps of motor 3: " + plain,
           replaced(plain, "\n", "\r\n"),
           replaced(plain, " ", ", "),
           replaced(plain, " ", ";"),
           "[" + replaced(replaced(plain, " ", ", "), "\n", "]\n["),
           "0 0\n" + plain,                 // with the start
           "2 motors, 10 steps\n" + plain,  // a heading
           "motor x motor y\n-----\n" + plain,
           "10 4\n0 0\n" + plain,  // the input again, and the start
           plain + "End: 10 4\n",  // the end again
           plain + "Goodbye\n",
           replaced(plain, "\n", "\n\n"),
           numbered,
           named,
           plain.substr(0, plain.size() - 1),
       }) {
    EXPECT_EQ(find_fault(ten_four, form).words, "") << form;
  }
}

TEST(LineAnswer, names_the_first_wrong_pulse) {
  const AnswerFault fault = find_fault(ten_four, replaced(table, "8 3", "8 4"));
  EXPECT_EQ(fault.pulse, 8);
  EXPECT_EQ(fault.expected, "8 3");
  EXPECT_EQ(fault.found, "8 4");
  EXPECT_EQ(fault.words, "move (10, 4), pulse 8: expected 8 3, found 8 4; motor 2: 8 * 4 / 10 = 3.2");
  EXPECT_EQ(find_fault(ten_four, "0 0\n1 0\n1 0\n").words,
            "move (10, 4), pulse 2: expected 2 1, found 1 0; motor 1 is a master and steps every time");
  EXPECT_EQ(find_fault(ten_four, "1 0\n2 0.8\n").found, "2 0.8");
}

// A position above the right ones is a pulse too many, whatever it is.
TEST(LineAnswer, that_begins_with_a_false_pulse_is_wrong) {
  const std::string plain = table;
  EXPECT_EQ(find_fault(ten_four, "0 1\n" + plain).found, "0 1");
  EXPECT_EQ(find_fault(ten_four, "-3 -10\n10 4\n" + plain).found, "-3 -10");
  EXPECT_EQ(find_fault(ten_four, "10 4\n10 4\n" + plain).found, "10 4");
  EXPECT_EQ(find_fault(ten_four, "Steps of motor 1: Steps of motor 2: 7 7\n" + plain).pulse, 1);
  // Two positions in each line are none.
  EXPECT_NE(find_fault(ten_four, "9 9 " + replaced(plain, "\n", "\n9 9 ")).words, "");
}

TEST(LineAnswer, that_is_too_short_or_too_long_or_none_is_wrong) {
  EXPECT_EQ(find_fault(ten_four, "").words, "move (10, 4): no positions found in its output");
  EXPECT_EQ(find_fault(ten_four, "Steps? Segment").words, "move (10, 4): no positions found in its output");
  EXPECT_EQ(find_fault(ten_four, "1 0\n2 1\n").words, "move (10, 4): ends after pulse 2 of 10");
  EXPECT_EQ(find_fault(ten_four, std::string(table) + "11 4\n").words,
            "move (10, 4): goes on after its 10 pulses with 11 4");
  EXPECT_EQ(find_fault(ten_four, std::string(table) + "10 4\n10 4\n").words,
            "move (10, 4): goes on after its 10 pulses with 10 4");
}

TEST(LineAnswer, to_no_steps_is_no_line_or_the_start) {
  const LineCase nothing{{0, 0}, ""};
  const std::string prompts = "Passi per il motore 0 Passi per il motore 1 ";
  EXPECT_EQ(find_fault(nothing, prompts).words, "");
  EXPECT_EQ(find_fault(nothing, "").words, "");
  EXPECT_EQ(find_fault(nothing, prompts + "0 0\n").words, "");
  EXPECT_EQ(find_fault(nothing, prompts + "1 1\n").words, "move (0, 0): goes on after its 0 pulses with 1 1");
}

// The faulty listings, written anew.
std::string shared_variable(unsigned x, unsigned y) {
  std::string out;
  const unsigned steps[2] = {x, y};
  unsigned at[2] = {0, 0};
  const auto longest = static_cast<int>(std::max(x, y));
  int d = longest;
  for (int i = 0; i < longest; ++i) {
    for (int motor = 0; motor < 2; ++motor) {
      d += 2 * static_cast<int>(steps[motor]);
      if (d >= 0) {
        ++at[motor];
        d -= 2 * longest;
      }
      out += fmt::format("{}\t", at[motor]);
    }
    out += "\n";
  }
  return out;
}
std::string rounded_quotient(double x, double y) {
  std::string out;
  const double longest = std::max(x, y);
  for (int i = 1; i <= longest; ++i)
    out += fmt::format("{}\t{}\t\n", std::round(x / longest * i), std::round(y / longest * i));
  return out;
}

TEST(LineAnswer, of_the_known_faulty_listings_is_wrong_where_it_is_known) {
  EXPECT_EQ(find_fault(ten_four, shared_variable(10, 4)).words,
            "move (10, 4), pulse 1: expected 1 0, found 1 1; motor 2: 1 * 4 / 10 = 0.4");
  const LineCase tie{{22, 15}, ""};
  EXPECT_EQ(find_fault(tie, rounded_quotient(22, 15)).words,
            "move (22, 15), pulse 11: expected 11 8, found 11 7; motor 2: 11 * 15 / 22 = 7.5");
  EXPECT_EQ(find_fault(ten_four, rounded_quotient(10, 4)).words, "");
}

TEST(CountedMotors, follow_from_what_a_program_prints_for_eight) {
  const StepCounts eight = {16, 1, 2, 4, 8, 15, 3, 0};
  const auto of_first = [&](std::size_t motors, const char* form) {
    std::string out;
    int pulse = 0;
    for (const StepCounts& position : line_positions({eight.begin(), eight.begin() + std::ptrdiff_t(motors)})) {
      out += fmt::format(fmt::runtime(form), fmt::arg("k", ++pulse), fmt::arg("p", fmt::join(position, " "))) + "\n";
    }
    return out;
  };
  for (const char* form : {"{p}", "{k}: {p}", "{k} {p}"}) {
    EXPECT_EQ(count_motors(of_first(2, form), eight), 2U) << form;
    EXPECT_EQ(count_motors(of_first(3, form), eight), 3U) << form;
    EXPECT_EQ(count_motors(of_first(8, form), eight), 0U) << form;
  }
  EXPECT_EQ(count_motors("", eight), 2U);
  EXPECT_EQ(count_motors(shared_variable(16, 1), eight), 2U);
}

}  // namespace
}  // namespace passo
