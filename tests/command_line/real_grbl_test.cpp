// --board grbl: on firmware of other people, as processes of their own: Grbl 1.1h on an emulated Uno, and grblHAL's
// simulator. Both are in ../shared/peers/grbl. Times are not judged: the simulators share the computer.
#include <filesystem>
#include <string>

#include "kit/command_line.hpp"
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace {

using testing::HasSubstr;

const std::string peers = PASSO_SOURCE_DIR "/../shared/peers/grbl";

class RealGrbl : public passo::test::CommandLine {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(peers)) GTEST_SKIP() << "no ../shared/peers/grbl beside the checkout";
  }
  // Plays a script of bash in the test's folder.
  passo::test::Outcome bash(const std::string& script) const {
    const std::string all = "P=" + peers +
                            "; passo() { " PASSO_PROGRAM " \"$@\"; }\nMACHINE=" PASSO_SOURCE_DIR
                            "/examples/machines/router.toml\n" +
                            script;
    const std::string command =
        "cd " + path("") + " && timeout 120 bash " + write("script", all) + " >" + path("out") + " 2>" + path("err");
    const int status = std::system(command.c_str());
    return {.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1,
            .out = passo::test::read(path("out")),
            .err = passo::test::read(path("err"))};
  }
};

// Grbl's check mode parses each line as in a run, and moves nothing.
TEST_F(RealGrbl, on_an_emulated_uno_takes_each_line_that_is_written_for_it) {
  const auto outcome = bash(R"(
$P/build.sh "$PWD/uno" || exit 77
E=$(dirname $(dirname $MACHINE))
passo cam drill $E/boards/timer.drl --tools 0.8,1.0 --mill 1 --peck 0.5 --for grbl -o 1.nc >/dev/null || exit
passo cam outline $E/boards/timer-Edge_Cuts.gbr --for grbl --units inch --tool 2mm --step 0.5mm -o 2.nc >/dev/null || exit
passo cam pocket $E/parts/bracket.svg --layer pocket --tool 3 --depth -3 --step 1.5 --for grbl -o 3.nc >/dev/null || exit
passo cam engrave --text 'Ah! Why?' --font simplex --for grbl -o 4.nc >/dev/null || exit
passo cam plot $E/parts/bracket.svg --servo 300 --knife 0.5 --for grbl -o 5.nc >/dev/null || exit
passo cam wire $E/foam/naca2412.dat --chord 100 --axes XY --for grbl -o 6.nc >/dev/null || exit
passo cam relief $E/reliefs/flower.png --width 6 --depth -2 --pitch 0.5 --for grbl -o 7.nc >/dev/null || exit
passo cam laser $E/laser/key-tag.svg --score-color blue --kerf 0.2 --focus 5 --passes 2 --step 1 --for grbl -o 8.nc >/dev/null || exit
passo cam laser $E/laser/ball.png --width 4 --line-distance 0.2 --air flood --for grbl -o 9.nc >/dev/null || exit
mkfifo commands
./uno $P/grbl-1.1h-uno.elf "$PWD/tty" --speed 0 <commands >/dev/null &
trap "kill $!" EXIT
exec 3>commands
until [ -e tty ]; do sleep 0.05; done
exec 4<>tty
until read -t 20 -u 4 answer && [[ $answer = Grbl* ]]; do :; done
while read -t 1 -u 4 answer; do :; done
{ echo '$32=1'; echo '$C'; cat ?.nc; } >all.nc
while IFS= read -r line; do
  printf '%s\n' "$line" >&4
  until read -t 20 -u 4 answer && [[ $answer = ok* || $answer = error* ]]; do :; done
  [[ $answer = ok* ]] || echo "$line: $answer"
done <all.nc
wc -l <all.nc >&2
)");
  if (outcome.code == 77) GTEST_SKIP() << "grbl_on_uno does not build here: libsimavr is missing";
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_GT(std::stoi(outcome.err), 300) << outcome.err;
}

