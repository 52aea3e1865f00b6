// passo probe and passo level.
#include "probing_commands.hpp"

#include <charconv>
#include <cstdio>

#include "cam_job.hpp"
#include "named_files.hpp"
#include "program_input.hpp"
#include <fmt/format.h>

#include "passo/base/counted.hpp"
#include "passo/diagnostics/file_bytes.hpp"
#include "passo/levelling/height_map.hpp"
#include "passo/levelling/map_figures.hpp"
#include "passo/probing/levelled_program.hpp"

namespace passo {
namespace {

// "10,5". Nothing: it is no place.
std::optional<std::pair<double, double>> read_place(std::string_view text) {
  double values[2] = {};
  for (double& value : values) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || !(std::abs(value) <= HeightMap::farthest)) return {};
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    if (&value == values && !text.starts_with(',')) return {};
    if (&value == values) text.remove_prefix(1);
  }
  if (!text.empty()) return {};
  return std::pair(values[0], values[1]);
}

std::optional<HeightMap> read_map(const std::string& file, Diagnostics& diagnostics) {
  const auto bytes = read_bytes(file, {.area = "surface", .expected = "a height map"}, diagnostics);
  return bytes ? read_height_map(file, *bytes, diagnostics) : std::nullopt;
}

}  // namespace

int probe(const ProbeArguments& arguments) {
  const auto program = probing_program(arguments.cycle);
  if (!program) return fail(exit_bad_program, "--" + program.error());
  return write_text(arguments.output, *program);
}

int level(const LevelArguments& arguments) {
  NamedFiles files;
  files.reads("the program", arguments.program.program);
  files.reads("--map", arguments.map);
  files.reads("--tools", arguments.program.tools);
  files.reads("--parameters", arguments.program.parameters);
  files.writes("--output", arguments.output);
  if (!files.are_apart()) return exit_bad_program;
  Diagnostics diagnostics;
  std::optional<HeightMap> map = read_map(arguments.map, diagnostics);
  show(diagnostics);
  if (!map) return exit_bad_program;
  if (!arguments.zero.empty()) {
    const auto zero = read_place(arguments.zero);
    if (!zero) return fail(exit_bad_program, "--zero: expected X,Y in mm, e.g. 10,5, not '" + arguments.zero + "'");
    map = map->lowered_by(map->height(zero->first, zero->second));
  }
  if (arguments.program.program.empty()) {
    fmt::print("{}", describe(*map));
    return exit_done;
  }
  std::optional<ProgramReader> program = streamed_program(arguments.program);
  const std::optional<InterpreterOptions> options = machine_options(arguments.program);
  if (!program || !options) return exit_bad_program;
  Diagnostics findings;
  std::string text;
  const LevelOptions wish{.tolerance = arguments.tolerance,
                          .holes = arguments.holes,
                          .clear = arguments.clear,
                          .beside = arguments.beside,
                          .knows_offsets = !arguments.program.parameters.empty()};
  const LevelCount count = write_levelled_program(std::move(*program), *options, *map, wish, findings,
                                                  [&](std::string_view piece) { text += piece; });
  show(findings);
  if (findings.any_error()) return exit_bad_program;
  if (const int code = write_text(arguments.output, text); code != exit_done) return code;
  if (!arguments.output.empty() && arguments.output != "-") {
    fmt::print("{} {} {} on the surface; {} {}\n", counted(count.moves_before, "move"),
               count.moves_before == 1 ? "is" : "are", count.moves_after, counted(count.holes, "hole"),
               count.holes == 1 ? "keeps its depth" : "keep their depths");
  }
  return exit_done;
}

}  // namespace passo
