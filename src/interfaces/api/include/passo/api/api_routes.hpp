// ApiRoute: the requests of the API, one row each: who may ask, what the body is, and which function answers. Nothing
// else compares methods or paths. A test holds the rows and docs/api/openapi.json together, in both directions.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>

namespace passo {

class CamApi;
class JobsApi;
class MachineApi;
class MachineFileApi;
class OwnerApi;
class ProgramsApi;
class StudiesApi;
struct ApiCall;
struct WebAnswer;

template <class Part>
using AnswerOf = WebAnswer (Part::*)(const ApiCall& call);
using ApiHandler = std::variant<AnswerOf<CamApi>, AnswerOf<JobsApi>, AnswerOf<MachineApi>, AnswerOf<MachineFileApi>,
                                AnswerOf<OwnerApi>, AnswerOf<ProgramsApi>, AnswerOf<StudiesApi>>;

// What a request's body is. `bytes`: of any file but JSON.
enum class BodyKind : std::uint8_t { none, json, program, table, bytes };
// What a server may lack. Without it, a request gets 404.
enum class Needs : std::uint8_t { nothing, history, maker, studies };

struct ApiRoute {
  std::string_view method;
  std::string_view path;       // below api_root, with {id} for a number
  std::string_view operation;  // the operationId in openapi.json
  bool moves;                  // only for the owner of motion
  BodyKind body;
  ApiHandler handler;
  Needs needs = Needs::nothing;
};

inline constexpr std::string_view api_root = "/api/v1";

std::span<const ApiRoute> api_routes();

// The route of a request. Null: there is none; `allowed` then has the methods of this path, as "GET, POST".
struct FoundRoute {
  const ApiRoute* route = nullptr;
  std::uint64_t id = 0;
  std::string allowed = {};
};
FoundRoute find_route(std::string_view method, std::string_view path);

}  // namespace passo
