// passo explain: what a line of a program does, in words, and under which modes the line runs.
#include <algorithm>
#include <charconv>
#include <cstdio>
#include <cstdlib>

#include "commands.hpp"
#include "program_input.hpp"
#include <fmt/format.h>
#include <unistd.h>

#include "passo/base/counted.hpp"
#include "passo/diagnostics/findings_json.hpp"
#include "passo/interpreter/explain.hpp"
#include "passo/machine_file/machine_description.hpp"

namespace passo {
namespace {

constexpr std::uint32_t most_lines = 10'000;

struct ExplainedPlace {
  std::string file;
  LineRange lines;
  bool whole_file = false;
};

bool read_number(std::string_view text, std::uint32_t& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size() && number >= 1;
}

bool read_range(std::string_view text, LineRange& range) {
  const std::size_t dash = text.find('-');
  if (!read_number(text.substr(0, dash), range.first)) return false;
  range.last = range.first;
  return dash == std::string_view::npos ||
         (read_number(text.substr(dash + 1), range.last) && range.last >= range.first);
}

// Reads FILE, FILE:LINE or FILE:FROM-TO. A colon may also be a part of the file's name. The text after the last colon
// decides.
bool read_place(const std::string& text, ExplainedPlace& place) {
  const std::size_t colon = text.rfind(':');
  const bool has_range =
      colon != std::string::npos && colon + 1 < text.size() && text.find('/', colon) == std::string::npos;
  if (colon != std::string::npos && colon > 0 && has_range &&
      read_range(std::string_view(text).substr(colon + 1), place.lines)) {
    place.file = text.substr(0, colon);
    return true;
  }
  if (colon != std::string::npos && access(text.c_str(), F_OK) != 0) return false;
  place.file = text;
  place.lines = {1, most_lines};
  place.whole_file = true;
  return true;
}

// The rotary axes whose surfaces count in the length, with their radii.
std::vector<std::pair<char, double>> surfaces_of(const Explanation::Moves& moves) {
  std::vector<std::pair<char, double>> surfaces;
  for (const Axis axis : {Axis::a, Axis::b, Axis::c}) {
    if (moves.surface_radius[axis] > 0) surfaces.emplace_back(letter_of(axis), moves.surface_radius[axis]);
  }
  return surfaces;
}
std::string surfaces_in_words(const Explanation::Moves& moves) {
  std::string words;
  for (const auto& surface : surfaces_of(moves)) {
    words += fmt::format("{} radius of {:.4g} mm ({})", words.empty() ? " on the surface at a" : " and a",
                         surface.second, surface.first);
  }
  return words;
}

class Writer {
 public:
  explicit Writer(bool colour) : colour_(colour) {}

  void write(const Explanation& line, const std::string& file, bool whole_run) {
    out_ += fmt::format("{} {}\n", paint("1", fmt::format("{}:{}:", file, line.line)), printable(line.text));
    for (const Diagnostic& finding : line.findings) out_ += render(finding, colour_);
    if (line.executions == 0) {
      out_ += whole_run ? "  never executed\n" : "  not executed in the part of the program that was run\n";
      return;
    }
    if (line.executions > 1 || !whole_run) {
      out_ += fmt::format("  executed {}{}; this is the first\n", whole_run ? "" : "at least ",
                          counted(line.executions, "time"));
    }
    std::size_t width = 0;
    for (const Explanation::Word& word : line.words)
      width = std::max(width, std::min<std::size_t>(word.word.size(), 24));
    for (const Explanation::Word& word : line.words) row(printable(word.word), width, word.meaning);
    if (line.words.empty()) out_ += "  nothing to do\n";
    heading("operations");
    for (const std::string& operation : line.operations) out_ += fmt::format("    {}\n", printable(operation));
    if (line.operations.empty()) out_ += "    none\n";
    heading("position");
    position("work", line.before.work, line.after.work);
    position("machine", line.before.machine, line.after.machine);
    moves(line.moves);
    heading("modes");
    for (const Explanation::Mode& mode : line.modes) {
      const std::string text = mode.code.empty() ? mode.meaning : fmt::format("{:<6}{}", mode.code, mode.meaning);
      out_ += fmt::format("    {:<20}{}{}\n", mode.name, text, mode.set_here ? paint("32", "  (set here)") : "");
    }
  }
  const std::string& text() const { return out_; }

 private:
  // Control characters in a program must not reach the terminal.
  static std::string printable(std::string text) {
    for (char& c : text) {
      if (static_cast<unsigned char>(c) < 0x20U || c == 0x7f) c = ' ';
    }
    return text;
  }
  std::string paint(const char* style, const std::string& text) const {
    return colour_ ? fmt::format("\x1b[{}m{}\x1b[0m", style, text) : text;
  }
  void heading(const char* text) { out_ += "  " + paint("1", text) + "\n"; }
  void row(const std::string& word, std::size_t width, const std::string& meaning) {
    out_ += fmt::format("  {:<{}}  {}\n", word, width, meaning);
  }
  void position(const char* name, const Point& before, const Point& after) {
    out_ += before == after ? fmt::format("    {:<9}{}\n", name, in_words(after))
                            : fmt::format("    {:<9}{}  ->  {}\n", name, in_words(before), in_words(after));
  }

