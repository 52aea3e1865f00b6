// ImportContext: what the readers of all formats need: the values of a tree as numbers, with an error or an entry of
// the report for each value that is none, and the report itself.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "imported_model.hpp"

#include "passo/machine_import/machine_import.hpp"

namespace passo {

// A conversion to the unit of the machine file: value × factor / divisor.
struct UnitFactor {
  std::int64_t factor = 1;
  std::int64_t divisor = 1;
};

class ImportContext {
 public:
  ImportContext(const ImportSource& source, ImportedMachine& result, Diagnostics& diagnostics)
      : source_(source), result_(result), diagnostics_(diagnostics), errors_before_(diagnostics.errors()) {}

  // From now on a number ends at the first blank: people write a comment or a second number behind it.
  void end_numbers_at_blanks() { numbers_end_at_blanks_ = true; }

  // Marks a node as dealt with: list_rest() leaves it out.
  void mark(const SourceNode& node) { done_.insert(&node); }
  void mark_all(const SourceNode& node);

  // A number that the machine file needs: an error if the text is none. `key` is its full name.
  std::optional<SourcedNumber> number(const SourceNode* node, std::string key, UnitFactor unit = {});
  // A number that it can do without: listed if the text is none.
  std::optional<SourcedNumber> optional_number(const SourceNode* node, std::string key, UnitFactor unit = {});
  // A whole number from 0 to 65535, for masks and switches. Listed if it is none.
  std::optional<unsigned> mask(const SourceNode* node, std::string key);
  // A text for people: printable UTF-8, at most 80 bytes.
  static std::string printable(std::string_view text);

  ValueOrigin origin(const SourceNode& node, std::string key) const {
    return {.key = std::move(key), .value = printable(node.text), .line = node.line, .column = node.column};
  }

  void understood(const ValueOrigin& origin, std::string target);
  void unmapped(const ValueOrigin& origin, std::string reason);
  // Lists a node, if it is there, and marks it.
  void unmapped(const SourceNode* node, std::string key, std::string reason);
  void assumed(std::string target, std::string reason);
  void warn(std::string sentence) { result_.warnings.push_back(std::move(sentence)); }
  // At the place of a value. Line 0: about the file as a whole.
  void error(const char* code, const ValueOrigin& origin, std::string message, std::string expected);
  bool has_failed() const { return diagnostics_.errors() > errors_before_; }

  // Lists all leaves below the node that are not marked. `path` precedes their names.
  void list_rest(const SourceNode& node, const std::string& path, std::string_view separator,
                 const std::string& reason = {});

  ImportedMachine& result() { return result_; }

 private:
  std::optional<SourcedNumber> read(const SourceNode* node, std::string key, UnitFactor unit, bool is_needed);
  std::string line_text(std::uint32_t line) const;

  const ImportSource& source_;
  ImportedMachine& result_;
  Diagnostics& diagnostics_;
  std::size_t errors_before_;
  bool numbers_end_at_blanks_ = false;
  std::set<const SourceNode*> done_;
};

}  // namespace passo
