// LinuxCNC's own programs and cases give the same calls in the same order, with the same numbers.
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

#include "passo/interpreter/tool_table_file.hpp"

namespace passo {
namespace {

namespace fs = std::filesystem;

const fs::path peers = fs::path(PASSO_SOURCE_DIR) / "../shared/peers/linuxcnc";

#define SKIP_WITHOUT_PEERS() \
  if (!fs::exists(peers)) GTEST_SKIP() << "no ../shared/peers/linuxcnc beside the checkout"

// As in rs274, only the calls that the first wrong block made before its error are printed after that error.
std::string canon_up_to_an_error(const fs::path& path, const InterpreterOptions& options, bool& refused) {
  Diagnostics diagnostics;
  auto reader = ProgramReader::open(path.string());
  if (!reader) {
    ADD_FAILURE() << "cannot read " << path;
    return {};
  }
  Interpreter interpreter(std::move(*reader), options, diagnostics);
  CanonPrinter printer(options.machine_units);
  Operation operation;
  std::string canon;
  while (interpreter.next(operation)) {
    const bool is_end = std::holds_alternative<operation::Finish>(operation.what);
    if (diagnostics.any_error() && (is_end || operation.source.line != diagnostics.all().back().place.line)) break;
    printer.print(operation, canon);
  }
  refused = diagnostics.any_error();
  return canon;
}

Interpreted interpret_file(const fs::path& path, const InterpreterOptions& options = {}) {
  Interpreted result;
  auto reader = ProgramReader::open(path.string());
  if (!reader) {
    result.diagnostics.add(reader.error());
    return result;
  }
  interpret(std::move(*reader), options, result);
  return result;
}

// rs274 alone is a machine of inches. So the lengths in its tables and parameters are inches.
InterpreterOptions options_of_rs274() {
  InterpreterOptions options;
  options.machine_units = LengthUnits::inch;
  options.tools = example_tools();
  return options;
}

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

// Cuts the text as `awk '{$1=""; print}'` does. Most of the expected calls were cut in this way: the counter goes, and
// the first word of each text of (PRINT,…).
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

// Where a line's call begins, behind the counter and the N column. 0: the line is no call.
std::size_t call_in(const std::string& line) {
  std::size_t at = line.find_first_not_of(' ');
  if (at == std::string::npos) return 0;
  const std::size_t counter = at;
  while (at < line.size() && is_digit(line[at])) ++at;
  if (at > counter) at = std::min(line.find_first_not_of(' ', at), line.size());
  if (at + 1 >= line.size() || line[at] != 'N' || !(line[at + 1] == '.' || is_digit(line[at + 1]))) return 0;
  return std::min(line.find_first_not_of(' ', line.find(' ', at)), line.size());
}

// The call of a line, without counter and N column. Empty for a call on which LinuxCNC's own versions do not agree.
std::string call_of(std::string line) {
  line.erase(0, call_in(line));
  line.erase(0, line.find_first_not_of(' '));
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

// Texts must be the same. Numbers in them may differ by 1e-4, which is what four decimals leave.
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
  const std::map<std::string, std::string> outside = {
      {"skeleton.ngc", "T1 M6 G43, after which rs274 alone takes Z to be where it was"},
      {"x-trim.ngc", "a sub in a file that is not there"}};
  InterpreterOptions options = options_of_rs274();
  Diagnostics diagnostics;
  const std::string table = (peers / "programs-canon/sim_mm.tbl").string();
  ASSERT_TRUE(read_tool_table(table, options.machine_units, options.tools, diagnostics)) << render(diagnostics, false);
  std::size_t same = 0;
  for (const auto& entry : fs::directory_iterator(peers / "programs-canon")) {
    if (entry.path().extension() != ".canon") continue;
    const std::string name = entry.path().stem().string();
    if (outside.contains(name)) continue;
    const Interpreted result = interpret_file(peers / "programs" / name, options);
    EXPECT_FALSE(result.diagnostics.any_error()) << result.rendered();
    const std::string difference = first_difference(calls_of(without_first_word(contents(entry.path().string()))),
                                                    calls_of(without_first_word(result.canon)));
    EXPECT_EQ(difference, "") << name;
    same += difference.empty() ? 1 : 0;
  }
  std::cout << "programs: " << same << " print the same calls, " << outside.size() << " do not\n";
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

// One call of rs274 in a case's command.
struct Invocation {
  std::vector<fs::path> programs;  // more than one if the name has a shell's variable in it
  InterpreterOptions options;
  bool cut = false;       // the calls are cut by awk '{$1=""; print}'
  bool messages = false;  // only messages are kept
};

// The files that a name with ${t} in it stands for. They have the same text before and behind it.
std::vector<fs::path> files_like(const fs::path& folder, std::string name) {
  std::erase(name, '"');
  const std::size_t variable = name.find("${t}");
  if (variable == std::string::npos) return {folder / name};
  std::set<fs::path> found;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string file = entry.path().filename().string();
    if (file.starts_with(name.substr(0, variable)) && file.ends_with(name.substr(variable + 4))) found.insert(entry);
  }
  return {found.begin(), found.end()};
}

void read_settings(const fs::path& path, Invocation& invocation, Diagnostics& diagnostics) {
  auto settings = std::make_shared<SettingsFile>();
  (void)settings->read(path.string(), diagnostics);
  invocation.options.sub_folders = settings->sub_folders();
  invocation.options.settings = settings;
}

Invocation read_invocation(const fs::path& folder, const std::string& command) {
  Invocation invocation;
  invocation.options = options_of_rs274();
  invocation.cut = command.find("$1=\"\"") != std::string::npos;
  invocation.messages = command.find("/MESSAGE/") != std::string::npos;
  Diagnostics diagnostics;
  std::istringstream words(command);
  for (std::string word; words >> word;) {
    if (word == "|" || word.starts_with('>')) break;
    std::string file;
    if (word.ends_with(';')) word.pop_back();
    if (word == "-t" && words >> file) {
      (void)read_tool_table((folder / file).string(), LengthUnits::inch, invocation.options.tools, diagnostics);
    } else if (word == "-v" && words >> file) {
      (void)read_parameter_file((folder / file).string(), invocation.options.parameters, diagnostics);
    } else if (word == "-i" && words >> file) {
      read_settings(folder / file, invocation, diagnostics);
    } else if (word == "-b") {
      invocation.options.block_delete = true;
    } else if (word.ends_with(".ngc") || word.ends_with(".ngc\"")) {
      invocation.programs = files_like(folder, word);
    }
  }
  EXPECT_FALSE(diagnostics.any_error()) << command << "\n" << render(diagnostics, false);
  return invocation;
}

std::vector<Invocation> invocations_of(const Case& found) {
  std::vector<Invocation> invocations;
  const std::string& command = found.command;
  for (std::size_t at = command.find("rs274 "); at != std::string::npos;) {
    const std::size_t next = command.find("rs274 ", at + 1);
    invocations.push_back(read_invocation(peers / found.path, command.substr(at, next - at)));
    at = next;
  }
  return invocations;
}

// The part of the calls that a case's command keeps.
std::string filtered(const Invocation& invocation, const std::string& calls) {
  const std::string canon = invocation.cut ? without_first_word(calls) : calls;
  if (!invocation.messages) return canon;
  std::istringstream lines(canon);
  std::string kept;
  for (std::string line; std::getline(lines, line);) {
    if (line.find("MESSAGE") != std::string::npos) kept += line + "\n";
  }
  return kept;
}

// Some expected calls have rs274's error messages among them. Then only the calls are compared.
std::string calls_alone(const std::string& text) {
  std::istringstream lines(text);
  std::string kept;
  for (std::string line; std::getline(lines, line);) {
    if (call_in(line) > 0 && line.find("ON_RESET()") == std::string::npos) kept += line + "\n";
  }
  return kept;
}

bool may_fail(const Case& found) {
  return found.kind == "ERR" || found.command.starts_with("!") || found.command.find("2>&1") != std::string::npos;
}

// Whether rs274 refused the program for which this is expected. Then the program did not get to its end.
bool is_refusal(const std::string& expected) {
  return expected.find("PROGRAM_END()") == std::string::npos && expected.find("FINISH()") == std::string::npos;
}

std::string canon_of(const Invocation& invocation, bool& refused) {
  std::string canon;
  for (const fs::path& program : invocation.programs) {
    bool this_one = false;
    canon += filtered(invocation, canon_up_to_an_error(program, invocation.options, this_one));
    refused = refused || this_one;
  }
  return canon;
}

// Empty: the case passes. Otherwise it says what is different.
std::string verdict_of_calls(const Case& found) {
  const std::string expected = contents((peers / found.expected).string());
  std::string ours;
  bool refused = false;
  bool all_refused = true;
  for (const Invocation& invocation : invocations_of(found)) {
    bool this_one = false;
    ours += canon_of(invocation, this_one);
    refused = refused || this_one;
    all_refused = all_refused && this_one;
  }
  if (!may_fail(found)) {
    return refused && !is_refusal(expected) ? "is refused" : first_difference(calls_of(expected), calls_of(ours));
  }
  if (is_refusal(expected) != all_refused) return all_refused ? "is refused" : "is not refused";
  const std::vector<std::string> theirs = calls_of(calls_alone(expected));
  return first_difference(theirs, calls_of(calls_alone(ours)));
}

std::string verdict(const Case& found) {
  if (found.kind != "BAD" && found.kind != "GOODARC") return verdict_of_calls(found);
  const Interpreted result = interpret_file(peers / found.path, options_of_rs274());
  if (result.diagnostics.any_error() == (found.kind == "BAD")) return {};
  return found.kind == "BAD" ? "is not refused" : result.rendered();
}

// The cases that are expected to fail, with the reason.
std::map<std::string, std::string> expected_failures() {
  const char* const tapping = "on purpose: taps along the axis, LinuxCNC mixes up the axes outside G17";
  const char* const several = "its script runs several programs in its own order: see the next test";
  return {
      {"interp/interp/g84/g18/g98", tapping},
      {"interp/interp/g84/g19/g99", tapping},
      {"interp/interp/m98m99/11-main-program-oword", several},
  };
}

TEST(Peers, interpreter_cases_agree_with_linuxcnc) {
  SKIP_WITHOUT_PEERS();
  struct Count {
    int passed = 0;
    int all = 0;
  };
  std::map<std::string, Count> counts;
  const std::map<std::string, std::string> not_yet = expected_failures();
  for (const Case& found : read_cases()) {
    if (found.kind == "REMAP") continue;  // its programs need words that their settings define
    const std::string wrong = verdict(found);
    Count& count = counts[found.kind];
    ++count.all;
    count.passed += wrong.empty() ? 1 : 0;
    const auto excuse = not_yet.find(found.path);
    if (excuse == not_yet.end()) {
      EXPECT_EQ(wrong, "") << found.kind << " " << found.path;
    } else {
      EXPECT_NE(wrong, "") << found.path << " passes: take it off the list (" << excuse->second << ")";
    }
  }
  for (const auto& [kind, count] : counts) std::cout << kind << ": " << count.passed << " of " << count.all << "\n";
  EXPECT_EQ(counts.size(), 5U);
}

// Only the calls with a number, because texts of (PRINT,…) were cut differently from file to file.
std::vector<std::string> numbered_calls(const std::string& text) {
  std::vector<std::string> calls;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t n = line.find_first_not_of(" 0123456789");
    if (n == std::string::npos || line[n] != 'N') continue;
    std::string call = call_of(line.substr(n));
    if (const std::size_t two = call.find("  "); two != std::string::npos) call.erase(two, 1);
    if (!call.empty() && call != "ON_RESET()") calls.push_back(call);
  }
  return calls;
}

TEST(Peers, main_programs_with_o_words_give_the_calls_of_linuxcnc_up_to_their_end_or_error) {
  SKIP_WITHOUT_PEERS();
  const fs::path folder = peers / "interp/interp/m98m99/11-main-program-oword";
  std::string calls;
  for (const char* const program :
       {"legal-end-main-with-m2", "legal-end-main-with-m02", "legal-end-main-with-m30", "legal-end-main-with-percent",
        "illegal-end-main-with-eof", "illegal-no-m30-before-osub", "illegal-sub-after-percent"}) {
    calls += interpret_file(folder / ("test-" + std::string(program) + ".ngc"), options_of_rs274()).canon;
  }
  // In the last program LinuxCNC ends where it finds no sub. Passo goes on, to find more errors.
  const std::size_t gone_on = calls.rfind('\n', calls.rfind("returned from sub 2"));
  calls.erase(gone_on, calls.find('\n', gone_on + 1) - gone_on);
  EXPECT_EQ(first_difference(numbered_calls(contents((folder / "expected").string())), numbered_calls(calls)), "");
}

}  // namespace
}  // namespace passo
