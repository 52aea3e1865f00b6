// A code of a fault that is compared with is a code that somebody raises: "homing.not-released" was waited for, and
// never came.
#include <algorithm>
#include <regex>
#include <set>

#include "source_tree.hpp"
#include <gtest/gtest.h>

namespace passo {
namespace {

namespace fs = std::filesystem;

struct Comparison {
  std::string code;
  bool is_prefix = false;
  std::string where;
};

// Places such as `fault->code == "home.not-met"`, `code.starts_with("board.")`, `error.code === 'data.none'`; and, in a
// source, a constant for such a place.
std::vector<Comparison> comparisons_in(const std::string& name, const std::string& text) {
  static const std::regex compared(
      R"re(code(?:\(\))?\s*[!=]==?\s*["']([a-z-]+\.[a-z0-9.-]+)["']|code\.starts(?:_with|With)\(["']([a-z-]+\.[a-z.-]*)["'])re"
      R"re(|string_view \w+ = "([a-z-]+\.[a-z0-9.-]+)")re");
  std::vector<Comparison> all;
  // Only where one of them can begin: a search through all of the text takes a hundred times as long.
  for (const std::string_view begins : {"code", "string_view"}) {
    for (std::size_t at = text.find(begins); at != std::string::npos; at = text.find(begins, at + 1)) {
      std::smatch found;
      const auto here = text.begin() + static_cast<std::ptrdiff_t>(at);
      if (!std::regex_search(here, text.end(), found, compared, std::regex_constants::match_continuous)) continue;
      const bool is_prefix = found[2].matched;
      const bool is_shared = found[3].matched && name.ends_with(".hpp");  // whoever raises it uses the constant
      if (!is_shared) all.push_back({found[is_prefix ? 2 : found[3].matched ? 3 : 1].str(), is_prefix, name});
    }
  }
  return all;
}

// How often text stands between quotes, or begins there.
std::size_t count_in(const std::string& text, const Comparison& wanted) {
  std::size_t count = 0;
  const std::string quoted = "\"" + wanted.code + (wanted.is_prefix ? "" : "\"");
  for (std::size_t at = text.find(quoted); at != std::string::npos; at = text.find(quoted, at + 1)) ++count;
  return count;
}

std::vector<Comparison> never_raised(const std::vector<Comparison>& compared, const std::string& sources) {
  std::vector<Comparison> lonely;
  for (const Comparison& one : compared) {
    std::size_t comparisons = 0;
    for (const Comparison& other : compared) {
      const bool is_of_it = one.is_prefix ? other.code.starts_with(one.code) : other.code == one.code;
      if (is_of_it && !other.where.ends_with(".ts") && !other.where.ends_with(".tsx")) ++comparisons;
    }
    if (count_in(sources, one) <= comparisons) lonely.push_back(one);
  }
  return lonely;
}

TEST(Codes, that_are_compared_with_are_raised) {
  std::vector<Comparison> compared;
  std::string sources;
  for (const fs::path& file : files_below("src", {".hpp", ".cpp"})) {
    if (is_test(file)) continue;
    const std::string text = text_of(file);
    sources += text;
    for (Comparison& one : comparisons_in(file.string(), text)) compared.push_back(std::move(one));
  }
  for (const fs::path& file : files_below("page/src", {".ts", ".tsx"})) {
    for (Comparison& one : comparisons_in(file.string(), text_of(file))) compared.push_back(std::move(one));
  }
  EXPECT_GE(compared.size(), 7U);
  for (const Comparison& one : never_raised(compared, sources)) {
    ADD_FAILURE() << one.where << ": nobody raises " << one.code;
  }
}

// A fault of the machine is an enumerator: the compiler knows whether it exists.
TEST(Codes, of_faults_of_the_machine_are_compared_with_nowhere) {
  static const std::regex row(R"re(\{\w+, "([a-z-]+\.[a-z-]+)")re");
  std::set<std::string> faults;
  std::vector<Comparison> compared;
  for (const fs::path& file : files_below("src", {".hpp", ".cpp"})) {
    if (is_test(file)) continue;
    const std::string text = text_of(file);
    for (Comparison& one : comparisons_in(file.string(), text)) compared.push_back(std::move(one));
    if (file.filename() != "machine_fault.cpp") continue;
    for (std::sregex_iterator found(text.begin(), text.end(), row), end; found != end; ++found) {
      faults.insert((*found)[1]);
    }
  }
  EXPECT_GT(faults.size(), 10U);
  for (const Comparison& one : compared) {
    const bool is_of_fault = std::any_of(faults.begin(), faults.end(), [&](const std::string& fault) {
      return one.is_prefix ? fault.starts_with(one.code) : fault == one.code;
    });
    EXPECT_FALSE(is_of_fault) << one.where << " compares with " << one.code << " in place of its MachineFault";
  }
}

TEST(Codes, that_nobody_raises_are_found) {
  const std::string raises = R"(fail("home.not-met"); return "board.lost";)";
  const std::string good = R"(if (fault->code == "home.not-met" || code.starts_with("board.")) return;)";
  const std::string bad = R"(if (change.code != "homing.not-released" || code.starts_with("bord.")) return;)";
  EXPECT_TRUE(never_raised(comparisons_in("a.cpp", good), raises + good).empty());
  EXPECT_EQ(never_raised(comparisons_in("a.cpp", bad), raises + good + bad).size(), 2U);
  const std::string constant = R"(constexpr std::string_view outside = "travel.beyond";)";
  EXPECT_EQ(never_raised(comparisons_in("a.cpp", constant), raises + constant).size(), 1U);
  EXPECT_EQ(comparisons_in("a.ts", "error.code === 'data.none'").size(), 1U);
}

}  // namespace
}  // namespace passo
