// TableReader: one table of a TOML file that a user writes, key by key: a machine file, a tool library, an option
// profile.
//
// The caller reads each key that the table may have. Any other key is an error and is reported with the nearest known
// key. Missing required keys are reported together, in one diagnostic for the table. An absent or invalid value gives
// an empty optional.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "passo/toml/toml_document.hpp"
#include "passo/toml/toml_reporter.hpp"
#include "passo/toml/toml_sentences.hpp"

namespace passo {

// A key with a numeric value: its range (both ends included), and an example for messages.
struct NumberKey {
  std::string_view name;
  double least = 0;
  double most = 0;
  std::string_view example;
};

enum class Need { required, optional };

struct LowHigh {
  double low = 0;
  double high = 0;
};

class TableReader {
 public:
  // `path` is the table's name in the file ("axis.X"; empty for the top of the file). An absent table is read as an
  // empty one.
  TableReader(const TomlTable& table, std::string path, const SourceLocation& place, const TomlReporter& reporter);

  bool has(std::string_view key) const { return find(table_, key) != nullptr; }
  bool has_text(std::string_view key) const;
  SourceLocation place_of(std::string_view key) const;  // the position of its value; that of the table if there is no
                                                        // value

  std::optional<double> number(const NumberKey& key, Need need);
  // Reads a number without reporting errors; another reader of this table reports them.
  std::optional<double> peek(const NumberKey& key) const;
  std::optional<double> whole_number(const NumberKey& key, Need need);
  // Reads a list of two numbers in the key's range.
  std::optional<LowHigh> low_high(const NumberKey& key, Need need);
  // Reads a required list of such lists: [[a, b], [c, d]].
  std::optional<std::vector<LowHigh>> pairs(const NumberKey& key);
  // Marks a key as known that this reader does not read.
  void know(std::string_view key) { known_.push_back(key); }
  std::optional<bool> flag(std::string_view key);
  std::optional<std::string> text(std::string_view key, std::string_view example, Need need);
  // Reads a value that must be one of two words. An absent optional value counts as the first word.
  std::optional<bool> is_second_of(std::string_view code, std::string_view key, std::string_view first,
                                   std::string_view second, Need need);
  // Reads a list of at most `most` such words; true for the second word.
  std::vector<bool> are_second_of(std::string_view code, std::string_view key, std::string_view first,
                                  std::string_view second, std::size_t most);
  // Returns a table inside this one. `what` describes it for messages.
  const TomlEntry* table(std::string_view key, std::string_view what, Need need);

  void error(std::string_view code, std::string_view key, const FindingWords& message,
             const FindingWords& expected) const;
  void missing(std::string_view key, std::string example);

  // Reports unknown keys, and missing keys if `report_missing` (the whole file could be read). `top_keys` are top-level
  // keys that users often write below a [table] by mistake.
  void finish(bool report_missing, const std::vector<std::string_view>& top_keys);

  std::string full_name(std::string_view key) const;

 private:
  struct MissingKey {
    std::string_view name;
    std::string example;
  };

  const TomlEntry* ask(std::string_view key, std::string example, Need need);
  std::optional<LowHigh> pair_of(const NumberKey& key, const TomlValue& value, const std::string& expected) const;
  void wrong_type(const TomlEntry& entry, std::string expected) const;
  bool in_range(const NumberKey& key, double value, const SourceLocation& place) const;
  void report_unknown(const TomlEntry& entry, const std::vector<std::string_view>& top_keys);
  void forgive_missing(std::string_view key);
  void report_missing_keys() const;

  const TomlTable& table_;
  std::string path_;
  SourceLocation place_;
  const TomlReporter& reporter_;
  std::vector<std::string_view> known_;
  std::vector<MissingKey> missing_;
};

}  // namespace passo
