#include "setting_words.hpp"

#include <nlohmann/json.hpp>

namespace passo {

using nlohmann::ordered_json;

ordered_json to_json(const FirmwareSetting& setting) {
  ordered_json json = {{"name", setting.name},         {"value", setting.value}, {"title", setting.title},
                       {"unit", setting.unit},         {"group", setting.group}, {"meaning", setting.meaning},
                       {"kind", name_of(setting.kind)}};
  json["least"] = setting.least ? ordered_json(*setting.least) : ordered_json();
  json["most"] = setting.most ? ordered_json(*setting.most) : ordered_json();
  json["zero_too"] = setting.zero_too;
  json["choices"] = setting.choices;
  json["needs_restart"] = setting.needs_restart;
  json["read_only"] = setting.read_only;
  return json;
}

ordered_json to_json(const SettingChange& change) {
  return {{"name", change.name},   {"before", change.before},           {"wanted", change.wanted},
          {"value", change.after}, {"written", change.trouble.empty()}, {"trouble", change.trouble},
          {"also", change.also}};
}

ordered_json to_json(const SettingDifference& difference) {
  return {{"name", difference.name}, {"file", difference.in_file}, {"board", difference.on_board}};
}

}  // namespace passo
