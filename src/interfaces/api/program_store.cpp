#include "passo/api/program_store.hpp"

#include <algorithm>
#include <utility>
#include <variant>

#include "passo/activity/placed_tool_change.hpp"
#include "passo/activity/stage_options.hpp"
#include "passo/api/deleted_lines.hpp"
#include "passo/interpreter/saved_offsets.hpp"

namespace passo {
namespace {

constexpr std::uint64_t items_a_turn = 500;
constexpr std::uint64_t lines_a_mark = 256;

// The numbered parameters of G54 in RS274/NGC.

// A parameter that nobody has set counts like one that a program has left as it was.
bool mean_the_same(const SavedParameters& one, const SavedParameters& other) {
  const auto is_in = [](const SavedParameters& all) {
    return [&all](const auto& parameter) {
      const double usual = parameter.first == work_system_parameter ? 1 : 0;
      const auto found = all.find(parameter.first);
      return parameter.second == (found == all.end() ? usual : found->second);
    };
  };
  return std::ranges::all_of(one, is_in(other)) && std::ranges::all_of(other, is_in(one));
}

}  // namespace

std::string_view name_of(UploadState state) {
  switch (state) {
    case UploadState::unchecked: return "unchecked";
    case UploadState::checking: return "checking";
    case UploadState::good: return "good";
    case UploadState::bad: return "bad";
  }
  return "";
}

std::string_view StoredProgram::lines_from(std::uint64_t from, std::uint64_t count) const {
  const std::string_view all = text;
  const std::uint64_t first = std::max<std::uint64_t>(from, 1) - 1;
  if (first >= lines) return {};
  std::size_t at = line_starts[static_cast<std::size_t>(first / lines_a_mark)];
  for (std::uint64_t i = 0; i < first % lines_a_mark; ++i) at = all.find('\n', at) + 1;
  std::size_t end = at;
  for (std::uint64_t i = 0; i < count && end < all.size(); ++i) end = std::min(all.find('\n', end), all.size() - 1) + 1;
  return all.substr(at, end - at);
}

std::string StoredProgram::text_to_keep() const {
  return block_delete ? with_deleted_lines_as_comments(text) : text;
}

const StoredProgram* ProgramStore::add(std::string name, Dialect dialect, std::string text) {
  if (programs_.size() >= most_programs || text.size() > longest_program || bytes_ + text.size() > most_bytes) {
    return nullptr;
  }
  bytes_ += text.size();
  const std::uint64_t id = ++last_id_;
  StoredProgram& program = programs_[id];
  program.id = id;
  program.name = std::move(name);
  program.dialect = dialect;
  for (std::size_t at = 0; at < text.size(); at = std::min(text.find('\n', at), text.size() - 1) + 1) {
    if (program.lines++ % lines_a_mark == 0) program.line_starts.push_back(at);
  }
  program.deleted_lines = dialect == Dialect::grbl ? 0 : count_deleted_lines(text);
  program.text = std::move(text);
  return &program;
}

const StoredProgram* ProgramStore::add_small(std::string name, std::string text) {
  const StoredProgram* const program = add(std::move(name), Dialect::linuxcnc, std::move(text));
  if (program != nullptr) programs_.at(program->id).is_small = true;
  return program;
}

const StoredProgram* ProgramStore::find(std::uint64_t id) const {
  const auto found = programs_.find(id);
  return found == programs_.end() ? nullptr : &found->second;
}

bool ProgramStore::remove(std::uint64_t id) {
  const auto found = programs_.find(id);
  if (found == programs_.end()) return false;
  if (checked_ == id) checker_.reset();
  bytes_ -= found->second.text.size();
  programs_.erase(found);
  return true;
}

InterpreterOptions ProgramStore::options_of(const StoredProgram& program) const {
  InterpreterOptions options = options_of(program.dialect);
  options.block_delete = program.block_delete;
  return options;
}

InterpreterOptions ProgramStore::options_of(Dialect dialect) const {
  InterpreterOptions options;
  options.dialect = dialect;
  options.parameters = parameters_;
  begin_with_g54(options.parameters);
  options.tools = tools_;
  options.sub_folders = sub_folders_;
  return options;
}

void ProgramStore::set_block_delete(std::uint64_t id, bool leaves_out) {
  const auto found = programs_.find(id);
  if (found == programs_.end() || found->second.block_delete == leaves_out) return;
  if (checked_ == id) checker_.reset();
  found->second.block_delete = leaves_out;
  forget_check(found->second);
}

void ProgramStore::set_height_map(std::uint64_t id, HeightMap map) {
  const auto found = programs_.find(id);
  if (found != programs_.end()) found->second.height_map = std::move(map);
}

void ProgramStore::set_planned_time(std::uint64_t id, Seconds time) {
  const auto found = programs_.find(id);
  if (found != programs_.end()) found->second.planned_time = time;
}

void ProgramStore::check(std::uint64_t id, const MachineDescription& machine, const Point& start) {
  const auto found = programs_.find(id);
  if (found == programs_.end()) return;
  if (checker_) {
    if (const auto before = programs_.find(checked_); before != programs_.end()) {
      before->second.state = UploadState::unchecked;
    }
    checker_.reset();
  }
  StoredProgram& program = found->second;
  const bool is_known = program.state == UploadState::good && program.checked_from == start;
  if (is_known && program.path_points.complete()) return;
  ++program.checks;
  program.checked_from = start;
  program.findings.clear();
  program.planned_time.reset();
  program.path_points = ProgramPath();
  program.outline = JobOutline();
  program.changes_tools_by_moves = false;
  make_room_for_path(id);
  program.state = UploadState::checking;
  InterpreterOptions options = options_of(program);
  options.start = start;
  checked_ = id;
  checker_ = std::make_unique<ProgramChecker>(ProgramReader::from_text(program.name, program.text), machine, options,
                                              program.findings);
  path_ = PathFingerprint();
  judge_ = new_judge_ ? new_judge_() : nullptr;
  cuts_.emplace(motion_limits(machine), lives_ ? lives_() : LivesLeft());
  told_.clear();
  checker_->watch_operations([stored = &program, &machine](const Operation& operation) {
    stored->changes_tools_by_moves = stored->changes_tools_by_moves || is_placed_tool_change(operation, machine);
  });
  checker_->watch([this, stored = &program](const PathItem& item) {
    stored->path_points.add(item, checker_->frame());
    stored->outline.add(item);
    path_.add(item);
    cuts_->add(item);
    if (judge_) judge(item, *stored);
  });
}

// Each objection once, at the first line that gives cause for it.
void ProgramStore::judge(const PathItem& item, StoredProgram& program) {
  const auto good = judge_(item);
  if (good || std::ranges::find(told_, good.error()) != told_.end()) return;
  told_.push_back(good.error());
  const std::uint32_t line = std::visit([](const auto& one) { return one.source.line; }, item);
  program.findings.add({.code = "grbl.cannot",
                        .file = program.name,
                        .place = {.line = line, .column = 0},
                        .message = "a machine with Grbl cannot do this: " + good.error(),
                        .expected = "",
                        .text = ""});
}

void ProgramStore::make_room_for_path(std::uint64_t id) {
  std::size_t bytes = 0;
  for (const auto& [other, program] : programs_) bytes += program.path_points.bytes();
  for (auto& [other, program] : programs_) {
    if (bytes + programs_.at(id).text.size() <= most_path_bytes / 2) return;
    bytes -= program.path_points.bytes();
    program.path_points = ProgramPath();
  }
}

Frame ProgramStore::work_frame() const {
  Frame frame;
  frame.follow({operation::SetWorkOffset{.offset = saved_point(parameters_, work_offset_parameter(1))}, {}});
  frame.follow({operation::SetRotation{saved_value(parameters_, rotation_parameter(1))}, {}});
  return frame;
}

void ProgramStore::set_work_zero(const Point& zero) {
  for (std::size_t i = 0; i < axis_count; ++i)
    parameters_[work_offset_parameter(1) + static_cast<int>(i)] = zero.values[i];
  forget_checks();
}

void ProgramStore::set_offsets(const SavedParameters& parameters, const ToolTable& tools) {
  const bool change_nothing = mean_the_same(parameters, parameters_) && tools == tools_;
  parameters_ = parameters;
  tools_ = tools;
  if (!change_nothing) forget_checks();
}

void ProgramStore::forget_checks() {
  checker_.reset();
  for (auto& [id, program] : programs_) forget_check(program);
}

void ProgramStore::forget_check(StoredProgram& program) {
  program.state = UploadState::unchecked;
  program.planned_time.reset();
  program.path_points = ProgramPath();
}

void ProgramStore::poll() {
  if (!checker_ || !checker_->go_on(items_a_turn)) return;
  StoredProgram& program = programs_.at(checked_);
  program.check = checker_->result();
  program.path_points.finish();
  program.path = path_.value();
  if (program.check.good) cuts_->add_findings(program.name, program.findings);
  program.state = program.check.good && !program.findings.any_error() ? UploadState::good : UploadState::bad;
  checker_.reset();
}

}  // namespace passo