  void moves(const Explanation::Moves& moves) {
    if (moves.feed_length == 0 && moves.rapid_length == 0) return;
    heading("way");
    if (moves.rapid_length > 0) {
      out_ += fmt::format("    {:<9}{:.3f} mm, as fast as the machine can move\n", "rapid", moves.rapid_length);
    }
    if (moves.feed_length == 0) return;
    const std::string time = moves.feed_time
                                 ? fmt::format("{:.3f} s at the programmed feed, without ramps", *moves.feed_time)
                                 : std::string("for a time that does not follow from the feed rate");
    out_ += fmt::format("    {:<9}{:.3f} {}{}, {}\n", "feed", moves.feed_length, moves.in_degrees ? "degrees" : "mm",
                        surfaces_in_words(moves), time);
  }

  std::string out_;
  bool colour_;
};

nlohmann::ordered_json as_json(const Point& point) {
  nlohmann::ordered_json values;
  for (const Axis axis : all_axes) values[std::string(1, letter_of(axis))] = point[axis];
  return values;
}

nlohmann::ordered_json as_json(const Explanation::Moves& moves) {
  nlohmann::ordered_json radii = nlohmann::ordered_json::object();
  for (const auto& surface : surfaces_of(moves)) radii[std::string(1, surface.first)] = surface.second;
  return {{"rapid_mm", moves.rapid_length},
          {"feed_mm", moves.feed_length},
          {"feed_s", moves.feed_time ? nlohmann::ordered_json(*moves.feed_time) : nlohmann::ordered_json()},
          {"feed_unit", moves.in_degrees ? "deg" : "mm"},
          {"surface_radius_mm", radii}};
}

nlohmann::ordered_json as_json(const Explanation& line) {
  nlohmann::ordered_json words = nlohmann::ordered_json::array();
  for (const auto& [word, meaning] : line.words) words.push_back({{"word", word}, {"meaning", meaning}});
  nlohmann::ordered_json modes = nlohmann::ordered_json::array();
  for (const Explanation::Mode& mode : line.modes) {
    modes.push_back({{"name", mode.name}, {"code", mode.code}, {"meaning", mode.meaning}, {"set_here", mode.set_here}});
  }
  const auto position = [](const Explanation::Position& at) -> nlohmann::ordered_json {
    return {{"work", as_json(at.work)}, {"machine", as_json(at.machine)}};
  };
  return {{"line", line.line},
          {"text", line.text},
          {"executions", line.executions},
          {"words", words},
          {"operations", line.operations},
          {"before", position(line.before)},
          {"after", position(line.after)},
          {"moves", as_json(line.moves)},
          {"modes", modes},
          {"findings", findings_json(line.findings)}};
}

// What the machine file says about the words of a program. Nothing: the file is wrong.
std::optional<ExplainedMachine> explained_machine(const std::string& file, Diagnostics& findings) {
  if (file.empty()) return ExplainedMachine{};
  const std::optional<MachineDescription> machine = load_machine_file(file, findings, MachineUse::any_board);
  if (!machine) return {};
  ExplainedMachine explained;
  for (const AxisDescription& axis : machine->axes) explained.surface_radius[axis.axis] = axis.surface_radius;
  if (machine->has_rotary_axis()) explained.angle_tolerance = machine->path_tolerance_deg;
  return explained;
}

}  // namespace

int explain(const ExplainArguments& arguments) {
  ExplainedPlace place;
  if (!read_place(arguments.program.program, place)) {
    return fail(exit_bad_program,
                fmt::format("{}: expected FILE, FILE:LINE or FILE:FROM-TO, lines from 1", arguments.program.program));
  }
  ProgramArguments program_arguments = arguments.program;
  program_arguments.program = place.file;
  std::optional<ProgramReader> program = streamed_program(program_arguments);
  const std::optional<InterpreterOptions> options = interpreter_options(program_arguments);
  if (!program || !options) return exit_bad_program;

  Diagnostics of_machine;
  const std::optional<ExplainedMachine> machine = explained_machine(arguments.machine, of_machine);
  show(of_machine);
  if (!machine) return exit_bad_machine;

  Diagnostics findings(1000);
  const Explanations result = explain(std::move(*program), *options, place.lines, findings, {}, *machine);
  if (result.lines.empty()) {
    return fail(exit_bad_program, fmt::format("{} has {}: expected a line from 1 to {}", place.file,
                                              counted(result.lines_in_file, "line"), result.lines_in_file));
  }
  if (place.whole_file && result.lines_in_file > most_lines) {
    return fail(exit_bad_program, fmt::format("{} has {}: expected {}:FROM-TO, at most {} lines", place.file,
                                              counted(result.lines_in_file, "line"), place.file, most_lines));
  }

  if (arguments.json) {
    nlohmann::ordered_json lines = nlohmann::ordered_json::array();
    for (const Explanation& line : result.lines) lines.push_back(as_json(line));
    const nlohmann::ordered_json whole{{"file", place.file}, {"whole_run", result.whole_run}, {"lines", lines}};
    std::puts(whole.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace).c_str());
  } else {
    Writer writer(shows_colours(STDOUT_FILENO));
    for (const Explanation& line : result.lines) writer.write(line, place.file, result.whole_run);
    std::fputs(writer.text().c_str(), stdout);
  }
  const auto is_error = [](const Diagnostic& finding) { return finding.severity == Severity::error; };
  const bool wrong = std::ranges::any_of(
      result.lines, [&](const Explanation& line) { return std::ranges::any_of(line.findings, is_error); });
  return wrong ? exit_bad_program : exit_done;
}

}  // namespace passo
