// Damaged programs through the whole check: the examples and the golden programs of the interpreter, with characters,
// words and lines that are deleted, doubled, swapped or replaced. Whatever the damage is, the check ends, and each
// finding is in a place of the program. Longer runs: PASSO_SEED and PASSO_MUTANTS, the number of programs.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "kit/example_machine.hpp"
#include "kit/seed.hpp"
#include <gtest/gtest.h>

#include "passo/activity/program.hpp"

namespace passo {
namespace {

namespace fs = std::filesystem;

class Mutator {
 public:
  explicit Mutator(std::uint64_t seed) : random_(seed) {}

  std::size_t below(std::size_t limit) { return std::uniform_int_distribution<std::size_t>(0, limit - 1)(random_); }

  std::string mutant(std::string text) {
    for (std::size_t hits = 1 + below(3); hits > 0 && !text.empty(); --hits) {
      switch (below(3)) {
        case 0: damage_character(text); break;
        case 1: damage_part(text, " "); break;
        default: damage_part(text, "\n");
      }
    }
    return text;
  }

 private:
  void damage_character(std::string& text) {
    constexpr std::string_view characters = "GMXYZIJKRPQLFSTO0123456789.-[]#<>()/% \n=+*;,";
    const std::size_t at = below(text.size());
    switch (below(4)) {
      case 0: text.erase(at, 1); break;
      case 1: text.insert(at, 1, text[at]); break;
      case 2: std::swap(text[at], text[below(text.size())]); break;
      default: text[at] = characters[below(characters.size())];
    }
  }
  // A part of the text: from one separator to the next.
  void damage_part(std::string& text, const char* separator) {
    const std::size_t from = text.find(separator, below(text.size()));
    if (from == std::string::npos) return;
    const std::size_t to = std::min(text.find(separator, from + 1), text.size());
    const std::string part = text.substr(from, to - from);
    const int what = static_cast<int>(below(3));
    if (what != 0) text.erase(from, part.size());
    if (what != 1) text.insert(below(text.size() + 1), part);
  }

  std::mt19937_64 random_;
};

std::vector<std::string> good_programs() {
  std::vector<fs::path> paths;
  for (const char* const folder : {"examples", "src/language/interpreter/tests/golden"}) {
    for (const auto& entry : fs::directory_iterator(fs::path(PASSO_SOURCE_DIR) / folder)) {
      if (entry.path().extension() == ".ngc") paths.push_back(entry.path());
    }
  }
  std::ranges::sort(paths);  // the seed alone decides
  std::vector<std::string> programs;
  for (const fs::path& path : paths) {
    std::ifstream file(path, std::ios::binary);
    programs.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  }
  return programs;
}

void expect_places_in(const std::string& program, const Diagnostics& findings) {
  std::vector<std::size_t> lengths(1);
  for (const char c : program) c == '\n' ? lengths.push_back(0) : static_cast<void>(++lengths.back());
  for (const Diagnostic& finding : findings.all()) {
    ASSERT_GE(finding.place.line, 1U) << render(findings, false) << program;
    ASSERT_LE(finding.place.line, lengths.size()) << render(findings, false) << program;
    ASSERT_LE(finding.place.column, lengths[finding.place.line - 1] + 1) << render(findings, false) << program;
    ASSERT_FALSE(finding.message.empty());
  }
}

TEST(Mutants, of_good_programs_are_checked_to_an_end) {
  const char* const given = std::getenv("PASSO_MUTANTS");
  const unsigned long mutants = given != nullptr ? std::strtoul(given, nullptr, 10) : 500;
  SCOPED_TRACE("PASSO_SEED=" + std::to_string(test::seed()));
  const MachineDescription machine = test::example_machine("router");
  const std::vector<std::string> programs = good_programs();
  ASSERT_GT(programs.size(), 20U);
  Mutator mutator(test::seed());
  InterpreterOptions options;
  options.idle_passes = 1000;
  options.repeated_steps = 20'000;
  std::uint64_t wrong = 0;
  for (unsigned long i = 0; i < mutants; ++i) {
    const std::string program = mutator.mutant(programs[mutator.below(programs.size())]);
    Diagnostics findings;
    const ProgramCheck result =
        check_program(ProgramReader::from_text("mutant.ngc", program), machine, options, findings);
    ASSERT_EQ(result.good, !findings.any_error());
    wrong += result.good ? 0 : 1;
    expect_places_in(program, findings);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(wrong, mutants / 4) << "most damage is found";
}

}  // namespace
}  // namespace passo
