// LinuxCNC's own programs and cases: the same calls in the same order, the same numbers.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <set>
#include <sstream>

#include "interpreted.hpp"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace passo {
namespace {

namespace fs = std::filesystem;

const fs::path peers = fs::path(PASSO_SOURCE_DIR) / "../shared/peers/linuxcnc";

#define SKIP_WITHOUT_PEERS() \
  if (!fs::exists(peers)) GTEST_SKIP() << "no ../shared/peers/linuxcnc beside the checkout"

Interpreted interpret_file(const fs::path& path, bool block_delete = false) {
  Interpreted result;
  auto reader = ProgramReader::open(path.string());
  if (!reader) {
    result.diagnostics.add(reader.error());
    return result;
  }
  InterpreterOptions options;
  options.block_delete = block_delete;
  interpret(std::move(*reader), options, result);
  return result;
}

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

// As `awk '{$1=""; print}'` does it, with which most of the expected calls were cut: the counter goes, and of what
// (PRINT,…) says the first word.
std::string without_first_word(const std::string& text) {
  std::istringstream lines(text);
  std::string cut;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t word = line.find_first_not_of(' ');
    const std::size_t end = word == std::string::npos ? word : line.find(' ', word);
    cut += (end == std::string::npos ? "" : line.substr(end)) + "\n";
  }
  return cut;
}

// Without the N column; empty for what LinuxCNC's own versions do not agree on.
std::string call_of(std::string line) {
  const auto drop = [&line](auto belongs) {
    std::size_t i = 0;
    while (i < line.size() && belongs(line[i])) ++i;
    line.erase(0, i);
  };
  const auto space = [](char c) { return c == ' '; };
  drop(space);
  if (line.size() > 1 && line[0] == 'N' && (line[1] == '.' || is_digit(line[1]))) drop([](char c) { return c != ' '; });
  drop(space);
  if (line.starts_with("CHANGE_TOOL(")) return "CHANGE_TOOL";
  if (line.starts_with("START_CHANGE")) return {};
  return line;
}

std::vector<std::string> calls_of(const std::string& text) {
  std::vector<std::string> calls;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (std::string call = call_of(line); !call.empty() && call != "executing") calls.push_back(call);
  }
  return calls;
}

// Texts are the same, numbers in them to 1e-4 (what four decimals leave).
bool same_call(const std::string& a, const std::string& b) {
  constexpr double tolerance = 1.0001e-4;
  const char* p = a.c_str();
  const char* q = b.c_str();
  const auto number_at = [](const char* c) { return is_digit(*c) || (*c == '-' && is_digit(c[1])); };
  for (;;) {
    while (*p == ' ') ++p;
    while (*q == ' ') ++q;
    if (number_at(p) && number_at(q)) {
      char* p_end = nullptr;
      char* q_end = nullptr;
      if (std::abs(std::strtod(p, &p_end) - std::strtod(q, &q_end)) > tolerance) return false;
      p = p_end;
      q = q_end;
    } else if (*p != *q) {
      return false;
    } else if (*p == 0) {
      return true;
    } else {
      ++p, ++q;
    }
  }
}

std::string first_difference(const std::vector<std::string>& expected, const std::vector<std::string>& ours) {
  for (std::size_t i = 0; i < std::max(expected.size(), ours.size()); ++i) {
    const std::string theirs = i < expected.size() ? expected[i] : "(nothing)";
    const std::string mine = i < ours.size() ? ours[i] : "(nothing)";
    if (!same_call(theirs, mine)) {
      return "call " + std::to_string(i + 1) + ": expected " + theirs + "\n                 ours " + mine;
    }
  }
  return {};
}

TEST(Peers, every_motion_program_runs_to_its_end_or_is_wrong_on_purpose) {
  SKIP_WITHOUT_PEERS();
  // Arcs that end on another radius than they start on.
  const std::set<std::string> wrong_on_purpose = {"bad_spirals_1.ngc", "bad_spirals_lathe.ngc"};
  std::size_t run = 0;
  std::size_t refused = 0;
  for (const auto& entry : fs::recursive_directory_iterator(peers / "motion")) {
    if (entry.path().extension() != ".ngc") continue;
    const Interpreted result = interpret_file(entry.path());
    const bool expected = wrong_on_purpose.contains(entry.path().filename().string());
    EXPECT_EQ(result.diagnostics.any_error(), expected) << entry.path() << "\n" << result.rendered();
    result.diagnostics.any_error() ? ++refused : ++run;
  }
  std::cout << "motion: " << run << " programs run, " << refused << " wrong on purpose are refused\n";
  EXPECT_EQ(refused, wrong_on_purpose.size());
  EXPECT_GT(run, 90U);
}

TEST(Peers, sample_programs_print_the_canonical_calls_of_linuxcnc) {
  SKIP_WITHOUT_PEERS();
  const std::map<std::string, std::string> outside = {{"gridprobe.ngc", "probing"},
                                                      {"smartprobe.ngc", "probing"},
                                                      {"lathe_g7x_quadrants.ngc", "lathe cycles"},
                                                      {"polar.ngc", "drilling cycles"},
                                                      {"skeleton.ngc", "a tool table"},
                                                      {"x-trim.ngc", "a sub in a file that is not there"}};
  std::size_t same = 0;
  for (const auto& entry : fs::directory_iterator(peers / "programs-canon")) {
    if (entry.path().extension() != ".canon") continue;
    const std::string name = entry.path().stem().string();
    if (outside.contains(name)) continue;
    const Interpreted result = interpret_file(peers / "programs" / name);
    EXPECT_FALSE(result.diagnostics.any_error()) << result.rendered();
    const std::string difference = first_difference(calls_of(without_first_word(contents(entry.path().string()))),
                                                    calls_of(without_first_word(result.canon)));
    EXPECT_EQ(difference, "") << name;
    same += difference.empty() ? 1 : 0;
  }
  std::cout << "programs: " << same << " print the same calls, " << outside.size() << " use words that are refused\n";
}

