// One name, one meaning. In one namespace no two modules declare the same type, or a free function with the same name
// and parameters: in a program that links both, the compiler may use either for both, and no tool has to report it.
// Within a district a type's name is unique in all namespaces, because its readers omit the namespace. Two districts
// may use one short name for two types, each in its own namespace.
#include "declared_names.hpp"
#include "source_tree.hpp"

namespace passo {
namespace {

namespace fs = std::filesystem;

struct Place {
  std::string module;
  std::string where;  // "src/motion/path/segment.hpp:60"
};

// Names that two modules declare, with the places: "Action: src/board/chip/… src/motion/path/…".
class Doubles {
 public:
  void add(const std::string& module, const std::string& file, std::string_view text) {
    for (const DeclaredName& declared : declared_names(text)) {
      if (declared.name == "main") continue;
      const Place place{module, file + ":" + std::to_string(declared.line)};
      std::string name = declared.scope + "::" + declared.name;
      if (declared.kind == DeclaredName::Kind::type) {
        places_[district_of(file) + ": " + declared.name].push_back(place);
      } else {
        name += "(" + declared.parameters + ")";
      }
      places_[name].push_back(place);
    }
  }

  std::size_t names() const { return places_.size(); }

  std::vector<std::string> found() const {
    std::vector<std::string> doubles;
    for (const auto& [name, places] : places_) {
      std::set<std::string> modules;
      std::string line = name + ":";
      for (const Place& place : places) {
        modules.insert(place.module);
        line += " " + place.where;
      }
      if (modules.size() > 1) doubles.push_back(line);
    }
    return doubles;
  }

 private:
  // "src/motion/path/segment.hpp" -> "motion"
  static std::string district_of(const fs::path& file) { return std::next(file.begin())->string(); }

  std::map<std::string, std::vector<Place>> places_;
};

TEST(OneName, has_one_meaning_in_all_modules) {
  Doubles doubles;
  for (const fs::path& file : files_below("src", {".hpp", ".cpp"})) {
    if (!is_test(file)) doubles.add(module_of(file), file.string(), text_of(file));
  }
  EXPECT_GT(doubles.names(), 1800U);
  for (const std::string& found : doubles.found()) ADD_FAILURE() << "two modules declare " << found;
}

TEST(OneName, is_found_where_two_modules_declare_it) {
  Doubles doubles;
  doubles.add("path", "src/motion/a.hpp", R"(
    namespace passo {
    struct PlaneAxes { Axis first; };
    constexpr PlaneAxes axes_of(Plane plane) { return {}; }
    enum class Kind : std::uint8_t { line };
    using Tag = int;
    template <class T> class [[nodiscard]] Ring : public Base<T> { void push(T value); };
    bool operator==(const Plane& a, const Plane& b);
    void print(const std::vector<Mm>& values, std::map<int, bool> names = {}, unsigned most = 3);
    })");
  doubles.add("path", "src/motion/b.hpp", "namespace passo { void only_in_path(int a); }");
  doubles.add("path", "src/motion/b.cpp", "namespace passo { void only_in_path(int b) {} }");
  doubles.add("interpreter", "src/language/c.hpp", R"(
    namespace passo {
    class PlaneAxes final {};
    inline PlaneAxes axes_of(Plane) { if (true) { return {}; } return {}; }
    enum Kind { arc };
    namespace inner { struct Tag {}; }
    struct Ring { int entries[4] = {1, 2, 3, 4}; } the_ring;
    bool operator==(Plane a, Plane b) { return true; }
    void print(const std::vector<Mm>& v, std::map<int, bool> n, unsigned m);
    })");
  const std::vector<std::string> expected = {
      "passo::Kind: src/motion/a.hpp:5 src/language/c.hpp:5",
      "passo::PlaneAxes: src/motion/a.hpp:3 src/language/c.hpp:3",
      "passo::Ring: src/motion/a.hpp:7 src/language/c.hpp:7",
      "passo::axes_of(Plane): src/motion/a.hpp:4 src/language/c.hpp:4",
      "passo::operator==(Plane, Plane): src/motion/a.hpp:8 src/language/c.hpp:8",
      "passo::print(std::vector<Mm>, std::map<int,bool>, unsigned): src/motion/a.hpp:9 src/language/c.hpp:9",
  };
  EXPECT_EQ(doubles.found(), expected);
}

// `inner::Tag` of the test above is another type than `Tag` in another district, but not in the same one.
TEST(OneName, is_unique_within_a_district_in_all_namespaces) {
  Doubles doubles;
  doubles.add("path", "src/motion/a.hpp", "namespace passo { struct Tag {}; }");
  doubles.add("stepgen", "src/motion/b.hpp", "namespace passo::inner { struct Tag {}; }");
  EXPECT_EQ(doubles.found(), std::vector<std::string>({"motion: Tag: src/motion/a.hpp:1 src/motion/b.hpp:1"}));
}

TEST(OneName, is_free_where_no_other_file_can_mean_it) {
  Doubles doubles;
  doubles.add("path", "src/motion/a.cpp", R"(
    #include "x.hpp"
    #define OPEN \
      struct Macro {
    namespace passo {
    namespace { struct Hidden {}; int hidden(int x) { return x; } }
    struct Outer { struct Nested {}; void call(); enum class Kind { a }; };
    struct Ahead;
    static void own() {}
    void Outer::call() { struct Local {}; }
    constexpr int table[] = {1, 2};
    const auto text = "struct Quoted {"; const char brace = '{'; const auto raw = R"x(struct Raw {)x";
    void same_name(int a);
    })");
  doubles.add("ramp", "src/study/b.cpp", R"(
    namespace passo {
    namespace { struct Hidden {}; int hidden(int x) { return x; } }
    struct Other { struct Nested {}; void call(); enum class Kind { b }; };
    struct Ahead {};
    static void own() {}
    void Other::call() { struct Local {}; }
    struct Macro {}; struct Quoted {}; struct Raw {};  // struct Commented {
    constexpr int table[] = {1, 2};
    void same_name(double a);
    })");
  doubles.add("wire", "src/board/c.hpp", "namespace passo { /* struct Commented {}; */ struct Commented {}; }");
  EXPECT_EQ(doubles.found(), std::vector<std::string>());
}

}  // namespace
}  // namespace passo
