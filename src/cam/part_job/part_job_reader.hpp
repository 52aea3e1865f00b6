// PartJobReader: reads the tables of a job file. Private to part_job/.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "passo/part_job/part_job.hpp"
#include "passo/toml/table_reader.hpp"

namespace passo {

std::optional<PartKind> part_kind_of(std::string_view name);
std::vector<std::string_view> names_of_part_kinds();

// Options of the whole program, not of an operation: --for and the operator's texts.
inline bool is_of_program(std::string_view option) {
  return option == "for" || option == "start-text" || option == "tool-change-text" || option == "end-text";
}

class PartJobReader {
 public:
  PartJobReader(const TomlDocument& document, const TomlReporter& reporter, PartJob& job)
      : document_(document), reporter_(reporter), job_(job) {}

  // Errors go to the reporter.
  void read();

 private:
  void read_job(const TomlEntry& entry);
  void read_program_words(const TomlTable& table, TableReader& reader);
  void read_stock(const TomlEntry& entry);
  void read_nest(const TomlEntry& entry);
  void read_tools(const TomlEntry& entry);
  void read_tool(const TomlEntry& entry);
  void read_library(const std::string& path, const SourceLocation& place);
  void find_feeds(PartTool& tool);
  void read_clamp(const TomlTable& table, const std::string& path, const SourceLocation& place);
  void read_operation(const TomlTable& table, const std::string& path, const SourceLocation& place);
  void read_options(const TomlTable& table, TableReader& reader, PartOperation& operation);
  void apply_defaults(PartOperation& operation);
  void apply_tool(PartOperation& operation);
  std::int32_t tool_number(TableReader& reader, std::string_view key, Need need);

  // A number in the job's unit, or a text such as "1/2in". `least`: in mm. In mm.
  std::optional<double> length_of(TableReader& reader, std::string_view key, const TomlValue& value, double least,
                                  const std::string& example) const;
  // A key with two lengths: [x, y]. In mm.
  std::optional<LowHigh> pair(const TomlTable& table, TableReader& reader, std::string_view key, double least,
                              Need need);
  std::optional<double> length(const TomlTable& table, TableReader& reader, std::string_view key, double least,
                               std::string_view example, Need need);
  // The names in a text or a list of texts.
  std::vector<std::string> names(const TomlTable& table, TableReader& reader, std::string_view key);
  std::string in_folder(const std::string& name) const;
  template <class Read>
  void read_list(const TomlEntry& entry, Read read);

  const TomlDocument& document_;
  const TomlReporter& reporter_;
  PartJob& job_;
  double unit_mm_ = 1;
  std::optional<LowHigh> sheet_ = {};  // of [nest], instead of the size of the stock
  TomlTable defaults_;                 // options in [job] for all operations
};

}  // namespace passo
