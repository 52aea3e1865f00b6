// JoinedProgram: joins the programs of a job's operations into one.
//
// Each operation comes as a whole program, as its command writes it. Its tools get the numbers of the job. What one
// operation ends with and the next one begins with is left out where nothing changes: a tool that stays, a spindle that
// runs. All else is kept as it was written.
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
  // The job's number and name of each of the program's tools, which count from 1; in a program without tool changes,
  // of its only tool.
  struct Tool {
    std::int32_t number = 0;
    std::string words = {};
  };
  std::vector<Tool> tools = {};
  std::string park = {};  // "X0 Y0"
};

class JoinedProgram {
 public:
  // `head`: comments, one a line.
  explicit JoinedProgram(const std::vector<std::string>& head);

  void add(const JoinedOperation& operation);
  // Ends the program, and returns its text.
  std::string take();

  // The first line of each operation, from 1; where an operation ends, the next one begins.
  const std::vector<std::uint32_t>& first_lines() const { return first_lines_; }

 private:
  void line(std::string_view text);
  // `up`: the rapid with which the operation begins.
  void change_tool(const JoinedOperation& operation, const JoinedOperation::Tool& tool, std::string_view up);

  std::string text_;
  std::uint32_t lines_ = 0;
  std::vector<std::uint32_t> first_lines_;
  std::int32_t tool_ = -1;  // -1: none yet
  std::string spindle_;     // "M3 S12000"; empty: it is stopped
  std::string park_;
};

}  // namespace passo
