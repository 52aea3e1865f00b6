// Any bytes as a program for any controller: it is refused with a reason, or what is written has only characters that
// this controller takes, in lines that it can read. Pieces of any size give the same text. Before a line "----": a text
// of the operator for the start and for tool changes, which is refused with places inside its lines, or is used.
//
// The first byte chooses the controller, the second one the units.
#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>

#include "kit/require.hpp"

#include "passo/post_processor/post_processor.hpp"

namespace passo {
namespace {

using test::require;

struct Case {
  const ControllerWords& controller;
  LengthUnit read = LengthUnit::mm;
  LengthUnit written = LengthUnit::mm;
  OperatorText text = {};
};

struct Written {
  std::string text;
  bool is_refused = false;
};

Written written(const Case& one, std::string_view program, std::size_t piece) {
  PostProcessorOptions options{.program = "part \x21\xc3\xa9",
                               .read_unit = one.read,
                               .written_unit = one.written,
                               .tools = {{"cutter 3 mm", 3}, {"drill!", 0.8}},
                               .spindle = 12'000};
  options.start = one.text;
  options.tool_change = one.text;
  Written result;
  PostProcessor processor(one.controller, std::move(options), [&](std::string_view text) { result.text += text; });
  for (std::size_t at = 0; at < program.size(); at += piece) processor.add(program.substr(at, piece));
  const auto why = processor.finish();
  require(!why || why->starts_with("line "), "refused without a place");
  result.is_refused = why.has_value();
  return result;
}

void check_lines(const ControllerWords& controller, std::string_view text) {
  require(text.empty() || text.back() == '\n', "a line that does not end");
  for (const char c : text) {
    require(controller.comments.realtime.find(c) == std::string_view::npos, "a command in the text");
    require(!controller.comments.is_ascii || static_cast<unsigned char>(c) < 0x80, "a byte that is not ASCII");
  }
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    const std::string_view line = text.substr(0, end);
    const bool is_comment = line.starts_with('(');
    require(!is_comment || controller.comments.longest_line == 0 || line.size() <= controller.comments.longest_line,
            "a comment that is too long");
    require(line.size() < 4000, "a line of digits");
    text.remove_prefix(end + 1);
  }
}

void check_findings(const Diagnostics& findings) {
  for (const Diagnostic& finding : findings.all()) {
    require(finding.code.starts_with("post.") && !finding.message.empty(), "a finding without words");
    require(finding.place.column == 0 || finding.text.empty() || finding.place.column - 1 <= finding.text.size(),
            "a finding outside its line");
    static_cast<void>(render(finding, true));
  }
}

void check_program(Case one, std::string_view input) {
  constexpr std::string_view divider = "\n----\n";
  const std::size_t end = input.find(divider);
  if (end != std::string_view::npos) {
    Diagnostics findings;
    const OperatorText text =
        OperatorText::read(input.substr(0, end), "start.txt", OperatorText::Place::start, one.controller, findings);
    check_findings(findings);
    if (!findings.any_error()) one.text = text;
    input.remove_prefix(end + divider.size());
  }
  const Written whole = written(one, input, std::max<std::size_t>(1, input.size()));
  const Written pieces = written(one, input, 7);
  require(whole.text == pieces.text && whole.is_refused == pieces.is_refused, "pieces change the program");
  if (!whole.is_refused && !one.controller.knows_all()) check_lines(one.controller, whole.text);
}

}  // namespace
}  // namespace passo

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 2) return 0;
  using passo::LengthUnit;
  const auto all = passo::controllers();
  passo::check_program({.controller = all[data[0] % all.size()],
                        .read = (data[1] & 1U) != 0 ? LengthUnit::inch : LengthUnit::mm,
                        .written = (data[1] & 2U) != 0 ? LengthUnit::inch : LengthUnit::mm},
                       {reinterpret_cast<const char*>(data) + 2, size - 2});
  return 0;
}
