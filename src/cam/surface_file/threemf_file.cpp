#include "threemf_file.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>

#include "zip_archive.hpp"
#include <fmt/format.h>

#include "passo/diagnostics/file_bytes.hpp"
#include "passo/diagnostics/xml_parser.hpp"
#include "passo/surface_file/surface_file.hpp"

namespace passo {
namespace {

constexpr std::size_t most_model_bytes = std::size_t{2} << 30U;  // unpacked; about 30 million triangles
constexpr std::size_t most_objects = 100'000;
constexpr std::size_t most_parts = 1'000'000;  // items and components, as placed
constexpr int deepest_parts = 16;              // components of components

// Row vectors: x' = x m[0] + y m[3] + z m[6] + m[9].
using Placement = std::array<double, 12>;
constexpr Placement in_place{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};

SurfacePoint placed(const SurfacePoint& p, const Placement& m) {
  return {p.x * m[0] + p.y * m[3] + p.z * m[6] + m[9], p.x * m[1] + p.y * m[4] + p.z * m[7] + m[10],
          p.x * m[2] + p.y * m[5] + p.z * m[8] + m[11]};
}

// First `inner`, then `outer`.
Placement combined(const Placement& inner, const Placement& outer) {
  Placement all{};
  for (std::size_t row = 0; row < 4; ++row) {
    for (std::size_t column = 0; column < 3; ++column) {
      double sum = row == 3 ? outer[9 + column] : 0;
      for (std::size_t k = 0; k < 3; ++k) sum += inner[3 * row + k] * outer[3 * k + column];
      all[3 * row + column] = sum;
    }
  }
  return all;
}

// A reference to an object. `path`: the file of the archive; empty: the same file.
struct PartOf3mf {
  std::string path;
  std::string object;
  Placement placement = in_place;
};

struct ObjectOf3mf {
  std::vector<SurfacePoint> vertices = {};  // in the unit of the file
  std::vector<std::array<std::uint32_t, 3>> triangles = {};
  std::vector<PartOf3mf> components = {};
  bool is_model = true;
};

struct ModelOf3mf {
  double unit = 1;  // mm
  std::map<std::string, ObjectOf3mf, std::less<>> objects = {};
  std::vector<PartOf3mf> items = {};
};

// The data that all model files of an archive share.
struct CountsOf3mf {
  std::size_t vertices = 0;
  std::size_t triangles = 0;
  std::size_t bytes = 0;
};

// The name without its namespace prefix: "p:path" becomes "path".
std::string_view local_name(std::string_view name) {
  const std::size_t colon = name.rfind(':');
  return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

// Reads one model file, element by element.
class ModelReader {
 public:
  explicit ModelReader(CountsOf3mf& counts) : counts_(counts) {
    if (parser_.get() != nullptr) XML_SetEntityDeclHandler(parser_.get(), &ModelReader::refuse_entity);
  }

  // Returns false if it cannot continue; fault() has the reason.
  bool take(std::string_view piece, bool is_last = false) {
    if (!fault_.empty()) return false;
    counts_.bytes += piece.size();
    if (counts_.bytes > most_model_bytes) return refuse("its models have over 2 GiB");
    return parser_.take(piece, is_last) || refuse(parser_.fault());
  }
  const std::string& fault() const { return fault_; }
  ModelOf3mf take_model() { return std::move(model_); }

  void begin(const char* name, const char** attributes) { open(local_name(name), attributes); }
  void end(const char* name) {
    if (local_name(name) == "object") object_ = nullptr;
  }

 private:
  static void XMLCALL refuse_entity(void* self, const XML_Char*, int, const XML_Char*, int, const XML_Char*,
                                    const XML_Char*, const XML_Char*, const XML_Char*) {
    static_cast<ModelReader*>(self)->refuse("it declares an entity");
  }

  bool refuse(const std::string& fault) {
    if (!fault_.empty()) return false;
    fault_ = fault;
    if (parser_.get() == nullptr) return false;
    fault_ += fmt::format(", line {} column {}", parser_.line(), parser_.column());
    parser_.stop();
    return false;
  }

  static std::string_view text_of(const XML_Char** attributes, std::string_view name) {
    for (; *attributes != nullptr; attributes += 2) {
      if (local_name(attributes[0]) == name) return attributes[1];
    }
    return {};
  }
  double number_of(const XML_Char** attributes, std::string_view name) {
    std::string_view text = text_of(attributes, name);
    if (text.starts_with('+')) text.remove_prefix(1);
    double value = 0;
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || stop != text.data() + text.size() || !std::isfinite(value)) {
      refuse(fmt::format("{}: expected a number, found '{}'", name, text.substr(0, 40)));
    }
    return value;
  }
  std::uint32_t index_of(const XML_Char** attributes, std::string_view name) {
    const std::string_view text = text_of(attributes, name);
    std::uint32_t value = 0;
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || stop != text.data() + text.size() || value >= object_->vertices.size()) {
      refuse(fmt::format("{}: expected the number of a vertex, found '{}'", name, text.substr(0, 40)));
      return 0;
    }
    return value;
  }
  Placement placement_of(const XML_Char** attributes) {
    std::string_view text = text_of(attributes, "transform");
    Placement placement = in_place;
    if (text.empty()) return placement;
    for (double& value : placement) {
      text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n+"), text.size()));
      const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
      if (error != std::errc() || !std::isfinite(value)) {
        refuse("transform: expected 12 numbers");
        return in_place;
      }
      text.remove_prefix(static_cast<std::size_t>(stop - text.data()));
    }
    return placement;
  }
  PartOf3mf part_of(const XML_Char** attributes) {
    std::string path(text_of(attributes, "path"));
    if (path.starts_with('/')) path.erase(0, 1);
    return {std::move(path), std::string(text_of(attributes, "objectid")), placement_of(attributes)};
  }

