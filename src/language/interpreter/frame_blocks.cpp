#include "passo/interpreter/frame_blocks.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "block_watcher.hpp"
#include "code_table.hpp"

#include "passo/gcode/expression.hpp"

namespace passo {
namespace {

// Which of a block's codes this one is, or null.
FrameCode* field_of(FrameBlock& block, CodeNumber number) {
  switch (number) {
    case code(10):
    case code(28):
    case code(28, 1):
    case code(30):
    case code(30, 1):
    case code(52):
    case code(53):
    case code(92):
    case code(92, 1):
    case code(92, 2):
    case code(92, 3): return &block.place;
    case code(43):
    case code(43, 1):
    case code(43, 2):
    case code(49): return &block.tool;
    default: break;
  }
  return number >= code(54) && number <= code(59, 3) ? &block.system : nullptr;
}

bool is_cycle(CodeNumber motion) {
  return motion >= code(70) && motion < code(90) && motion != code(80);
}

}  // namespace

bool FrameBlock::has(char letter) const {
  return std::ranges::any_of(words, [&](const auto& word) { return word.first == letter; });
}

double FrameBlock::value(char letter) const {
  const auto found = std::ranges::find_if(words, [&](const auto& word) { return word.first == letter; });
  return found == words.end() ? 0 : found->second;
}

class FrameBlocks::Watcher final : public BlockWatcher {
 public:
  void before(const Block& block, std::string_view file, const ProgramState& /*state*/, const Parameters& parameters,
              const SymbolTable& /*symbols*/) override {
    last_.number += 1;
    last_.line = block.line;
    last_.place = last_.tool = last_.system = {};
    last_.words.clear();
    last_.named = {};
    for (const Word& word : block.words) {
      const Evaluation value = evaluate(block, word.value, parameters);
      if (!value) continue;
      if (word.letter == 'G') {
        take_code(word, *value);
      } else {
        last_.words.emplace_back(word.letter, *value);
        if (const std::optional<Axis> axis = axis_of(word.letter)) last_.named.add(*axis);
        if (word.letter == '@' || word.letter == '^') {
          last_.named.add(Axis::x);
          last_.named.add(Axis::y);
        }
      }
    }
    is_new_ = !last_.place.empty() || !last_.tool.empty() || !last_.system.empty();
    if (!is_new_) return;
    last_.file = file;
    last_.text = block.text;
  }

  void after(const ProgramState& state) override {
    last_.incremental = state.modal.incremental();
    const CodeNumber motion = state.modal[ModalGroup::motion];
    last_.cycle = is_cycle(motion) ? spelling('G', motion) : std::string();
    last_.to_start = state.modal[ModalGroup::retract] == code(98);
    last_.length_unit = state.length_unit();
    for (auto& [letter, value] : last_.words) {
      const std::optional<Axis> axis = axis_of(letter);
      if (axis && !is_rotary(*axis)) value *= last_.length_unit;
    }
    if (is_new_) executed_.push_back(last_);
    is_new_ = false;
  }

  const FrameBlock& last() const { return last_; }
  std::vector<FrameBlock> take_executed() { return std::exchange(executed_, {}); }

 private:
  void take_code(const Word& word, double value) {
    const double tenths = std::round(value * 10);
    if (!(tenths >= 0 && tenths < code(100))) return;
    const auto number = static_cast<CodeNumber>(tenths);
    FrameCode* const field = field_of(last_, number);
    if (field != nullptr) *field = {spelling('G', number), {word.span.column, word.span.length}};
  }

  FrameBlock last_;
  bool is_new_ = false;
  std::vector<FrameBlock> executed_;
};

FrameBlocks::FrameBlocks(Interpreter& interpreter) : watcher_(std::make_unique<Watcher>()) {
  interpreter.watch(*watcher_);
}
FrameBlocks::~FrameBlocks() = default;

const FrameBlock& FrameBlocks::last() const {
  return watcher_->last();
}

std::vector<FrameBlock> FrameBlocks::take_executed() {
  return watcher_->take_executed();
}

}  // namespace passo
