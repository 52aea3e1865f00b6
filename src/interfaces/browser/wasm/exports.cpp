// "Check my program" as a WebAssembly module. The page writes the request, a JSON text, to where check_room() tells,
// and calls check_program(). That asks the page for the bytes of the files and tells it how far it is: the module has
// no files and no clock of its own. The answer's text, and then each chunk of the path, lies at check_answer().
#include <cstddef>
#include <string>

#include "browser_check.hpp"
#include "browser_import.hpp"

#include "passo/base/browser_host.hpp"

#define PASSO_EXPORT(name) __attribute__((export_name(#name))) name

namespace {

using namespace passo;

std::string& request_text() {
  static std::string text;
  return text;
}
std::string& answer() {
  static std::string text;
  return text;
}
BrowserCheck& one_check() {
  static BrowserCheck check([](CheckStage stage, double share) { host_progress(static_cast<int>(stage), share); });
  return check;
}

}  // namespace

extern "C" {

char* PASSO_EXPORT(check_room)(std::size_t size) {
  request_text().assign(size, '\0');
  return request_text().data();
}
// Checks the program of the request. Returns the length of the answer.
std::size_t PASSO_EXPORT(check_program)() {
  answer().clear();
  answer() = one_check().check(request_text());
  return answer().size();
}
// Makes a machine file of the configuration of another controller. Returns the length of the answer.
std::size_t PASSO_EXPORT(check_import)() {
  answer() = import_in_browser(request_text());
  return answer().size();
}
const char* PASSO_EXPORT(check_answer)() {
  return answer().data();
}
// The length of a chunk of the path; 0: there is none.
std::size_t PASSO_EXPORT(check_path)(std::size_t chunk, unsigned level) {
  const ProgramPath& path = one_check().path();
  answer().clear();
  if (chunk < path.chunks() && level < ProgramPath::levels) answer() = path.chunk(chunk, level);
  return answer().size();
}

}  // extern "C"
