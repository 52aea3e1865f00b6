#include "passo/cam/board_job.hpp"

#include <algorithm>
#include <filesystem>
#include <tuple>

#include "zip_files.hpp"
#include <fmt/format.h>

#include "passo/cam/board_layer.hpp"
#include "passo/cam/design_board.hpp"
#include "passo/cam/excellon.hpp"
#include "passo/diagnostics/file_bytes.hpp"

namespace passo {
namespace {

namespace fs = std::filesystem;

constexpr int deepest_folder = 4;

class JobReader {
 public:
  explicit JobReader(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  void read(const std::string& path);
  // `path`: what the job is called where nothing is in it.
  BoardJob take(const std::string& path);

 private:
  void read_folder(const std::string& path);
  void read_file(const std::string& path);
  void add(const std::string& name, const std::string& bytes);
  void add_design(const std::string& name, const std::string& bytes);
  bool has_room_for(const std::string& path, std::size_t bytes);

  Diagnostics& diagnostics_;
  BoardJob job_;
  std::size_t files_ = 0;
  std::size_t bytes_ = 0;
};

bool JobReader::has_room_for(const std::string& path, std::size_t bytes) {
  ++files_;
  bytes_ += bytes;
  if (files_ <= most_board_files && bytes_ <= most_board_bytes) return true;
  diagnostics_.add(
      of_file("board.too-large", path, "with this file, the job exceeds 1,000 files or 256 MiB", "one board"));
  return false;
}

void JobReader::read(const std::string& path) {
  std::error_code none;
  if (fs::is_directory(path, none)) {
    read_folder(path);
  } else {
    read_file(path);
  }
}

void JobReader::read_folder(const std::string& path) {
  std::vector<std::string> names;
  std::error_code failed;
  for (fs::recursive_directory_iterator at(path, failed), end; !failed && at != end; at.increment(failed)) {
    if (at.depth() >= deepest_folder) at.disable_recursion_pending();
    std::error_code none;
    if (!at->is_regular_file(none)) continue;
    names.push_back(at->path().string());
    if (names.size() > most_board_files) break;
  }
  if (failed) {
    diagnostics_.add(of_file("board.unreadable", path, "cannot be read: " + failed.message(), "a folder of a board"));
    return;
  }
  std::ranges::sort(names);
  for (const std::string& name : names) {
    if (diagnostics_.full() || files_ > most_board_files || bytes_ > most_board_bytes) return;
    read_file(name);
  }
}

void JobReader::read_file(const std::string& path) {
  const std::optional<std::string> bytes = read_bytes(
      path,
      {.area = "board",
       .expected = "a Gerber file, a drill file, a board of KiCad, EAGLE or EasyEDA, a folder or a zip archive"},
      diagnostics_);
  if (!bytes || !has_room_for(path, bytes->size())) return;
  if (!looks_like_zip(*bytes)) return add(path, *bytes);
  for (const NamedBytes& file : read_zip(path, diagnostics_)) {
    if (!has_room_for(path, file.bytes.size())) return;
    add(path + ": " + file.name, file.bytes);
  }
}

void JobReader::add(const std::string& name, const std::string& bytes) {
  BoardFile file;
  file.name = name;
  if (looks_like_gerber(bytes)) {
    file.layer = read_gerber(name, bytes, diagnostics_);
    file.kind = kind_by_function(file.layer->function);
    if (file.kind.role == BoardRole::unknown) file.kind = kind_by_name(fs::path(name).filename().string());
  } else if (looks_like_design_board(bytes)) {
    add_design(name, bytes);
    return;
  } else if (looks_like_excellon(bytes)) {
    file.drills = read_excellon(name, bytes, {}, diagnostics_);
    file.kind = {BoardRole::drill, BoardSide::both, 0, "content"};
  } else {
    job_.left_out.push_back(name);
    return;
  }
  job_.files.push_back(std::move(file));
}

// Each layer is a file of the job. Copper with nothing on it is none.
void JobReader::add_design(const std::string& name, const std::string& bytes) {
  DesignBoard board = read_design_board(name, bytes, diagnostics_);
  const auto add_layer = [&](const std::string& layer, BoardFileKind kind, GerberLayer content) {
    kind.told_by = "content";
    job_.files.push_back({name + ": " + layer, kind, std::move(content), {}, name});
  };
  std::uint32_t number = 0;  // as in the attributes of Gerber files
  for (DesignLayer& one : board.copper) {
    ++number;
    if (one.layer.dark.empty() && one.layer.strokes.notes.empty()) continue;
    const auto is_one_of = [&](std::initializer_list<const char*> names) {
      return std::ranges::find(names, one.name) != names.end();
    };
    const BoardSide side = is_one_of({"F.Cu", "Top", "TopLayer"})         ? BoardSide::top
                           : is_one_of({"B.Cu", "Bottom", "BottomLayer"}) ? BoardSide::bottom
                                                                          : BoardSide::inner;
    add_layer(one.name, {BoardRole::copper, side, side == BoardSide::inner ? number : 0U}, std::move(one.layer));
  }
  if (!board.edge.strokes.paths.empty()) add_layer(board.edge_name, {BoardRole::outline}, std::move(board.edge));
  if (board.drills.holes.empty() && board.drills.paths.empty()) return;
  job_.files.push_back(
      {name + ": holes", {BoardRole::drill, BoardSide::both, 0, "content"}, {}, std::move(board.drills), name});
}

BoardJob JobReader::take(const std::string& path) {
  // Copper from the top down, then what lies on it, then what is unknown.
  const auto rank = [](const BoardFile& file) {
    constexpr int sides[] = {3, 0, 2, 1};
    const int side = sides[static_cast<int>(file.kind.side)];
    const int role = file.kind.role == BoardRole::unknown ? 99 : static_cast<int>(file.kind.role);
    return std::tuple(role, side, file.kind.copper_layer);
  };
  std::stable_sort(job_.files.begin(), job_.files.end(),
                   [&](const BoardFile& a, const BoardFile& b) { return rank(a) < rank(b); });
  if (job_.files.empty() && !diagnostics_.any_error()) {
    diagnostics_.add(of_file("board.no-layers", job_.left_out.empty() ? path : job_.left_out.front(),
                             "there is no Gerber file, drill file or board of KiCad, EAGLE or EasyEDA",
                             "the files that the layout program exports"));
  }
  return std::move(job_);
}

}  // namespace

BoardJob read_board_job(const std::vector<std::string>& paths, Diagnostics& diagnostics) {
  JobReader reader(diagnostics);
  for (const std::string& path : paths) reader.read(path);
  return reader.take(paths.empty() ? "" : paths.front());
}

void refuse_two_boards(const BoardJob& job, Diagnostics& diagnostics) {
  const auto is_used = [](const BoardFile& file) {
    return file.kind.role == BoardRole::drill || file.kind.role == BoardRole::outline ||
           (file.kind.role == BoardRole::copper && file.kind.side != BoardSide::inner);
  };
  const auto whole =
      std::ranges::find_if(job.files, [&](const BoardFile& file) { return is_used(file) && !file.board.empty(); });
  if (whole == job.files.end()) return;
  const auto other = std::ranges::find_if(
      job.files, [&](const BoardFile& file) { return is_used(file) && file.board != whole->board; });
  if (other == job.files.end()) return;
  diagnostics.add(of_file("board.two-boards", other->name,
                          fmt::format("this file does not belong to '{}', which is a whole board", whole->board),
                          "one board: its own file, or the folder with its layers"));
}

Region board_face(const BoardJob& job) {
  const auto is_outline = [](const BoardFile& file) { return file.kind.role == BoardRole::outline && file.layer; };
  const auto file = std::find_if(job.files.begin(), job.files.end(), is_outline);
  if (file == job.files.end()) return {};
  constexpr Nanometres usual_join{100'000};
  Diagnostics open_ends;
  const BoardEdge edge = board_edge({file->layer->dark, file->layer->strokes}, usual_join, open_ends);
  return open_ends.any_error() ? Region{} : edge.board;
}

}  // namespace passo
