// The documents' pictures: each is drawn by the command that stands beside it.
#include <algorithm>
#include <sstream>

#include "kit/command_line.hpp"
#include <gmock/gmock.h>

namespace {

namespace fs = std::filesystem;
using passo::test::checkout;
using passo::test::Outcome;
using passo::test::read;

class Documents : public passo::test::CommandLine {};

TEST_F(Documents, each_picture_is_drawn_by_the_command_beside_it) {
  const std::string program = "build/release/passo ";
  std::size_t drawn = 0;
  for (const auto& entry : fs::recursive_directory_iterator(checkout + "/docs")) {
    if (entry.path().extension() != ".md") continue;
    std::istringstream text(read(entry.path()));
    for (std::string line; std::getline(text, line);) {
      for (std::string rest;
           line.ends_with('\\') && std::getline(text, rest);) {  // the command goes on in the next line
        line.back() = ' ';
        line += rest.substr(std::min(rest.find_first_not_of(' '), rest.size()));
      }
      const std::size_t picture = line.find("docs/pictures/");
      if (!line.starts_with(program) || picture == std::string::npos) continue;
      const std::string name = line.substr(picture, line.find(' ', picture) - picture);
      EXPECT_TRUE(fs::exists(checkout + "/" + name))
          << name << " of " << entry.path() << ": scripts/pictures.sh draws it";
      line.replace(picture, name.size(), path("picture" + fs::path(name).extension().string()));
      const Outcome outcome = passo(line.substr(program.size()), "cd " + checkout + " &&");
      EXPECT_EQ(outcome.code, 0) << line << "\n" << outcome.err;
      EXPECT_GT(fs::file_size(path("picture" + fs::path(name).extension().string())), 1000U);
      ++drawn;
    }
  }
  EXPECT_GE(drawn, 8U);
}

// Words and numbers with one space between them, because documents break long lines.
std::string in_one_line(const std::string& text) {
  std::istringstream words(text);
  std::string line;
  for (std::string word; words >> word;) line += word + " ";
  return line;
}

// A block of a document may show a command with what it prints: "$ build/release/passo ..." and the lines below it.
// "..." stands for what is left out.
TEST_F(Documents, each_command_that_stands_with_its_output_prints_that) {
  const std::string prompt = "$ build/release/passo ";
  std::size_t run = 0;
  for (const auto& entry : fs::recursive_directory_iterator(checkout + "/docs")) {
    if (entry.path().extension() != ".md") continue;
    std::istringstream text(read(entry.path()));
    std::string line;
    std::getline(text, line);
    while (text) {
      if (!line.starts_with(prompt)) {
        std::getline(text, line);
        continue;
      }
      const std::string command = line.substr(prompt.size());
      std::string shown;
      while (std::getline(text, line) && !line.starts_with("```") && !line.starts_with("$ ")) shown += line + "\n";
      const Outcome outcome = passo(command, "cd " + checkout + " &&");
      const std::string printed = in_one_line(outcome.out + outcome.err);
      std::size_t at = 0;
      for (std::size_t begin = 0; begin < shown.size();) {
        const std::size_t end = std::min(shown.find("...\n", begin), shown.size());
        const std::string part = in_one_line(shown.substr(begin, end - begin));
        // A piece that is cut off in mid-word has no space at its end.
        const std::string wanted = end > 0 && shown[end - 1] != '\n' ? part.substr(0, part.size() - 1) : part;
        const std::size_t found = printed.find(wanted, at);
        EXPECT_TRUE(found != std::string::npos && (begin > 0 || found == 0))
            << entry.path() << ": " << command << "\nshows\n"
            << wanted << "\nprints\n"
            << printed;
        at = found == std::string::npos ? at : found + wanted.size();
        begin = end + 4;
      }
      if (!shown.ends_with("...\n")) {
        EXPECT_EQ(at, printed.size()) << command << " prints more:\n" << printed;
      }
      ++run;
    }
  }
  EXPECT_GE(run, 12U);
}

// The errata name the tests that verify their numbers: `a_listing_in_doubles_misses_ties`, `SourceNumbers.of_a_step`.
TEST_F(Documents, each_test_that_the_errata_name_exists) {
  std::string sources;
  for (const auto& entry : fs::recursive_directory_iterator(checkout + "/src/study")) {
    if (entry.path().filename().string().ends_with("_test.cpp")) sources += read(entry.path());
  }
  sources += read(checkout + "/tests/command_line/interpolate_test.cpp");
  const std::string errata = read(checkout + "/docs/errata.md");
  std::size_t named = 0;
  for (std::size_t at = errata.find('`'); at != std::string::npos; at = errata.find('`', at)) {
    const std::size_t end = errata.find('`', at + 1);
    std::string name = errata.substr(at + 1, end - at - 1);
    at = end + 1;
    name.erase(0, name.find('.') == std::string::npos ? 0 : name.find('.') + 1);
    if (std::ranges::count(name, '_') < 2 ||
        name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") != std::string::npos)
      continue;
    EXPECT_NE(sources.find(", " + name + ")"), std::string::npos) << name;
    ++named;
  }
  EXPECT_GE(named, 30U);
}

// The examples of a command's help: "  passo ramp ...", perhaps over several lines, and after two spaces what they do.
std::vector<std::string> examples_of(const std::string& help, const std::string& command) {
  std::vector<std::string> examples;
  std::istringstream text(help);
  for (std::string line; std::getline(text, line);) {
    line.erase(0, line.find_first_not_of(' '));
    if (!line.starts_with("passo " + command + " ")) continue;
    for (std::string rest; line.ends_with('\\') && std::getline(text, rest);) {
      line.back() = ' ';
      line.erase(line.find_last_not_of(' ') + 2);
      line += rest.substr(rest.find_first_not_of(' '));
    }
    examples.push_back(line.substr(6, std::min(line.find("  "), line.size()) - 6));
  }
  return examples;
}

TEST_F(Documents, each_example_of_the_help_of_a_study_runs) {
  for (const char* command : {"interpolate", "chords", "ramp", "motor", "loop", "windings"}) {
    const std::vector<std::string> examples = examples_of(passo(std::string(command) + " --help").out, command);
    EXPECT_GE(examples.size(), 3U) << command;
    for (const std::string& example : examples) {
      const Outcome outcome = passo(example, "cd " + path(".") + " &&");
      EXPECT_EQ(outcome.code, 0) << example << "\n" << outcome.err;
    }
  }
}

}  // namespace
