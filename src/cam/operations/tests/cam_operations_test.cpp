// The operations of `passo cam` as rows: each says all that the command line, the API, the page and the manual need.
#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <set>

#include "kit/golden.hpp"
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "passo/operations/cam_arguments.hpp"
#include "passo/operations/cam_operation.hpp"
#include "passo/operations/study_arguments.hpp"

namespace passo {
namespace {

// What a member may hold, by the kind of the option.
bool fits(CamKind kind, const CamValue& value) {
  const bool is_text = std::holds_alternative<std::string*>(value);
  const bool is_texts = std::holds_alternative<std::vector<std::string>*>(value);
  const bool is_flag = std::holds_alternative<bool*>(value);
  switch (kind) {
    case CamKind::flag: return is_flag;
    case CamKind::drawings:
    case CamKind::text:
    case CamKind::length: return is_text || is_texts;
    case CamKind::choice:
    case CamKind::place:
    case CamKind::file:
    case CamKind::feed: return is_text;
    default: return !is_text && !is_texts && !is_flag;
  }
}

TEST(CamOperations, have_rows_that_agree_with_themselves) {
  std::set<std::string> names;
  for (const CamOperation& operation : cam_operations()) {
    EXPECT_TRUE(names.insert(operation.name).second) << operation.name << " stands there twice";
    EXPECT_EQ(find_cam_operation(operation.name), &operation);
    const std::vector<CamOption> options = operation.options();
    std::set<std::string_view> known;
    int files = 0;
    for (const CamOption& option : options) {
      const std::string where = fmt::format("{} --{}", operation.name, option.name);
      EXPECT_TRUE(known.insert(option.name).second) << where << " stands there twice";
      EXPECT_TRUE(fits(option.kind, option.value)) << where << " has a value of another kind";
      EXPECT_FALSE(option.help.empty()) << where;
      EXPECT_EQ(option.kind == CamKind::choice || option.kind == CamKind::place || option.kind == CamKind::file,
                !option.traits.choices.empty() || option.kind == CamKind::file)
          << where;
      const std::string text = text_of(option);
      const auto& choices = option.traits.choices;
      if (option.kind == CamKind::choice || option.kind == CamKind::place) {
        EXPECT_TRUE(text.empty() || std::ranges::find(choices, text) != choices.end()) << where << ": " << text;
      }
      if (const auto& range = option.traits.range; range && !text.empty()) {
        const double number = std::strtod(text.c_str(), nullptr);
        EXPECT_TRUE(number >= range->least && number <= range->most) << where << ": " << text;
      }
      EXPECT_TRUE(text.empty() || option.traits.usual.empty()) << where << " has two defaults";
      if (option.kind == CamKind::drawings) ++files;
    }
    EXPECT_EQ(files, 1) << operation.name;
    for (const char* part : operation.parts) EXPECT_NE(find_cam_operation(part), nullptr) << part;
    const std::string_view instead = operation.instead_of_files;
    EXPECT_TRUE(instead.empty() || find_option(options, instead) != nullptr) << instead;
  }
  EXPECT_EQ(find_cam_operation("show"), nullptr) << "it makes no program";
}

TEST(CamOperations, read_and_write_the_member_that_a_row_names) {
  CamOutlineArguments arguments;
  const std::vector<CamOption> options = cam_options_of(arguments);
  const CamOption& tabs = *find_option(options, "tabs");
  EXPECT_EQ(text_of(tabs), "4");
  *std::get<std::uint32_t*>(tabs.value) = 6;
  EXPECT_EQ(arguments.tabs, 6U);
  EXPECT_EQ(text_of(tabs), "6");
  EXPECT_EQ(text_of(*find_option(options, "tool")), "2mm");
  EXPECT_EQ(text_of(*find_option(options, "scale")), "") << "nothing is said";
  EXPECT_EQ(find_option(options, "passes"), nullptr);
  EXPECT_EQ(text_of(*find_option(find_cam_operation("outline")->options(), "tabs")), "4") << "the default has changed";
}

constexpr const char* table_head = "| option | default | |\n|---|---|---|\n";

std::string table_of(const CamOperation& operation) {
  std::string text = table_head;
  for (const CamOption& option : operation.options()) {
    std::string help(option.help);
    std::ranges::replace(help, '\n', ' ');
    if (const auto& range = option.traits.range) help += fmt::format(" ({:g} to {:g})", range->least, range->most);
    std::string value = text_of(option);
    if (value.empty()) value = option.traits.usual;
    if (option.kind == CamKind::file) value = value.substr(value.rfind('/') + 1);
    const std::string letter =
        option.traits.letter.empty() ? std::string() : fmt::format("`-{}`, ", option.traits.letter);
    const bool is_files = option.kind == CamKind::drawings;
    text += fmt::format("| {}`{}{}` |{} | {} |\n", letter, is_files ? "" : "--", option.name,
                        value.empty() ? value : " " + value, help);
  }
  return text;
}

// A chapter of docs/manual/cam-options.md.
std::string manual_of(const CamOperation& operation) {
  std::string purpose = operation.purpose;
  purpose.front() = static_cast<char>(purpose.front() - 'a' + 'A');
  return fmt::format("\n## passo cam {}\n\n{}.\n\n{}", operation.name, purpose, table_of(operation));
}

TEST(CamOperations, stand_in_the_manual) {
  std::string page =
      "# The options of passo cam\n\n"
      "The options of each operation, on the command line and in orders of the [HTTP API](serve.md). A length is a\n"
      "number with a unit (`2mm`, `0.2cm`, `30mil`, `1/32in`), or without one in the unit of `--units` or mm.\n\n"
      "A test writes this page from the program's own description of its operations (`src/cam/operations`).\n";
  for (const CamOperation& operation : cam_operations()) page += manual_of(operation);
  test::expect_golden("docs/manual/cam-options.md", page);
}

TEST(TuneStudy, has_its_options_in_the_manual) {
  std::ifstream file(PASSO_SOURCE_DIR "/docs/manual/tuning.md");
  std::string page(std::istreambuf_iterator<char>(file), {});
  const std::size_t begin = page.find(table_head);
  ASSERT_NE(begin, std::string::npos);
  const std::size_t end = page.find("\n\n", begin) + 1;
  page.replace(begin, end - begin, table_of(tune_study()));
  test::expect_golden("docs/manual/tuning.md", page);
}

TEST(TuneStudy, has_rows_that_agree_with_themselves) {
  TuneArguments arguments;
  for (const CamOption& option : cam_options_of(arguments)) {
    EXPECT_TRUE(fits(option.kind, option.value)) << option.name;
    EXPECT_FALSE(option.help.empty()) << option.name;
  }
  const std::vector<CamOption> options = tune_study().options();
  EXPECT_EQ(text_of(*find_option(options, "margin")), fmt::format("{}", arguments.margin));
  EXPECT_EQ(text_of(*find_option(options, "way")), "") << "half of the travel";
}

}  // namespace
}  // namespace passo
