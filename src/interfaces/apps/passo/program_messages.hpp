// ProgramMessages: shows the texts by which a program speaks to the operator, (MSG,…), (DEBUG,…) and (PRINT,…), on
// standard error.
//
// A text is shown when its line is read. The program is read ahead, so the machine may be some seconds behind. Of a
// program that talks without end, as many texts are shown as the summary keeps.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <utility>

#include "passo/interpreter/operation.hpp"

namespace passo {

class ProgramMessages {
 public:
  // `program` names the file of lines that name none.
  ProgramMessages(std::string program, bool wanted) : program_(std::move(program)), wanted_(wanted) {}
  // `before` is called before a text is shown, to make room for it.
  void show(const Operation& operation, const std::function<void()>& before = {});

 private:
  std::string program_;
  bool wanted_;
  std::size_t shown_ = 0;
};

}  // namespace passo
