#include "passo/path/hand_tool_change.hpp"

#include <charconv>

#include "passo/interpreter/is_any_of.hpp"

namespace passo {
namespace {

void skip_blanks(std::string_view& text) {
  while (text.starts_with(' ')) text.remove_prefix(1);
}

}  // namespace

std::int32_t tool_named_in(std::string_view comment) {
  constexpr std::int32_t largest = 99'999;
  skip_blanks(comment);
  if (comment.starts_with("MSG,")) comment.remove_prefix(4);
  skip_blanks(comment);
  bool has_colon = comment.starts_with("tool:");
  if (!has_colon && !comment.starts_with("tool ")) return 0;
  comment.remove_prefix(5);
  skip_blanks(comment);
  if (has_colon) {
    if (!comment.starts_with('T')) return 0;
    comment.remove_prefix(1);
  }
  std::int32_t tool = 0;
  const auto [end, error] = std::from_chars(comment.data(), comment.data() + comment.size(), tool);
  if (error != std::errc() || tool < 1 || tool > largest) return 0;
  comment.remove_prefix(static_cast<std::size_t>(end - comment.data()));
  has_colon = has_colon ? comment.empty() || comment.front() == ' ' : comment.starts_with(':');
  return has_colon ? tool : 0;
}

void HandToolChange::name(std::int32_t tool) {
  if (tool == 0) return;
  next_ = tool;
  if (!has_fed_ && at_start_ == 0) at_start_ = tool;
}

void HandToolChange::watch(const Operation& operation) {
  using namespace passo::operation;
  const OperationKind& what = operation.what;
  if (is_any_of<StraightFeed, ArcFeed, NurbsFeed, RigidTap>(operation)) {
    has_fed_ = true;
    next_ = 0;
  } else if (is_any_of<ChangeTool, SetToolNumber>(operation)) {
    uses_m6_ = true;
  } else if (const auto* select = std::get_if<SelectTool>(&what)) {
    next_ = select->tool;
  } else if (const auto* comment = std::get_if<Comment>(&what)) {
    name(tool_named_in(comment->text));
  } else if (const auto* message = std::get_if<Message>(&what)) {
    name(tool_named_in(message->text));
  }
}

}  // namespace passo
