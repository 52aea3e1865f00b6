#include "camera_reader.hpp"

#include <string>
#include <utility>
#include <variant>

#include "machine_file_sentences.hpp"
#include <fmt/format.h>

#include "passo/diagnostics/diagnostic.hpp"
#include "passo/toml/fit_for_parser.hpp"
#include "passo/toml/toml_document.hpp"

namespace passo {
namespace {

const char* const camera_code = "machine.camera";
constexpr std::string_view url_key = "url";
constexpr std::string_view snapshot_key = "snapshot";
constexpr std::string_view mirrored_key = "mirrored";
constexpr NumberKey offset_key{"offset_mm", -1000, 1000, "[42.5, -3.1]"};
constexpr NumberKey rotation_key{"rotation_deg", 0, 270, "180"};
constexpr int quarter_turn = 90;

std::optional<HttpUrl> read_url(TableReader& reader, std::string_view key, std::string_view example, Need need) {
  const auto text = reader.text(key, example, need);
  if (!text) return {};
  auto url = parse_http_url(*text);
  if (!url) {
    reader.error(camera_code, key, machine_file_says::camera_url.with({{"key", reader.full_name(key)}}),
                 fmt::format("http://HOST:PORT/PATH without a user name, e.g. {} = \"{}\"", key, example));
  }
  return url;
}

int read_rotation(TableReader& reader) {
  const auto degrees = reader.whole_number(rotation_key, Need::optional);
  if (!degrees) return 0;
  const int rotation = static_cast<int>(*degrees);
  if (rotation % quarter_turn == 0) return rotation;
  reader.error(camera_code, rotation_key.name, fmt::format("{} is {}", reader.full_name(rotation_key.name), rotation),
               "0, 90, 180 or 270");
  return 0;
}

CameraDescription read_camera(TableReader& reader) {
  CameraDescription camera;
  if (auto url = read_url(reader, url_key, "http://192.168.1.20:8080/stream", Need::required)) camera.stream = *url;
  camera.snapshot = read_url(reader, snapshot_key, "http://192.168.1.20:8080/snapshot", Need::optional);
  if (const auto offset = reader.low_high(offset_key, Need::optional)) {
    camera.offset_x = Mm(offset->low);
    camera.offset_y = Mm(offset->high);
  }
  camera.rotation = read_rotation(reader);
  camera.is_mirrored = reader.flag(mirrored_key).value_or(false);
  return camera;
}

}  // namespace

void check_camera(const TomlEntry& entry, const TomlReporter& reporter, const std::function<void(TableReader&)>& end) {
  TableReader reader(std::get<TomlTable>(entry.value.content), "camera", entry.place, reporter);
  static_cast<void>(read_camera(reader));
  end(reader);
}

std::optional<CameraDescription> parse_camera(std::string_view machine_file) {
  if (machine_file.starts_with("\xEF\xBB\xBF")) machine_file.remove_prefix(3);
  Diagnostics found;
  const TomlReporter reporter(machine_file, "", found);
  TomlDocument document;
  if (is_fit_for_parser(reporter)) document = parse_toml(std::string(machine_file), reporter);
  const TomlEntry* const entry = find(document.root, "camera");
  const auto* const table = entry != nullptr ? std::get_if<TomlTable>(&entry->value.content) : nullptr;
  if (table == nullptr) return {};
  TableReader reader(*table, "camera", entry->place, reporter);
  CameraDescription camera = read_camera(reader);
  return found.any_error() ? std::nullopt : std::optional(std::move(camera));
}

Point under_cross_hair(const CameraDescription& camera, const Point& tool) {
  Point place = tool;
  place[Axis::x] += camera.offset_x.value();
  place[Axis::y] += camera.offset_y.value();
  return place;
}

}  // namespace passo
