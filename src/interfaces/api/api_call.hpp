// ApiCall: a request with its route and its parsed body. Private to api/.
#pragma once

#include <cstdint>

#include <nlohmann/json.hpp>

#include "passo/web/web_server.hpp"

namespace passo {

using Json = nlohmann::ordered_json;

struct ApiCall {
  const WebRequest& request;
  std::uint64_t id = 0;                  // the number in the path
  std::string rest = {};                 // the last part of the path, where the route has any; not decoded
  Json body = Json::value_t::discarded;  // the body if it is a JSON object; otherwise discarded

  // Returns the members of the body; an empty object if there is no body.
  Json members() const { return body.is_object() ? body : Json::object(); }
  std::string_view query(std::string_view key) const { return query_value(request.query, key); }
};

}  // namespace passo
