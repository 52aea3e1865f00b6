// ApiRoute: the requests of the API, as docs/api/openapi.json describes them. A test holds the two together.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace passo {

// What a request's body is. `bytes`: of any file but JSON.
enum class BodyKind : std::uint8_t { none, json, program, table, bytes };

struct ApiRoute {
  std::string_view method;
  std::string_view path;  // with {id} for a number
  bool moves = false;     // only for the owner of motion
  BodyKind body = BodyKind::none;
};

std::span<const ApiRoute> api_routes();

// The route of a request. Null: there is none; `knows_path` tells whether the path has others.
struct FoundRoute {
  const ApiRoute* route = nullptr;
  std::uint64_t id = 0;
  bool knows_path = false;
};
FoundRoute find_route(std::string_view method, std::string_view path);

}  // namespace passo
