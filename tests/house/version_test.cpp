// The version is written once, in CMakeLists.txt. What cannot read it there agrees with it.
#include <regex>

#include "source_tree.hpp"

namespace passo {
namespace {

// The first text in parentheses of `pattern` in a file of the project.
std::string first_match(const char* file, const char* pattern) {
  const std::regex expression(pattern);
  for (const std::string& line : lines_of(file)) {
    std::smatch match;
    if (std::regex_search(line, match, expression)) return match[1];
  }
  return "";
}

TEST(Version, is_the_same_everywhere) {
  const std::string version = PASSO_VERSION;
  EXPECT_EQ(first_match("CITATION.cff", "^version: (.*)$"), version);
  EXPECT_EQ(first_match("docs/api/openapi.json", R"re(^  "version": "(.*)",$)re"), version);
  EXPECT_EQ(first_match("README.md", R"(\*\*Status\.\*\* Version ([^ ,]*),)"), version);
  EXPECT_EQ(first_match("CHANGELOG.md", R"(^## ([0-9][^ ,]*))"), version);
  // Debian sorts 1.0.0~rc1 before 1.0.0.
  EXPECT_EQ(std::regex_replace(first_match("debian/changelog", R"(^passo \((.*)\))"), std::regex("~"), "-"), version);
}

}  // namespace
}  // namespace passo
