// JoinedProgram: joins the programs of a job's operations into one.
//
// Each operation is a complete program, as its command writes it. Its tools get the numbers of the job. The words
// between two operations are omitted where nothing changes: the tool stays in the spindle, the spindle keeps running.
// Everything else is kept as it was written.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace passo {

struct JoinedOperation {
  std::string title = {};
  std::string program = {};
  // The job's number and name for each tool of the program, in the program's order from 1; in a program without tool
  // changes, for its only tool.
  struct Tool {
    std::int32_t number = 0;
    std::string words = {};
  };
  std::vector<Tool> tools = {};
  std::string park = {};  // "X0 Y0"
};

class JoinedProgram {
 public:
  // in_spindle: all operations have the same tool, which the operator has inserted before the start. The program names
  // it in a message, and has no T word.
  enum class Tools : std::uint8_t { changed, in_spindle };
  // `head`: comments, one per line.
  explicit JoinedProgram(const std::vector<std::string>& head, Tools tools = Tools::changed);

  void add(const JoinedOperation& operation);
  // Ends the program, and returns its text.
  std::string take();

  // The first line of each operation, from 1. An operation ends where the next one begins.
  const std::vector<std::uint32_t>& first_lines() const { return first_lines_; }

 private:
  void line(std::string_view text);
  // `up`: the rapid with which the operation begins.
  void change_tool(const JoinedOperation& operation, const JoinedOperation::Tool& tool, std::string_view up);
  void stop_coolant();

  Tools tools_;
  std::string text_;
  std::uint32_t lines_ = 0;
  std::vector<std::uint32_t> first_lines_;
  std::int32_t tool_ = -1;  // -1: none yet
  std::string spindle_;     // "M3 S12000"; empty: it is stopped
  std::string coolant_;     // "M7" or "M8"; empty: it is off
  std::string park_;
};

}  // namespace passo
