// What clients of HTTP and of the stream ask, on a whole API around a session on a virtual machine: each answer has a
// status of HTTP, and all JSON is JSON. (web_fuzz has the bytes of HTTP itself.)
//
// Requests are divided by the byte 1E. A request is a path, perhaps with a query, a line end, and a body. Before it
// stands a byte: a control character chooses a path of the API's own; 'W' says that the rest is a message of the
// stream; others choose the method and whether the key of the motion's owner comes along.
#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>

#include "kit/fuzzed_machine.hpp"
#include <nlohmann/json.hpp>

#include "passo/api/api_routes.hpp"
#include "passo/api/web_api.hpp"

namespace passo::test {
namespace {

constexpr char divides = '\x1E';
constexpr int turns_of_request = 20;
constexpr const char* key = "key";

class Bench {
 public:
  void take(std::string_view request) {
    if (request.empty()) return;
    const char first = request.front();
    request.remove_prefix(1);
    if (first == 'W') {
      require(nlohmann::json::accept(api_.hear(request, 1)), "an answer that is no JSON");
    } else {
      look(api_.answer(read(first, request)));
    }
    for (int i = 0; i < turns_of_request; ++i) poll();
  }
  void poll() {
    world_.session.poll(Seconds(0.01));
    api_.on_change(world_.session.take_changes());
    api_.poll();
  }

 private:
  static WebRequest read(char first, std::string_view text) {
    const std::size_t line = std::min(text.find('\n'), text.size());
    std::string target(text.substr(0, line));
    WebRequest request{.key = (first & 1) != 0 ? key : ""};
    request.body = text.substr(std::min(line + 1, text.size()));
    static constexpr const char* methods[] = {"POST", "GET", "DELETE", "PUT"};
    request.method = methods[(first >> 1) & 3];
    if (!target.empty() && static_cast<unsigned char>(target.front()) >= 0x80) {
      const auto routes = api_routes();
      const ApiRoute& route = routes[static_cast<unsigned char>(target.front()) % routes.size()];
      request.method = route.method;
      std::string path = std::string(api_root) + std::string(route.path);
      if (const std::size_t id = path.find("{id}"); id != std::string::npos) path.replace(id, 4, "1");
      target.replace(0, 1, path);
    }
    const std::size_t mark = std::min(target.find('?'), target.size());
    request.path = target.substr(0, mark);
    request.query = target.substr(std::min(mark + 1, target.size()));
    return request;
  }
  static void look(const WebAnswer& answer) {
    require(answer.status >= 200 && answer.status < 600, "a status that HTTP does not know");
    if (answer.type != "application/json") return;
    require(nlohmann::json::accept(answer.body), "an answer that is no JSON");
  }

  FuzzedSession world_{Trust::commanded};
  MachineControl owner_;
  WebApi api_{
      fuzzed_machine(), world_.session, owner_, {.version = "1", .openapi = "{}", .make_key = [] { return key; }}};
};

void check_requests(std::string_view input) {
  Bench bench;
  while (!input.empty()) {
    const std::size_t end = std::min(input.find(divides), input.size());
    bench.take(input.substr(0, end));
    input.remove_prefix(std::min(end + 1, input.size()));
  }
}

}  // namespace
}  // namespace passo::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  passo::test::check_requests({reinterpret_cast<const char*>(data), size});
  return 0;
}
