#include "passo/part_job/joined_program.hpp"

#include <algorithm>
#include <charconv>

#include <fmt/format.h>

namespace passo {
namespace {

// The lines of an operation's program, as they appear in the joined program.
class OperationLines {
 public:
  explicit OperationLines(std::string_view program) : rest_(program) {}

  bool next(std::string_view& line) {
    if (rest_.empty()) return false;
    const std::size_t end = std::min(rest_.find('\n'), rest_.size());
    line = rest_.substr(0, end);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    return true;
  }
  // The next line, which stays.
  std::string_view peek() const { return rest_.substr(0, std::min(rest_.find('\n'), rest_.size())); }

 private:
  std::string_view rest_;
};

bool is_comment(std::string_view line) {
  return line.starts_with('(');
}

// The number of "T2 M6"; 0: this is no tool change.
std::size_t changed_tool(std::string_view line) {
  if (!line.starts_with('T') || !line.ends_with(" M6")) return 0;
  std::size_t number = 0;
  const std::string_view digits = line.substr(1, line.size() - 4);
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  return error == std::errc() && end == digits.data() + digits.size() ? number : 0;
}

std::string comment_of(std::string_view words) {
  std::string text(words.substr(0, 120));
  for (char& c : text) {
    if (c == '(' || c == ')' || c == '%' || static_cast<unsigned char>(c) < ' ') c = '_';
  }
  return "(" + text + ")";
}

}  // namespace

JoinedProgram::JoinedProgram(const std::vector<std::string>& head, Tools tools) : tools_(tools) {
  for (const std::string& words : head) line(comment_of(words));
}

void JoinedProgram::line(std::string_view text) {
  text_ += text;
  text_ += '\n';
  ++lines_;
}

void JoinedProgram::change_tool(const JoinedOperation& operation, const JoinedOperation::Tool& tool,
                                std::string_view up) {
  if (tool.number == tool_) return;
  stop_coolant();
  if (!spindle_.empty()) line("M5");
  spindle_.clear();
  if (tool_ != -1) line("G0 " + operation.park);
  line(comment_of(fmt::format("MSG, tool {}: {}", tool.number, tool.words)));
  tool_ = tool.number;
  if (tools_ == Tools::in_spindle) return;
  line(fmt::format("T{} M6", tool.number));
  line(up);
}

void JoinedProgram::stop_coolant() {
  if (!coolant_.empty()) line("M9");
  coolant_.clear();
}

void JoinedProgram::add(const JoinedOperation& operation) {
  line("");
  first_lines_.push_back(lines_);
  line(comment_of(operation.title));
  OperationLines lines(operation.program);
  std::string_view text;
  std::string_view up;     // the first rapid
  bool has_begun = false;  // with the line of modes
  if (operation.program.find("\nM7\n") == std::string::npos && operation.program.find("\nM8\n") == std::string::npos) {
    stop_coolant();
  }
  const bool has_changes = operation.program.find(" M6\n") != std::string::npos;
  park_ = operation.park;
  while (lines.next(text)) {
    has_begun = has_begun || (!text.empty() && !is_comment(text));
    if (!has_begun || text.empty() || text.starts_with("(MSG, tool") || text.starts_with("(tool ")) continue;
    if (text == "M2" || text == "M5" || text == "M9") continue;
    if (text == "M7" || text == "M8") {
      if (text == coolant_) continue;
      stop_coolant();
      coolant_ = text;
    }
    // The end of the program, or the move to a tool change.
    const bool is_before_end = text == "G0 " + operation.park && (lines.peek() == "M2" || is_comment(lines.peek()));
    if (is_before_end) continue;
    if (const std::size_t number = changed_tool(text); number > 0) {
      change_tool(operation, operation.tools[std::min(number, operation.tools.size()) - 1], up);
      continue;
    }
    if (text.starts_with("M3 ") || text.starts_with("M4 ")) {
      const bool runs = text == spindle_;
      spindle_ = text;
      if (!runs) {
        line(text);
      } else if (lines.peek().starts_with("G4 ")) {
        static_cast<void>(lines.next(text));
      }
      continue;
    }
    line(text);
    if (up.empty() && text.starts_with("G0 Z")) {
      up = text;
      if (!has_changes) change_tool(operation, operation.tools.back(), up);
    }
  }
}

std::string JoinedProgram::take() {
  line("");
  stop_coolant();
  if (!spindle_.empty()) line("M5");
  line("G0 " + park_);
  line("M2");
  return std::move(text_);
}

}  // namespace passo