  void open(std::string_view name, const XML_Char** attributes) {
    if (name == "model") {
      open_model(text_of(attributes, "unit"));
    } else if (name == "object") {
      if (model_.objects.size() >= most_objects) {
        refuse("it has over 100,000 objects");
        return;
      }
      object_ = &model_.objects[std::string(text_of(attributes, "id"))];
      const std::string_view type = text_of(attributes, "type");
      object_->is_model = type.empty() || type == "model" || type == "surface";
    } else if (name == "item") {
      add_part(model_.items, attributes);
    } else if (object_ == nullptr) {
      return;
    } else if (name == "vertex") {
      if (++counts_.vertices > most_triangles) {
        refuse(fmt::format("it has over {} vertices", most_triangles));
        return;
      }
      object_->vertices.push_back({number_of(attributes, "x"), number_of(attributes, "y"), number_of(attributes, "z")});
    } else if (name == "triangle") {
      if (++counts_.triangles > most_triangles) {
        refuse(fmt::format("it has over {} triangles", most_triangles));
        return;
      }
      object_->triangles.push_back(
          {index_of(attributes, "v1"), index_of(attributes, "v2"), index_of(attributes, "v3")});
    } else if (name == "component") {
      add_part(object_->components, attributes);
    }
  }
  void add_part(std::vector<PartOf3mf>& parts, const XML_Char** attributes) {
    if (++parts_ > most_objects) {
      refuse("it has over 100,000 items and components");
      return;
    }
    parts.push_back(part_of(attributes));
  }
  void open_model(std::string_view unit) {
    constexpr std::pair<std::string_view, double> units[] = {
        {"", 1},         {"millimeter", 1}, {"micron", 1e-3}, {"centimeter", 10},
        {"meter", 1000}, {"inch", 25.4},    {"foot", 304.8}};
    for (const auto& [name, mm] : units) {
      if (name != unit) continue;
      model_.unit = mm;
      return;
    }
    refuse(fmt::format("unit: expected millimeter, micron, centimeter, meter, inch or foot, found '{}'",
                       unit.substr(0, 40)));
  }

  CountsOf3mf& counts_;
  XmlParser parser_{*this};
  ModelOf3mf model_;
  ObjectOf3mf* object_ = nullptr;
  std::size_t parts_ = 0;
  std::string fault_;
};

class ThreeMfReader {
 public:
  ThreeMfReader(const std::string& name, std::string_view bytes, Diagnostics& diagnostics)
      : name_(name), diagnostics_(diagnostics), archive_(bytes) {}

  std::vector<SurfaceTriangle> read() {
    if (!archive_.is_open()) {
      refuse("the archive is damaged", "a 3MF file that other programs can open");
      return {};
    }
    const std::string root = root_file();
    const ModelOf3mf* const model = model_in(root);
    if (model == nullptr) return {};
    unit_ = model->unit;
    for (const PartOf3mf& item : model->items) {
      if (!add(item, root, in_place, 0)) return {};
    }
    if (all_.empty()) refuse("has no triangle", "build items that refer to objects with meshes");
    return std::move(all_);
  }

