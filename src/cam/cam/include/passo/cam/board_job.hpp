// read_board_job: all files of a circuit board, from files, folders or a zip archive, each with what it is for.
//
// What a file is for is told by its attribute (.FileFunction), or else by its name as layout programs choose names, or
// by what is in it (a drill file). A guess is no fact: show it, and let the user confirm.
//
// At most 1,000 files and 256 MiB, unpacked; an archive that has more is refused before it is unpacked.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "passo/cam/gerber.hpp"

namespace passo {

enum class BoardRole : std::uint8_t { unknown, copper, mask, paste, print, outline, drill, drawing };
enum class BoardSide : std::uint8_t { both, top, bottom, inner };

struct BoardFileKind {
  BoardRole role = BoardRole::unknown;
  BoardSide side = BoardSide::both;
  std::uint32_t copper_layer = 0;  // of inner copper, as the file counts; 0: it does not say
  const char* told_by = "";        // "attribute", "name", "content", or "you": the user has said so
};

// "top copper", "inner copper 2", "outline".
std::string words_for(const BoardFileKind& kind);
// The reverse, without a number. "nothing": the file is not used. Empty: there is no such layer.
std::optional<BoardFileKind> kind_of_words(std::string_view words);
// By .FileFunction: "Copper,L1,Top". Unknown: it says nothing.
BoardFileKind kind_by_function(std::string_view function);
// By the name, without folders.
BoardFileKind kind_by_name(std::string_view name);

struct BoardFile {
  std::string name;  // as the user finds it: "job.zip: gerbers/board-F_Cu.gbr"
  BoardFileKind kind = {};
  std::optional<GerberLayer> layer = {};
  std::optional<Drawing> drills = {};  // of a drill file
  std::string board = {};              // of KiCad, of which this is a layer; empty: the file is a layer of its own
};

// By the name within its folder or archive.
std::string short_name(const BoardFile& file);

struct BoardJob {
  std::vector<BoardFile> files = {};       // those that were read, by role
  std::vector<std::string> left_out = {};  // names of files that are neither Gerber nor drill files
};

// Errors are in `diagnostics`: "board.…" and those of the readers.
BoardJob read_board_job(const std::vector<std::string>& paths, Diagnostics& diagnostics);

// What the user says of a file, by its name or its short one: this kind counts, and no guess. Returns why not; empty:
// done.
std::string set_kind(BoardJob& job, std::string_view name, std::string_view words);

// An error if what is used of the job is of several boards: two of KiCad, or one and files of layers beside it.
void refuse_two_boards(const BoardJob& job, Diagnostics& diagnostics);

// The face of the board: what its outline surrounds, without what is cut out inside. Empty: there is no outline, or it
// is not closed within 0.1 mm.
Region board_face(const BoardJob& job);

}  // namespace passo
