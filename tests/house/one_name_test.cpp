// One name, one meaning: no two modules declare a type of one name, or a free function of one name and parameters.
// Where two programs are linked from them the compiler may take either for both, and no tool has to say so.
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
      // A type's name has one meaning in every namespace: readers read it without.
      const std::string name = declared.kind == DeclaredName::Kind::type
                                   ? declared.name
                                   : declared.scope + "::" + declared.name + "(" + declared.parameters + ")";
      places_[name].push_back({module, file + ":" + std::to_string(declared.line)});
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
  std::map<std::string, std::vector<Place>> places_;
};

TEST(OneName, has_one_meaning_in_all_modules) {
  Doubles doubles;
  for (const fs::path& file : files_below("src", {".hpp", ".cpp"})) {
    if (!is_test(file)) doubles.add(module_of(file), file.string(), text_of(file));
  }
  EXPECT_GT(doubles.names(), 900U);
  for (const std::string& found : doubles.found()) ADD_FAILURE() << "two modules declare " << found;
}

TEST(OneName, is_found_where_two_modules_declare_it) {
  Doubles doubles;
  doubles.add("path", "a.hpp", R"(
    namespace passo {
    struct PlaneAxes { Axis first; };
    constexpr PlaneAxes axes_of(Plane plane) { return {}; }
    enum class Kind : std::uint8_t { line };
    using Tag = int;
    template <class T> class [[nodiscard]] Ring : public Base<T> { void push(T value); };
    bool operator==(const Plane& a, const Plane& b);
    void print(const std::vector<Mm>& values, std::map<int, bool> names = {}, unsigned most = 3);
    })");
  doubles.add("path", "b.hpp", "namespace passo { void only_in_path(int a); }");
  doubles.add("path", "b.cpp", "namespace passo { void only_in_path(int b) {} }");
  doubles.add("interpreter", "c.hpp", R"(
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
      "Kind: a.hpp:5 c.hpp:5",
      "PlaneAxes: a.hpp:3 c.hpp:3",
      "Ring: a.hpp:7 c.hpp:7",
      "Tag: a.hpp:6 c.hpp:6",
      "passo::axes_of(Plane): a.hpp:4 c.hpp:4",
      "passo::operator==(Plane, Plane): a.hpp:8 c.hpp:8",
      "passo::print(std::vector<Mm>, std::map<int,bool>, unsigned): a.hpp:9 c.hpp:9",
  };
  EXPECT_EQ(doubles.found(), expected);
}

TEST(OneName, is_free_where_no_other_file_can_mean_it) {
  Doubles doubles;
  doubles.add("path", "a.cpp", R"(
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
  doubles.add("ramp", "b.cpp", R"(
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
  doubles.add("wire", "c.hpp", "namespace passo { /* struct Commented {}; */ struct Commented {}; }");
  EXPECT_EQ(doubles.found(), std::vector<std::string>());
}

}  // namespace
}  // namespace passo
