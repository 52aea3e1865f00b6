// BoardPage: what `passo cam board` has made, as one page in HTML that says what to do when.
//
// The page is a single file: it needs no network and runs no script, and all that comes from files is escaped.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "passo/units/units.hpp"

namespace passo {

struct BoardStep {
  // For programs that have words of their own: "blank", "drill", "heights-front", "heights-back", "front", "turn",
  // "find-holes", "back" or "edge".
  std::string kind = {};
  std::string title = {};               // "Mill the front"
  std::string program = {};             // its file; empty: a step without a program
  std::vector<std::string> tools = {};  // in the order in which they are used
  std::vector<std::string> words = {};  // what to do, a sentence each
  std::string figures = {};             // what was measured, a line each
  std::optional<Seconds> time = {};     // empty: unknown
  std::string picture = {};             // SVG; empty: none
};

struct BoardPageFile {
  std::string name;
  std::string short_name;  // within its folder or archive
  std::string layer;       // "top copper"
  std::string told_by;
  bool is_drill_file = false;
};
std::string words_for(const BoardPageFile& file);

struct BoardPage {
  std::string name;
  std::string machine;                // for which the times are; empty: none
  std::vector<BoardPageFile> files;   // what was read, and as what
  std::vector<std::string> left_out;  // names
  double width = 0;                   // mm, of the board
  double height = 0;
  double margin = 0;         // mm, of its lower left corner from X0 and from Y0
  const char* up = "front";  // the side that is up at first, or "back"
  const char* turn = "";     // "x" or "y"; empty: it is not turned over
  const char* holes = "";    // two beside the board: "pins" or "probe"; empty: none
  std::vector<BoardStep> steps;
};

std::string to_html(const BoardPage& page);
std::string to_json(const BoardPage& page);

}  // namespace passo
