#include "passo/sender/grbl_program_check.hpp"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <variant>
#include <vector>

#include "passo/interpreter/saved_offsets.hpp"
#include "passo/sender/grbl_code.hpp"

namespace passo {
namespace {

// Reports what a Grbl machine cannot do, at its line, once for each reason.
class Objections {
 public:
  Objections(const std::string& program, Diagnostics& diagnostics) : program_(program), diagnostics_(diagnostics) {}
  void note(const Operation& operation) {
    if (operation.source.line == line_) return;
    line_ = operation.source.line;
    text_ = operation.text;
    file_ = operation.file;
  }
  void add(const std::string& reason, std::uint32_t line) {
    if (std::ranges::find(told_, reason) != told_.end()) return;
    told_.push_back(reason);
    diagnostics_.add({.code = "grbl.cannot",
                      .file = file_.empty() ? program_ : file_,
                      .place = {.line = line, .column = line == line_ && !text_.empty() ? 1U : 0U},
                      .message = "a machine with Grbl cannot do this: " + reason,
                      .expected = "",
                      .text = line == line_ ? text_ : ""});
  }

 private:
  const std::string& program_;
  Diagnostics& diagnostics_;
  std::uint32_t line_ = 0;
  std::string text_;
  std::string file_;
  std::vector<std::string> told_;
};

}  // namespace

void set_offsets(InterpreterOptions& options, const GrblMachine& machine) {
  const double unit = options.machine_units == LengthUnits::inch ? mm_per_inch : 1;
  const auto set = [&](int first, const Point& offset) {
    for (const Axis axis : all_axes) {
      options.parameters[first + static_cast<int>(index_of(axis))] = offset[axis] / (is_rotary(axis) ? 1 : unit);
    }
  };
  begin_with_g54(options.parameters);
  forget_g92(options.parameters);
  for (const auto& [name, offset] : machine.offsets) {
    if (name == "G92") {
      options.parameters[g92_active_parameter] = offset == Point() ? 0 : 1;
      set(g92_parameter, offset);
    } else if (name.size() == 3 && name[2] >= '4' && name[2] <= '9') {
      set(work_offset_parameter(1 + name[2] - '4'), offset);
    } else if (name.size() == 5 && name.starts_with("G59.") && name[4] >= '1' && name[4] <= '3') {
      set(work_offset_parameter(7 + name[4] - '1'), offset);
    }
  }
}

// GrblFeed writes the probe moves.
GrblPathJudge grbl_path_judge(const GrblTarget& target) {
  return [code = std::make_shared<GrblCode>(target)](const PathItem& item) -> Status<std::string> {
    const auto* action = std::get_if<Action>(&item);
    const bool is_probe =
        action != nullptr && (action->kind == Action::Kind::probe_begin || action->kind == Action::Kind::probe_end);
    std::vector<std::string> lines;
    return is_probe ? Status<std::string>(Unit{}) : code->write(item, lines);
  };
}

ProgramCheck check_for_grbl(const ProgramReader& program, const MachineDescription& machine,
                            const InterpreterOptions& options, const GrblTarget& target, Diagnostics& findings,
                            const std::function<void(const PathItem&)>& watch_path,
                            const std::function<void(const Operation&)>& watch_operations) {
  Objections objections(program.name(), findings);
  const GrblPathJudge judge_item = grbl_path_judge(target);
  ProgramCheck check = check_program(
      program.again(), machine, options, findings,
      [&](const PathItem& item) {
        const auto possible = judge_item(item);
        if (!possible) objections.add(possible.error(), GrblCode::source_line(item));
        if (watch_path) watch_path(item);
      },
      [&](const Operation& operation) {
        objections.note(operation);
        if (watch_operations) watch_operations(operation);
      });
  check.good = check.good && !findings.any_error();
  return check;
}

}  // namespace passo
