// passo ramp, as a user starts it.
#include <algorithm>
#include <cctype>
#include <cstdio>
#include <sstream>

#include "kit/command_line.hpp"
#include "kit/ramp_sequences.hpp"
#include <nlohmann/json.hpp>

namespace {

namespace fs = std::filesystem;
using passo::test::Outcome;

class RampCommand : public passo::test::CommandLine {
 protected:
  Outcome ramp(const std::string& arguments) const { return passo("ramp " + arguments); }
  std::string read(const std::string& name) const { return passo::test::read(path(name)); }
};

const std::string motor = "--clock 250000 --steps-per-rev 400 --accel 50 ";

struct RampRow {
  double c = 0;
  double end = 0;
};
std::vector<RampRow> rows_of(const std::string& csv) {
  std::istringstream lines(csv);
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "n,c,t_end");
  std::vector<RampRow> rows;
  while (std::getline(lines, line)) {
    std::size_t n = 0;
    RampRow row;
    EXPECT_EQ(std::sscanf(line.c_str(), "%zu,%lf,%lf", &n, &row.c, &row.end), 3) << line;
    EXPECT_EQ(n, rows.size());
    rows.push_back(row);
  }
  return rows;
}

TEST_F(RampCommand, prints_the_published_sequences) {
  const auto sequences = passo::test::ramp_sequences();
  if (sequences.empty()) GTEST_SKIP() << "../shared/golden is not here";
  for (const auto& sequence : sequences) {
    std::ostringstream of_motor;
    of_motor.precision(15);
    of_motor << "--clock " << sequence.clock << " --steps-per-rev " << sequence.steps_per_turn << " --accel "
             << sequence.acceleration << " --steps " << sequence.exact.size();
    const std::vector<RampRow> exact = rows_of(ramp("--method exact " + of_motor.str()).out);
    const std::vector<RampRow> recursive = rows_of(ramp("--method recursive " + of_motor.str()).out);
    ASSERT_EQ(exact.size(), sequence.exact.size());
    ASSERT_EQ(recursive.size(), sequence.exact.size());
    for (std::size_t n = 0; n < exact.size(); ++n) {
      ASSERT_NEAR(exact[n].c / sequence.exact[n], 1, 1e-12);
      ASSERT_NEAR(exact[n].end / sequence.ends[n], 1, 1e-12);
      ASSERT_NEAR(recursive[n].c / sequence.recursive[n], 1, 1e-12);
    }
    const Outcome table = ramp("--method table " + of_motor.str());
    ASSERT_EQ(table.code, sequence.table.empty() ? 2 : 0);
    if (sequence.table.empty()) continue;
    const std::vector<RampRow> rows = rows_of(table.out);
    ASSERT_EQ(rows.size(), sequence.table.size());
    for (std::size_t n = 0; n < rows.size(); ++n) ASSERT_EQ(rows[n].c, sequence.table[n]);
  }
}

TEST_F(RampCommand, prints_fifteen_digits_and_whole_ticks_of_a_table) {
  EXPECT_EQ(ramp("--method exact " + motor + "--steps 2").out,
            "n,c,t_end\n0,6266.57068657750,6266.57068657750\n1,2595.69856795008,8862.26925452758\n");
  EXPECT_EQ(ramp("--method table " + motor + "--steps 2").out, "n,c,t_end\n0,6266,6266\n1,2595,8861\n");
}

TEST_F(RampCommand, a_first_interval_beyond_16_bits_is_an_error_with_words) {
  const Outcome outcome = ramp("--method table --clock 1e6 --steps-per-rev 200 --accel 10 --steps 5");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_EQ(outcome.out, "");
  for (const char* word : {"K_b", "79266.5", "65535", "826780", "--method exact"}) {
    EXPECT_NE(outcome.err.find(word), std::string::npos) << word << ": " << outcome.err;
  }
}

