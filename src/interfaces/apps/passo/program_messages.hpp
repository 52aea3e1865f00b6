// ProgramMessages: shows a program's messages to the operator, (MSG,…), (DEBUG,…) and (PRINT,…), on standard error.
//
// A message is shown when its line is read. The program is read ahead, so the machine may be some seconds behind. For a
// program with endless messages, only as many are shown as the summary keeps.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <utility>

#include "passo/interpreter/operation.hpp"

namespace passo {

class ProgramMessages {
 public:
  // `program` is the file of lines that name none.
  ProgramMessages(std::string program, bool wanted) : program_(std::move(program)), wanted_(wanted) {}
  // `before` is called before a message is shown, to clear the display.
  void show(const Operation& operation, const std::function<void()>& before = {});

 private:
  std::string program_;
  bool wanted_;
  std::size_t shown_ = 0;
};

}  // namespace passo
