#include "passo/part_job/part_job.hpp"

#include <gtest/gtest.h>

namespace passo {
namespace {

constexpr const char* head =
    "[job]\ndrawing = \"plate.svg\"\nclearance = 5\n[tool.1]\nshape = \"flat\"\ndiameter_mm = 6\nfeed_mm_min = 900\n"
    "plunge_mm_min = 300\nspindle_rpm = 18000\n";

std::string errors_of(const std::string& text) {
  Diagnostics findings;
  const auto job = parse_part_job(text, "shop/plate.toml", findings);
  EXPECT_EQ(job.has_value(), !findings.any_error());
  return render(findings, false);
}

PartJob job_of(const std::string& text) {
  Diagnostics findings;
  auto job = parse_part_job(text, "shop/plate.toml", findings);
  EXPECT_TRUE(job.has_value()) << render(findings, false);
  return job.value_or(PartJob{});
}

TEST(PartJob, an_operation_has_the_options_of_its_command_and_its_tool) {
  const PartJob job =
      job_of(std::string(head) +
             "[[operation]]\nkind = \"pocket\"\ntool = 1\nlayer = [\"a\", \"b\"]\ndepth = -4\nstep-over = 55\n");
  ASSERT_EQ(job.operations.size(), 1U);
  const auto& pocket = std::get<CamPocketArguments>(job.operations[0].arguments);
  EXPECT_EQ(pocket.depth, "-4");
  EXPECT_EQ(pocket.step_over, 55);
  EXPECT_EQ(pocket.tool, "6mm");
  EXPECT_EQ(pocket.feed, "900mm");
  EXPECT_EQ(pocket.plunge_feed, "300mm");
  EXPECT_EQ(pocket.spindle, 18000U);
  EXPECT_EQ(pocket.clearance, "5");
  EXPECT_EQ(job.operations[0].layers, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(job.operations[0].files, std::vector<std::string>{"shop/plate.svg"});
  EXPECT_EQ(job.operations[0].title, "pocket a b");
  EXPECT_EQ(job.output, "shop/plate.ngc");
}

// Every option of a command that the job does not set is a key of an operation's table.
TEST(PartJob, an_operation_takes_precedence_over_its_tool_and_the_job) {
  const PartJob job =
      job_of(std::string(head) +
             "[[operation]]\nkind = \"profile\"\ntool = 1\nfeed = 400\nclearance = \"1cm\"\ntab = [[1, 2], [3, 4]]\n");
  const auto& profile = std::get<CamProfileArguments>(job.operations[0].arguments);
  EXPECT_EQ(profile.feed, "400");
  EXPECT_EQ(profile.clearance, "1cm");
  EXPECT_EQ(profile.tab_places, (std::vector<std::string>{"1,2", "3,4"}));
}

// Their dots are no depth.
TEST(PartJob, a_line_may_have_many_numbers) {
  std::string places = "[1.5, -2.5]";
  std::vector<std::string> expected = {"1.5,-2.5"};
  for (int i = 0; i < 40; ++i) {
    places += ",[ 1.25 ,2.5]";
    expected.emplace_back("1.25,2.5");
  }
  const PartJob job =
      job_of(std::string(head) + "[[operation]]\nkind = \"profile\"\ntool = 1\ntab = [" + places + "]\n");
  EXPECT_EQ(std::get<CamProfileArguments>(job.operations[0].arguments).tab_places, expected);
}

TEST(PartJob, a_misspelt_key_is_shown_with_its_position_and_the_nearest_key) {
  EXPECT_EQ(errors_of(std::string(head) + "[[operation]]\nkind = \"pocket\"\ntool = 1\ndeph = -4\n"),
            "shop/plate.toml:13:1: error: a job file has no key operation.1.deph [job.unknown-key]\n"
            "   13 | deph = -4\n      | ^~~~\n      = expected: perhaps depth\n1 error\n");
}

TEST(PartJob, a_wrong_value_is_shown_with_the_values_that_the_option_accepts) {
  const std::string errors =
      errors_of(std::string(head) + "[[operation]]\nkind = \"profile\"\ntool = 1\nside = \"middle\"\n");
  EXPECT_NE(errors.find("plate.toml:13:8: error: operation.1.side is the text \"middle\" [job.bad-value]"),
            std::string::npos)
      << errors;
  EXPECT_NE(errors.find("expected: part, outside, inside, on"), std::string::npos) << errors;
  EXPECT_NE(errors_of(std::string(head) + "[[operation]]\nkind = \"pocket\"\ntool = 1\nstep-over = 120\n")
                .find("a number from 1 to 95"),
            std::string::npos);
}

TEST(PartJob, an_unknown_kind_and_a_missing_tool_are_named) {
  EXPECT_NE(errors_of(std::string(head) + "[[operation]]\nkind = \"poket\"\ntool = 1\n").find("perhaps pocket"),
            std::string::npos);
  const std::string errors = errors_of(std::string(head) + "[[operation]]\nkind = \"pocket\"\ntool = 4\n");
  EXPECT_NE(errors.find("there is no table [tool.4] [job.no-such-tool]"), std::string::npos) << errors;
}

TEST(PartJob, a_tool_that_cannot_do_it_is_refused) {
  const std::string errors = errors_of(std::string(head) + "[[operation]]\nkind = \"chamfer\"\ntool = 1\ndepth = -1\n");
  EXPECT_NE(errors.find("[job.wrong-tool]"), std::string::npos) << errors;
}

TEST(PartJob, a_clamp_ends_after_it_begins) {
  const std::string errors = errors_of(std::string(head) +
                                       "[[clamp]]\nfrom = [10, 0]\nto = [5, 20]\nheight = 10\n"
                                       "[[operation]]\nkind = \"pocket\"\ntool = 1\n");
  EXPECT_NE(errors.find("plate.toml:12:6: error: clamp.1.to is [5, 20], not beyond clamp.1.from [job.bad-value]"),
            std::string::npos)
      << errors;
}

TEST(PartJob, lengths_of_stock_and_clamps_are_in_the_units_of_the_job) {
  const PartJob job = job_of(
      "[job]\nunits = \"inch\"\ndrawing = \"a.svg\"\n[stock]\nsize = [4, 2]\nthickness = 0.5\n"
      "[tool.1]\nshape = \"flat\"\ndiameter_mm = 6\n[[operation]]\nkind = \"pocket\"\ntool = 1\n");
  EXPECT_NEAR(job.stock->width, 101.6, 1e-9);
  EXPECT_NEAR(job.stock->thickness, 12.7, 1e-9);
  EXPECT_EQ(std::get<CamPocketArguments>(job.operations[0].arguments).units, "inch");
}

TEST(PartJob, a_length_in_quotes_has_its_own_unit) {
  const std::string operation =
      "[tool.1]\nshape = \"flat\"\ndiameter_mm = 6\n[[operation]]\nkind = \"pocket\"\ntool = 1\n";
  const std::string text = "[job]\nunits = \"cm\"\ndrawing = \"a.svg\"\n";
  const PartJob job = job_of(text +
                             "[stock]\nsize = [\"4in\", 5]\nthickness = \"1/2in\"\nbelow = \"1mm\"\n"
                             "[[clamp]]\nfrom = [\"-10mm\", 0]\nto = [\"20 mm\", 3]\nheight = \"15mm\"\n" +
                             operation);
  EXPECT_NEAR(job.stock->width, 101.6, 1e-9);
  EXPECT_NEAR(job.stock->length, 50, 1e-9);
  EXPECT_NEAR(job.stock->thickness, 12.7, 1e-9);
  EXPECT_NEAR(job.stock->margin_below, 1, 1e-9);
  EXPECT_NEAR(job.clamps[0].x[0], -10, 1e-9);
  EXPECT_NEAR(job.clamps[0].height, 15, 1e-9);
  const auto error_of = [&](const std::string& stock) { return errors_of(text + "[stock]\n" + stock + operation); };
  EXPECT_NE(error_of("size = [4, 5]\nthickness = \"1ln\"\n")
                .find("plate.toml:6:13: error: stock.thickness is the text \"1ln\" [job.bad-value]"),
            std::string::npos);
  EXPECT_NE(error_of("size = [4, 5]\nthickness = 5000\n").find("expected: 0.0001 to 1000 cm"), std::string::npos);
  EXPECT_NE(error_of("size = [4, true]\nthickness = 1\n").find("plate.toml:5:12: error: stock.size is"),
            std::string::npos);
  EXPECT_NE(error_of("thickness = 1\n").find("[job.missing-key]"), std::string::npos);
}

TEST(PartJob, a_missing_operation_or_tool_is_reported) {
  const std::string errors = errors_of("[job]\ndrawing = \"a.svg\"\n");
  EXPECT_NE(errors.find("[job.missing-key]"), std::string::npos) << errors;
  EXPECT_NE(errors.find("operation"), std::string::npos) << errors;
}

}  // namespace
}  // namespace passo