TEST_F(RampCommand, a_move_has_exactly_the_steps_asked_for_and_is_its_own_mirror) {
  for (const char* method : {"exact", "table", "recursive", "exact --jerk 2000", "exact --start-rate 300"}) {
    const Outcome outcome = ramp(std::string("--method ") + method + " " + motor + "--max-rate 900 --move 777");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const std::vector<RampRow> rows = rows_of(outcome.out);
    ASSERT_EQ(rows.size(), 777U);
    for (std::size_t n = 0; n < rows.size(); ++n) {
      ASSERT_NEAR(rows[n].c / rows[776 - n].c, 1, 1e-6) << method << " " << n;
      ASSERT_GE(rows[n].c, 250'000 / 900.0 * (1 - 1e-9));
    }
  }
}

TEST_F(RampCommand, a_stop_ends_in_fewer_steps_at_rest) {
  const Outcome outcome = ramp("--method table " + motor + "--move 1000 --stop-after 4");
  const std::vector<RampRow> rows = rows_of(outcome.out);
  ASSERT_EQ(rows.size(), 9U);
  EXPECT_EQ(rows.back().c, 6266);
}

TEST_F(RampCommand, limit_answers_both_ways) {
  const Outcome text = ramp("--limit --table-size 256 --steps-per-rev 100 --max-rate 280");
  EXPECT_EQ(text.code, 0);
  EXPECT_NE(text.out.find("at least 9.62113 rad"), std::string::npos) << text.out;
  const auto exact =
      nlohmann::json::parse(ramp("--limit --table-size 256 --steps-per-rev 100 --max-rate 280 --json").out);
  EXPECT_NEAR(exact["least_acceleration_rad_s2"].get<double>() / 9.6211275016187, 1, 1e-12);
  const Outcome json = ramp("--limit --table-size 512 --steps-per-rev 200 --max-rate 400 --accel 10 --json");
  const auto answer = nlohmann::json::parse(json.out);
  EXPECT_NEAR(answer["least_acceleration_rad_s2"].get<double>() / 4.90873852123405, 1, 1e-12);
  EXPECT_NEAR(answer["reached_rate_hz"].get<double>(), 570.9197, 0.0001);
  // Without a size, both usual tables.
  EXPECT_NE(ramp("--limit --steps-per-rev 100 --max-rate 280").out.find("table of 512 entries"), std::string::npos);
  EXPECT_EQ(ramp("--limit --max-rate 280").code, 2);
}

TEST_F(RampCommand, limit_is_drawn_and_written_for_all_usual_motors) {
  const Outcome both = ramp("--limit --max-rate 280 --accel 20 --picture " + path("l.svg") + " -o " + path("l.csv"));
  EXPECT_EQ(both.code, 0) << both.err;
  EXPECT_EQ(both.out, "");
  EXPECT_NE(read("l.svg").find("</svg>"), std::string::npos);
  const std::string table = read("l.csv");
  EXPECT_EQ(table.find(
                "steps_per_rev,table_size,max_rate_hz,least_acceleration_rad_s2,acceleration_rad_s2,reached_rate_hz\n"),
            0U);
  EXPECT_NE(table.find("\n100,256,280,9.621127501"), std::string::npos) << table;
  EXPECT_NE(table.find("\n400,512,280,"), std::string::npos);
  EXPECT_EQ(ramp("--limit --max-rate 280 --picture " + path("l.jpg")).code, 2);
}

TEST_F(RampCommand, prints_its_table_for_a_chip_in_three_forms) {
  const std::string csv = ramp("--print-table 512 --format csv " + motor).out;
  EXPECT_EQ(csv.find("n,factor,k,c\n0,65535,1,6266\n1,27145,0.4141998291,2595\n2,20829,"), 0U) << csv.substr(0, 90);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 513);
  const std::string c = ramp("--print-table 256 --max-rate 1500 " + motor).out;
  EXPECT_NE(c.find("#define RAMP_SIZE 256u\n#define RAMP_FIRST_INTERVAL 6266u\n"), std::string::npos) << c;
  EXPECT_NE(c.find("const uint16_t ramp_factors[RAMP_SIZE] = {\n    65535, 27145, 20829,"), std::string::npos);
  EXPECT_NE(c.find("at least 69.02"), std::string::npos) << c.substr(0, 800);
  const std::string assembly = ramp("--print-table 256 --format asm").out;
  EXPECT_NE(assembly.find("ramp_factors:\n    .2byte 65535, 27145,"), std::string::npos);
  EXPECT_EQ(assembly.find("RAMP_FIRST_INTERVAL"), std::string::npos);
  // Each form has the same numbers.
  const auto factors = [](const std::string& text, const std::string& begin) {
    std::vector<int> found;
    std::istringstream rest(text.substr(text.find(begin) + begin.size()));
    for (char sign = 0; rest.get(sign);) {
      if (std::isdigit(static_cast<unsigned char>(sign)) == 0 || found.size() == 256) continue;
      rest.unget();
      found.push_back(0);
      rest >> found.back();
    }
    return found;
  };
  std::string plain = assembly;
  for (std::size_t at = 0; (at = plain.find(".2byte", at)) != std::string::npos;) plain.replace(at, 6, "");
  EXPECT_EQ(factors(c, "= {"), factors(plain, "ramp_factors:"));
  EXPECT_EQ(factors(c, "= {").size(), 256U);
}