 private:
  bool refuse(std::string message, std::string expected) {
    diagnostics_.add(of_file("surface.3mf", name_, std::move(message), std::move(expected)));
    return false;
  }

  // Returns the file that the archive names as its model. Most archives use the same name.
  std::string root_file() const {
    std::string relations;
    constexpr std::size_t most = 1 << 20U;
    const std::string fault = archive_.read("_rels/.rels", most, [&](std::string_view piece) {
      relations += piece;
      return true;
    });
    std::string usual = "3D/3dmodel.model";
    if (!fault.empty()) return usual;
    for (std::size_t at = relations.find("<Relationship "); at != std::string::npos;
         at = relations.find("<Relationship ", at + 1)) {
      const std::string_view element = std::string_view(relations).substr(at, relations.find('>', at) - at);
      if (element.find("/3dmodel\"") == std::string_view::npos) continue;
      constexpr std::string_view target = "Target=\"";
      const std::size_t begin = element.find(target);
      if (begin == std::string_view::npos) continue;
      const std::string_view rest = element.substr(begin + target.size());
      std::string path(rest.substr(0, rest.find('"')));
      if (path.starts_with('/')) path.erase(0, 1);
      if (archive_.has(path)) return path;
    }
    return usual;
  }

  // The model in a file of the archive. Null, with a message: it cannot be read.
  const ModelOf3mf* model_in(const std::string& path) {
    if (const auto known = models_.find(path); known != models_.end()) return &known->second;
    if (models_.size() >= most_models) {
      refuse("it consists of over 1,000 files", "a 3MF file of one part");
      return nullptr;
    }
    ModelReader reader(counts_);
    std::string fault =
        archive_.read(path, most_model_bytes, [&](std::string_view piece) { return reader.take(piece); });
    if (fault.empty() && (!reader.fault().empty() || !reader.take({}, true))) {
      fault = fmt::format("'{}' is not a 3MF model: {}", path, reader.fault());
    }
    if (!fault.empty()) {
      refuse(std::move(fault), "a 3MF file that other programs can open");
      return nullptr;
    }
    return &models_.emplace(path, reader.take_model()).first->second;
  }

  bool add(const PartOf3mf& part, const std::string& from, const Placement& outer, int depth) {
    if (depth > deepest_parts || ++parts_ > most_parts) {
      return refuse("its components contain each other", "components of at most 16 levels");
    }
    const std::string& path = part.path.empty() ? from : part.path;
    const ModelOf3mf* const model = model_in(path);
    if (model == nullptr) return false;
    const auto found = model->objects.find(part.object);
    if (found == model->objects.end()) {
      return refuse(fmt::format("object '{}' is missing", part.object.substr(0, 40)), "the number of an object");
    }
    const ObjectOf3mf& object = found->second;
    if (!object.is_model) return true;
    const Placement placement = combined(part.placement, outer);
    if (object.triangles.size() > most_triangles - all_.size()) {
      return refuse("has too many triangles", fmt::format("at most {}", most_triangles));
    }
    for (const auto& corners : object.triangles) {
      SurfaceTriangle triangle{};
      for (std::size_t i = 0; i < 3; ++i) {
        const SurfacePoint p = placed(object.vertices[corners[i]], placement);
        triangle[i] = {p.x * unit_, p.y * unit_, p.z * unit_};
        const double far = std::max({std::abs(triangle[i].x), std::abs(triangle[i].y), std::abs(triangle[i].z)});
        if (!(far <= farthest_surface)) {
          return refuse("a triangle is too far away", fmt::format("coordinates of at most {:g} mm", farthest_surface));
        }
      }
      all_.push_back(triangle);
    }
    return std::ranges::all_of(object.components,
                               [&](const PartOf3mf& component) { return add(component, path, placement, depth + 1); });
  }

  static constexpr std::size_t most_models = 1000;
  const std::string& name_;
  Diagnostics& diagnostics_;
  ZipArchive archive_;
  std::map<std::string, ModelOf3mf, std::less<>> models_;
  CountsOf3mf counts_;
  double unit_ = 1;  // mm, of the root
  std::size_t parts_ = 0;
  std::vector<SurfaceTriangle> all_;
};

}  // namespace

bool looks_like_3mf(std::string_view bytes) {
  return bytes.starts_with("PK\x03\x04") && bytes.find(".model") != std::string_view::npos;
}

std::vector<SurfaceTriangle> read_3mf(const std::string& name, std::string_view bytes, Diagnostics& diagnostics) {
  return ThreeMfReader(name, bytes, diagnostics).read();
}

}  // namespace passo