// The switches of X and Y close 2 mm from where the machine starts, that of Z 1 mm. After homing the machine stands a
// millimetre off them, at -1, and the program makes 3 mm and 2.5 mm of it at 250 steps/mm.
TEST_F(RealGrbl, on_an_emulated_uno_homes_and_makes_each_step) {
  write("p.ngc", "G21 G90 G94\nG53 G0 X-4 Y-3.5\nM2\n");
  const auto outcome = bash(R"(
$P/build.sh "$PWD/uno" || exit 77
mkfifo commands
./uno $P/grbl-1.1h-uno.elf "$PWD/tty" --speed 0 --switch-at X:500 --switch-at Y:500 --switch-at Z:250 <commands >counts &
trap "kill $!" EXIT
exec 3>commands
until [ -e tty ]; do sleep 0.05; done
exec 4<>tty
until read -t 20 -u 4 answer && [[ $answer = Grbl* ]]; do :; done
for setting in '$22=1' '$24=100' '$25=500' '$110=600' '$111=600' '$112=600' '$120=100' '$121=100' '$122=100'; do
  echo "$setting" >&4
  until read -t 5 -u 4 answer && [[ $answer = ok* || $answer = error* ]]; do :; done
done
exec 4>&-
passo home -m $MACHINE --board "grbl:$PWD/tty" --json >home.json || exit
echo counts >&3
passo run p.ngc -m $MACHINE --board "grbl:$PWD/tty" --json >run.json || exit
echo counts >&3
sleep 0.2
grep steps counts
)");
  if (outcome.code == 77) GTEST_SKIP() << "grbl_on_uno does not build here: libsimavr is missing";
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto home = nlohmann::json::parse(passo::test::read(path("home.json")));
  EXPECT_EQ(home["position_mm"], (nlohmann::json{{"X", -1.0}, {"Y", -1.0}, {"Z", -1.0}}));
  const auto run = nlohmann::json::parse(passo::test::read(path("run.json")));
  EXPECT_EQ(run["grbl"]["firmware"], "Grbl");
  EXPECT_EQ(run["grbl"]["receive_buffer"], 128);
  EXPECT_EQ(run["position_mm"], (nlohmann::json{{"X", -4.0}, {"Y", -3.5}, {"Z", -1.0}}));
  long before[3];
  long after[3];
  const std::string& counts = outcome.out;
  const std::size_t second = counts.find('\n') + 1;
  ASSERT_EQ(std::sscanf(counts.c_str() + counts.find("steps"), "steps %ld %ld %ld", before, before + 1, before + 2), 3);
  ASSERT_EQ(
      std::sscanf(counts.c_str() + counts.find("steps", second), "steps %ld %ld %ld", after, after + 1, after + 2), 3);
  EXPECT_EQ(after[0] - before[0], -750);
  EXPECT_EQ(after[1] - before[1], -625);
  EXPECT_EQ(after[2] - before[2], 0);
}

// One value out of the range that Passo knows, one that Grbl itself rejects.
TEST_F(RealGrbl, on_an_emulated_uno_has_its_settings_written_compared_and_restored) {
  const auto outcome = bash(R"(
$P/build.sh "$PWD/uno" || exit 77
mkfifo commands
./uno $P/grbl-1.1h-uno.elf "$PWD/tty" --speed 0 <commands >/dev/null &
trap "kill $!" EXIT
exec 3>commands
until [ -e tty ]; do sleep 0.05; done
L="grbl:$PWD/tty"
passo board settings $L --save kept.txt || exit
passo board settings $L --set 110=600 --set 0=2 --set 20=1 --json >set.json && exit 1
passo board settings $L --compare kept.txt
passo board settings $L --restore kept.txt
passo machine --from $L -o mine.toml 2>/dev/null && passo machine mine.toml >/dev/null && echo read
)");
  if (outcome.code == 77) GTEST_SKIP() << "grbl_on_uno does not build here: libsimavr is missing";
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "$110: 500.000 in the file, 600.000 on the board\n$110: 600.000 -> 500.000\nread\n");
  const auto changes = nlohmann::json::parse(passo::test::read(path("set.json")))["changes"];
  EXPECT_EQ(changes[1]["trouble"], "$0=2: $0 (Step pulse) is 3 to 255 us");
  EXPECT_EQ(changes[2]["trouble"], "the board rejects $20=1: error:10, soft limits need homing");
}