TEST_F(RampCommand, a_reversal_is_in_the_csv_with_its_places) {
  const Outcome outcome = ramp("--method table " + motor + "--move 1000 --reverse-after 4");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out.find("n,c,t_end,place\n0,6266,6266,1\n"), 0U);
  EXPECT_NE(outcome.out.find("\n8,6266,26539,9\n9,6266,32805,8\n"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("\n17,6266,53078,0\n"), std::string::npos) << outcome.out;
  EXPECT_EQ(
      ramp("--method exact " + motor + "--move 1000 --jerk 900 --reverse-after 300 --picture " + path("r.svg")).code,
      0);
}

TEST_F(RampCommand, the_midpoint_recursion_prints_the_exact_sequence) {
  const std::vector<RampRow> rows = rows_of(ramp("--method midpoint " + motor + "--steps 3").out);
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_NEAR(rows[1].c, 2595.70, 0.005);
  EXPECT_NEAR(rows[2].c, 1991.75, 0.005);
  EXPECT_EQ(ramp("--method midpoint " + motor + "--steps 30 --picture " + path("m.svg")).code, 0);
}

TEST_F(RampCommand, writes_pictures_and_files_and_nothing_where_it_fails) {
  EXPECT_EQ(ramp(motor + "--steps 24 --picture " + path("a.svg")).code, 0);
  EXPECT_NE(read("a.svg").find("</svg>"), std::string::npos);
  EXPECT_EQ(read("out"), "");
  EXPECT_EQ(ramp(motor + "--method exact --jerk 900 --move 400 --picture " + path("b.png")).code, 0);
  EXPECT_EQ(read("b.png").substr(1, 3), "PNG");
  EXPECT_EQ(ramp("--method exact " + motor + "--steps 3 -o " + path("c.csv")).code, 0);
  EXPECT_EQ(rows_of(read("c.csv")).size(), 3U);
  EXPECT_EQ(ramp(motor + "--steps 24 --picture " + path("a.jpg")).code, 2);
  EXPECT_EQ(ramp("--method table --clock 1e9 --steps-per-rev 400 --accel 50 --steps 3 -o " + path("d.csv")).code, 2);
  EXPECT_FALSE(fs::exists(path("d.csv")));
}

TEST_F(RampCommand, bad_options_are_told_with_what_was_expected) {
  const auto refused = [&](const std::string& arguments, const std::string& words) {
    const Outcome outcome = ramp(arguments);
    EXPECT_EQ(outcome.code, 2) << arguments;
    EXPECT_NE(outcome.err.find(words), std::string::npos) << arguments << ": " << outcome.err;
  };
  refused("", "--method");
  refused("--method exact --clock 1000", "--accel RAD_S2, --steps-per-rev N");
  refused("--method exact --clock 0 --steps-per-rev 200 --accel 1", "--clock 0: expected more than 0");
  refused("--method exact --clock nan --steps-per-rev 200 --accel 1", "--clock nan");
  refused("--method exact --clock 1e6 --steps-per-rev 0 --accel 1", "--steps-per-rev 0");
  refused("--method exact " + motor + "--steps 0", "--steps 0: expected 1 to 536870912");
  refused("--method exact " + motor + "--steps 5 --move 5", "expected either --steps (a ramp) or --move");
  refused("--method table " + motor + "--steps 5 --table-size 65536", "--table-size 65536: expected 1 to 65535");
  refused("--method table " + motor + "--move 5 --jerk 7", "--method exact");
  refused("--method exact " + motor + "--steps 5 --start-rate 3", "start rate");
  refused("--method exact " + motor + "--steps 5 --stop-after 3", "--stop-after is for a --move");
  refused("--method exact " + motor + "--steps 5 --reverse-after 3", "--reverse-after is for a --move");
  refused("--method exact " + motor + "--move 9 --stop-after 3 --reverse-after 3", "cannot be combined");
  refused("--print-table 0", "--print-table 0: expected 1 to 65535");
  refused("--print-table 256 --clock 1e9 --steps-per-rev 400 --accel 50", "16 bits");
  refused("--method exact " + motor + "--steps 5 --format c", "--format is for --print-table");
  refused("--method magic " + motor, "magic");
}

}  // namespace
