// Holds, resumes, overrides, stops and lost lines at random instants of random programs, on machines with every mixture
// of limits: judged from the steps. No axis exceeds a limit, and the machine comes to rest within its braking time and
// 0.1 s.
//
// PASSO_SEED=S PASSO_RUNS=N random_motion_tests --gtest_filter=*Halt* takes the programs S to S + N - 1. Each has some
// eight such instants.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <deque>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "kit/driven.hpp"
#include "kit/job_rows.hpp"
#include "kit/least_rest.hpp"
#include "kit/path_places.hpp"
#include "kit/random_gcode.hpp"
#include "kit/soonest_rest.hpp"
#include "kit/step_judge.hpp"
#include "kit/step_log.hpp"

namespace passo {
namespace {

constexpr double soon = 0.1;  // seconds after the braking time
constexpr int most_instants = 12;
constexpr int most_cuts = 3;
constexpr Seconds most_time{60};
constexpr Seconds cut_for{8};  // longer than any machine brakes

// The law of halts, and the shortest least time for which it is searched, in seconds.
constexpr double most_of_least_rest = 1.2;
constexpr double least_halt = 0.02;

// A halt that was asked for at `asked`, while motion was committed up to `from`.
struct Halt {
  const char* what = "";
  bool is_tail = false;  // the board plays what it holds
  double asked = 0;
  double from = 0;
  double rested = 0;                 // the drive says so: no step came from then on
  std::vector<double> speeds = {};   // of each axis: the highest from `asked` to `from`
  test::LeastRest least = {};        // from `from` to rest
  test::LaidPath::Place place = {};  // at `from`
  double sooner = 0;                 // a rest that the search found, in less time than the law allows; 0: none
};

// How fast the axes were in the motion given last.
class LastSpeeds {
 public:
  explicit LastSpeeds(const MachineDescription& machine) : machine_(machine) {}

  void note(const MotionItem& item) {
    path_.note(item);
    const auto* move = std::get_if<PlannedMove>(&item);
    if (move == nullptr || move->phase_count == 0) return;
    const Point slope = move->segment.curve.tangent(move->to);
    given_.push_back({.time = move->duration().value(), .speeds = {}});
    for (const AxisDescription& axis : machine_.axes) {
      given_.back().speeds.push_back(std::abs(slope[axis.axis]) * move->exit_velocity().value());
    }
    least_rest_ = test::least_rest_after(*move, machine_.axes);
    while (given_.size() > most) given_.pop_front();
  }
  // The least time to rest from the end of that motion.
  test::LeastRest least_rest() const { return least_rest_; }
  const test::LaidPath& path() const { return path_; }
  // The highest of each axis in that time. At least at the end of the motion.
  std::vector<double> in_the_last(double time) const {
    std::vector<double> highest(machine_.axes.size(), 0.0);
    for (auto one = given_.rbegin(); one != given_.rend(); time -= one->time, ++one) {
      if (one != given_.rbegin() && time < 0) break;
      for (std::size_t k = 0; k < highest.size(); ++k) highest[k] = std::max(highest[k], one->speeds[k]);
    }
    return highest;
  }

