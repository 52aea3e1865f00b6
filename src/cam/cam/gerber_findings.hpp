// GerberFindings: collects the errors of the command being read, and notes. Private to cam/.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "gerber_text.hpp"

#include "passo/diagnostics/diagnostic.hpp"

namespace passo {

class GerberFindings {
 public:
  GerberFindings(const std::string& file, const GerberText& text, Diagnostics& diagnostics)
      : file_(file), text_(text), diagnostics_(diagnostics) {}

  GerberCommand command;  // the command being read

  // Reports an error; always returns false. `at` and `length` locate it in the command's text; length 0: up to the end.
  bool refuse(std::size_t at, std::size_t length, const char* code, std::string message, std::string expected) {
    return refuse_in(command, at, length == 0 ? command.words.size() - std::min(at, command.words.size()) : length,
                     code, std::move(message), std::move(expected));
  }
  bool refuse_in(const GerberCommand& of, std::size_t at, std::size_t length, const char* code, std::string message,
                 std::string expected) {
    diagnostics_.add({.code = code,
                      .file = file_,
                      .place = text_.place(of, at, length),
                      .message = std::move(message),
                      .expected = std::move(expected),
                      .text = std::string(text_.line_of(of, at))});
    return false;
  }
  // Refuses the command, unless an earlier one was refused for the same reason.
  bool refuse_once(const char* code, const std::string& message, std::string expected) {
    const auto is_same = [&](const Diagnostic& one) { return one.file == file_ && one.message == message; };
    const std::vector<Diagnostic>& all = diagnostics_.all();
    return std::any_of(all.begin(), all.end(), is_same) ? false : refuse(0, 0, code, message, std::move(expected));
  }
  // Adds a note, unless the same note exists already.
  void note(std::string words) {
    if (std::find(notes_.begin(), notes_.end(), words) == notes_.end()) notes_.push_back(std::move(words));
  }
  std::vector<std::string> take_notes() { return std::move(notes_); }
  bool full() const { return diagnostics_.full(); }
  bool any_error() const { return diagnostics_.any_error(); }

 private:
  const std::string& file_;
  const GerberText& text_;
  Diagnostics& diagnostics_;
  std::vector<std::string> notes_;
};

}  // namespace passo
