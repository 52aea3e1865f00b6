#include "inner_types.hpp"

#include "passo/diagnostics/shown_location.hpp"
#include "passo/interpreter/parameter_file.hpp"
#include "passo/interpreter/tool_table_file.hpp"

namespace passo::v1 {

const char* library_version() {
  return PASSO_VERSION;
}

Finding finding_of(const passo::Diagnostic& diagnostic) {
  const SourceLocation place = shown_location(diagnostic);
  return {.severity = diagnostic.severity == passo::Severity::error ? Severity::error : Severity::warning,
          .code = diagnostic.code,
          .file = diagnostic.file,
          .line = place.line,
          .column = place.column,
          .length = place.column > 0 ? place.length : 0,
          .message = diagnostic.message,
          .expected = diagnostic.expected,
          .text = diagnostic.text};
}

std::vector<Finding> findings_of(const passo::Diagnostics& diagnostics) {
  std::vector<Finding> findings;
  findings.reserve(diagnostics.all().size());
  for (const passo::Diagnostic& diagnostic : diagnostics.all()) findings.push_back(finding_of(diagnostic));
  return findings;
}

Finding error_of(std::string code, std::string file, std::uint32_t line, std::string message, std::string expected) {
  return {.severity = Severity::error,
          .code = std::move(code),
          .file = std::move(file),
          .line = line,
          .column = 0,
          .length = 0,
          .message = std::move(message),
          .expected = std::move(expected),
          .text = {}};
}

std::string describe(const Finding& finding) {
  return passo::render(
      {.severity = finding.severity == Severity::error ? passo::Severity::error : passo::Severity::warning,
       .code = finding.code,
       .file = finding.file,
       .place = {.line = finding.line, .column = finding.column, .length = finding.length},
       .message = finding.message,
       .expected = finding.expected,
       .text = finding.text},
      false);
}

passo::InterpreterOptions interpreter_options_of(const ReadOptions& options, passo::Diagnostics& diagnostics) {
  passo::InterpreterOptions inner;
  inner.dialect = options.dialect == GcodeDialect::grbl ? Dialect::grbl : Dialect::linuxcnc;
  inner.block_delete = options.block_delete;
  inner.units = options.inches ? LengthUnits::inch : LengthUnits::mm;
  inner.sub_folders = options.sub_folders;
  // The errors are in `diagnostics`.
  if (!options.tool_table.empty()) {
    (void)read_tool_table(options.tool_table, LengthUnits::mm, inner.tools, diagnostics);
  }
  if (!options.parameters.empty()) (void)read_parameter_file(options.parameters, inner.parameters, diagnostics);
  return inner;
}

}  // namespace passo::v1
