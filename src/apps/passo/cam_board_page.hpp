// BoardPage: what `passo cam board` has made, as one page in HTML that says what to do when.
//
// The page is a single file: it needs no network and runs no script, and all that comes from files is escaped.
#pragma once

#include <string>
#include <vector>

namespace passo {

struct BoardStep {
  std::string title = {};               // "Mill the front"
  std::string program = {};             // its file; empty: a step without a program
  std::vector<std::string> tools = {};  // in the order in which they are used
  std::vector<std::string> words = {};  // what to do, a sentence each
  std::string figures = {};             // what was measured, a line each
  std::string time = {};                // "0:12:31"; empty: unknown
  std::string picture = {};             // SVG; empty: none
};

struct BoardPage {
  std::string name;
  std::string machine;                // for which the times are; empty: none
  std::vector<std::string> files;     // what was read, and as what
  std::vector<std::string> left_out;  // names
  std::vector<BoardStep> steps;
};

std::string to_html(const BoardPage& page);

}  // namespace passo
