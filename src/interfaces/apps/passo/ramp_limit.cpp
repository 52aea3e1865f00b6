#include "ramp_limit.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>

#include "picture_names.hpp"
#include "program_input.hpp"
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "passo/base/counted.hpp"
#include "passo/base/sensible_number.hpp"
#include "passo/interpolate/ramp_table.hpp"
#include "passo/ramp/ramp_sequence.hpp"
#include "passo/report/output_file.hpp"
#include "passo/report/ramp_limit_picture.hpp"

namespace passo {
namespace {

constexpr std::int32_t usual_sizes[] = {256, 512};
constexpr std::int32_t usual_motors[] = {24, 48, 96, 100, 180, 200, 400};  // steps a revolution
constexpr double usual_accelerations[] = {5, 10, 20, 50, 100};             // rad/s²

std::vector<std::int32_t> sizes_of(const RampArguments& arguments) {
  if (arguments.table_size) return {*arguments.table_size};
  return {std::begin(usual_sizes), std::end(usual_sizes)};
}

int write(const std::string& text, const std::string& path) {
  auto file = OutputFile::open(path.empty() ? "-" : path);
  if (!file) return fail(exit_failed, file.error().message);
  file->write(text);
  const Status<OutputError> written = file->commit();
  return written ? exit_done : fail(exit_failed, written.error().message);
}

// --- limits ---------------------------------------------------------------------------------------------------------

nlohmann::ordered_json limit_json(const RampArguments& arguments, std::int32_t size) {
  nlohmann::ordered_json json;
  json["table_size"] = size;
  json["steps_per_rev"] = *arguments.steps_per_turn;
  if (arguments.max_rate) {
    json["max_rate_hz"] = *arguments.max_rate;
    json["least_acceleration_rad_s2"] =
        least_acceleration(Hertz(*arguments.max_rate), size, *arguments.steps_per_turn).value;
  }
  if (arguments.acceleration) {
    json["acceleration_rad_s2"] = *arguments.acceleration;
    json["reached_rate_hz"] = reached_rate({*arguments.acceleration}, size, *arguments.steps_per_turn).value();
  }
  return json;
}

std::string limit_words(const RampArguments& arguments, std::int32_t size) {
  const std::int32_t steps = *arguments.steps_per_turn;
  std::string text = fmt::format("A table of {}, a motor with {} per revolution:\n",
                                 counted(static_cast<std::uint32_t>(size), "entry", "entries"), counted(steps, "step"));
  if (arguments.max_rate) {
    const double least = least_acceleration(Hertz(*arguments.max_rate), size, steps).value;
    text += fmt::format("  {} Hz needs an acceleration of at least {} rad/s\u00B2\n",
                        sensible_number(*arguments.max_rate), sensible_number(least));
  }
  if (arguments.acceleration) {
    const double reached = reached_rate({*arguments.acceleration}, size, steps).value();
    text += fmt::format("  {} rad/s\u00B2 reaches {} Hz, and then continues at that rate\n",
                        sensible_number(*arguments.acceleration), sensible_number(reached));
  }
  return text;
}

// A row for each usual motor, or for the one that was named, and for each size of the table.
std::string limit_table(const RampArguments& arguments) {
  std::vector<std::int32_t> motors(std::begin(usual_motors), std::end(usual_motors));
  if (arguments.steps_per_turn) motors = {*arguments.steps_per_turn};
  std::string text = "steps_per_rev,table_size";
  if (arguments.max_rate) text += ",max_rate_hz,least_acceleration_rad_s2";
  if (arguments.acceleration) text += ",acceleration_rad_s2,reached_rate_hz";
  text += "\n";
  for (const std::int32_t steps : motors) {
    for (const std::int32_t size : sizes_of(arguments)) {
      text += fmt::format("{},{}", steps, size);
      if (arguments.max_rate) {
        text += fmt::format(",{:.15g},{:.15g}", *arguments.max_rate,
                            least_acceleration(Hertz(*arguments.max_rate), size, steps).value);
      }
      if (arguments.acceleration) {
        text += fmt::format(",{:.15g},{:.15g}", *arguments.acceleration,
                            reached_rate({*arguments.acceleration}, size, steps).value());
      }
      text += "\n";
    }
  }
  return text;
}

int draw_limits(const RampArguments& arguments) {
  if (const std::string why = refuse_picture(arguments.picture); !why.empty()) return fail(exit_bad_program, why);
  RampLimitScene scene{.table_sizes = sizes_of(arguments), .rate = {}, .accelerations = {}};
  if (arguments.max_rate) scene.rate = Hertz(*arguments.max_rate);
  for (const double usual : usual_accelerations) {
    // Around the acceleration that was named: a quarter of it to four times as much.
    const double scale = arguments.acceleration ? *arguments.acceleration / 20 : 1;
    scene.accelerations.push_back({usual * scale});
  }
  if (arguments.steps_per_turn) {
    scene.most_steps_per_turn = std::max(scene.most_steps_per_turn, *arguments.steps_per_turn);
    scene.least_steps_per_turn = std::min(scene.least_steps_per_turn, *arguments.steps_per_turn);
  }
  auto file = OutputFile::open(arguments.picture);
  if (!file) return fail(exit_failed, file.error().message);
  const PictureOptions options{
      .format = *picture_format_of(arguments.picture),
      .program = "Limits of a ramp table",
      .machine =
          "a table of N entries ends at f = \u221A(a N pg / \u03C0):  a_lim = \u03C0 f\u00B2 / (N pg), pg steps/rev"};
  Status<OutputError> done = draw_ramp_limits(scene, options, *file);
  if (done) done = file->commit();
  return done ? exit_done : fail(exit_failed, done.error().message);
}

// --- the table itself -----------------------------------------------------------------------------------------------

struct PrintedTable {
  std::vector<std::uint16_t> factors;
  std::optional<std::uint32_t> first_interval;  // K_b, cut off; empty: the motor was not named
  std::vector<std::string> remarks;             // on the motor, and on what the table can do
};

std::vector<std::string> remarks_of(const RampArguments& arguments, std::int32_t size) {
  std::vector<std::string> remarks = {
      fmt::format("A ramp of constant acceleration: k_n = sqrt(n+1) - sqrt(n) in 0.16, cut off, n = 0 ... {}.",
                  size - 1),
      "Step n takes c_n = (K_b * k_n) >> 16 ticks, and c_0 = K_b. k_0 = 1 does not fit into 16 bits, so do not read "
      "it.",
      "At the end of the table, the motor continues at its present rate."};
  if (!arguments.steps_per_turn) return remarks;
  const std::int32_t steps = *arguments.steps_per_turn;
  if (arguments.clock && arguments.acceleration) {
    const RampSetup setup{
        .clock = Hertz(*arguments.clock), .steps_per_turn = steps, .acceleration = {*arguments.acceleration}};
    remarks.push_back(fmt::format("K_b = f sqrt(2 alpha / a) = {} ticks: f = {} Hz, {} steps/rev, a = {} rad/s2.",
                                  sensible_number(first_interval(setup)), sensible_number(*arguments.clock), steps,
                                  sensible_number(*arguments.acceleration)));
  }
  if (arguments.acceleration) {
    remarks.push_back(fmt::format("With {} rad/s2, the table ends at {} steps/s.",
                                  sensible_number(*arguments.acceleration),
                                  sensible_number(reached_rate({*arguments.acceleration}, size, steps).value())));
  }
  if (arguments.max_rate) {
    remarks.push_back(fmt::format("{} steps/s need at least {} rad/s2.", sensible_number(*arguments.max_rate),
                                  sensible_number(least_acceleration(Hertz(*arguments.max_rate), size, steps).value)));
  }
  return remarks;
}

std::string numbers(const std::vector<std::uint16_t>& factors, const char* line_begin, const char* line_end) {
  constexpr std::size_t in_a_line = 12;
  std::string text;
  for (std::size_t n = 0; n < factors.size(); ++n) {
    const bool first = n % in_a_line == 0;
    const bool last = n % in_a_line == in_a_line - 1 || n + 1 == factors.size();
    text += (first ? std::string(line_begin) : std::string(", ")) + fmt::format("{:>5}", factors[n]);
    if (last) text += line_end;
  }
  return text;
}

std::string as_c(const PrintedTable& table) {
  std::string text;
  for (const std::string& remark : table.remarks) text += "// " + remark + "\n";
  text += fmt::format("#include <stdint.h>\n\n#define RAMP_SIZE {}u\n", table.factors.size());
  if (table.first_interval) text += fmt::format("#define RAMP_FIRST_INTERVAL {}u\n", *table.first_interval);
  return text + "\nconst uint16_t ramp_factors[RAMP_SIZE] = {\n" + numbers(table.factors, "    ", ",\n") + "};\n";
}

// For the GNU assembler, whatever the chip: .2byte has 16 bits everywhere. The section is that of an AVR's flash.
std::string as_assembly(const PrintedTable& table) {
  std::string text;
  for (const std::string& remark : table.remarks) text += "/* " + remark + " */\n";
  text += fmt::format("\n    .equ RAMP_SIZE, {}\n", table.factors.size());
  if (table.first_interval) text += fmt::format("    .equ RAMP_FIRST_INTERVAL, {}\n", *table.first_interval);
  return text + "\n    .section .progmem.data, \"a\"\n    .balign 2\n    .global ramp_factors\nramp_factors:\n" +
         numbers(table.factors, "    .2byte ", "\n");
}

std::string as_csv(const PrintedTable& table) {
  std::string text = table.first_interval ? "n,factor,k,c\n" : "n,factor,k\n";
  for (std::size_t n = 0; n < table.factors.size(); ++n) {
    const std::uint32_t factor = table.factors[n];
    // Entry 0 is never read; its k is 1.
    text += fmt::format("{},{},{:.10g}", n, factor, n == 0 ? 1 : factor / 65536.0);
    if (table.first_interval)
      text += fmt::format(",{}", n == 0 ? *table.first_interval : *table.first_interval * factor >> 16);
    text += "\n";
  }
  return text;
}

}  // namespace

int ramp_limit(const RampArguments& arguments) {
  if (!arguments.picture.empty()) {
    const int code = draw_limits(arguments);
    if (code != exit_done || arguments.output.empty()) return code;
  }
  if (arguments.json) {
    nlohmann::ordered_json json;
    const std::vector<std::int32_t> sizes = sizes_of(arguments);
    if (sizes.size() == 1) json = limit_json(arguments, sizes[0]);
    for (const std::int32_t size : sizes) {
      if (sizes.size() > 1) json["tables"].push_back(limit_json(arguments, size));
    }
    return write(json.dump(2) + "\n", arguments.output);
  }
  if (!arguments.output.empty()) return write(limit_table(arguments), arguments.output);
  std::string text;
  for (const std::int32_t size : sizes_of(arguments)) text += limit_words(arguments, size);
  return write(text, "");
}

int print_ramp_table(const RampArguments& arguments) {
  const std::int32_t size = *arguments.print_table;
  PrintedTable table{.factors = std::vector<std::uint16_t>(static_cast<std::size_t>(size)),
                     .first_interval = {},
                     .remarks = remarks_of(arguments, size)};
  make_ramp_table(table.factors.data(), table.factors.size());
  if (arguments.clock && arguments.steps_per_turn && arguments.acceleration) {
    RampRequest request;
    request.setup = {.clock = Hertz(*arguments.clock),
                     .steps_per_turn = *arguments.steps_per_turn,
                     .acceleration = {*arguments.acceleration}};
    request.method = RampMethod::table;
    request.steps = 1;
    Result<RampSequence, RampError> sequence = RampSequence::start(request);
    if (!sequence) return fail(exit_bad_program, sequence.error().message);
    table.first_interval = static_cast<std::uint32_t>(sequence->next());
  }
  if (arguments.format == "csv") return write(as_csv(table), arguments.output);
  return write(arguments.format == "asm" ? as_assembly(table) : as_c(table), arguments.output);
}

}  // namespace passo