// It has no switches: homing ends in an alarm, which the next command tells, and `$X` would end.
TEST_F(RealGrbl, grblhal_runs_programs_and_tells_that_it_has_no_switches) {
  write("p.ngc", "G21 G90 G94\nM3 S500\nG1 X2 Y1 F400\nG2 X3 Y2 I1 J0\nM5\nM2\n");
  const auto outcome = bash(R"(
start() { $P/grblHAL_sim -n -p $1 -t 1 -e eeprom$1 -s steps$1 -b blocks -r 0.01 >/dev/null 2>&1 </dev/null & trap "kill -9 $!" EXIT; }
for port in $((20000 + $$ % 10000)) $((30000 + $$ % 10000)); do
  start $port
  for i in {1..40}; do (exec 3<>/dev/tcp/127.0.0.1/$port) 2>/dev/null && break 2; sleep 0.05; done
done
L=grbl:tcp:127.0.0.1:$port
passo run p.ngc -m $MACHINE --board $L --json >run.json || exit
# Reports with as little in them as can be: without MPos and WCO.
tell() { exec 4<>/dev/tcp/127.0.0.1/$port; for line in "$@"; do echo "$line" >&4; until read -t 5 -u 4 answer && [[ $answer = ok* || $answer = error* ]]; do :; done; done; exec 4>&-; }
tell '$10=0' 'G10L2P1X1'
passo board settings $L 398 --set 398=5 --set 65=1 --json >settings.json && exit 1
passo run p.ngc -m $MACHINE --board $L --json >again.json || exit
grep -c ' 750, 500, 0,' steps$port
tell '$22=1' '$25=3000' '$110=6000' '$111=6000' '$112=6000' '$120=500' '$121=500' '$122=500' '$130=5' '$131=5' '$132=5'
passo home -m $MACHINE --board $L 2>home.err && exit 1
passo run p.ngc -m $MACHINE --board $L 2>run.err && exit 1
exit 0
)");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto run = nlohmann::json::parse(passo::test::read(path("run.json")));
  EXPECT_EQ(run["grbl"]["firmware"], "grblHAL");
  EXPECT_EQ(run["grbl"]["receive_buffer"], 1023);
  EXPECT_EQ(run["position_mm"], (nlohmann::json{{"X", 3.0}, {"Y", 2.0}, {"Z", 0.0}}));
  const auto again = nlohmann::json::parse(passo::test::read(path("again.json")));
  EXPECT_EQ(again["grbl"]["receive_buffer"], 1023);
  EXPECT_GT(std::stoi(outcome.out), 0) << "250 steps/mm";
  EXPECT_EQ(again["position_mm"], (nlohmann::json{{"X", 4.0}, {"Y", 2.0}, {"Z", 0.0}}));
  const auto settings = nlohmann::json::parse(passo::test::read(path("settings.json")));
  EXPECT_EQ(settings["settings"][0]["most"], 1000.0) << "as the board describes it";
  EXPECT_EQ(settings["settings"][0]["group"], "General");
  EXPECT_THAT(settings["changes"][0]["trouble"], HasSubstr("is 30 to 1000"));
  EXPECT_EQ(settings["changes"][1]["value"], "1");
  EXPECT_THAT(passo::test::read(path("home.err")), HasSubstr("ALARM:9, homing found no switch"));
  EXPECT_THAT(passo::test::read(path("run.err")), HasSubstr("[grbl.locked]"));
}

}  // namespace