 private:
  static constexpr std::size_t most = 1000;
  struct Given {
    double time = 0;
    std::vector<double> speeds;  // at its end
  };
  const MachineDescription& machine_;
  std::deque<Given> given_;
  test::LeastRest least_rest_;
  test::LaidPath path_;
};

// What all runs together had.
struct Tally {
  int holds = 0;
  int resumes = 0;
  int overrides = 0;
  int stops = 0;
  int cuts = 0;
  int halts = 0;
  double latest = -1;  // of a rest, in seconds after the braking time
  std::uint64_t latest_number = 0;
  int instants() const { return holds + resumes + overrides + stops + cuts; }
  void print() const {
    std::printf("%d instants: %d holds, %d resumes, %d overrides, %d stops, %d lost lines; %d rests\n", instants(),
                holds, resumes, overrides, stops, cuts, halts);
    std::printf("the latest %.4f s after its braking time (%llu)\n", latest,
                static_cast<unsigned long long>(latest_number));
  }
};

// Searches for a stop that is a fifth earlier, if the least time leaves room for one.
void search_sooner_rest(Halt& halt, const MachineDescription& machine, const test::LaidPath& path) {
  const double took = halt.rested - halt.from;
  if (halt.least.time < least_halt || took <= most_of_least_rest * halt.least.time) return;
  test::SoonestRest search(machine.axes, path.pieces());
  const double found = search.time_from(halt.place, took / most_of_least_rest);
  if (std::isfinite(found)) halt.sooner = found;
}

// Returns what is wrong with the run. A late stop on a bend is wrong if the search finds a much earlier one: where a
// bend uses all of the acceleration, no axis can brake.
std::vector<std::string> faults_of(const MachineDescription& machine, const test::StepLog::Steps& steps,
                                   std::vector<Halt>& halts, const test::PathPlaces& path, const test::LaidPath& laid,
                                   std::uint64_t number, Tally& tally) {
  std::vector<std::string> faults;
  std::vector<test::StepJudge::Tail> tails;
  for (const Halt& halt : halts) {
    if (halt.is_tail) tails.push_back({.from = halt.asked, .to = halt.rested});
  }
  const test::StepJudge judge(machine, steps, std::move(tails));
  if (const auto fault = judge.fault()) faults.push_back(*fault);
  if (const auto fault = path.fault(machine, steps)) faults.push_back(*fault);
  for (Halt& halt : halts) {
    const double rested = judge.last_step_before(halt.rested);
    const double braking = judge.braking(halt.speeds, halt.asked, rested);
    const double late = rested - halt.from - braking;
    ++tally.halts;
    if (late > tally.latest) {
      tally.latest = late;
      tally.latest_number = number;
    }
    const bool is_on_bend = halt.least.time > 0 && !halt.least.is_on_line;
    if (test::prints_rows() || late > soon) search_sooner_rest(halt, machine, laid);
    if (late <= soon || (is_on_bend && halt.sooner == 0)) continue;
    faults.push_back(fmt::format("{} from {:.4f} s on, with a braking time of {:.4f} s, rests at {:.4f} s", halt.what,
                                 halt.from, braking, rested));
  }
  return faults;
}

// Acts at random instants on one run.
class RandomActs {
 public:
  RandomActs(test::DrivenProgram& job, const LastSpeeds& speeds, test::Random& random, Tally& tally)
      : drive_(job.drive()), speeds_(speeds), random_(random), tally_(tally), next_(gap()) {}

  const std::vector<Halt>& halts() const { return halts_; }

  void act() {
    const MotionDrive::State state = drive_.state();
    if (state == MotionDrive::State::held) return go_on_from_rest();
    if (drive_.now() < next_) return;
    next_ = drive_.now() + gap();
    if (drive_.stopped()) return;
    ++instants_;
    if (instants_ > most_instants || drive_.now() > most_time) return stop();
    if (state == MotionDrive::State::holding) return random_.chance(0.2) ? resume() : override_something();
    random_.chance(0.55) ? hold() : override_something();
  }
  void end() {
    if (drive_.stopped() && halting_) rest();
  }

 private:
  Seconds gap() { return Seconds(std::exp(random_.between(-5, 0.5))); }

  void hold() {
    ++tally_.holds;
    begin_halt("hold");
    drive_.hold();
  }
  void stop() {
    ++tally_.stops;
    if (!halting_) begin_halt("stop");
    drive_.stop();
  }
  void resume() {
    ++tally_.resumes;
    halting_ = false;
    drive_.resume();
  }
  void override_something() {
    ++tally_.overrides;
    if (random_.chance(0.25)) return drive_.set_rapid_override(random_.between(0.1, 1));
    if (random_.chance(0.25)) return drive_.set_adaptive_feed(random_.between(0.05, 1));
    drive_.set_feed_override(random_.chance(0.3) ? 1 : random_.between(0.05, 2));
  }
  void go_on_from_rest() {
    if (halting_) rest();
    if (random_.chance(0.3)) test::let_pass(drive_, Seconds(random_.between(0, 0.3)));
    ++tally_.resumes;
    drive_.resume();
    next_ = drive_.now() + gap();
  }
  void begin_halt(const char* what) {
    halting_ = true;
    const double from = (drive_.now() + drive_.committed()).value();
    halts_.push_back({.what = what,
                      .asked = from,
                      .from = from,
                      .speeds = speeds_.in_the_last(0),
                      .least = speeds_.least_rest(),
                      .place = speeds_.path().place()});
  }
  void rest() {
    halting_ = false;
    halts_.back().rested = drive_.now().value();
  }

