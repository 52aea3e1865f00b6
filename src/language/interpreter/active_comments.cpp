#include "active_comments.hpp"

#include <algorithm>

#include "comment_text.hpp"
#include "interpreter_sentences.hpp"
#include <fmt/format.h>

namespace passo {

// As LinuxCNC does: what follows ';' is never obeyed, and of several comments in parentheses the last one is.
bool ActiveComments::obey(const Block& block) {
  const BlockComment* last = nullptr;
  for (const BlockComment& comment : block.comments) {
    const bool says_nothing = comment.text.empty() && comment.kind == BlockComment::Kind::plain;
    if (says_nothing || block.text[comment.span.column - 1] == ';') continue;
    if (last != nullptr && last->kind != BlockComment::Kind::plain) {
      reporter_.warning("gcode.hidden-comment", last->span, "only the last active comment of a block is executed",
                        "one active comment per block");
    }
    last = &comment;
  }
  return last == nullptr || obey(*last);
}

bool ActiveComments::obey(const BlockComment& comment) {
  using Kind = BlockComment::Kind;
  using Log = operation::Log;
  const auto filled = [&]() -> std::string_view {
    fill_in_parameters(comment.text, parameters_, symbols_, text_);
    return text_;
  };
  switch (comment.kind) {
    case Kind::plain:
      emit(operation::Comment{
          comment.text.substr(std::min(comment.text.find_first_not_of(" \t"), comment.text.size()))});
      return true;
    case Kind::message: emit_ahead(operation::Message{comment.text}); return true;
    case Kind::debug:
      if (parameters_.get(show_debug_parameter) != 0) emit_ahead(operation::Message{filled()});
      return true;
    case Kind::print: emit_ahead(operation::Print{filled()}); return true;
    case Kind::log: emit_ahead(Log{Log::Kind::line, filled()}); return true;
    case Kind::log_open: emit_ahead(Log{Log::Kind::open, comment.text}); return true;
    case Kind::log_append: emit_ahead(Log{Log::Kind::append, comment.text}); return true;
    case Kind::log_close: emit_ahead(Log{Log::Kind::close, {}}); return true;
    case Kind::abort:
      block_.ended = block_.gave_up = true;
      return fail("gcode.abort", comment.span, interpreter_says::aborts.with({{"words", std::string(filled())}}));
    case Kind::probe_open:
    case Kind::probe_close:  // as rs274 shows them: whole
      emit(operation::Comment{reporter_.block().text.substr(comment.span.column, comment.span.length - 2)});
      return true;
  }
  return true;
}

}  // namespace passo
