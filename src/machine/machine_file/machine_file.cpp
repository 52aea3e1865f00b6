// The bytes of a machine file.
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <utility>

#include "machine_file_sentences.hpp"
#include "machine_reader.hpp"
#include <fmt/format.h>

#include "passo/machine_file/machine_description.hpp"
#include "passo/machine_file/spindle_bus_description.hpp"
#include "passo/toml/fit_for_parser.hpp"

namespace passo {
namespace {

constexpr std::size_t largest_file = 1U << 20U;

struct FileCloser {
  void operator()(std::FILE* file) const { (void)std::fclose(file); }
};

void file_error(Diagnostics& diagnostics, const char* code, const std::string& file, FindingWords message,
                FindingWords expected) {
  diagnostics.add({.severity = Severity::error,
                   .code = code,
                   .file = file,
                   .place = {},
                   .message = std::move(message),
                   .expected = std::move(expected),
                   .text = {}});
}

// A path that a machine file names. std::filesystem would do it, but WebAssembly has none.
std::string beside(const std::string& machine_file, const std::string& path) {
  const std::size_t slash = machine_file.rfind('/');
  const bool is_here = path.starts_with('/') || slash == std::string::npos;
  return is_here ? path : machine_file.substr(0, slash + 1) + path;
}

}  // namespace

std::optional<std::string> machine_file_text(const std::string& path, Diagnostics& diagnostics) {
  errno = 0;
  const std::unique_ptr<std::FILE, FileCloser> file(std::fopen(path.c_str(), "rb"));
  std::string text(largest_file + 1, '\0');
  if (file != nullptr) text.resize(std::fread(text.data(), 1, text.size(), file.get()));
  if (file == nullptr || std::ferror(file.get()) != 0) {
    file_error(diagnostics, "machine.cannot-read", path, fmt::format("cannot read it: {}", std::strerror(errno)),
               "the path of a machine file");
    return std::nullopt;
  }
  return text;
}

std::optional<MachineDescription> load_machine_file(const std::string& path, Diagnostics& diagnostics, MachineUse use) {
  const auto text = machine_file_text(path, diagnostics);
  if (!text) return std::nullopt;
  auto machine = parse_machine(*text, path, diagnostics, use);
  if (machine && machine->spindle.modbus) {
    auto bus = std::make_shared<SpindleBusDescription>(*machine->spindle.modbus);
    if (bus->has_table_file()) bus->drive = beside(path, bus->drive);
    machine->spindle.modbus = std::move(bus);
  }
  return machine;
}

std::optional<MachineDescription> parse_machine(std::string_view text, const std::string& file,
                                                Diagnostics& diagnostics, MachineUse use) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  if (text.find_first_not_of(" \t\r\n") == std::string_view::npos) {
    file_error(diagnostics, "machine.empty", file, machine_file_says::empty_file,
               "a machine file: name, [board], [axis.X]...");
    return std::nullopt;
  }
  if (text.size() > largest_file) {
    file_error(diagnostics, "machine.too-big", file, fmt::format("the file has more than {} bytes", largest_file),
               "a machine file, usually a page of text");
    return std::nullopt;
  }
  Diagnostics found(most_sorted_errors);
  const TomlReporter reporter(text, file, found);
  MachineDescription machine;
  if (is_fit_for_parser(reporter)) machine = read_machine(parse_toml(std::string(text), reporter), reporter, use);
  hand_over(found, diagnostics);
  if (found.any_error()) return std::nullopt;
  return machine;
}

}  // namespace passo
