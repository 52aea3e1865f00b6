// PostProcessor: rewrites a program of `passo cam` in the words of another controller. Every program of `passo cam`
// passes through it, so that no program writer knows any controller.
//
// It reads the plain words that Passo's writers use: one position in absolute coordinates per line, arcs with I, J and
// K, T and M6 in one line, M2 at the end. Positions are rounded once, so errors do not add up. Only the current line
// and the modal state are kept: a program of any length takes constant memory.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "passo/post_processor/controller_words.hpp"
#include "passo/post_processor/operator_text.hpp"

namespace passo {

enum class LengthUnit : std::uint8_t { mm, cm, inch };

// A tool of the program, for the placeholders of the operator's texts.
struct ProgramTool {
  std::string words = {};  // "cutter 3 mm"
  double diameter_mm = 0;
};

struct PostProcessorOptions {
  std::string program = {};  // name of the program
  LengthUnit read_unit = LengthUnit::mm;
  LengthUnit written_unit = LengthUnit::mm;
  std::vector<ProgramTool> tools = {};  // tool 1 comes first
  std::uint32_t first_tool = 1;         // in the text for the start
  std::optional<std::uint32_t> spindle = {};
  double spindle_seconds = 0;
  double park_x = 0;  // in the unit that is written, as are the following
  double park_y = 0;
  double change_height = 0;
  OperatorText start = {};
  OperatorText tool_change = {};  // replaces the controller's own words
  OperatorText end = {};
};

class PostProcessor {
 public:
  using Sink = std::function<void(std::string_view)>;

  // `controller` and the function that `sink` calls must outlive the object.
  PostProcessor(const ControllerWords& controller, PostProcessorOptions options, Sink sink);
  ~PostProcessor();

  // Adds a piece of the program, which may end within a line.
  void add(std::string_view text);
  // Ends the program. If the controller cannot run the program, returns the reason; the text written so far is then
  // useless.
  [[nodiscard]] std::optional<std::string> finish();

 private:
  class Lines;

  std::unique_ptr<Lines> lines_;
  std::string rest_;  // the beginning of an unfinished line
};

}  // namespace passo