struct Case {
  std::string kind;
  std::string path;
  std::string command;
  std::string expected;
};

std::vector<Case> read_cases() {
  std::vector<Case> cases;
  std::ifstream file(peers / "interp-cases.tsv");
  std::string line;
  std::getline(file, line);  // the heading
  while (std::getline(file, line)) {
    std::istringstream fields(line);
    Case found;
    std::getline(fields, found.kind, '\t');
    std::getline(fields, found.path, '\t');
    std::getline(fields, found.command, '\t');
    std::getline(fields, found.expected, '\t');
    cases.push_back(found);
  }
  return cases;
}

// The one program of a CANON case's folder that its command names.
fs::path program_of(const Case& found) {
  std::istringstream words(found.command);
  for (std::string word; words >> word;) {
    if (word.ends_with(".ngc")) return peers / found.path / word;
  }
  return {};
}

// What a case's command leaves of the calls.
std::string filtered(const Case& found, const std::string& calls) {
  const bool cut = found.command.find("$1=\"\"") != std::string::npos;
  const std::string canon = cut ? without_first_word(calls) : calls;
  if (found.command.find("/MESSAGE/") == std::string::npos) return canon;
  std::istringstream lines(canon);
  std::string kept;
  for (std::string line; std::getline(lines, line);) {
    if (line.find("MESSAGE") != std::string::npos) kept += line + "\n";
  }
  return kept;
}

TEST(Peers, interpreter_cases_give_the_canonical_calls_of_linuxcnc) {
  SKIP_WITHOUT_PEERS();
  const char* const cutter = "cutter compensation";
  const char* const lathe = "lathe cycles";
  const char* const drilling = "drilling and tapping cycles";
  const char* const fanuc = "M98 and numbered programs";
  const char* const modal = "M70 to M73";
  const char* const inches = "offset parameters in inches: rs274 alone is a machine in inches, ours in millimetres";
  const std::map<std::string, std::string> outside = {
      {"interp/ccomp/lathe-comp", cutter},
      {"interp/ccomp/mill-line-arc-entry", cutter},
      {"interp/interp/cam-nisley", cutter},
      {"interp/interp/inside-corners", cutter},
      {"interp/interp/inverse-time-with-comp", cutter},
      {"interp/interp/g10/g10-l1-l10", "a tool table"},
      {"interp/interp/g52/g52-g92-interaction", inches},
      {"interp/interp/unit-conversion", inches},
      {"interp/interp/g71-endless-loop", lathe},
      {"interp/interp/g71-endless-loop2", lathe},
      {"interp/interp/g71-with-g70", lathe},
      {"interp/interp/g72-missing-iteration", lathe},
      {"interp/interp/g76", lathe},
      {"interp/interp/g81/g17/g98", drilling},
      {"interp/interp/g81/g17/g99", drilling},
      {"interp/interp/g81/g18/g99", drilling},
      {"interp/interp/g81/g19/g98", drilling},
      {"interp/interp/g84/g17/g98", drilling},
      {"interp/interp/g84/g18/g98", drilling},
      {"interp/interp/g84/g19/g99", drilling},
      {"interp/interp/m98m99/01-basics", fanuc},
      {"interp/interp/m98m99/05-M98-loops", fanuc},
      {"interp/interp/m98m99/08-sub-follows-main", fanuc},
      {"interp/interp/m98m99/11-main-program-oword", fanuc},
      {"interp/interp/m98m99/13-named-program", fanuc},
      {"interp/m70-m73/m70m72-restore.0", modal},
      {"interp/m70-m73/m73autorestore.0", modal},
  };
  std::size_t same = 0;
  for (const Case& found : read_cases()) {
    if (found.kind != "CANON" || outside.contains(found.path)) continue;
    const Interpreted result = interpret_file(program_of(found));
    const std::string difference = first_difference(calls_of(contents((peers / found.expected).string())),
                                                    calls_of(filtered(found, result.canon)));
    EXPECT_EQ(difference, "") << found.path << "\n" << result.rendered();
    same += difference.empty() ? 1 : 0;
  }
  std::cout << "cases: " << same << " give the same calls, " << outside.size() << " are outside this release\n";
}

TEST(Peers, arcs_at_the_edge_of_the_tolerance_are_accepted_and_beyond_it_refused) {
  SKIP_WITHOUT_PEERS();
  std::size_t good = 0;
  std::size_t bad = 0;
  for (const Case& found : read_cases()) {
    if (found.kind == "GOODARC") {
      const Interpreted result = interpret_file(peers / found.path);
      EXPECT_FALSE(result.diagnostics.any_error()) << found.path << "\n" << result.rendered();
      ++good;
    } else if (found.kind == "BAD") {
      const Interpreted result = interpret_file(peers / found.path);
      EXPECT_TRUE(result.diagnostics.any_error()) << found.path;
      ++bad;
    }
  }
  std::cout << "arcs at the edge: " << good << " accepted; programs that are wrong: " << bad << " refused\n";
  EXPECT_GT(good, 0U);
  EXPECT_GT(bad, 0U);
}

}  // namespace
}  // namespace passo