  MotionDrive& drive_;
  const LastSpeeds& speeds_;
  test::Random& random_;
  Tally& tally_;
  Seconds next_;
  int instants_ = 0;
  bool halting_ = false;
  std::vector<Halt> halts_;
};

struct HaltedRun {
  std::vector<Halt> halts;
  std::vector<std::string> faults;
};

HaltedRun act_at_random(std::uint64_t number, const test::RandomJob& job, test::Random& random, Tally& tally) {
  Diagnostics diagnostics;
  test::DrivenProgram running(ProgramReader::from_text("t", job.program), job.machine, InterpreterOptions(),
                              diagnostics, {.live = live_commitment});
  test::StepLog log;
  test::PathPlaces path;
  running.machine().add_observer(log);
  running.path().watch([&](const PathItem& item) { path.note(item); });
  LastSpeeds speeds(job.machine);
  running.motion().watch([&](const MotionItem& item) { speeds.note(item); });
  RandomActs acts(running, speeds, random, tally);
  while (running.advance()) acts.act();
  acts.end();
  HaltedRun run{.halts = acts.halts(), .faults = {}};
  std::erase_if(run.halts, [](const Halt& halt) { return halt.rested == 0; });  // taken back, or at the program's end
  run.faults = faults_of(job.machine, log.steps, run.halts, path, speeds.path(), number, tally);
  if (diagnostics.any_error()) run.faults.push_back(render(diagnostics, false));
  if (running.link().error()) run.faults.push_back("the link failed");
  return run;
}

// Cuts the line a few times. The board plays what it holds, the end of which is a way to rest, and the job goes on when
// the line is there again.
HaltedRun cut_at_random(std::uint64_t number, test::RandomJob job, test::Random& random, Tally& tally) {
  job.machine.board.held_items = random.chance(0.5) ? 240 : 31;
  Diagnostics diagnostics;
  test::DrivenProgram running(ProgramReader::from_text("t", job.program), job.machine, InterpreterOptions(),
                              diagnostics, {.line = LineOptions{}});
  test::StepLog log;
  test::PathPlaces path;
  running.machine().add_observer(log);
  running.path().watch([&](const PathItem& item) { path.note(item); });
  LastSpeeds speeds(job.machine);
  running.motion().watch([&](const MotionItem& item) { speeds.note(item); });
  std::vector<Halt> halts;
  const auto gap = [&] { return Seconds(std::exp(random.between(-3, 0.5))); };
  Seconds next = running.machine().elapsed() + gap();
  while (running.advance()) {
    const Seconds now = running.machine().elapsed();
    if (now < next || running.drive().stopped()) continue;
    if (halts.size() == most_cuts || now > most_time) {
      running.drive().stop();
      continue;
    }
    running.line().cut(now, cut_for);
    next = now + cut_for + gap();
    const Seconds committed = running.drive().committed();
    halts.push_back({.what = "lost line",
                     .is_tail = true,
                     .asked = now.value(),
                     .from = (now + committed).value(),
                     .rested = (now + cut_for).value(),
                     .speeds = speeds.in_the_last(committed.value())});
    ++tally.cuts;
  }
  HaltedRun run{.halts = std::move(halts), .faults = {}};
  run.faults = faults_of(job.machine, log.steps, run.halts, path, speeds.path(), number, tally);
  if (diagnostics.any_error()) run.faults.push_back(render(diagnostics, false));
  if (running.link().error()) run.faults.push_back("the link failed");
  return run;
}

// Rows of the halts, and of the run.
std::string rows_of(std::uint64_t number, const test::RandomJob& job, const HaltedRun& run, const Tally& tally) {
  std::string rows;
  for (const Halt& halt : run.halts) {
    if (halt.least.time == 0) continue;  // a lost line
    rows += fmt::format("halt\t{}\t{}\t{}\t{:.6f}\t{:.6f}\t{:.6f}\t{}\t{:.6f}\n", number, test::mixture_of(job.machine),
                        halt.what, halt.from, halt.rested - halt.from, halt.least.time,
                        halt.least.is_on_line ? "line" : "bend", halt.sooner);
  }
  return rows + fmt::format("acts\t{}\t{}\t{}\t{}\n", number, test::mixture_of(job.machine), tally.instants(),
                            fmt::join(run.faults, "; "));
}

template <class Act>
void for_each_mixture(int runs, const Act& act) {
  constexpr auto machines = test::Machines::of_any_limits;
  if (test::prints_rows()) {
    const auto rows = [&](std::uint64_t number, const test::RandomJob& job, test::Random& random) {
      Tally tally;
      const HaltedRun run = act(number, job, random, tally);
      return rows_of(number, job, run, tally);
    };
    return test::print_job_rows(machines, rows);
  }
  Tally tally;
  const auto try_one = [&](std::uint64_t number, const test::RandomJob& job, test::Random& random) {
    for (const std::string& fault : act(number, job, random, tally).faults) ADD_FAILURE() << fault;
  };
  test::for_each_job(runs, try_one, machines);
  tally.print();
}

TEST(RandomHalt, keeps_limits_and_rests_soon_on_machines_of_all_mixtures) {
  for_each_mixture(test::fewer(60, 4), act_at_random);
}

TEST(RandomHalt, of_a_lost_line_keeps_limits_and_rests_soon_on_machines_of_all_mixtures) {
  for_each_mixture(test::fewer(30, 4), cut_at_random);
}

// Holds at that time, and goes on after a moment.
void hold_program_at(const MachineDescription& machine, const std::string& program, Seconds at) {
  SCOPED_TRACE("hold at " + std::to_string(at.value()));
  Diagnostics diagnostics;
  test::DrivenProgram running(ProgramReader::from_text("t", program), machine, InterpreterOptions(), diagnostics,
                              {.live = live_commitment});
  test::StepLog log;
  test::PathPlaces path;
  running.machine().add_observer(log);
  running.path().watch([&](const PathItem& item) { path.note(item); });
  LastSpeeds speeds(machine);
  running.motion().watch([&](const MotionItem& item) { speeds.note(item); });
  std::vector<Halt> halts;
  while (running.advance()) {
    MotionDrive& drive = running.drive();
    if (drive.state() == MotionDrive::State::held) {
      halts.back().rested = drive.now().value();
      drive.resume();
    } else if (halts.empty() && drive.now() >= at) {
      const double from = (drive.now() + drive.committed()).value();
      halts.push_back({.what = "hold", .asked = from, .from = from, .rested = 1e9, .speeds = speeds.in_the_last(0)});
      drive.hold();
    }
  }
  EXPECT_FALSE(diagnostics.any_error()) << render(diagnostics, false);
  Tally tally;
  for (const std::string& fault : faults_of(machine, log.steps, halts, path, speeds.path(), 0, tally))
    ADD_FAILURE() << fault;
}

// X turns back with 5 mm of backlash, which takes 0.7 s. A hold meanwhile was obeyed after that.
TEST(Halt, comes_soon_while_backlash_is_taken_up) {
  MachineDescription machine;
  machine.path_tolerance = Mm(0.01);
  AxisDescription axis;
  axis.axis = Axis::x;
  axis.steps_per_unit = 100;
  axis.velocity = MmPerSecond(50);
  axis.acceleration = MmPerSecond2(50);
  axis.jerk = MmPerSecond3(2'000);
  axis.screw = ScrewDescription{.backlash = 5};
  axis.travel_low = -1e5;
  axis.travel_high = 1e5;
  machine.axes.push_back(axis);
  for (double at = 0.05; at < 3; at += 0.15) hold_program_at(machine, "G1 X10 F3000\nX0\nM2\n", Seconds(at));
}

// Programs in which a hold once made an axis jump, or was ignored.
class HaltCase : public testing::Test {
 protected:
  static constexpr const char* folder = PASSO_SOURCE_DIR "/../shared/cases/motion/";
  void SetUp() override {
    if (!std::ifstream(folder + std::string("README.tsv"))) GTEST_SKIP() << "no ../shared/cases beside this checkout";
  }
  static void hold_at(const std::string& name, Seconds at) {
    SCOPED_TRACE(name);
    Diagnostics diagnostics;
    const auto machine = load_machine_file(folder + name + ".toml", diagnostics);
    ASSERT_TRUE(machine) << render(diagnostics, false);
    std::ifstream file(folder + name + ".ngc");
    hold_program_at(*machine, {std::istreambuf_iterator<char>(file), {}}, at);
  }
  // At instants over all of the program.
  static void hold_everywhere(const std::string& name, Seconds whole, int instants) {
    for (int i = 1; i < instants && !HasFailure(); ++i) hold_at(name, whole * (static_cast<double>(i) / instants));
  }
};

TEST_F(HaltCase, hold_jump) {
  hold_at("hold_jump", Seconds(1.9686));
  hold_everywhere("hold_jump", Seconds(3), test::fewer(200, 4));
}
TEST_F(HaltCase, mixjump) {
  hold_at("mixjump", Seconds(0.2301));
  hold_everywhere("mixjump", Seconds(0.5), test::fewer(300, 4));
}
TEST_F(HaltCase, slow_hold) {
  for (const Seconds at : {Seconds(200), Seconds(300), Seconds(340), Seconds(355)}) hold_at("slow_hold", at);
}

}  // namespace
}  // namespace passo
