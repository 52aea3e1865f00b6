// ApiRoute: the requests of the API, one row each: required rights, body type, and handler function. All dispatch by
// method and path uses this table. A test checks that the rows match docs/api/openapi.json, in both directions.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>

namespace passo {

class BoardFilesApi;
class CamApi;
class CameraApi;
class JobsApi;
class MachineApi;
class MachineFileApi;
class OwnerApi;
class PortsApi;
class ProgramsApi;
class SettingsApi;
class SmallJobsApi;
class StudiesApi;
class ToolsApi;
struct ApiCall;
struct WebAnswer;

template <class Part>
using AnswerOf = WebAnswer (Part::*)(const ApiCall& call);
using ApiHandler = std::variant<AnswerOf<BoardFilesApi>, AnswerOf<CamApi>, AnswerOf<CameraApi>, AnswerOf<JobsApi>,
                                AnswerOf<MachineApi>, AnswerOf<MachineFileApi>, AnswerOf<OwnerApi>, AnswerOf<PortsApi>,
                                AnswerOf<ProgramsApi>, AnswerOf<SettingsApi>, AnswerOf<SmallJobsApi>,
                                AnswerOf<StudiesApi>, AnswerOf<ToolsApi>>;

// The type of a request's body. `bytes`: any file except JSON.
enum class BodyKind : std::uint8_t { none, json, program, table, bytes };
// A service that a server may lack; the request then gets 404.
enum class Needs : std::uint8_t { nothing, camera, history, maker, ports, settings, studies };

struct ApiRoute {
  std::string_view method;
  std::string_view path;       // below api_root, with {id} for a number, and {path} at its end for all that follows
  std::string_view operation;  // operationId in openapi.json
  bool moves;                  // whether only the client in control may send it
  BodyKind body;
  ApiHandler handler;
  Needs needs = Needs::nothing;
};

inline constexpr std::string_view api_root = "/api/v1";

std::span<const ApiRoute> api_routes();

// The route of a request. Null: there is none; `allowed` then lists the methods of this path, e.g. "GET, POST".
struct FoundRoute {
  const ApiRoute* route = nullptr;
  std::uint64_t id = 0;
  std::string rest = {};  // in the place of {path}, not decoded
  std::string allowed = {};
};
FoundRoute find_route(std::string_view method, std::string_view path);

}  // namespace passo
