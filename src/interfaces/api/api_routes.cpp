#include "passo/api/api_routes.hpp"

#include <charconv>

namespace passo {
namespace {

constexpr ApiRoute routes[] = {
    {"GET", "/api/v1/alarms"},
    {"GET", "/api/v1/health"},
    {"GET", "/api/v1/history"},
    {"GET", "/api/v1/homing"},
    {"GET", "/api/v1/interrupted"},
    {"GET", "/api/v1/log"},
    {"GET", "/api/v1/machine"},
    {"GET", "/api/v1/machine/file"},
    {"GET", "/api/v1/make"},
    {"GET", "/api/v1/make/page"},
    {"GET", "/api/v1/make/picture"},
    {"GET", "/api/v1/metrics"},
    {"GET", "/api/v1/openapi.json"},
    {"GET", "/api/v1/programs"},
    {"GET", "/api/v1/programs/{id}"},
    {"GET", "/api/v1/programs/{id}/height-map"},
    {"GET", "/api/v1/programs/{id}/path"},
    {"GET", "/api/v1/programs/{id}/text"},
    {"GET", "/api/v1/programs/{id}/way"},
    {"GET", "/api/v1/pulses"},
    {"GET", "/api/v1/queue"},
    {"GET", "/api/v1/status"},
    {"GET", "/api/v1/stream"},
    {"GET", "/api/v1/study"},
    {"GET", "/api/v1/study/loads"},
    {"GET", "/api/v1/study/picture"},
    {"GET", "/api/v1/uploads"},
    {"GET", "/api/v1/uploads/{id}"},
    {"DELETE", "/api/v1/interrupted", true},
    {"DELETE", "/api/v1/make/files"},
    {"DELETE", "/api/v1/owner"},
    {"DELETE", "/api/v1/programs/{id}", true},
    {"DELETE", "/api/v1/queue/{id}", true},
    {"DELETE", "/api/v1/uploads/{id}"},
    {"POST", "/api/v1/hold", false, BodyKind::json},
    {"POST", "/api/v1/home", true},
    {"POST", "/api/v1/interrupted/reenter", true},
    {"POST", "/api/v1/interrupted/resume", true},
    {"POST", "/api/v1/jog", true, BodyKind::json},
    {"POST", "/api/v1/jog/renew", true},
    {"POST", "/api/v1/machine/file", true, BodyKind::json},
    {"POST", "/api/v1/machine/file/draft", false, BodyKind::json},
    {"POST", "/api/v1/make", false, BodyKind::json},
    {"POST", "/api/v1/make/files", false, BodyKind::bytes},
    {"POST", "/api/v1/mdi", true, BodyKind::json},
    {"POST", "/api/v1/operator-done", true},
    {"POST", "/api/v1/outputs", true, BodyKind::json},
    {"POST", "/api/v1/override", true, BodyKind::json},
    {"POST", "/api/v1/owner", false, BodyKind::json},
    {"POST", "/api/v1/owner/renew", true},
    {"POST", "/api/v1/position", true, BodyKind::json},
    {"POST", "/api/v1/probe", true, BodyKind::json},
    {"POST", "/api/v1/programs", false, BodyKind::program},
    {"POST", "/api/v1/programs/{id}/block-delete", false, BodyKind::json},
    {"POST", "/api/v1/programs/{id}/check"},
    {"POST", "/api/v1/programs/{id}/height-map", false, BodyKind::table},
    {"POST", "/api/v1/programs/{id}/level"},
    {"POST", "/api/v1/programs/{id}/run", true},
    {"POST", "/api/v1/queue", false, BodyKind::program},
    {"POST", "/api/v1/queue/{id}/run", true},
    {"POST", "/api/v1/reset", true},
    {"POST", "/api/v1/resume", true},
    {"POST", "/api/v1/sleep", true},
    {"POST", "/api/v1/stop"},
    {"POST", "/api/v1/stops", true, BodyKind::json},
    {"POST", "/api/v1/study", false, BodyKind::json},
    {"POST", "/api/v1/uploads"},
    {"POST", "/api/v1/uploads/{id}", false, BodyKind::program},
    {"POST", "/api/v1/wake", true},
    {"POST", "/api/v1/work", true, BodyKind::json},
};
constexpr std::string_view id_place = "{id}";

bool matches(std::string_view pattern, std::string_view path, std::uint64_t& id) {
  const std::size_t at = pattern.find(id_place);
  if (at == std::string_view::npos) return pattern == path;
  if (!path.starts_with(pattern.substr(0, at))) return false;
  path.remove_prefix(at);
  const auto [end, error] = std::from_chars(path.data(), path.data() + path.size(), id);
  if (error != std::errc()) return false;
  path.remove_prefix(static_cast<std::size_t>(end - path.data()));
  return path == pattern.substr(at + id_place.size());
}

}  // namespace

std::span<const ApiRoute> api_routes() {
  return routes;
}

FoundRoute find_route(std::string_view method, std::string_view path) {
  FoundRoute found;
  for (const ApiRoute& one : routes) {
    if (!matches(one.path, path, found.id)) continue;
    found.knows_path = true;
    if (one.method == method) found.route = &one;
  }
  return found;
}

}  // namespace passo
