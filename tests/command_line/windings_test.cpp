// passo windings, as a user starts it.
#include "kit/command_line.hpp"
#include <gmock/gmock.h>

namespace {

using passo::test::Outcome;
using passo::test::read;
using testing::HasSubstr;
using testing::StartsWith;

class WindingsCommand : public passo::test::CommandLine {
 protected:
  Outcome windings(const std::string& arguments) const { return passo("windings " + arguments); }
};

TEST_F(WindingsCommand, prints_the_outputs_the_currents_and_the_rotor_of_each_motor) {
  const Outcome wave = windings("--drive wave --to 2,-1 --time 1");
  EXPECT_EQ(wave.code, 0) << wave.err;
  EXPECT_EQ(wave.out,
            "t,x,x_f1,x_f2,x_f3,x_f4,x_a,x_b,x_deg,y,y_f1,y_f2,y_f3,y_f4,y_a,y_b,y_deg\n"
            "0.000000000,0,1,0,0,0,1,0,0,0,1,0,0,0,1,0,0\n"
            "0.585786438,1,0,1,0,0,0,1,1.8,-1,0,0,0,1,0,-1,-1.8\n"
            "1.000000000,2,0,0,1,0,-1,0,3.6,-1,0,0,0,1,0,-1,-1.8\n");
}

TEST_F(WindingsCommand, counts_the_drivers_steps) {
  const std::string half = windings("--drive half-step --full-steps 48 --to 3 --time 0.3").out;
  EXPECT_THAT(half, HasSubstr("\n0.100000000,1,0,1,0,0,0,1,3.75\n"));
  const std::string micro = windings("--drive microsteps:4 --to 2 --time 0.3").out;
  EXPECT_THAT(micro, HasSubstr("\n0.300000000,2,0,1,0,0,0,1,0.9\n"));
}

TEST_F(WindingsCommand, plays_arcs_and_ramps_that_turn_back) {
  EXPECT_THAT(windings("--drive two-on --from 5,0 --to 0,5 --center 0,0 --method midpoint --time 1").out,
              HasSubstr("1.000000000,-5,"));
  const Outcome back = windings("--drive two-on --move 40 --clock 250000 --accel 50 --reverse-after 4");
  EXPECT_EQ(back.code, 0) << back.err;
  EXPECT_THAT(back.out, HasSubstr(",9,"));
  EXPECT_THAT(back.out, testing::EndsWith(",0,1,1,0,0,1,1,0\n"));
}

TEST_F(WindingsCommand, writes_traces_and_a_picture) {
  const Outcome all = windings("--drive half-step --to 10,4 --time 0.1 --trace " + path("w.vcd") + " --trace " +
                               path("w.csv") + " --picture " + path("w.png"));
  EXPECT_EQ(all.code, 0) << all.err;
  EXPECT_EQ(all.out, "");
  EXPECT_THAT(read(path("w.vcd")), HasSubstr("$var real 64 !& x_A $end"));
  EXPECT_THAT(read(path("w.csv")), StartsWith("t,x,x_f1"));
  EXPECT_THAT(read(path("w.png")), StartsWith("\x89PNG"));
}

TEST_F(WindingsCommand, draws_currents_that_rise_where_the_motor_and_its_supply_are_known) {
  const std::string motor = "--drive wave --to 2 --time 0.02 --current 1 --resistance 12.8 --inductance 10 --drop 1";
  // A time constant is 0.78125 ms; a row an eighth of that later, F2 has 1 − e^(−1/8) = 0.1175 of its current.
  const std::string plain = windings(motor + " --supply 13.8").out;
  EXPECT_THAT(plain, HasSubstr("\n0.010000000,1,0,1,0,0,1,0,1.8\n0.010097656,1,0,1,0,0,"));
  EXPECT_THAT(plain, HasSubstr(",0.117503,1.8\n"));
  // With twice the voltage and as large a resistor the same in half the time.
  EXPECT_THAT(windings(motor + " --supply 26.6 --series 12.8").out, HasSubstr(",0.117503,1.8\n"));
  EXPECT_THAT(windings(motor + " --supply 36 --chopper").out, HasSubstr("\n0.010355669,1,0,1,0,0,0.614286,1,1.8\n"));
  const Outcome machine = windings("--drive wave --to 2 --time 0.02 --axis X -m " +
                                   (passo::test::examples / "machines/strong-router.toml").string());
  EXPECT_EQ(machine.code, 0) << machine.err;
  EXPECT_GT(machine.out.size(), windings("--drive wave --to 2 --time 0.02").out.size());
}

TEST_F(WindingsCommand, what_is_wrong_is_said_and_exits_with_2) {
  const auto wrong = [&](const std::string& arguments) {
    const Outcome outcome = windings(arguments);
    EXPECT_EQ(outcome.code, 2) << arguments;
    EXPECT_EQ(outcome.out, "") << arguments;
    return outcome.err;
  };
  EXPECT_THAT(wrong("--drive full --to 3,3 --time 1"), HasSubstr("--drive: expected two-on, wave, half-step"));
  EXPECT_THAT(wrong("--drive wave"), HasSubstr("--to X,Y..."));
  EXPECT_THAT(wrong("--drive wave --to 3,3"), HasSubstr("--time SECONDS"));
  EXPECT_THAT(wrong("--drive wave --to 3,3 --time 1 --method wu"), HasSubstr("not one of"));
  EXPECT_THAT(wrong("--drive wave --move 30"), HasSubstr("--clock, --accel"));
  EXPECT_THAT(wrong("--drive wave --to 3 --time 1 --trace " + path("w.txt")), HasSubstr(".vcd or .csv"));
  EXPECT_THAT(wrong("--drive wave --to 3 --time 1 --picture " + path("w.txt")), HasSubstr(".svg or .png"));
  EXPECT_THAT(wrong("--drive wave --to 3000 --time 1 --picture " + path("w.svg")), HasSubstr("too many"));
  EXPECT_THAT(wrong("--drive wave --to 3 --time 1 --series 5 --supply 24"),
              HasSubstr("expected also --current, --resistance, --inductance"));
  EXPECT_THAT(wrong("--drive wave --to 3 --time 1 --current 1 --resistance 0 --inductance 1 --supply 24"),
              HasSubstr("the resistance must be above 0"));
  EXPECT_THAT(wrong("--drive wave --to 3 --time 1 --axis X"), HasSubstr("--axis is an axis of a --machine"));
  EXPECT_TRUE(files().empty());
}

}  // namespace
