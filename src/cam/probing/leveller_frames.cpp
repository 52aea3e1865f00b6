// Leveller: work coordinate systems, offsets and places of the machine. What the machine knows and this program does
// not (offsets, lengths of tools, homes) stays words: G55, G43 H1, G28.
#include <cmath>
#include <utility>

#include "leveller.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

constexpr AxisSet every_axis{0x1FF};

AxisSet only(Axis axis) {
  AxisSet set;
  set.add(axis);
  return set;
}

// " X1.5", of the words of the axes.
std::string axis_words_of(const FrameBlock& block, double more_z = 0) {
  std::string text;
  for (const auto& [letter, value] : block.words) {
    if (!axis_of(letter)) continue;
    text += fmt::format(" {}{:.5f}", letter, letter == 'Z' ? value + more_z : value);
  }
  return text;
}

}  // namespace

// What no operation says.
void Leveller::read_block(const FrameBlock& block) {
  if (!is_reset_) return;
  if (!block.system.empty()) read_system(block);
  const std::string& code = block.place.name;
  if (code == "G28.1" || code == "G30.1") return store_home(block);
  if (code == "G10") return read_tool_entry(block);
  if (code == "G52" || code == "G92") {
    refuse(block, "level.offset", fmt::format("{} changes the work zero", code),
           "work offsets set before the program (e.g. G54)");
  }
}

void Leveller::read_system(const FrameBlock& block) {
  writer_.end_run();
  writer_.add_line(block.system.name);
  // The interpreter has the number already; where it stays, no operation follows.
  const int before = std::exchange(written_.system, system_of_code(block.system.name));
  if (before != written_.system && !wish_.knows_offsets) lose(every_axis);
}

// G10 L1, L10 and L11 set a tool, L2 and L20 the zero of the work.
void Leveller::read_tool_entry(const FrameBlock& block) {
  const auto kind = static_cast<int>(std::lround(block.value('L')));
  if (kind != 0 && kind != 1 && kind != 10 && kind != 11) {
    return refuse(block, "level.offset", fmt::format("G10 L{} changes the work zero", kind),
                  "work offsets set before the program (e.g. G54)");
  }
  writer_.end_run();
  std::string line = fmt::format("G10 L{}", kind);
  for (const char letter : {'P', 'R', 'I', 'J', 'Q'}) {
    if (!block.has(letter) || kind == 0) continue;
    const double unit = letter == 'R' ? block.length_unit : 1;
    line += fmt::format(" {}{:g}", letter, block.value(letter) * unit);
  }
  // L10 and L11 say where the tool is; the levelled program is higher.
  if (kind != 0) line += axis_words_of(block, kind == 1 ? 0 : writer_.higher_than(place_));
  writer_.add_line(std::move(line));
}

// The machine keeps where it stands: higher than the program would stand by the height of the surface.
void Leveller::store_home(const FrameBlock& block) {
  writer_.end_run();
  writer_.add_line(block.place.name);
  const double higher = writer_.higher_than(place_) / machine_unit_;
  if (std::abs(higher) < 1e-6) return;
  const int parameter = block.place.name == "G28.1" ? 5163 : 5183;
  writer_.add_line(fmt::format("#{}=[#{}{:+.6f}]", parameter, parameter, -higher));
}

// True: the operation is about the frame, and is done.
bool Leveller::follow_frame(const Operation& operation) {
  const Frame before = frame_;
  if (!frame_.follow(operation)) return false;
  if (is_reset_) write_frame(operation, before);
  writer_.end_run();
  const Point after = frame_.work_from_machine(before.machine_from_work(place_));
  writer_.rise(after[Axis::z] - place_[Axis::z]);
  place_ = after;
  writer_.stand_at(place_);
  return true;
}

void Leveller::write_frame(const Operation& operation, const Frame& before) {
  if (std::holds_alternative<operation::SetToolOffset>(operation.what)) return write_tool_offset();
  const FrameBlock& block = blocks_.last();
  if (frame_.work_system() != before.work_system()) {
    if (frame_.work_system() == written_.system) return;          // written with its block
    if (block.value('M') == 2 || block.value('M') == 30) return;  // the end of the program, here and there
    written_.system = frame_.work_system();
    writer_.end_run();
    writer_.add_line(code_of_system(written_.system));  // M72
    return lose(every_axis);
  }
  const bool has_moved = frame_.g92_offset() != before.g92_offset();
  if (block.place.name.starts_with("G92.") && block.number != written_.g92_block) {
    written_.g92_block = block.number;
    if (has_moved && writer_.any_levelled()) {
      return refuse(operation, "level.offset",
                    fmt::format("{} changes the work zero after moves on the surface", block.place.name),
                    "work offsets set before the program (e.g. G54)");
    }
    writer_.end_run();
    writer_.add_line(block.place.name);
    if (!wish_.knows_offsets) lose(every_axis);
  }
}

// Without a tool table the lengths are not known.
void Leveller::write_tool_offset() {
  const FrameBlock& block = blocks_.last();
  std::string line = block.tool.name;
  if (line.empty()) {  // M72
    const Point& offset = frame_.tool_offset();
    line = offset == Point() ? "G49" : "G43.1";
    for (const Axis axis : all_axes) {
      if (offset[axis] != 0) line += fmt::format(" {}{:.5f}", letter_of(axis), offset[axis]);
    }
  } else if (line == "G43.1" || (line == "G43.2" && !block.has('H'))) {
    line += axis_words_of(block);
  } else if (block.has('H')) {
    line += fmt::format(" H{}", std::lround(block.value('H')));
  }
  writer_.end_run();
  writer_.add_line(std::move(line));
  const bool was_known = std::exchange(written_.has_tool_offset, true) || wish_.knows_offsets;
  if (!was_known || !has_tools_) lose(only(Axis::z));
}

void Leveller::lose(AxisSet axes) {
  said_.lose(axes);
  writer_.code().forget(axes);
}

void Leveller::handle_machine_move(const Point& end, bool rapid) {
  const FrameBlock& block = blocks_.last();
  if (block.named.empty()) return;
  writer_.end_run(block.named.has(Axis::z));
  writer_.code().machine_move(rapid, feed_of(end), block.named, frame_.machine_from_work(end));
  stand_in_machine(end, block.named);
}

// G28 and G30 go to a place of the work first. False: this is that move, and it goes somewhere.
bool Leveller::handle_home(const Point& end) {
  const FrameBlock& block = blocks_.last();
  if (std::exchange(homing_, block.number) != block.number) {
    return is_same_place(end, place_) && (block.incremental || said_.has_all(block.named));
  }
  const AxisSet axes = block.named.empty() ? every_axis : block.named;
  writer_.end_run(axes.has(Axis::z));
  writer_.code().home(block.place.name, block.named);
  stand_in_machine(end, axes);
  return true;
}

// In a work that is turned X and Y change together.
void Leveller::stand_in_machine(const Point& end, AxisSet axes) {
  ++writer_.count().moves_before;
  ++writer_.count().moves_after;
  if (axes.has(Axis::x) || axes.has(Axis::y)) {
    axes.add(Axis::x);
    axes.add(Axis::y);
  }
  const double higher = axes.has(Axis::z) ? 0 : writer_.higher_than(place_);
  if (!wish_.knows_offsets) lose(axes);
  if (axes.has(Axis::z)) lose(only(Axis::z));
  if (axes.has(Axis::z)) said_.leave_work();
  place_ = end;
  writer_.set_height(end[Axis::z] + higher);
  writer_.stand_at(place_);
}

}  // namespace passo
