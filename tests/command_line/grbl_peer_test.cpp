// The same random lines to real Grbl 1.1h, on an emulated Uno, and to passo serve: the same replies, and the same modes
// after each line. What differs on purpose stands in a table of docs/manual/serve.md.
#include <filesystem>
#include <regex>
#include <string>

#include "kit/command_line.hpp"
#include "kit/in_full.hpp"
#include <fmt/format.h>

namespace {

using passo::test::read;

constexpr const char* peers = PASSO_SOURCE_DIR "/../shared/peers/grbl";

// The differences of $G in the manual's table: grbl forgets T with the next line, and this one has no mist (M7). Of a
// line such as "      'G0 X1   [GC:G0 … T0 F0 S0]  |  [GC:G0 … T7 F0 S0]'".
bool differs_in_tool_or_mist_alone(const std::string& line) {
  static const std::regex modes(R"re(\[GC:[^\]]*\])re");
  static const std::regex tool(" (T[0-9]+|M[79])(?= )");
  std::sregex_iterator found(line.begin(), line.end(), modes);
  if (std::distance(found, std::sregex_iterator()) != 2) return false;
  const std::string grbl = std::regex_replace((found++)->str(), tool, "");
  return grbl == std::regex_replace(found->str(), tool, "");
}

bool asks_for_mist(const std::string& line) {
  static const std::regex mist("M7(?![0-9])");
  return std::regex_search(line, mist);
}

class GrblPeer : public passo::test::CommandLine {
 protected:
  // A machine without switches whose travel the lines cannot leave.
  void write_wide_machine() const {
    std::istringstream router(read(PASSO_SOURCE_DIR "/examples/machines/router.toml"));
    static const std::regex travel(R"re(travel_mm = \[[^\]]*\])re");
    std::string text;
    bool is_of_switches = false;
    for (std::string line; std::getline(router, line);) {
      if (line.starts_with("[")) is_of_switches = line.find("hom") != std::string::npos;
      if (!is_of_switches) text += std::regex_replace(line, travel, "travel_mm = [-90000, 90000]") + "\n";
    }
    write("wide.toml", text);
  }
  // What compare_replies.py prints.
  std::string compare(int seed, int lines) const {
    // Its standard input must stay open.
    const std::string script = R"(peers=$1 passo=$2 seed=$3 lines=$4
cd "$5" && mkfifo in && : >said && "$peers/build.sh" "$PWD/grbl_on_uno" || exit 1
exec 9<>in
./grbl_on_uno "$peers/grbl-1.1h-uno.elf" "$PWD/uno" --speed 0 <&9 >/dev/null & uno=$!
"$passo" serve -m wide.toml --grbl-tcp 127.0.0.1:0 >said & daemon=$!
while ! grep -q Ctrl-C said || ! test -e uno; do kill -0 $daemon $uno || exit 1; sleep 0.05; done
sed 's/texts\[:8\]/texts/' "$peers/compare_replies.py" >compare.py  # all differences
python3 compare.py $seed $lines "$PWD/uno" $(sed -n 's/^ *tcp:\(.*\)/\1/p' said) >compared 2>&1; code=$?
kill $daemon $uno; wait; rm -f in uno; exit $code
)";
    write_wide_machine();
    const std::string command = fmt::format("sh {} {} {} {} {} {}", write("compare.sh", script), peers, PASSO_PROGRAM,
                                            seed, lines, dir_.string());
    EXPECT_EQ(std::system(command.c_str()), 0) << read(path("compared"));
    return read(path("compared"));
  }
};

TEST_F(GrblPeer, answers_as_passo_serve_does) {
  if (!std::filesystem::exists(peers)) GTEST_SKIP() << "no ../shared/peers beside the checkout";
  if (std::system("command -v g++ python3 >/dev/null") != 0) GTEST_SKIP() << "needs g++ and python3";
  const bool in_full = passo::test::in_full() != 0;
  for (int seed = 1; seed <= (in_full ? 5 : 1); ++seed) {
    const std::string said = compare(seed, in_full ? 1200 : 150);
    std::istringstream lines(said);
    std::string line;
    std::getline(lines, line);
    int same = 0;
    int all = 0;
    ASSERT_EQ(std::sscanf(line.c_str(), "%d of %d", &same, &all), 2) << said;
    bool has_grbl_no_word = false;  // of the lines that follow
    while (std::getline(lines, line)) {
      if (!line.starts_with(" ")) has_grbl_no_word = line.find("error:20 | ") != std::string::npos;
      const bool is_known = differs_in_tool_or_mist_alone(line) || (has_grbl_no_word && asks_for_mist(line));
      same += is_known && line.starts_with(" ") ? 1 : 0;
    }
    EXPECT_EQ(same, all) << "seed " << seed << "\n" << said;
  }
}

}  // namespace
