// Random programs, interpreted here and by LinuxCNC's rs274 where it is installed (Debian: linuxcnc-uspace). Both must
// make the same calls with the same numbers, or both must refuse the program. PASSO_SEED chooses the programs.
// PASSO_RUNS says how many.
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <sstream>

#include "interpreted.hpp"
#include "kit/seed.hpp"
#include "random_program.hpp"
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

namespace passo {
namespace {

namespace fs = std::filesystem;

// What rs274 prints for a program. Its errors, which go to standard error, are left out.
struct Peer {
  bool refused = false;
  bool endless = false;  // it goes round some contours for ever
  bool crashed = false;  // of some contours too
  std::string canon;
};

class Rs274 {
 public:
  Rs274() : folder_(fs::temp_directory_path() / fmt::format("passo-differential-{}", getpid())) {
    fs::create_directory(folder_);
  }
  ~Rs274() { fs::remove_all(folder_); }
  Rs274(const Rs274&) = delete;
  Rs274& operator=(const Rs274&) = delete;

  static bool is_installed() { return std::system("command -v rs274 >/dev/null 2>&1") == 0; }

  // It gets a home of its own. Those that share one truncate ~/.tool.mmap under each other, and die of it now and then.
  Peer run(const std::string& program) const {
    const fs::path path = folder_ / "program.ngc";
    std::ofstream(path) << program;
    Peer peer;
    const std::string command =
        fmt::format("HOME={} timeout 20 rs274 -g {} 2>/dev/null", folder_.string(), path.string());
    std::FILE* const pipe = popen(command.c_str(), "r");
    if (pipe == nullptr) return peer;
    std::array<char, 65536> buffer;
    for (std::size_t size = 0; (size = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;) {
      peer.canon.append(buffer.data(), size);
    }
    const int status = pclose(pipe);
    constexpr int timed_out = 124;
    peer.endless = WIFEXITED(status) && WEXITSTATUS(status) == timed_out;
    peer.crashed = !WIFEXITED(status) || WEXITSTATUS(status) > timed_out;
    peer.refused = status != 0;
    return peer;
  }

  // "2.9", as the program itself sees it.
  std::string version() const {
    std::istringstream lines(run("(debug,%.1f#<_vmajor>.%d#<_vminor>)\nM2\n").canon);
    for (std::string line; std::getline(lines, line);) {
      if (line.find("MESSAGE") != std::string::npos) return line.substr(line.find('"'));
    }
    return "unknown";
  }

 private:
  fs::path folder_;
};

// Whether two words of calls are the same, numbers but for their rounding.
bool same_word(const std::string& mine, const std::string& other) {
  char* my_end = nullptr;
  char* other_end = nullptr;
  const double a = std::strtod(mine.c_str(), &my_end);
  const double b = std::strtod(other.c_str(), &other_end);
  if (my_end == mine.c_str() || other_end == other.c_str()) return mine == other;
  return std::abs(a - b) < 1.5e-4 && std::string(my_end) == other_end;
}

bool same_line(std::string mine, std::string other) {
  for (std::string* const line : {&mine, &other}) {
    for (char& c : *line) c = c == '(' ? ' ' : c;
  }
  std::istringstream my_words(mine);
  std::istringstream other_words(other);
  for (std::string a, b;;) {
    const bool more = static_cast<bool>(my_words >> a);
    if (static_cast<bool>(other_words >> b) != more) return false;
    if (!more) return true;
    if (!same_word(a, b)) return false;
  }
}

// rs274 says "Oops" among its calls where a part of a contour is too small for D.
void expect_same_calls(const std::string& mine, const std::string& other, const std::string& program) {
  std::istringstream my_lines(mine);
  std::istringstream other_lines(other);
  for (std::string a, b;;) {
    const bool more = static_cast<bool>(std::getline(my_lines, a));
    bool other_more = static_cast<bool>(std::getline(other_lines, b));
    while (other_more && b.starts_with("Oops")) other_more = static_cast<bool>(std::getline(other_lines, b));
    ASSERT_EQ(more, other_more) << a << "\n" << b << "\n" << program;
    if (!more) return;
    ASSERT_TRUE(same_line(a, b)) << "here:  " << a << "\nrs274: " << b << "\n" << program;
  }
}

// Runs PASSO_RUNS programs, or as many as `runs_otherwise`, here and there.
template <class Write>
void expect_same_programs(int runs_otherwise, const Write& write) {
  if (!Rs274::is_installed()) GTEST_SKIP() << "no rs274: the package linuxcnc-uspace is not installed";
  const Rs274 rs274;
  std::cout << "rs274 of LinuxCNC " << rs274.version() << "\n";
  SCOPED_TRACE("PASSO_SEED=" + std::to_string(test::seed()));
  test::RandomProgram random(test::seed());
  InterpreterOptions options;
  options.machine_units = LengthUnits::inch;  // rs274 alone is a machine of inches
  options.tools = example_tools();
  const char* const wanted = std::getenv("PASSO_RUNS");
  const int runs = wanted != nullptr ? std::atoi(wanted) : runs_otherwise;
  int accepted = 0;
  for (int i = 0; i < runs; ++i) {
    const std::string program = write(random);
    const Interpreted here = interpret_text(program, options);
    const Peer there = rs274.run(program);
    if (there.endless || there.crashed) continue;
    ASSERT_EQ(here.diagnostics.any_error(), there.refused) << here.rendered() << there.canon << program;
    if (there.refused) continue;
    ++accepted;
    expect_same_calls(here.canon, there.canon, program);
    if (testing::Test::HasFatalFailure()) return;
  }
  std::cout << accepted << " of " << runs << " programs ran\n";
  EXPECT_GT(accepted, runs / 2) << "most programs are good ones";
}

TEST(Differential, random_programs_mean_the_same_to_rs274) {
  expect_same_programs(60, [](test::RandomProgram& random) { return random.program(); });
}

TEST(Differential, random_contours_are_turned_as_by_rs274) {
  expect_same_programs(20, [](test::RandomProgram& random) { return random.lathe_program(); });
}

}  // namespace
}  // namespace passo
