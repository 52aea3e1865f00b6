#include "passo/sender/board_files.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "passo/sender/grbl_reply.hpp"

namespace passo {
namespace {

constexpr std::string_view card = "/sd/";
constexpr std::string_view flash = "/localfs/";
constexpr std::size_t longest_grblhal_name = 40;
constexpr std::size_t most_folders = 16;  // one in the other

bool is_plain(std::string_view text) {
  return !text.empty() && text.size() <= longest_board_path &&
         std::ranges::all_of(text, [](char letter) { return letter >= ' ' && letter <= '~'; });
}

// The line would be cut by what the board reads in the middle of lines.
Status<std::string> check_path(std::string_view path) {
  if (!is_plain(path)) return Failure{std::string("expected a name of printable ASCII, at most 200 characters")};
  const std::size_t wrong = path.find_first_of("?!~\"|[]");
  if (wrong == std::string_view::npos) return Unit{};
  return Failure{fmt::format("expected a name without {}", path[wrong])};
}

// The command of FluidNC for the place of a path.
Result<std::string, std::string> line_in_place(std::string_view command, std::string_view path) {
  if (path.starts_with(flash)) return fmt::format("$LocalFS/{}=/{}", command, path.substr(flash.size()));
  if (path.starts_with(card)) return fmt::format("$SD/{}=/{}", command, path.substr(card.size()));
  return Failure{std::string("expected a path that begins with /sd/ or /localfs/, as the list shows it")};
}

}  // namespace

Result<BoardFiles, std::string> BoardFiles::of(const GrblMachine& machine) {
  if (machine.firmware == "FluidNC") return BoardFiles(true);
  const bool has = machine.has_option("SD") || machine.has_option("FS") || machine.has_option("YM");
  if (machine.firmware == "grblHAL" && has) return BoardFiles(false);
  if (machine.firmware == "grblHAL") {
    return Failure{std::string("this board has no files: its grblHAL was built without the plugin for SD cards")};
  }
  return Failure{fmt::format("this board has no files: {} cannot store any", machine.firmware)};
}

std::vector<std::string> BoardFiles::questions() const {
  if (is_fluidnc_) return {"$SD/List", "$LocalFS/List"};
  return {"$F+"};
}

// "[FILE:/part.nc|SIZE:120]" of grblHAL. FluidNC: "[DIR: parts]", then "[FILE:  part.nc|SIZE:120]": as many blanks as
// folders, and one.
void BoardFiles::hear(std::string_view question, std::span<const std::string> said) {
  const std::string root(!is_fluidnc_ ? "" : question.starts_with("$SD") ? card : flash);
  std::vector<std::string> folders;
  for (std::string_view line : said) {
    if (!line.starts_with('[')) continue;
    line.remove_prefix(1);
    if (line.ends_with(']')) line.remove_suffix(1);
    const bool is_folder = line.starts_with("DIR:");
    if (!is_folder && !line.starts_with("FILE:")) continue;
    line.remove_prefix(is_folder ? 4 : 5);
    std::string_view name = next_grbl_field(line, '|');
    if (!is_fluidnc_) {
      add(std::string(name), line);
      continue;
    }
    const std::size_t blanks = std::min(name.find_first_not_of(' '), name.size());
    name.remove_prefix(blanks);
    const std::size_t depth = is_folder ? blanks : blanks - std::min<std::size_t>(blanks, 1);
    if (depth > folders.size() || depth >= most_folders) continue;
    folders.resize(depth);
    std::string path = root;
    for (const std::string& folder : folders) path += folder + "/";
    path += name;
    if (is_folder) {
      folders.emplace_back(name);
    } else {
      add(std::move(path), line);
    }
  }
}

void BoardFiles::add(std::string path, std::string_view fields) {
  if (files_.size() >= most_board_files || !is_plain(path)) return;
  StoredFile file{.path = std::move(path)};
  while (!fields.empty()) {
    std::string_view value = next_grbl_field(fields, '|');
    const std::string_view name = next_grbl_field(value, ':');
    const auto size = read_grbl_number(value);
    if (name == "SIZE" && size && *size >= 0 && *size < 1e15) file.bytes = static_cast<std::uint64_t>(*size);
    if (name == "UNUSABLE") file.can_run = false;
  }
  file.can_run = file.can_run && check_path(file.path).has_value();
  files_.push_back(std::move(file));
}

Result<std::string, std::string> BoardFiles::run_line(std::string_view path) const {
  if (const auto good = check_path(path); !good) return Failure{good.error()};
  if (!is_fluidnc_) return fmt::format("$F={}{}", path.starts_with('/') ? "" : "/", path);
  return line_in_place("Run", path);
}

// grblHAL: "$FD=" of fs_stream.c; FluidNC: "SD/Delete" of WebCommands.cpp.
Result<std::string, std::string> BoardFiles::remove_line(std::string_view path) const {
  if (const auto good = check_path(path); !good) return Failure{good.error()};
  if (!is_fluidnc_) return fmt::format("$FD={}{}", path.starts_with('/') ? "" : "/", path);
  return line_in_place("Delete", path);
}

Result<std::string, std::string> BoardFiles::upload_line(std::string_view path) const {
  if (const auto good = check_path(path); !good) return Failure{good.error()};
  if (!is_fluidnc_) {
    if (path.size() <= longest_grblhal_name) return std::string();
    return Failure{std::string("expected a name of at most 40 characters")};
  }
  if (path.starts_with(flash)) return fmt::format("$Xmodem/Receive={}", path.substr(flash.size()));
  if (path.starts_with(card)) return fmt::format("$Xmodem/Receive={}", path);
  return Failure{std::string("expected a path that begins with /sd/ or /localfs/")};
}

}  // namespace passo
