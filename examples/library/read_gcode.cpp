// Reads a G-code program to operations, and prints its moves and tool changes.
#include <cstdio>

#include <passo/library.hpp>

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("read_gcode PROGRAM\n", stderr);
    return 2;
  }
  const passo::Outcome<passo::Program> program = passo::Program::open(argv[1]);
  if (!program) {
    std::fputs(passo::describe(program.findings().front()).c_str(), stderr);
    return 2;
  }
  passo::OperationReader reader(*program);
  passo::Operation operation;
  while (reader.next(operation)) {
    if (const auto* line = std::get_if<passo::operation::Line>(&operation.what)) {
      const passo::Position end = reader.to_machine(line->end);
      std::printf("%u: %s to %g %g %g, %g mm/s\n", operation.line, line->rapid ? "rapid" : "line", end.x, end.y, end.z,
                  line->feed.value);
    } else if (const auto* arc = std::get_if<passo::operation::Arc>(&operation.what)) {
      std::printf("%u: arc to %g %g %g\n", operation.line, arc->end.x, arc->end.y, arc->end.z);
    } else if (const auto* change = std::get_if<passo::operation::ChangeTool>(&operation.what)) {
      std::printf("%u: tool %d\n", operation.line, change->tool);
    }
  }
  for (const passo::Finding& finding : reader.findings()) std::fputs(passo::describe(finding).c_str(), stderr);
  return reader.any_error() ? 2 : 0;
}
