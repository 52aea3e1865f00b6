#include "passo/sender/grbl_program.hpp"

#include <algorithm>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "passo/drive/program_stop.hpp"
#include "passo/interpreter/saved_offsets.hpp"

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

ProgramCheck check_for_grbl(const ProgramReader& program, const MachineDescription& machine,
                            const InterpreterOptions& options, const GrblTarget& target, Diagnostics& findings,
                            const std::function<void(const PathItem&)>& watch_path,
                            const std::function<void(const Operation&)>& watch_operations) {
  Objections objections(program.name(), findings);
  GrblCode code(target);
  std::vector<std::string> lines;
  ProgramCheck check = check_program(
      program.again(), machine, options, findings,
      [&](const PathItem& item) {
        lines.clear();
        const auto written = code.write(item, lines);
        if (!written) objections.add(written.error(), GrblCode::source_line(item));
        if (watch_path) watch_path(item);
      },
      [&](const Operation& operation) {
        objections.note(operation);
        if (watch_operations) watch_operations(operation);
      });
  check.good = check.good && !findings.any_error();
  return check;
}

GrblProgram::GrblProgram(const ProgramReader& program, const MachineDescription& machine,
                         const InterpreterOptions& options, const GrblTarget& target, bool waits)
    : code_(target), checker_(program.again(), machine, options, unheard_), waits_(waits) {
  checker_.watch([this](const PathItem& item) { add(item); });
  checker_.watch_operations([this, tools = options.tools](const Operation& operation) {
    words_.watch(operation, tools);
    if (from_line_ == 0 && listener_) listener_(operation);
  });
}

void GrblProgram::begin_at(const Reentry& way) {
  for (const PathItem& item : way.lead_in) write(item);
  from_line_ = way.at.line;
}

std::optional<GrblProgram::Line> GrblProgram::next() {
  while (!stop_ && !ended()) {
    if (ready_.empty()) {
      ended_ = checker_.go_on(1);
      if (ended_) ready_.push_back({.line = {.text = GrblCode::wait_for_rest}});
      continue;
    }
    Ready next = std::move(ready_.front());
    ready_.pop_front();
    stop_ = std::move(next.stop);
    return std::move(next.line);
  }
  return {};
}

void GrblProgram::add(const PathItem& item) {
  if (from_line_ != 0 && !reaches(item)) return;
  write(item);
}

// From the beginning of the line on. What was set before is in the way there.
bool GrblProgram::reaches(const PathItem& item) {
  const auto* segment = std::get_if<Segment>(&item);
  if (segment == nullptr || segment->source.line != from_line_) return false;
  from_line_ = 0;
  Segment to_start = *segment;
  to_start.curve = Curve::line(segment->curve.end(), segment->curve.start());
  write(to_start);
  return true;
}

void GrblProgram::write(const PathItem& item) {
  std::vector<std::string> lines;
  if (!code_.write(item, lines)) return;  // the check has told it
  const std::uint32_t line = GrblCode::source_line(item);
  const auto* action = std::get_if<Action>(&item);
  const Seconds silence = action != nullptr && action->kind == Action::Kind::dwell ? action->dwell : Seconds(0);
  for (std::string& text : lines) {
    ready_.push_back({.line = {.text = std::move(text), .line = line, .silence = silence}});
  }
  if (action == nullptr || !is_program_stop(*action) || !waits_) return;
  const OperatorWait wait{.kind = action->kind, .tool = action->tool, .line = line, .words = words_.at(line)};
  words_.pass(line);
  ready_.push_back({.line = {.text = GrblCode::wait_for_rest, .line = line}, .stop = wait});
}

}  // namespace passo
